// SPDX-License-Identifier: MIT
// Drops drawn from each law: 95 % intervals hold the truth, and the law is found where it can be told.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "law_choice.hpp"
#include "made_drops.hpp"

using namespace shakedown;

namespace {

/// A law with numbers, noise and a design drawn anew each time.
struct Drawn {
  MadeBall ball;
  std::vector<double> speeds;
  int flights = 0;
};

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }
double log_between(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

Drawn drawn(LawKind law, bool scattering, Random& random) {
  Drawn one;
  one.ball.law = law;
  one.ball.parameters = {between(random, 0.6, 0.93)};
  if (law == LawKind::power) one.ball.parameters.push_back(between(random, 0.01, 0.15));
  if (law == LawKind::plastic) one.ball.parameters[0] = between(random, 0.4, 0.7);
  one.ball.timing = log_between(random, 5e-5, 1e-3);
  one.ball.scatter = scattering ? log_between(random, 0.002, 0.02) : 0;
  const int drops = 1 + static_cast<int>(6 * random.uniform());
  const double fastest = between(random, 2, 5);
  for (int i = 0; i < drops; ++i) one.speeds.push_back(fastest * between(random, 0.6, 1));
  one.flights = 5 + static_cast<int>(6 * random.uniform());
  return one;
}

struct Count {
  int held = 0, all = 0;
  void add(const Estimate& estimate, double truth) {
    held += estimate.low <= truth && truth <= estimate.high, ++all;
  }
  double share() const { return static_cast<double>(held) / std::max(1, all); }
};

struct Coverage {
  Count restitution, second, slow, fast, averaged, scatter, timing;
  int named = 0, in_answer = 0, all = 0, false_outliers = 0, impacts = 0;
};

void add_case(const Drawn& one, std::uint64_t seed, std::uint64_t run, Coverage& coverage) {
  Random random(seed, run, Stream::hidden);
  const std::vector<Drop> drops = made_drops(one.ball, one.speeds, one.flights, random);
  BounceOptions options;
  options.reference = one.ball.reference;
  const BounceAnswer answer = choose_law(drops, options);
  double mass = 0;
  bool within = false;
  for (const LawFit& law : answer.laws) {
    const bool true_one = law.model.law == one.ball.law && law.model.air == AirModel::none;
    within = within || (true_one && mass < 0.95);
    mass += law.probability;
    if (!true_one) continue;
    coverage.restitution.add(law.values[0], one.ball.parameters[0]);
    if (one.ball.parameters.size() > 1) coverage.second.add(law.values[1], one.ball.parameters[1]);
    const auto truth = [&](double speed) {
      return restitution(one.ball.law, one.ball.parameters, speed, one.ball.reference);
    };
    coverage.slow.add(law.restitution_at(answer.slowest), truth(answer.slowest));
    coverage.fast.add(law.restitution_at(answer.fastest), truth(answer.fastest));
    coverage.timing.add(law.posterior.spread(&SpreadNode::timing), one.ball.timing);
    if (one.ball.scatter > 0)
      coverage.scatter.add(law.posterior.spread(&SpreadNode::scatter), one.ball.scatter);
    coverage.averaged.add(answer.averaged_at(answer.reference), truth(answer.reference));
  }
  coverage.named += answer.best().model.law == one.ball.law && answer.best().model.air == AirModel::none;
  coverage.in_answer += within;
  coverage.false_outliers += static_cast<int>(answer.outliers.size());
  coverage.impacts += static_cast<int>(answer.best().at.rows.size());
  ++coverage.all;
}

Coverage measured(LawKind law, bool scattering, int cases, std::uint64_t seed) {
  Coverage coverage;
  for (int i = 0; i < cases; ++i) {
    Random random(seed, static_cast<std::uint64_t>(i), Stream::other);
    add_case(drawn(law, scattering, random), seed, static_cast<std::uint64_t>(i), coverage);
  }
  return coverage;
}

std::string described(const char* name, const Coverage& c) {
  const auto percent = [](const Count& count) { return 100 * count.share(); };
  return fmt::format(
      "{:<14} {:4} cases: restitution {:.1f} %, exponent {:.1f}, slowest {:.1f}, fastest {:.1f}, averaged "
      "over the laws {:.1f}, scatter {:.1f}, timing {:.1f}; named {:.1f} %, in the 95 % set {:.1f}; false "
      "outliers "
      "{} "
      "of {} impacts",
      name, c.all, percent(c.restitution), percent(c.second), percent(c.slow), percent(c.fast),
      percent(c.averaged), percent(c.scatter), percent(c.timing), 100.0 * c.named / c.all,
      100.0 * c.in_answer / c.all, c.false_outliers, c.impacts);
}

class SlowCoverage : public testing::TestWithParam<std::tuple<const char*, LawKind, bool>> {};

}  // namespace

TEST_P(SlowCoverage, IntervalsHoldTheTruth) {
  const auto& [name, law, scattering] = GetParam();
  const auto asked = [](const char* variable, int otherwise) {
    const char* text = std::getenv(variable);
    return text ? std::atoi(text) : otherwise;
  };
  const int cases = asked("SHAKEDOWN_CASES", 24);
  const Coverage coverage =
      measured(law, scattering, cases, static_cast<std::uint64_t>(asked("SHAKEDOWN_SEED", 20260901)));
  fmt::print("{}\n", described(name, coverage));
  // Three deviations of a share of 95 %.
  const double least = 0.95 - 3 * std::sqrt(0.95 * 0.05 / cases);
  for (const Count* count : {&coverage.restitution, &coverage.slow, &coverage.fast})
    EXPECT_GE(count->share(), least);
  if (coverage.second.all > 0) {
    EXPECT_GE(coverage.second.share(), least);
  }
}

INSTANTIATE_TEST_SUITE_P(SlowLaws, SlowCoverage,
                         testing::Values(std::tuple{"constant", LawKind::constant, false},
                                         std::tuple{"viscoelastic", LawKind::viscoelastic, false},
                                         std::tuple{"power", LawKind::power, false},
                                         std::tuple{"plastic", LawKind::plastic, false},
                                         std::tuple{"scattering", LawKind::constant, true},
                                         std::tuple{"power_scattering", LawKind::power, true},
                                         std::tuple{"viscoelastic_scattering", LawKind::viscoelastic, true}),
                         [](const auto& one) { return std::string(std::get<0>(one.param)); });
