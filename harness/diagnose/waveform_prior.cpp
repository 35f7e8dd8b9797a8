// SPDX-License-Identifier: MIT
// Lists the laws for a waveform, and says what each is worth beforehand.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "effect_strength.hpp"
#include "known_effects.hpp"
#include "rules.hpp"
#include "waveform_search.hpp"

namespace shakedown {

namespace {

constexpr double impossible = -std::numeric_limits<double>::infinity();

/// Chance of a line in noise above which a second swing is not even asked for.
constexpr double one_in_a_thousand = 1e-3;

/// Returns the ln density of a strength beforehand (Cauchy about none).
double log_cauchy(double strength, double typical, bool one_sided) {
  const double ratio = strength / typical;
  return std::log((one_sided ? 2 : 1) / (std::numbers::pi * typical * (1 + ratio * ratio)));
}

}  // namespace

bool say_the_same(const WaveformLaw& one, const WaveformLaw& other) {
  return !one.family.empty() && one.family == other.family && (one.only_waveform || other.only_waveform);
}

bool says_it_twice(const WaveformFit& fit, std::size_t which) {
  return std::any_of(fit.laws.begin(), fit.laws.begin() + static_cast<std::ptrdiff_t>(which),
                     [&](const WaveformLaw& other) { return say_the_same(fit.laws[which], other); });
}

std::vector<WaveformLaw> waveform_laws(const Setup& setup, KnownEffects known) {
  std::vector<WaveformLaw> laws;
  for (const MomentumTerm& term : momentum_terms(setup, known, true)) {
    const EffectRecord* record = known.find(term.effect);
    if (record == nullptr) continue;
    const Search search = search_of(*record);
    const bool on_box = record->acts_on == ActsOn::box || search.in_waveform;
    if (!on_box) continue;
    WaveformLaw law{
        term, search.harmonic.has_value(), search.in_waveform, std::string(record->family), "", "", ""};
    if (search.harmonic) {
      const auto key = [&](std::string_view parameter) {
        return parameter.empty() ? "" : std::string(record->name) + "." + std::string(parameter);
      };
      law.frequency_key = key(search.harmonic->frequency), law.phase_key = key(search.harmonic->phase);
      law.rate_key = key(search.harmonic->rate);
    }
    laws.push_back(std::move(law));
  }
  return laws;
}

double log_prior_odds(const WaveformFit& fit, double candidates, double swing_frequency) {
  double sum = 0;
  std::vector<Eigen::Index> own;
  int dry = 0;
  for (std::size_t i = 0; i < fit.laws.size(); ++i) {
    const WaveformLaw& law = fit.laws[i];
    const Eigen::Index at = fit.first_of(i);
    const double each = std::min(0.5, rules::expected_effects * law.term.odds / std::max(1.0, candidates));
    sum += std::log(each / (1 - each));
    if (law.term.dry && ++dry > 1) return impossible;
    if (says_it_twice(fit, i)) return impossible;
    for (Eigen::Index k = 0; k < law.width(); ++k) own.push_back(at + k);
    if (law.is_mode) {
      const double amplitude = std::hypot(fit.value[at], fit.value[at + 1]);
      // Any phase is as likely, any frequency up to five times the swing's, and dying away in a period or
      // slower.
      sum += log_cauchy(amplitude, law.term.typical, true) -
             std::log(2 * std::numbers::pi * amplitude * 5 * swing_frequency * swing_frequency);
      constexpr double grows = -2;  // standard errors
      if (fit.value[at + 3] < grows * std::sqrt(fit.covariance(at + 3, at + 3))) return impossible;
      continue;
    }
    const double strength = fit.value[at];
    if ((law.term.never_negative && strength <= 0) || !law.term.possible(strength)) return impossible;
    sum += log_cauchy(strength, law.term.typical, law.term.never_negative);
  }
  if (own.empty()) return 0;
  const Eigen::MatrixXd covariance = fit.covariance(own, own);
  const Eigen::VectorXd root = covariance.diagonal().cwiseSqrt();
  if (!(root.minCoeff() > 0)) return impossible;
  const double determinant =
      (root.cwiseInverse().asDiagonal() * covariance * root.cwiseInverse().asDiagonal()).determinant();
  if (!(determinant > 0)) return impossible;
  return sum + static_cast<double>(own.size()) * std::log(2 * std::numbers::pi) / 2 +
         root.array().log().sum() + std::log(determinant) / 2;
}

double line_in(const std::vector<PowerAt>& spectrum) {
  if (spectrum.empty()) return 0;
  const auto peak = std::max_element(spectrum.begin(), spectrum.end(),
                                     [](const PowerAt& a, const PowerAt& b) { return a.power < b.power; });
  const auto at = peak - spectrum.begin();
  // The peak and its skirts are five steps wide to either side; noise is what lies beside it, on the side
  // where it is stronger: a track's wander falls with the frequency.
  constexpr std::ptrdiff_t skirt = 5, beside = 20;
  double noise = 0;
  for (const std::ptrdiff_t side : {-1, 1}) {
    double sum = 0, count = 0;
    for (std::ptrdiff_t i = skirt + 1; i <= skirt + beside; ++i)
      if (const std::ptrdiff_t k = at + side * i; k >= 0 && k < std::ssize(spectrum))
        sum += spectrum[static_cast<std::size_t>(k)].power, ++count;
    if (count >= skirt) noise = std::max(noise, sum / count);
  }
  if (!(noise > 0)) return 0;
  // The power of noise is exponential: of n frequencies one exceeds x means by chance with n exp(-x).
  const double by_chance = static_cast<double>(spectrum.size()) * std::exp(-peak->power / noise);
  return by_chance < one_in_a_thousand ? peak->frequency : 0;
}

}  // namespace shakedown
