// SPDX-License-Identifier: MIT
// A proof, case by case, that first_wall_root() misses no root and invents none, by a method that shares
// nothing with it: interval bisection on the derivative bounds |g''| <= R W^2, in extended precision.
//
// An answer t is right when it is the first root of a gap that differs from the given one by no more than
// rounding, delta:
//   missed      the gap is below -delta somewhere before t (every sub-interval is proved free of that, or
//   refutes the answer); early       the gap at t is above +delta; redetected  the gap opens at t: the wall
//   that the grain has just left.
// Nothing else can be asked near a tangent, where half a unit in the last place of the room decides whether
// there is a root at all.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "random.hpp"
#include "wall_root.hpp"

namespace shakedown {

enum class WallRootCase {
  damper,
  fast,
  slow,
  grazing,
  just_left,
  tiny_amplitude,
  many_periods,
  equal_top_speed,
  rest,
  any_scale,
  just_ahead
};
constexpr std::array<const char*, 11> wall_root_case_names{
    "as in a damper",     "fast grain",     "slow grain",       "grazing",
    "just left the wall", "tiny amplitude", "many periods",     "grain at the wall's top speed",
    "grain at rest",      "any scale",      "a wall just ahead"};

enum class WallRootVerdict { right, missed, early, redetected, undecided };
constexpr std::array<const char*, 5> wall_root_verdict_names{"right", "missed", "early", "redetected",
                                                             "undecided"};

HarmonicGap random_gap(WallRootCase kind, Random& random);

/// `rounding`: |gap| at the answer, in units of 2^-53 times the terms that are summed in it.
struct WallRootProof {
  WallRootVerdict verdict;
  double rounding;
  std::int64_t intervals;
};
WallRootProof prove(const HarmonicGap& gap, double answer);

/// What came of `cases` random gaps, all kinds in turn.
struct WallRootSurvey {
  struct Kind {
    std::int64_t cases = 0, roots = 0;
    std::array<std::int64_t, wall_root_verdict_names.size()> verdicts{};
    double worst_rounding = 0;
    std::int64_t wrong() const { return cases - verdicts[0]; }
  };
  std::array<Kind, wall_root_case_names.size()> kinds;
  std::int64_t intervals = 0;
  std::string first_wrong;  ///< the numbers of the first wrong answer
  std::int64_t wrong() const;
};
WallRootSurvey survey_wall_roots(std::int64_t cases, std::uint64_t seed);

}  // namespace shakedown
