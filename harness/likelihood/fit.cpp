// SPDX-License-Identifier: MIT
#include "fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "camera_features.hpp"
#include "damper_errors.hpp"
#include "distributions.hpp"
#include "free_parameters.hpp"
#include "key_unit.hpp"
#include "known_to_errors.hpp"
#include "refit.hpp"
#include "refit_options.hpp"
#include "setup_file.hpp"
#include "suggestion.hpp"
#include "told_apart.hpp"

namespace shakedown {

namespace {

/// Until when the first stages look at the runs, s; the last stage looks at them wholly.
constexpr double first_looks[] = {2.5, 6.0};
/// Correlation beyond which only a combination of two estimates is told.
constexpr double confounded = 0.95;

/// Returns the run up to this time (s) only.
MeasuredFeatures beginning_of(const MeasuredFeatures& whole, double end) {
  MeasuredFeatures part{whole.run, whole.setup, {}, {}};
  std::vector<Eigen::Index> kept;
  for (std::size_t f = 0; f < whole.plan.features.size(); ++f) {
    if (whole.plan.features[f].time > end) continue;
    part.plan.features.push_back(whole.plan.features[f]);
    part.plan.readings.push_back(whole.plan.readings[f]);
    kept.push_back(static_cast<Eigen::Index>(f));
  }
  double last = end + 0.1;
  for (const FeaturePlan::Reading& reading : part.plan.readings) last = std::max(last, reading.time.back());
  part.plan.end = std::min(whole.plan.end, last);
  part.setup.run.duration = part.plan.end + simulated_beyond;
  part.values = whole.values(kept);
  for (const auto& [key, change] : whole.by_camera) part.by_camera[key] = change(kept);
  if (whole.own.cols() > 0) part.own = whole.own(kept, Eigen::all);
  return part;
}

/// Refuses fewer simulations than twice the regression's terms: one on as many simulations as it has terms
/// leaves nothing between them, so that what is chaos would seem known.
void refuse_too_few_simulations(const std::vector<Knob>& knobs, int count) {
  const int terms = static_cast<int>(number_of_terms(knobs));
  const bool half_decides = 4 * terms > 2 * fewest_on_the_way;
  if (std::min(count, simulations_on_the_way(count)) >= 2 * terms) return;
  throw InputError(
      {{{"--runs", 0, 0},
        fmt::format("{}", count),
        fmt::format("is too few for {} keys (a regression of {} terms)", knobs.size(), terms),
        fmt::format("give {} or more, or fit fewer keys", half_decides ? 4 * terms : 2 * terms)}});
}

void add_remark(FittedParameter& parameter, const std::string& remark) {
  parameter.remark += (parameter.remark.empty() ? "" : "; ") + remark;
}

/// Returns the parameter with what is to be said of it. `knob`: where the fit ended; `start`: where it began.
FittedParameter told_parameter(const Knob& knob, const Knob& start, double value, double error, bool at_bound,
                               KnownEffects known) {
  FittedParameter found{knob.key,
                        unit_of_key(knob.key, known),
                        start.centre,
                        value,
                        std::max(knob.low, value - normal_95 * error),
                        std::min(knob.high, value + normal_95 * error),
                        error,
                        true,
                        ""};
  const bool covers_most = 2 * normal_95 * error > 2.0 / 3 * (knob.high - knob.low) || !std::isfinite(error);
  found.told = !covers_most;
  if (covers_most)
    found.remark = "the data do not tell it: its interval covers most of what is possible";
  else if (at_bound)
    found.remark = "at the bound of what is possible";
  else if (start.low == 0 && value - normal_95 * error <= 0)
    found.remark = "not different from zero";
  return found;
}

class Fitter {
 public:
  Fitter(const Setup& setup, const Measurement& measurement, std::vector<Knob> knobs, const Engine& engine,
         const FitOptions& options)
      : setup_(setup),
        measurement_(measurement),
        asked_(knobs.size()),
        knobs_(std::move(knobs)),
        options_(options) {
    fit_.start = setup;
    refuse_unknown_runs(measurement, options.on);
    refuse_too_few_simulations(knobs_, options.count);
    workshop_ = {&engine, options.known, options.execution};
    workshop_.meter.done = [this](int more) {
      fit_.runs += more;
      if (options_.progress) options_.progress(stage_, fit_.runs);
    };
    start_ = knobs_;
    free_beside(camera_knobs(setup, measurement, options.known));
    all_ = features_with_camera(measurement, options.known);
    add_wander(options.wander, all_);
    part();
  }

  Fit run() {
    const auto begin = std::chrono::steady_clock::now();
    for (const double end : first_looks) look_until(end);
    free_what_was_weighed();
    const Refit last = fit_all();
    tell(last);
    foretell();
    fit_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return fit_;
  }

