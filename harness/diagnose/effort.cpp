// SPDX-License-Identifier: MIT
#include "effort.hpp"

#include <array>

namespace shakedown {

std::span<const Rule> effort_rules() {
  using namespace effort;
  static constexpr std::array all{far_off,  glance_sees, glance_tells,      well_seen,      signature_errs,
                                  hopeless, moves_along, short_fits_differ, short_fits_err, astray};
  return all;
}

}  // namespace shakedown
