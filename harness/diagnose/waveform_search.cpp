// SPDX-License-Identifier: MIT
#include "waveform_search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "effect_strength.hpp"
#include "known_effects.hpp"
#include "rules.hpp"
#include "waveform_sets.hpp"

namespace shakedown {

namespace {

/// In parts of the frequency: a second swing nearer than this to the box's own, or to a multiple of it, is
/// none. The one exchanges energy with the box (beats), the other is a harmonic. Both allow for the swing's
/// own frequency changing with its amplitude.
constexpr double near_own = 0.2, near_multiple = 0.05;

bool is_own(double frequency, double swing, double resolution) {
  if (std::abs(frequency - swing) < std::max(near_own * swing, resolution)) return true;
  const double multiple = std::max(2.0, std::round(frequency / swing));
  return std::abs(frequency - multiple * swing) < std::max(near_multiple * multiple * swing, resolution);
}

double longest_of(const std::vector<WaveformRun>& runs) {
  double longest = 0;
  for (const WaveformRun& run : runs) longest = std::max(longest, run.time.back() - run.time.front());
  return longest;
}

/// Runs the course of one search.
class WaveformSearch {
 public:
  WaveformSearch(std::vector<WaveformRun> runs, const EffectsInQuestion& asked, bool free_frequency)
      : runs_(std::move(runs)),
        laws_(waveform_laws(runs_.front().setup, asked.known)),
        options_{.known = asked.known, .free_frequency = free_frequency, .threads = asked.threads} {
    std::erase_if(laws_, [&](const WaveformLaw& law) {
      return !asked.only.empty() &&
             std::find(asked.only.begin(), asked.only.end(), law.term.effect) == asked.only.end();
    });
  }

  WaveformAnswer run(double frequency) {
    WaveformFit whole = plain_laws(frequency);
    WaveformAnswer answer;
    // A fit of many laws may end in a side valley that a set within it leaves: then go on from that set.
    constexpr int most_rounds = 3;
    constexpr double much_better = 0.8;  // of the remains
    for (int round = 0; round < most_rounds; ++round) {
      weigh_runs(whole);
      whole = fit_waveform(runs_, whole.laws, whole.value, options_);
      constexpr int most_added = 4;
      for (int added = 0; added < most_added && add_one(whole); ++added) {
        weigh_runs(whole);
        whole = fit_waveform(runs_, whole.laws, whole.value, options_);
      }
      put_look_alikes_in_place(whole);
      answer.sets = sets().within(whole);
      if (answer.sets.empty() || !(answer.sets.front().fit.rms() < much_better * whole.rms())) break;
      whole = answer.sets.front().fit;
    }
    WaveformOptions fixed = options_;
    fixed.free_frequency = false;
    answer.as_given =
        fit_growing(runs_, {}, starting_values(runs_, {}, runs_.front().setup.spring.frequency), fixed);
    if (!answer.sets.empty()) answer.gain = sets().gains_of(answer.sets.front().fit);
    answer.table = in_words(answer.sets);
    answer.runs = runs_;
    return answer;
  }

 private:
  WaveformSets sets() const { return {runs_, static_cast<double>(laws_.size()), few_, options_}; }

