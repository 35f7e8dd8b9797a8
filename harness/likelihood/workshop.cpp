// SPDX-License-Identifier: MIT
#include "workshop.hpp"

#include "errors.hpp"

namespace shakedown {

void Workshop::ask(std::int64_t more) const {
  if (execution.stopped()) throw Interrupted("interrupted");
  if (meter.ask_for) meter.ask_for(more);
}

}  // namespace shakedown
