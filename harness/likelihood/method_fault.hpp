// SPDX-License-Identifier: MIT
// Mistakes put into the method on purpose, one at a time: a trial of the diagnosis is worth something when it
// notices them.
#pragma once
#include <array>
#include <string_view>

namespace shakedown {

enum class MethodFault {
  none,
  in_sample,      ///< weights and spread from the same simulations
  no_refit,       ///< the user's restitutions and frequency are taken for the truth
  no_centre,      ///< the grains' positions are thrown away
  wrong_sign,     ///< the first knob's sensitivity has the wrong sign
  noise_tenfold,  ///< the camera's noise is taken for ten times what the frames say
};
constexpr std::array<std::string_view, 6> method_fault_names{"none",      "in-sample",  "no-refit",
                                                             "no-centre", "wrong-sign", "noise-tenfold"};

}  // namespace shakedown
