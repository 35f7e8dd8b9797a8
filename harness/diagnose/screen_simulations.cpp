// SPDX-License-Identifier: MIT
#include "screen_simulations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "effort.hpp"
#include "errors.hpp"
#include "feature_covariance.hpp"
#include "linear_model.hpp"
#include "random.hpp"
#include "refit.hpp"

namespace shakedown {

namespace {

/// Returns what two codes differ by in a feature of this run, m.
double model_error_of(const MeasuredFeatures& measured) {
  return RefitOptions{}.model_error * measured.setup.release.displacement;
}

/// Makes a covariance (m^2) of a run's chaos, camera noise and difference of two codes.
using CovarianceOf = Eigen::MatrixXd(const Eigen::MatrixXd&, const FeaturePlan&, double);
std::vector<Eigen::MatrixXd> covariances_of(const std::vector<MeasuredFeatures>& measured,
                                            const std::vector<Emulator>& emulators, CovarianceOf& of) {
  std::vector<Eigen::MatrixXd> list;
  for (std::size_t r = 0; r < measured.size(); ++r)
    list.push_back(
        with_own(of(emulators[r].residuals, measured[r].plan, model_error_of(measured[r])), measured[r]));
  return list;
}

int count_of(const Candidate& candidate, const LevelEffort& effort) {
  return candidate.dear ? effort.dear : candidate.slow ? effort.slow : effort.plain;
}

/// Takes the means of more simulations at the same point into the emulators, and what these leave.
void join(std::vector<Emulator>& emulators, const std::vector<Emulator>& more) {
  for (std::size_t r = 0; r < emulators.size(); ++r) {
    Emulator& one = emulators[r];
    const Eigen::Index before = one.residuals.rows(), fresh = more[r].residuals.rows();
    const double share = static_cast<double>(fresh) / static_cast<double>(before + fresh);
    one.coefficients.row(0) += share * (more[r].coefficients.row(0) - one.coefficients.row(0));
    one.residuals.conservativeResize(before + fresh, Eigen::NoChange);
    one.residuals.bottomRows(fresh) = more[r].residuals;
  }
}

std::vector<Knob> at_a_point(std::vector<Knob> knobs) {
  for (Knob& knob : knobs) knob.width = 0;
  return knobs;
}

}  // namespace

ScreenSimulations::ScreenSimulations(std::vector<MeasuredFeatures> measured, std::vector<Knob> fitted,
                                     const Workshop& workshop, const ScreenEffort& effort, int first_run,
                                     const ScreenStart& start)
    : measured_(std::move(measured)), fitted_(std::move(fitted)), workshop_(workshop), first_run_(first_run) {
  const bool simulates = start.emulators.empty();
  std::vector<Emulator> nothing =
      simulates ? emulate(measured_, at_a_point(fitted_), effort.nothing, next_run(), workshop)
                : start.emulators;
  // The fit that put the parameters there has made the noise of its own simulations part of them.
  if (!simulates && effort.nothing_more > 0) try {
      join(nothing, emulate(measured_, at_a_point(fitted_), effort.nothing_more, next_run(), workshop));
    } catch (const BudgetSpent&) {  // the fit's own have to do
    }
  about_ = simulates ? straight(fitted_, 0.5) : start.knobs;
  const std::vector<Emulator> slopes =
      simulates ? emulate(measured_, about_, effort.slopes, next_run(), workshop) : start.emulators;
  for (const Emulator& e : nothing) means_.push_back(e.coefficients.row(0).transpose());
  ScreenStart used{start.for_means, start.likeliest};
  if (used.for_means.empty()) used.for_means = covariances_of(measured_, nothing, covariance_for_means);
  if (used.likeliest.empty()) used.likeliest = covariances_of(measured_, nothing, feature_covariance);
  of_means_ = frame_of(used.for_means, about_, slopes, nothing);
  outside_.emplace(of_means_.model.free);
  without_ = {(*outside_)(of_means_.model.residual), of_means_.model.noise};
  of_runs_ = frame_of(used.likeliest, about_, slopes, nothing);
  of_runs_.model.variance = variances(nothing, effort.nothing);
  of_runs_.model.simulations = filmed(nothing);
  of_runs_.model.codes_differ = rules::codes_differ;
}

void ScreenSimulations::look_at_the_middle(const Candidate& candidate, const LevelEffort& effort,
                                           Looked& looked) {
  if (candidate.fitted_knobs().front().exact) return look(candidate, effort, looked);
  std::vector<Candidate::Level> middle;
  for (const double sign : {1.0, -1.0}) {
    std::vector<Candidate::Level> levels = candidate.levels;
    std::erase_if(levels, [&](const Candidate::Level& level) { return !(level.strength * sign > 0); });
    std::stable_sort(levels.begin(), levels.end(), [](const Candidate::Level& a, const Candidate::Level& b) {
      return std::abs(a.strength) < std::abs(b.strength);
    });
    if (!levels.empty()) middle.push_back(levels[levels.size() / 2]);
  }
  looked.count = count_of(candidate, effort);
  add_levels(candidate, middle, looked.count, looked);
}

void ScreenSimulations::look(const Candidate& candidate, const LevelEffort& effort, Looked& looked) {
  if (candidate.fitted_knobs().front().exact) {
    if (!looked.whole) looked.levels = {exact_level(candidate)}, looked.count = 1;
    looked.exact = looked.whole = true;
    return;
  }
  const int count = count_of(candidate, effort);
  if (!looked.whole) {
    if (looked.levels.empty()) looked.count = count;
    looked.whole = true;
    return add_levels(candidate, candidate.levels, looked.count, looked);
  }
  for (const Candidate::Level& level : candidate.levels) try {
      if (looked.has(level.strength)) looked.add(simulated_level(candidate, level, count, looked), count);
    } catch (const PhysicsError& error) {
      looked.reason = error.what();
    } catch (const InputError& error) {
      looked.reason = error.what();
    }
}

void ScreenSimulations::add_levels(const Candidate& candidate, const std::vector<Candidate::Level>& chosen,
                                   int count, Looked& looked) {
  // A weak level that lies far from what was measured makes the stronger ones of its sign hopeless: they lie
  // farther.
  const auto is_hopeless = [&](double strength) {
    return std::any_of(looked.levels.begin(), looked.levels.end(), [&](const SignatureLevel& level) {
      return level.strength * strength > 0 && std::abs(level.strength) < std::abs(strength) &&
             Signature({level}, without_).log_likelihood(level.strength) < -effort::hopeless;
    });
  };
  for (const Candidate::Level& level : chosen) try {
      if (!looked.has(level.strength) && !is_hopeless(level.strength)) {
        looked.levels.push_back(simulated_level(candidate, level, count, looked));
        looked.simulated[level.strength] = count;
      }
    } catch (const PhysicsError& error) {
      looked.reason = error.what();
    } catch (const InputError& error) {
      looked.reason = error.what();
    }
}

double ScreenSimulations::log_likelihood_ratio(const std::vector<MeasuredFeatures>& other,
                                               const std::vector<Knob>& values, int count) {
  const std::vector<Emulator> there = emulate(other, at_a_point(values), count, next_run(), workshop_);
  // Where parameters were moved, what is known of them beforehand counts from there.
  const OtherModel model{change_at(there, values, of_runs_), chaos_of(there, of_runs_) / count,
                         variances(there, count)};
  return shakedown::log_likelihood_ratio(model, of_runs_.model);
}

ScreenSimulations::Frame ScreenSimulations::frame_of(const std::vector<Eigen::MatrixXd>& covariances,
                                                     const std::vector<Knob>& about,
                                                     const std::vector<Emulator>& slopes,
                                                     const std::vector<Emulator>& nothing) const {
  Frame frame;
  for (std::size_t r = 0; r < measured_.size(); ++r)
    frame.coordinates.emplace_back(measured_[r], covariances[r], model_error_of(measured_[r]));
  const auto count = std::ssize(fitted_);
  std::vector<Eigen::VectorXd> left;
  for (std::size_t r = 0; r < measured_.size(); ++r) left.push_back(measured_[r].values - means_[r]);
  frame.model.residual = stacked(left, frame);
  const Eigen::Index features = frame.model.residual.size() - count;
  frame.model.free.resize(frame.model.residual.size(), count);
  for (Eigen::Index k = 0; k < count; ++k) {
    std::vector<Eigen::VectorXd> column;
    for (const Emulator& e : slopes) column.push_back(e.coefficients.row(1 + k).transpose());
    frame.model.free.col(k) = stacked(column, frame);
    const Knob& knob = about[static_cast<std::size_t>(k)];
    if (!(knob.believed_error > 0)) continue;
    frame.model.free(features + k, k) = knob.width / knob.believed_error;
    frame.model.residual[features + k] = (knob.believed - knob.centre) / knob.believed_error;
  }
  frame.model.noise = chaos_of(nothing, frame) / static_cast<double>(nothing.front().residuals.rows());
  return frame;
}

Eigen::VectorXd ScreenSimulations::stacked(const std::vector<Eigen::VectorXd>& runs,
                                           const Frame& frame) const {
  Eigen::Index total = std::ssize(fitted_), at = 0;
  for (const Eigen::VectorXd& run : runs) total += run.size();
  Eigen::VectorXd column = Eigen::VectorXd::Zero(total);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    column.segment(at, runs[r].size()) = frame.coordinates[r](runs[r]);
    at += runs[r].size();
  }
  return column;
}

