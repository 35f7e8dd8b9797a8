// SPDX-License-Identifier: MIT
// The engines that every property is tested on, each with the promises it makes. A new engine is one more
// entry.
#pragma once
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "bullet_engine.hpp"
#include "hard_engine.hpp"
#include "soft_engine.hpp"

namespace shakedown {

struct EngineUnderTest {
  std::string name;
  std::function<std::unique_ptr<Engine>()> make;
  /// Largest error of the restitution of a binary impact with contacts of 20 and of 50 steps, unit: 1.
  double restitution_error_coarse, restitution_error_fine;
  double ledger_error;    ///< of E0
  double momentum_error;  ///< of M Omega Delta0
};

inline void PrintTo(const EngineUnderTest& engine, std::ostream* out) { *out << engine.name; }

inline std::vector<EngineUnderTest> engines_under_test() {
  return {
      {"hard", [] { return make_hard_engine(); }, 1e-12, 1e-12, 1e-12, 1e-12},
      {"soft", [] { return make_soft_engine(); }, 3.5e-3, 6e-4, 1e-12, 1e-12},
      {"bullet", [] { return make_bullet_engine(); }, 2e-4, 2e-4, 1e-12, 1e-12},
  };
}

}  // namespace shakedown
