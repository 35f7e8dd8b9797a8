// SPDX-License-Identifier: MIT
// A soft run keeps book of work by class of contact, work of each effect, and impulse from outside.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "physics.hpp"

namespace shakedown {

/// A sum that carries its rounding along (Neumaier), so that millions of tiny works add up without drift.
class CompensatedSum {
 public:
  void operator+=(double term) {
    const double sum = sum_ + term;
    carry_ += std::abs(sum_) >= std::abs(term) ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }
  double value() const { return sum_ + carry_; }  ///< the sum, with what rounding has left out

 private:
  double sum_ = 0, carry_ = 0;
};

struct Accounts {
  std::array<CompensatedSum, contact_classes> contact_work;  ///< J, done by contacts on grains and box
  std::vector<CompensatedSum> effect_work;                   ///< J, done by each line of Setup::effects
  CompensatedSum outer_impulse;  ///< N s along x, from spring, clamp and fields on box and grains
  std::array<std::int64_t, contact_classes> collisions{};  ///< first touches
  double deepest_overlap = 0;                              ///< m

  /// Adds work, J, to the line of an effect; an effect of -1 has none.
  void add_work(int effect, double work) {
    if (effect >= 0) effect_work[static_cast<std::size_t>(effect)] += work;
  }
};

}  // namespace shakedown