Eigen::VectorXd ScreenSimulations::change_to(const std::vector<Emulator>& there, const Frame& frame) const {
  std::vector<Eigen::VectorXd> changes;
  for (std::size_t r = 0; r < there.size(); ++r)
    changes.push_back(there[r].coefficients.row(0).transpose() - means_[r]);
  return stacked(changes, frame);
}

Eigen::ArrayXd ScreenSimulations::variances(const std::vector<Emulator>& there, int count) const {
  Eigen::Index total = std::ssize(fitted_), at = 0;
  for (const Emulator& e : there) total += e.residuals.cols();
  Eigen::ArrayXd column = Eigen::ArrayXd::Ones(total);
  for (std::size_t r = 0; r < there.size(); ++r) {
    const Eigen::MatrixXd& residuals = there[r].residuals;
    const Eigen::ArrayXd of_run =
        of_runs_.coordinates[r].variance(residuals.topRows(std::min<Eigen::Index>(residuals.rows(), count)));
    column.segment(at, of_run.size()) = of_run;
    at += of_run.size();
  }
  return column;
}

Eigen::MatrixXd ScreenSimulations::filmed(const std::vector<Emulator>& there) const {
  Eigen::Index total = std::ssize(fitted_), at = 0, rows = there.front().residuals.rows();
  for (const Emulator& e : there) total += e.residuals.cols(), rows = std::min(rows, e.residuals.rows());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(rows, total);
  for (std::size_t r = 0; r < there.size(); ++r) {
    Random random(29, r, Stream::camera);
    const Eigen::Index features = there[r].residuals.cols();
    // Repeats share simulations; here each is to have its own.
    Eigen::MatrixXd own(rows, features);
    for (Eigen::Index i = 0; i < rows; ++i)
      own.row(i) = there[r].residuals.row((i + static_cast<Eigen::Index>(r) * rows / 7) % rows);
    all.middleCols(at, features) = of_runs_.coordinates[r].filmed(own, random);
    at += features;
  }
  return all;
}