 private:
  bool is_asked(const std::string& key) const {
    return std::any_of(knobs_.begin(), knobs_.begin() + static_cast<std::ptrdiff_t>(asked_),
                       [&](const Knob& knob) {
                         const std::vector<std::string> keys = joined_keys(knob.key);
                         return std::find(keys.begin(), keys.end(), key) != keys.end();
                       });
  }

  /// Frees besides what is known to within an error only, as a diagnosis does: a film through a lens and a
  /// shutter, or a box two grams heavier than was weighed, is not the model's mistake.
  void free_beside(const std::vector<Knob>& known_to_an_error) {
    for (const Knob& knob : known_to_an_error) {
      if (is_asked(knob.key)) continue;
      knobs_.push_back(knob);
      start_.push_back(knob);
    }
  }

  /// Sorts the runs into those that are fitted and those that are foretold.
  void part() {
    used_.clear(), left_out_.clear();
    for (const MeasuredFeatures& run : all_) {
      const bool wanted = options_.on.empty() ||
                          std::find(options_.on.begin(), options_.on.end(), run.run) != options_.on.end();
      (wanted ? used_ : left_out_).push_back(run);
    }
  }

  /// Simulates what the errors of masses and releases do, where the first looks have brought the model: at a
  /// wrong frequency it would have another phase.
  void free_what_was_weighed() {
    std::vector<DamperError> errors = damper_errors(measurement_);
    std::erase_if(errors, [&](const DamperError& error) { return is_asked(error.key); });
    if (errors.empty()) return;
    stage_ = damper_weighed;
    std::vector<MeasuredFeatures> here = all_;
    for (MeasuredFeatures& run : here)
      for (std::size_t k = 0; k < asked_; ++k)
        if (!knobs_[k].exact) set_knob(run.setup, knobs_[k], options_.known);
    const int first_run = round(1, 1).first_run;
    add_columns(errors, columns_of(errors, here, simulations_of_a_column, first_run, workshop_),
                options_.known, all_);
    free_beside(knobs_of(errors, setup_));
    part();
  }

  RefitOptions round(int rounds, int most_rounds) {
    RefitOptions options;
    options.count = options_.count;
    options.rounds = rounds;
    options.most_rounds = most_rounds;
    options.first_run = options_.first_run + 100000 * ++batch_;
    return options;
  }

  double model_error() const { return RefitOptions{}.model_error * std::abs(setup_.release.displacement); }

  void move_to(const Refit& found) {
    for (std::size_t k = 0; k < knobs_.size(); ++k) {
      if (knobs_[k].exact) continue;  // it stays where the recording was read
      knobs_[k].centre = found.values[k].value;
      knobs_[k].width = std::clamp(4 * found.values[k].error, 0.1 * start_[k].width, start_[k].width);
    }
  }

  void look_until(double end) {
    stage_ = fmt::format("fitting the first {:g} s", end);
    std::vector<MeasuredFeatures> beginnings;
    for (const MeasuredFeatures& run : used_) beginnings.push_back(beginning_of(run, end));
    move_to(refit(beginnings, knobs_, workshop_, round(2, 5)));
  }

  Refit fit_all() {
    stage_ = "fitting the whole";
    const Refit found = refit(used_, knobs_, workshop_, round(2, 5));
    move_to(found);
    return found;
  }

  void tell(const Refit& found) {
    stage_ = "what the data tell";
    const std::vector<Emulator> emulators =
        emulate(used_, knobs_, options_.count, options_.first_run, workshop_);
    const ToldApart told = told_apart(used_, knobs_, emulators, model_error());
    covariance_ = told.covariance * std::max(1.0, found.scatter);
    const auto asked = static_cast<Eigen::Index>(asked_);
    fit_.correlation = told.correlation.topLeftCorner(asked, asked);
    fit_.used = found.runs;
    fit_.measured = used_;
    fit_.solution = found;
    fit_.p_value = found.p_value;
    fit_.scatter = found.scatter;
    fit_.judgement = judgement_of(found.test(), {std::nan(""), std::nan(""), "not asked"}, found.left());
    camera_ = Eigen::VectorXd::Zero(std::ssize(knobs_));
    for (std::size_t k = 0; k < knobs_.size(); ++k)
      if (knobs_[k].exact) camera_[static_cast<Eigen::Index>(k)] = knobs_[k].z_of(found.values[k].value);
    fit_.fitted = setup_;
    for (std::size_t k = 0; k < asked_; ++k) {
      Knob at_solution = knobs_[k];
      at_solution.centre = found.values[k].value;
      set_knob(fit_.fitted, at_solution, options_.known);
    }
    for (std::size_t k = 0; k < asked_; ++k) fit_.parameters.push_back(parameter(k, found.values[k], told));
    for (NuisanceFound& one : nuisances_of(found, options_.known))
      if (!is_asked(one.name)) fit_.beside.push_back(std::move(one));
  }

