// SPDX-License-Identifier: MIT
#include "swing_judged.hpp"

#include <algorithm>
#include <cmath>

#include "distributions.hpp"
#include "key_unit.hpp"
#include "setup_file.hpp"
#include "swing.hpp"

namespace shakedown {

namespace {

constexpr std::string_view of_frequency = "spring.frequency";

double rms_of(const Eigen::VectorXd& left) {
  return std::sqrt(left.squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, left.size())));
}

/// Compares each run with the model that its waveform asks for.
std::vector<Validation> validation_of(const WaveformFit& fit, const SwingRemains& remains) {
  std::vector<Validation> rows;
  // Error, in parts of the noise, that fitted numbers make in frames whose noise has no memory.
  const double input_share = std::sqrt(static_cast<double>(fit.value.size()) /
                                       static_cast<double>(std::max<Eigen::Index>(1, fit.frames)));
  for (std::size_t r = 0; r < remains.frames.size(); ++r) {
    const double noise = std::hypot(remains.frames[r].white, remains.wander);
    rows.push_back({remains.frames[r].name, "box", rms_of(remains.left[r]),
                    3e-7 * remains.frames[r].amplitude, input_share * noise, noise});
  }
  return rows;
}

/// Returns a number that a user names as a law whose value is the number itself.
WaveformLaw law_of(const Knob& knob) {
  WaveformLaw law;
  law.keys = joined_keys(knob.key);
  const std::size_t dot = knob.key.find('.');
  law.term.effect = knob.key.substr(0, dot), law.term.parameter = knob.key.substr(dot + 1);
  law.term.typical = knob.width;
  law.term.least = knob.low, law.term.most = knob.high;
  return law;
}

/// Fits what is free by least squares, within bounds.
class SwingFitter {
 public:
  SwingFitter(const Measurement& measurement, const std::vector<Knob>& knobs, const MomentumAudit& balance,
              KnownEffects known)
      : runs_(waveform_runs(measurement)), balance_(balance) {
    options_.known = known;
    options_.free_frequency = false;
    if (runs_.empty()) return;
    frequency_ = runs_.front().setup.spring.frequency;
    for (const Knob& knob : knobs) {
      if (knob.exact) continue;
      if (knob.key == of_frequency)
        of_spring_ = knob;
      else
        free_.push_back(knob);
    }
    if (!of_spring_) return;
    options_.free_frequency = true;
    frequency_ = of_spring_->centre;
    options_.believed_frequency = of_spring_->believed;
    options_.believed_error = of_spring_->believed_error;
  }

  bool possible() const { return !runs_.empty(); }

  /// Returns the rms with the knobs where they start, m.
  double as_given() const {
    WaveformOptions fixed = options_;
    fixed.free_frequency = false;
    fixed.believed_error = 0;
    return fit_growing(runs_, laws(), start(frequency_), fixed).rms();
  }

  WaveformFit run() {
    WaveformFit fit = from_starts();
    // What leaves its bounds stays there, and the others are fitted beside it.
    for (std::size_t times = 0; times <= free_.size() && hold_outside(fit); ++times) fit = from_starts();
    constexpr int rounds = 2;
    for (int round = 0; round < rounds && fit.possible; ++round) {
      for (std::size_t r = 0; r < runs_.size(); ++r) {
        const double band = noise_in_band(runs_[r], fit.residual[r], fit.frequency());
        runs_[r].noise = std::max({runs_[r].white, std::sqrt(band), 1e-6 * runs_[r].amplitude});
      }
      fit = fit_waveform(runs_, fit.laws, fit.value, options_);
    }
    return fit;
  }