double ScreenSimulations::chaos_of(const std::vector<Emulator>& there, const Frame& frame) {
  double sum = 0;
  for (std::size_t r = 0; r < there.size(); ++r) sum += frame.coordinates[r].chaos(there[r].residuals);
  return sum;
}

Eigen::VectorXd ScreenSimulations::change_at(const std::vector<Emulator>& there,
                                             const std::vector<Knob>& fitted, const Frame& frame) const {
  Eigen::VectorXd change = change_to(there, frame);
  const Eigen::Index features = change.size() - std::ssize(fitted_);
  for (std::size_t k = 0; k < fitted_.size(); ++k)
    for (const Knob& moved : fitted)
      if (moved.key == fitted_[k].key && !moved.exact && fitted_[k].believed_error > 0)
        change[features + static_cast<Eigen::Index>(k)] =
            (moved.centre - fitted_[k].centre) / fitted_[k].believed_error;
  return change;
}

std::vector<Emulator> ScreenSimulations::simulated_at(const Candidate& candidate, const LevelPoint& point,
                                                      int count) {
  std::vector<MeasuredFeatures> with =
      candidate.slow || candidate.dear ? kicked_rarely(measured_) : measured_;
  for (MeasuredFeatures& m : with) {
    m.setup = prepared(m.setup, candidate, workshop_.known);
    set_knob(m.setup, point.knob, workshop_.known);
  }
  return emulate(with, at_a_point(point.fitted), count, next_run(), workshop_);
}