  FittedParameter parameter(std::size_t k, const FittedValue& value, const ToldApart& told) const {
    const Knob& knob = knobs_[k];
    const auto i = static_cast<Eigen::Index>(k);
    // The pseudo-experiments' spread ends at the edge of the scattered box; the slopes' does not.
    const double error = std::max(value.error, told.error[i] * std::sqrt(std::max(1.0, fit_.scatter)));
    FittedParameter found =
        told_parameter(knob, start_[k], value.value, error, value.at_bound, options_.known);
    for (std::size_t other = 0; other < knobs_.size(); ++other)
      if (other != k && std::abs(told.correlation(i, static_cast<Eigen::Index>(other))) > confounded)
        add_remark(found, fmt::format("only a combination with {} is told (alone it would be known to {:.2g} "
                                      "of this interval)",
                                      knobs_[other].key, told.alone[i] / told.error[i]));
    return found;
  }

  void foretell() {
    if (left_out_.empty()) return;
    stage_ = "foretelling the runs left out";
    std::vector<Emulator> emulators =
        emulate(left_out_, knobs_, options_.count, options_.first_run + 50000, workshop_);
    for (Emulator& emulator : emulators)
      emulator.coefficients.row(0) +=
          camera_.transpose() * emulator.coefficients.middleRows(1, camera_.size());
    for (std::size_t r = 0; r < left_out_.size(); ++r)
      fit_.left_out.push_back(foretold(left_out_[r], knobs_, emulators[r], covariance_, model_error()));
  }

  const Setup& setup_;
  const Measurement& measurement_;
  const std::size_t asked_;  ///< number of knobs that the user frees; those of the camera follow
  std::vector<Knob> knobs_;  ///< where the fit has come to
  std::vector<Knob> start_;  ///< where it began
  Eigen::VectorXd camera_;   ///< z of the camera's knobs at the solution, 0 of the others
  const FitOptions& options_;
  std::vector<MeasuredFeatures> all_, used_, left_out_;  ///< all: in the order of the measurement
  Workshop workshop_;
  Eigen::MatrixXd covariance_;  // of the estimates
  Fit fit_;
  std::string stage_;
  int batch_ = 0;
};

}  // namespace

void refuse_unknown_runs(const Measurement& measurement, const std::vector<std::string>& wanted) {
  std::vector<std::string_view> names;
  for (const Measurement::Run& run : measurement.runs) names.push_back(run.recorded.name);
  std::vector<Violation> found;
  for (const std::string& name : wanted)
    if (std::find(names.begin(), names.end(), name) == names.end())
      found.push_back({{"--on", 0, 0}, name, "is no run of the experiment", "it has " + listed(names)});
  if (!found.empty()) throw InputError(std::move(found));
}

std::vector<FittedParameter> parameters_of(const Refit& fit, const std::vector<Knob>& start,
                                           KnownEffects known) {
  EXPECT(fit.values.size() == start.size());
  const Eigen::MatrixXd correlation = correlation_of(fit.covariance);
  std::vector<FittedParameter> list;
  for (std::size_t k = 0; k < start.size(); ++k) {
    const FittedValue& value = fit.values[k];
    list.push_back(told_parameter(start[k], start[k], value.value, value.error, value.at_bound, known));
    for (std::size_t other = 0; other < start.size(); ++other)
      if (other != k &&
          std::abs(correlation(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(other))) > confounded)
        add_remark(list.back(), "only a combination with " + start[other].key + " is told");
  }
  return list;
}

Eigen::MatrixXd correlation_of(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd root = covariance.diagonal().cwiseSqrt().cwiseMax(1e-300);
  Eigen::MatrixXd correlation =
      root.cwiseInverse().asDiagonal() * covariance * root.cwiseInverse().asDiagonal();
  correlation.diagonal().setOnes();
  return correlation;
}

namespace {

/// Returns the covariance of the parameters in the units of the values.
Eigen::MatrixXd covariance_of(const Fit& fit) {
  Eigen::VectorXd error(std::ssize(fit.parameters));
  for (std::size_t k = 0; k < fit.parameters.size(); ++k)
    error[static_cast<Eigen::Index>(k)] = fit.parameters[k].error;
  return error.asDiagonal() * fit.correlation * error.asDiagonal();
}

}  // namespace

std::vector<FittedValue> values_of(const Fit& fit) {
  std::vector<FittedValue> values;
  for (const FittedParameter& p : fit.parameters)
    values.push_back({p.key, p.value, p.low, p.high, p.error, false});
  return values;
}

ContactCurve curve_of(const CurveLaw& law, const Fit& fit, KnownEffects known) {
  return contact_curve(law, fit.fitted, values_of(fit), covariance_of(fit), known);
}

Fit fit_parameters(const Setup& setup, const Measurement& measurement, std::vector<Knob> knobs,
                   const Engine& engine, const FitOptions& options) {
  EXPECT(!knobs.empty());
  return Fitter(setup, measurement, std::move(knobs), engine, options).run();
}

}  // namespace shakedown