  /// Fills in a fit's values in the order of the knobs, with intervals, and their covariance.
  void tell(const WaveformFit& fit, const std::vector<Knob>& knobs, Refit& refit) const {
    std::vector<Eigen::Index> at;
    for (const Knob& knob : knobs)
      if (!knob.exact) at.push_back(place_of(fit, knob)), refit.knobs.push_back(knob);
    const auto n = std::ssize(at);
    refit.covariance = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Knob& knob = refit.knobs[static_cast<std::size_t>(i)];
      FittedValue value{knob.key, 0, 0, 0, 0, false};
      const Eigen::Index here = at[static_cast<std::size_t>(i)];
      if (here >= 0) {
        value.value = fit.value[here];
        for (Eigen::Index j = 0; j < n; ++j)
          if (const Eigen::Index there = at[static_cast<std::size_t>(j)]; there >= 0)
            refit.covariance(i, j) = fit.covariance(here, there);
        value.error = std::sqrt(refit.covariance(i, i));
      } else {
        value.value = held_.at(knob.key);
        value.at_bound = true;
      }
      value.low = std::max(knob.low, value.value - normal_95 * value.error);
      value.high = std::min(knob.high, value.value + normal_95 * value.error);
      refit.values.push_back(std::move(value));
    }
  }

 private:
  std::vector<WaveformLaw> laws() const {
    std::vector<WaveformLaw> list;
    for (const Knob& knob : free_) list.push_back(law_of(knob));
    return list;
  }
  Eigen::VectorXd start(double frequency) const {
    Eigen::VectorXd value = starting_values(runs_, laws(), frequency);
    for (std::size_t i = 0; i < free_.size(); ++i)
      value[value.size() - std::ssize(free_) + static_cast<Eigen::Index>(i)] = free_[i].centre;
    return value;
  }

  /// Fits from the frequency as given and from that which the balance has found; returns the better fit.
  WaveformFit from_starts() const {
    WaveformFit best = fit_growing(runs_, laws(), start(frequency_), options_);
    const double other = balance_.possible ? balance_.frequency : 0;
    if (options_.free_frequency && options_.believed_error == 0 && other > 0) {
      WaveformFit again = fit_growing(runs_, laws(), start(other), options_);
      if (again.possible && (!best.possible || again.chi2 < best.chi2)) best = std::move(again);
    }
    return best;
  }

  bool hold_outside(const WaveformFit& fit) {
    bool any = false;
    if (options_.free_frequency &&
        (fit.frequency() < of_spring_->low || fit.frequency() > of_spring_->high)) {
      frequency_ = std::clamp(fit.frequency(), of_spring_->low, of_spring_->high);
      held_[std::string(of_frequency)] = frequency_;
      options_.free_frequency = false, options_.believed_error = 0;
      any = true;
    }
    std::vector<Knob> inside;
    for (std::size_t i = 0; i < free_.size(); ++i) {
      const double value = fit.value[fit.first_of(i)], kept = std::clamp(value, free_[i].low, free_[i].high);
      if (kept == value) {
        inside.push_back(free_[i]);
        continue;
      }
      held_[free_[i].key] = kept;
      for (WaveformRun& run : runs_)
        for (const std::string& key : joined_keys(free_[i].key))
          set_number(run.setup, key, kept, options_.known);
      any = true;
    }
    free_ = std::move(inside);
    return any;
  }

  Eigen::Index place_of(const WaveformFit& fit, const Knob& knob) const {
    if (knob.key == of_frequency) return options_.free_frequency ? 3 * std::ssize(fit.residual) : -1;
    for (std::size_t i = 0; i < free_.size(); ++i)
      if (free_[i].key == knob.key) return fit.first_of(i);
    return -1;
  }

  std::vector<WaveformRun> runs_;
  const MomentumAudit& balance_;
  WaveformOptions options_;
  double frequency_ = 0;
  std::optional<Knob> of_spring_;
  std::vector<Knob> free_;
  std::map<std::string, double> held_;  ///< at a bound
};

std::vector<RunComparison> comparisons_of(const SwingRemains& remains) {
  std::vector<RunComparison> runs;
  for (std::size_t r = 0; r < remains.frames.size(); ++r) {
    const Eigen::VectorXd& left = remains.left[r];
    RunComparison run;
    run.run = remains.frames[r].name;
    run.error_box = rms_of(left);
    run.floor_box = std::hypot(remains.frames[r].white, remains.wander);
    run.chi2 = left.squaredNorm() / std::pow(run.floor_box, 2);
    run.residual = left;
    run.spread = Eigen::VectorXd::Constant(left.size(), run.floor_box);
    run.validation = {remains.validation[r]};
    runs.push_back(std::move(run));
  }
  return runs;
}