LevelPoint ScreenSimulations::moved_by(LevelPoint point, const Eigen::VectorXd& steps) const {
  for (std::size_t k = 0; k < fitted_.size(); ++k) {
    if (fitted_[k].exact) continue;
    Knob& moved = point.fitted[k];
    const double before = moved.centre;
    moved.centre = std::clamp(before + steps[static_cast<Eigen::Index>(k)], moved.low, moved.high);
    if (moved.key == point.knob.absent_key)
      point.knob.centre =
          std::clamp(point.knob.centre + moved.centre - before, point.knob.low, point.knob.high);
  }
  return point;
}

LevelPoint ScreenSimulations::start_of(const Candidate& candidate, const Candidate::Level& level,
                                       const Looked& looked) const {
  LevelPoint point{fitted_, candidate.fitted_knobs().front()};
  point.knob.centre = level.value;
  const LevelPoint* nearest = nullptr;
  double strength = 0;
  for (const auto& [other, there] : looked.points)
    if (other * level.strength > 0 && std::abs(other) > std::abs(strength))
      nearest = &there, strength = other;
  if (nearest == nullptr) return within_reach(std::move(point), level.strength);
  Eigen::VectorXd steps(std::ssize(fitted_));
  for (std::size_t k = 0; k < fitted_.size(); ++k)
    steps[static_cast<Eigen::Index>(k)] =
        (nearest->fitted[k].centre - fitted_[k].centre) * level.strength / strength;
  return within_reach(moved_by(std::move(point), steps), level.strength);
}

LevelPoint ScreenSimulations::within_reach(LevelPoint point, double strength) {
  for (Knob& absent : point.fitted) {
    if (absent.key != point.knob.absent_key) continue;
    point.knob.centre = std::clamp(absent.centre + strength, point.knob.low, point.knob.high);
    absent.centre = std::clamp(point.knob.centre - strength, absent.low, absent.high);
  }
  return point;
}

std::optional<LevelPoint> ScreenSimulations::moved_along(const Eigen::VectorXd& change,
                                                         const LevelPoint& point) const {
  Eigen::VectorXd steps = outside_->taken_of(-change);
  bool far = false;
  for (std::size_t k = 0; k < fitted_.size(); ++k) {
    double& step = steps[static_cast<Eigen::Index>(k)];
    far = far || (!fitted_[k].exact && std::abs(step) > effort::moves_along);
    step *= about_[k].width;
  }
  if (!far) return std::nullopt;
  return moved_by(point, steps);
}

SignatureLevel ScreenSimulations::simulated_level(const Candidate& candidate, const Candidate::Level& level,
                                                  int count, Looked& looked) {
  const auto known = looked.points.find(level.strength);
  LevelPoint point = known != looked.points.end() ? known->second : start_of(candidate, level, looked);
  std::vector<Emulator> there = simulated_at(candidate, point, count);
  Eigen::VectorXd change = change_at(there, point.fitted, of_means_);
  if (known == looked.points.end()) {
    if (const auto moved = moved_along(change, point)) {
      point = within_reach(*moved, level.strength);
      there = simulated_at(candidate, point, count);
      change = change_at(there, point.fitted, of_means_);
    }
    looked.points[level.strength] = point;
  }
  return {level.strength, (*outside_)(change), chaos_of(there, of_means_) / count};
}

SignatureLevel ScreenSimulations::exact_level(const Candidate& candidate) const {
  const Knob& knob = candidate.fitted_knobs().front();
  std::vector<Eigen::VectorXd> changes;
  for (const MeasuredFeatures& m : measured_) changes.push_back(knob.width * m.by_camera.at(knob.key));
  return {knob.width, (*outside_)(stacked(changes, of_means_)), 0};
}

}  // namespace shakedown
