// SPDX-License-Identifier: MIT
#include "wall_root_proof.hpp"

#include <algorithm>
#include <cstdio>
#include <numbers>

namespace shakedown {

namespace {

using Real = long double;  // 64 bits of mantissa at least: its own rounding is 2^-11 of what is asked about

struct PreciseGap {
  Real a, b, w, c, u, amplitude, curvature;
  explicit PreciseGap(const HarmonicGap& gap)
      : a(gap.a),
        b(gap.b),
        w(gap.angular_frequency),
        c(gap.c),
        u(gap.u),
        amplitude(std::hypot(a, b)),
        curvature(amplitude * w * w) {}
  struct Value {
    Real gap, rate;
  };
  Value at(Real t) const {
    const Real cosine = std::cos(w * t), sine = std::sin(w * t);
    return {a * cosine + b * sine + c - u * t, w * (b * cosine - a * sine) - u};
  }
  /// One unit of rounding of the gap in double precision, phase and time included.
  Real unit(Real t) const { return 0x1p-53L * (amplitude * (1 + w * t) + std::abs(c) + std::abs(u) * t); }
};

/// Rounding that an answer may show. Seen: 3.
constexpr Real allowed_units = 8;

enum class Free { yes, no, undecided };

/// Proves that the gap stays above -delta on [low, high], or finds a point where it does not.
Free stays_above(const PreciseGap& gap, Real low, Real high, Real delta, int depth, std::int64_t& intervals) {
  ++intervals;
  const Real middle = low + (high - low) / 2, half = (high - low) / 2;
  const PreciseGap::Value value = gap.at(middle);
  if (value.gap < -delta) return Free::no;
  if (value.gap - std::abs(value.rate) * half - gap.curvature * half * half / 2 >= -delta) return Free::yes;
  if (depth == 0) return Free::undecided;
  const Free left = stays_above(gap, low, middle, delta, depth - 1, intervals);
  return left != Free::yes ? left : stays_above(gap, middle, high, delta, depth - 1, intervals);
}

double log_uniform(Random& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}
double sign(Random& random) { return random.uniform() < 0.5 ? -1 : 1; }

/// A box like the paper's at a random phase of a random amplitude, a grain somewhere in it.
HarmonicGap damper_gap(Random& random) {
  const double w = 2 * std::numbers::pi * 1.23, amplitude = 0.1075 * random.uniform(),
               phase = 2 * std::numbers::pi * random.uniform();
  const double a = amplitude * std::cos(phase);
  return {a, amplitude * std::sin(phase), w, 0.1 * random.uniform() - a, w * 0.1075 * random.normal()};
}

/// Lifts the gap so that the minimum of a random period nearly, or by a hair, touches zero; nothing happens
/// before.
HarmonicGap grazing_gap(Random& random) {
  HarmonicGap gap = damper_gap(random);
  const double amplitude = std::hypot(gap.a, gap.b), w = gap.angular_frequency;
  const double choice = random.uniform();
  gap.u = w * amplitude * random.uniform() *
          (choice < 0.2   ? 0.0
           : choice < 0.4 ? -1.0
           : choice < 0.6 ? 1e-3
                          : 1.0);
  const Real phi = std::atan2(Real(gap.b), Real(gap.a)), tilt = std::asin(Real(gap.u) / (w * amplitude));
  const Real pi = std::numbers::pi_v<Real>;
  // later minima are lower only then
  const int period = gap.u > 0 ? static_cast<int>(4 * random.uniform()) : 0;
  Real phase = phi + pi + tilt + 2 * pi * period;  // a minimum: sin(Wt - phi) = -u / (W R), rising
  if (phase < 0) phase += 2 * pi;
  if (gap.u <= 0) phase = std::fmod(phase, 2 * pi);
  const Real lowest = PreciseGap(gap).at(phase / w).gap - gap.c;
  gap.c = static_cast<double>(-lowest);
  if (random.uniform() < 0.9) gap.c += sign(random) * log_uniform(random, 1e-19, 1e-6);
  // a receding grain can start below its first minimum
  return gap.a + gap.c >= 0 ? gap : grazing_gap(random);
}

/// A gap of zero but for rounding that opens, fast or hardly.
HarmonicGap just_left_gap(Random& random) {
  HarmonicGap gap = damper_gap(random);
  gap.c = -gap.a;
  const double few_units = std::floor(5 * random.uniform()) - 2;
  if (random.uniform() < 0.5) gap.c += few_units * 0x1p-53 * std::abs(gap.a);
  gap.u = gap.angular_frequency * gap.b - log_uniform(random, 1e-12, 2);
  return gap;
}

/// A gap that closes soon, fast or hardly: what is asked most.
HarmonicGap gap_just_ahead(Random& random) {
  HarmonicGap gap = damper_gap(random);
  gap.c = log_uniform(random, 1e-12, 1e-1) - gap.a;
  gap.u = gap.angular_frequency * gap.b + log_uniform(random, 1e-9, 2);
  return gap;
}

}  // namespace

HarmonicGap random_gap(WallRootCase kind, Random& random) {
  HarmonicGap gap = damper_gap(random);
  const double top_speed = std::hypot(gap.a, gap.b) * gap.angular_frequency;
  switch (kind) {
    case WallRootCase::damper: break;
    case WallRootCase::fast: gap.u = sign(random) * top_speed * log_uniform(random, 1, 1e6); break;
    case WallRootCase::slow: gap.u = sign(random) * top_speed * log_uniform(random, 1e-2, 1); break;
    case WallRootCase::grazing: gap = grazing_gap(random); break;
    case WallRootCase::just_left: gap = just_left_gap(random); break;
    case WallRootCase::tiny_amplitude: {
      const double shrink = log_uniform(random, 1e-14, 1e-3);
      gap.c += gap.a * (1 - shrink);
      gap.a *= shrink;
      gap.b *= shrink;
      gap.u *= random.uniform() < 0.5 ? 1 : shrink * 10;
      break;
    }
    case WallRootCase::many_periods:
      gap.u = 0.1 * gap.angular_frequency / (2 * std::numbers::pi) / log_uniform(random, 1, 1e6);
      break;
    case WallRootCase::equal_top_speed:
      gap.u = sign(random) * top_speed * (1 + sign(random) * log_uniform(random, 1e-17, 1e-2));
      break;
    case WallRootCase::rest: gap.u = 0; break;
    case WallRootCase::just_ahead: gap = gap_just_ahead(random); break;
    case WallRootCase::any_scale: {
      const double amplitude = log_uniform(random, 1e-9, 1e3),
                   phase = 2 * std::numbers::pi * random.uniform();
      gap.angular_frequency = log_uniform(random, 1e-3, 1e5);
      gap.a = amplitude * std::cos(phase);
      gap.b = amplitude * std::sin(phase);
      gap.c = amplitude * log_uniform(random, 1e-9, 1e3) - gap.a;
      gap.u = sign(random) * amplitude * gap.angular_frequency * log_uniform(random, 1e-2, 1e3);
      break;
    }
  }
  return gap;
}

WallRootProof prove(const HarmonicGap& given, double answer) {
  const PreciseGap gap(given);
  const Real period = 2 * std::numbers::pi_v<Real> / gap.w;
  // Without an answer two periods decide: g(t + P) = g(t) - u P is no lower from then on when u <= 0.
  if (answer == never && gap.u > 0) {
    // 1e12 periods, wall_root.hpp
    const bool beyond_the_horizon = gap.c - gap.amplitude > 0.99e12L * gap.u * period;
    return {beyond_the_horizon ? WallRootVerdict::right : WallRootVerdict::missed, 0, 0};
  }
  const Real end = answer == never ? 2 * period : Real(answer);
  // By the same identity nothing is below -delta before the last periods when nothing is within them (u > 0).
  const Real begin = gap.u > 0 ? std::max(Real(0), end - 100 * period) : 0;
  const Real unit = gap.unit(end), delta = allowed_units * unit;
  WallRootProof proof{WallRootVerdict::right, 0, 0};
  // The start may be on the wall: there the gap must be opening, or the answer is the start itself.
  Real low = begin;
  const int pieces = static_cast<int>(std::min<Real>(400, std::ceil((end - begin) / (period / 4))));
  for (int piece = 0; piece < pieces; ++piece) {
    const Real high = begin + (end - begin) * (piece + 1) / pieces;
    const Free free = stays_above(gap, low, high, delta, 60, proof.intervals);
    if (free != Free::yes) {
      proof.verdict = free == Free::no ? WallRootVerdict::missed : WallRootVerdict::undecided;
      return proof;
    }
    low = high;
  }
  if (answer == never) return proof;
  const PreciseGap::Value last = gap.at(end);
  if (unit > 0) proof.rounding = static_cast<double>(std::abs(last.gap) / unit);
  if (last.gap > delta) proof.verdict = WallRootVerdict::early;
  // A rate that this much rounding of the gap, or its own rounding, can turn round is not opening.
  const Real rate_rounding =
      std::sqrt(2 * gap.curvature * delta) +
      allowed_units * 0x1p-53L * (gap.amplitude * gap.w * (1 + gap.w * end) + std::abs(gap.u));
  if (last.rate > rate_rounding) proof.verdict = WallRootVerdict::redetected;
  return proof;
}

std::int64_t WallRootSurvey::wrong() const {
  std::int64_t sum = 0;
  for (const Kind& kind : kinds) sum += kind.wrong();
  return sum;
}

WallRootSurvey survey_wall_roots(std::int64_t cases, std::uint64_t seed) {
  WallRootSurvey survey;
  Random random(seed, 0, Stream::other);
  for (std::int64_t n = 0; n < cases; ++n) {
    const std::size_t k = static_cast<std::size_t>(n) % survey.kinds.size();
    const HarmonicGap gap = random_gap(static_cast<WallRootCase>(k), random);
    const double answer = first_wall_root(gap);
    const WallRootProof proof = prove(gap, answer);
    WallRootSurvey::Kind& kind = survey.kinds[k];
    ++kind.cases;
    kind.roots += answer < never;
    ++kind.verdicts[static_cast<std::size_t>(proof.verdict)];
    kind.worst_rounding = std::max(kind.worst_rounding, proof.rounding);
    survey.intervals += proof.intervals;
    if (proof.verdict != WallRootVerdict::right && survey.first_wrong.empty()) {
      std::array<char, 400> text;
      std::snprintf(text.data(), text.size(),
                    "%s, %s: a = %.17g, b = %.17g, W = %.17g, c = %.17g, u = %.17g: answer %.17g",
                    wall_root_case_names[k], wall_root_verdict_names[static_cast<std::size_t>(proof.verdict)],
                    gap.a, gap.b, gap.angular_frequency, gap.c, gap.u, answer);
      survey.first_wrong = text.data();
    }
  }
  return survey;
}

}  // namespace shakedown