void set_values(Setup& setup, const std::vector<FittedValue>& values, KnownEffects known) {
  for (const FittedValue& value : values)
    for (const std::string& key : joined_keys(value.key)) set_number(setup, key, value.value, known);
}

}  // namespace

Eigen::Index SwingRemains::frame_count() const {
  Eigen::Index count = 0;
  for (const Eigen::VectorXd& one : left) count += one.size();
  return count;
}

std::vector<Difference> SwingRemains::differences(double as_given) const {
  std::vector<Difference> list{{"box", error, floor, as_given, amplitude, looks_like}};
  for (Difference& row : differences_of(validation)) list.push_back(std::move(row));
  return list;
}

SwingRemains remains_of(const Measurement& measurement, const WaveformFit& fit, const MomentumAudit& balance,
                        KnownEffects known) {
  SwingRemains all;
  all.frames = waveform_runs(measurement, true);
  WaveformOptions options;
  options.known = known;
  all.left = residuals_of(all.frames, fit, options);
  all.wander = balance.possible ? std::min(balance.wander.deviation, balance.most_wander) : 0;
  double white = 0, worst = 0, squares = 0;
  for (std::size_t r = 0; r < all.frames.size(); ++r) {
    const WaveformRun& run = all.frames[r];
    const double of_run = all.left[r].squaredNorm();
    squares += of_run;
    all.chi2 += of_run / std::pow(run.white, 2);
    white = std::max(white, run.white);
    all.amplitude = std::max(all.amplitude, run.amplitude);
    if (of_run > worst) worst = of_run, all.looks_like = words_of_swing(run.time, all.left[r]);
  }
  all.floor = std::hypot(white, all.wander);
  all.error = std::sqrt(squares / std::max(1.0, static_cast<double>(all.frame_count())));
  all.validation = validation_of(fit, all);
  return all;
}

ModelTest no_ensembles() { return {std::nan(""), std::nan(""), "an empty box has no ensembles"}; }
ModelTest waveform_instead_of_balance() { return {std::nan(""), std::nan(""), "its waveform is judged"}; }

std::optional<JudgedSwing> judged_swing(const Setup& setup, const Measurement& measurement,
                                        const std::vector<Knob>& knobs, const MomentumAudit& balance,
                                        KnownEffects known) {
  SwingFitter fitter(measurement, knobs, balance, known);
  if (!fitter.possible()) return {};
  JudgedSwing judged{setup, {}, fitter.as_given(), {}, {}};
  const WaveformFit fit = fitter.run();
  fitter.tell(fit, knobs, judged.refit);
  set_values(judged.fitted, judged.refit.values, known);
  // What is held at a bound is in the runs' setups.
  const SwingRemains remains = remains_of(with_setup(measurement, judged.fitted, known), fit, balance, known);
  judged.refit.runs = comparisons_of(remains);
  judged.refit.chi2 = fit.chi2;
  judged.refit.degrees = static_cast<double>(fit.frames - fit.value.size());
  judged.refit.p_value = judged.refit.far_p_value = judged.refit.held_out_error_box = std::nan("");
  double chi2 = 0;
  for (const RunComparison& run : judged.refit.runs) chi2 += run.chi2;
  judged.refit.scatter = chi2 / std::max(1.0, static_cast<double>(remains.frame_count()));
  judged.found = {remains.frames, fit, remains.left};
  judged.judgement =
      judgement_of(no_ensembles(), waveform_instead_of_balance(), remains.differences(judged.as_given));
  return judged;
}

std::vector<RunComparison> foretold_swings(const JudgedSwing& judged, const Measurement& others,
                                           const MomentumAudit& balance, KnownEffects known) {
  const std::optional<JudgedSwing> beside =
      judged_swing(judged.fitted, with_setup(others, judged.fitted, known), {}, balance, known);
  return beside ? beside->refit.runs : std::vector<RunComparison>{};
}

}  // namespace shakedown
