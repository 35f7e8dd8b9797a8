// SPDX-License-Identifier: MIT
// wall_root_check [CASES] [SEED]: proves the answers of first_wall_root() to random gaps (1e6 unless told),
// prints what came of it, exits with 1 when any answer is wrong.
#include <cstdio>
#include <cstdlib>

#include "wall_root_proof.hpp"

int main(int argc, char** argv) {
  using namespace shakedown;
  const std::int64_t cases = argc > 1 ? std::llround(std::strtod(argv[1], nullptr)) : 1'000'000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  const WallRootSurvey survey = survey_wall_roots(cases, seed);
  std::printf("%-30s %9s %9s %8s %8s %11s %10s %15s\n", "case", "cases", "roots", "missed", "early",
              "redetected", "undecided", "worst rounding");
  for (std::size_t k = 0; k < survey.kinds.size(); ++k) {
    const WallRootSurvey::Kind& kind = survey.kinds[k];
    std::printf("%-30s %9lld %9lld %8lld %8lld %11lld %10lld %15.2f\n", wall_root_case_names[k],
                static_cast<long long>(kind.cases), static_cast<long long>(kind.roots),
                static_cast<long long>(kind.verdicts[1]), static_cast<long long>(kind.verdicts[2]),
                static_cast<long long>(kind.verdicts[3]), static_cast<long long>(kind.verdicts[4]),
                kind.worst_rounding);
  }
  std::printf("%lld of %lld answers wrong, %.1f intervals proved free of a root per case\n",
              static_cast<long long>(survey.wrong()), static_cast<long long>(cases),
              static_cast<double>(survey.intervals) / static_cast<double>(cases));
  std::printf("rounding: the gap at the answer in units of 2^-53 (R (1 + W t) + |c| + |u| t)\n");
  if (survey.wrong() > 0) std::printf("first wrong: %s\n", survey.first_wrong.c_str());
  return survey.wrong() > 0 ? 1 : 0;
}