  /// Returns the plain fit. It has every law of one strength that engines without a waveform look for too,
  /// without those that stand for another one (a friction that yields).
  WaveformFit plain_laws(double frequency) {
    std::vector<WaveformLaw> plain;
    for (const WaveformLaw& law : laws_)
      if (is_plain(law)) plain.push_back(law);
    const WaveformFit start =
        fit_waveform(runs_, {}, starting_values(runs_, {}, frequency), until(3 / frequency));
    plain = leaving_trace(start, plain);
    std::erase_if(laws_, [&](const WaveformLaw& law) {
      return is_plain(law) && std::find(plain.begin(), plain.end(), law) == plain.end();
    });
    // Fit each damping alone first: of several that may have either sign the beginning of a swing tells too
    // little.
    WaveformFit best = fit_growing(runs_, plain, with_zeros(start.value, plain), options_);
    for (const WaveformLaw& damping : plain) {
      if (!damping.term.never_negative) continue;
      std::vector<WaveformLaw> laws;
      for (const WaveformLaw& law : plain)
        if (!law.term.never_negative || law == damping) laws.push_back(law);
      const WaveformFit one = fit_growing(runs_, laws, with_zeros(start.value, laws), options_);
      if (!one.possible) continue;
      few_.push_back(one);
      WaveformFit all = fit_waveform(runs_, plain, spread(one, plain), options_);
      if (all.possible && (!best.possible || all.chi2 < best.chi2)) best = std::move(all);
    }
    // Then fit each two of them.
    const std::vector<WaveformFit> alone = few_;
    for (std::size_t a = 0; a < alone.size(); ++a)
      for (std::size_t b = 0; b < alone.size(); ++b) {
        if (a == b || alone[b].chi2 < alone[a].chi2) continue;
        std::vector<WaveformLaw> laws = alone[a].laws;
        for (const WaveformLaw& law : alone[b].laws)
          if (std::find(laws.begin(), laws.end(), law) == laws.end()) laws.push_back(law);
        few_.push_back(fit_waveform(runs_, laws, spread(alone[a], laws), options_));
      }
    return best;
  }
  bool is_plain(const WaveformLaw& law) const {
    return !law.is_mode && !law.only_waveform && law.term.shape.empty();
  }
  WaveformOptions until(double end) const {
    WaveformOptions part = options_;
    part.until = end;
    return part;
  }
  static Eigen::VectorXd with_zeros(const Eigen::VectorXd& value, const std::vector<WaveformLaw>& laws) {
    Eigen::Index more = 0;
    for (const WaveformLaw& law : laws) more += law.width();
    Eigen::VectorXd longer = Eigen::VectorXd::Zero(value.size() + more);
    longer.head(value.size()) = value;
    return longer;
  }
  /// Returns the values of a fit as a start for more laws.
  static Eigen::VectorXd spread(const WaveformFit& fit, const std::vector<WaveformLaw>& laws) {
    Eigen::VectorXd start = with_zeros(fit.value.head(fit.first_of(0)), laws);
    Eigen::Index next = fit.first_of(0);
    for (const WaveformLaw& law : laws) {
      for (std::size_t i = 0; i < fit.laws.size(); ++i)
        if (fit.laws[i] == law)
          start.segment(next, law.width()) = fit.value.segment(fit.first_of(i), law.width());
      next += law.width();
    }
    return start;
  }
  /// Returns those laws that frequency, places and origins do not take up.
  std::vector<WaveformLaw> leaving_trace(const WaveformFit& fit, const std::vector<WaveformLaw>& laws) const {
    // Derivatives are differences over 1e-4 of what changes the motion by its amplitude, and err by as much:
    // of a law that does nothing 1e-8 is left in squares.
    constexpr double left_by_differences = 1e-6;
    const std::vector<LawScore> scores = scores_of(runs_, fit, laws, until(3 / fit.frequency()));
    std::vector<WaveformLaw> leaving;
    for (std::size_t i = 0; i < laws.size(); ++i)
      if (scores[i].seen > left_by_differences) leaving.push_back(laws[i]);
    return leaving;
  }

  void weigh_runs(const WaveformFit& fit) {
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const double band = noise_in_band(runs_[r], fit.residual[r], fit.frequency());
      runs_[r].noise = std::max({runs_[r].white, std::sqrt(band), 1e-6 * runs_[r].amplitude});
    }
  }

