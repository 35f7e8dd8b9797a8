// SPDX-License-Identifier: MIT
#include "workshop.hpp"

#include "errors.hpp"

namespace shakedown {

void Execution::ask(std::int64_t more) const {
  if (stop && *stop) throw Interrupted("interrupted");
  if (ask_for) ask_for(more);
}

}  // namespace shakedown