  /// Adds the law that makes the whole most probable; returns false where none does.
  bool add_one(WaveformFit& whole) {
    std::vector<WaveformFit> tried;
    std::vector<WaveformLaw> others;
    for (const WaveformLaw& law : laws_) {
      if (has(whole, law) || law.is_mode) continue;
      if (law.term.shape.empty())
        others.push_back(law);
      else if (std::optional<WaveformFit> other = in_place_of_dry(whole, law))
        tried.push_back(std::move(*other));
    }
    const std::vector<LawScore> scores = scores_of(runs_, whole, others, options_);
    std::vector<std::pair<double, const WaveformLaw*>> by_gain;
    for (std::size_t i = 0; i < others.size(); ++i) by_gain.push_back({scores[i].gain, &others[i]});
    std::sort(by_gain.begin(), by_gain.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    constexpr std::size_t most_fitted = 3;
    constexpr double worth_a_fit = 6;  // chi2
    for (std::size_t i = 0; i < std::min(most_fitted, by_gain.size()); ++i)
      if (by_gain[i].first > worth_a_fit) tried.push_back(with_law(whole, *by_gain[i].second));
    for (const WaveformLaw& law : laws_)
      if (law.is_mode && !has(whole, law))
        if (std::optional<WaveformFit> other = with_mode(whole, law)) tried.push_back(std::move(*other));
    double most = -whole.chi2 / 2 + cost(whole);
    const WaveformFit* best = nullptr;
    for (const WaveformFit& other : tried)
      if (other.possible && -other.chi2 / 2 + cost(other) > most)
        most = -other.chi2 / 2 + cost(other), best = &other;
    if (best == nullptr) return false;
    whole = WaveformFit(*best);
    return true;
  }
  /// Returns the ln odds beforehand of the laws of a fit. Signs are not asked for on the way: what is
  /// needless goes in the end.
  double cost(const WaveformFit& fit) const {
    const double each = log_odds_of_one_more(static_cast<double>(laws_.size()));
    double sum = 0;
    for (const WaveformLaw& law : fit.laws) sum += each * static_cast<double>(law.width() > 1 ? 3 : 1);
    return sum;
  }
  static bool has(const WaveformFit& fit, const WaveformLaw& law) {
    return std::any_of(fit.laws.begin(), fit.laws.end(), [&](const WaveformLaw& other) {
      return law.is_mode ? other == law : other.term.key() == law.term.key();
    });
  }

  WaveformFit with_law(const WaveformFit& whole, const WaveformLaw& law) const {
    std::vector<WaveformLaw> laws = whole.laws;
    laws.push_back(law);
    Eigen::VectorXd start = with_zeros(whole.value, {law});
    start[start.size() - 1] = law.term.inverse ? 0.1 * law.term.typical : 0;
    return fit_waveform(runs_, laws, start, options_);
  }

  /// Returns a fit with a friction that yields in place of the dry one that the whole has, as strong; nothing
  /// where it has none.
  std::optional<WaveformFit> in_place_of_dry(const WaveformFit& whole, const WaveformLaw& law) const {
    const double travel = law.term.besides.empty() ? 0 : law.term.besides.back().second;
    double amplitude = 0;
    for (const WaveformRun& run : runs_) amplitude = std::max(amplitude, run.amplitude);
    if (travel > amplitude || travel < amplitude / 100) return {};
    constexpr double clearly = 5;  // standard errors
    for (std::size_t i = 0; i < whole.laws.size(); ++i) {
      const Eigen::Index at = whole.first_of(i);
      if (!whole.laws[i].term.dry || !(whole.value[at] > clearly * std::sqrt(whole.covariance(at, at))))
        continue;
      std::vector<WaveformLaw> laws = whole.laws;
      laws[i] = law;
      WaveformOptions few = options_;
      few.evaluations = 8;
      return fit_waveform(runs_, laws, whole.value, few);
    }
    return {};
  }

  /// Puts another law that says the same in the place of one of the whole where it explains more: a pendulum
  /// beside its own cubic term adds next to nothing, in place of it it leaves less.
  void put_look_alikes_in_place(WaveformFit& whole) const {
    for (std::size_t i = 0; i < whole.laws.size(); ++i)
      for (const WaveformLaw& law : laws_) {
        if (has(whole, law) || law.is_mode || !say_the_same(whole.laws[i], law)) continue;
        std::vector<WaveformLaw> laws = whole.laws;
        laws[i] = law;
        Eigen::VectorXd start = whole.value;
        start[whole.first_of(i)] = law.term.inverse ? 0.1 * law.term.typical : 0;
        WaveformFit other = fit_growing(runs_, laws, start, options_);
        const double beforehand = std::log(law.term.odds / whole.laws[i].term.odds);
        if (other.possible && (whole.chi2 - other.chi2) / 2 + beforehand > 0) whole = std::move(other);
      }
  }

  /// Returns a fit with a second swing where the residual has its strongest one; nothing where none stands
  /// out.
  std::optional<WaveformFit> with_mode(const WaveformFit& whole, const WaveformLaw& law) const {
    const double length = longest_of(runs_), swing = whole.frequency();
    const WaveformRun& run = runs_.front();
    const Eigen::VectorXd& left = whole.residual.front();
    const double highest = std::min(
        5 * swing, 0.4 * static_cast<double>(run.time.size()) / (run.time.back() - run.time.front()));
    std::vector<PowerAt> spectrum;
    for (double f = 1.5 / length; f < highest; f += 0.5 / length) {
      if (is_own(f, swing, 2 / length)) continue;
      double sine = 0, cosine = 0;
      for (Eigen::Index i = 0; i < left.size(); ++i) {
        const double phase = 2 * std::numbers::pi * f * run.time[static_cast<std::size_t>(i)];
        sine += std::sin(phase) * left[i], cosine += std::cos(phase) * left[i];
      }
      spectrum.push_back({f, (sine * sine + cosine * cosine) / static_cast<double>(left.size())});
    }
    const double found = line_in(spectrum);
    if (!(found > 0)) return {};
    std::vector<WaveformLaw> laws = whole.laws;
    laws.push_back(law);
    Eigen::VectorXd start = with_zeros(whole.value, {law});
    // Take sine and cosine part from the equation's own response, which is linear at this frequency.
    start[start.size() - 2] = found;
    const Eigen::Vector2d parts = linear_mode(runs_, whole, law, found, options_);
    start[start.size() - 4] = parts[0], start[start.size() - 3] = parts[1];
    WaveformFit fit = fit_waveform(runs_, laws, start, options_);
    const double there = fit.value[fit.value.size() - 2];
    if (!(there > 0) || is_own(there, fit.frequency(), 1 / length)) return {};
    return fit;
  }

  std::vector<Hypothesis> in_words(const std::vector<WaveformSet>& sets) const {
    std::vector<Hypothesis> table;
    for (const WaveformSet& set : sets) {
      Hypothesis h;
      h.log_odds = set.log_odds;
      for (const WaveformLaw& law : set.fit.laws) h.effects.push_back(law.term.effect);
      table.push_back(std::move(h));
    }
    weigh(table);
    return table;
  }

  std::vector<WaveformRun> runs_;
  std::vector<WaveformLaw> laws_;
  WaveformOptions options_;
  std::vector<WaveformFit> few_;  ///< one damping or two with the spring's laws, from the beginning on
};

}  // namespace

WaveformAnswer search_waveform(const Measurement& measurement, double frequency,
                               const EffectsInQuestion& asked) {
  std::vector<WaveformRun> runs = waveform_runs(measurement);
  if (runs.empty()) return {};
  const bool held = knows_frequency_exactly(measurement);
  if (held) frequency = runs.front().setup.spring.frequency;
  return WaveformSearch(std::move(runs), asked, !held).run(frequency);
}

bool knows_frequency_exactly(const Measurement& measurement) {
  return std::any_of(measurement.known.begin(), measurement.known.end(), [](const KnownValue& known) {
    return known.key == "spring.frequency" && known.error == 0;
  });
}

}  // namespace shakedown
