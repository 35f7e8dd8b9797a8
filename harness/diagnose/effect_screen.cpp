// SPDX-License-Identifier: MIT
#include "effect_screen.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "errors.hpp"
#include "feature_coordinates.hpp"
#include "feature_covariance.hpp"
#include "linear_model.hpp"
#include "model_ratio.hpp"
#include "outside.hpp"
#include "random.hpp"
#include "refit.hpp"
#include "rules.hpp"
#include "signature.hpp"

namespace shakedown {

namespace {

/// What two codes differ by in a feature of this run, m.
double model_error_of(const MeasuredFeatures& measured) {
  return RefitOptions{}.model_error * measured.setup.release.displacement;
}

/// Of each run's chaos, camera noise and difference of two codes.
using CovarianceOf = Eigen::MatrixXd(const Eigen::MatrixXd&, const FeaturePlan&, double);
std::vector<Eigen::MatrixXd> covariances_of(const std::vector<MeasuredFeatures>& measured,
                                            const std::vector<Emulator>& emulators, CovarianceOf& of) {
  std::vector<Eigen::MatrixXd> list;
  for (std::size_t r = 0; r < measured.size(); ++r)
    list.push_back(
        with_own(of(emulators[r].residuals, measured[r].plan, model_error_of(measured[r])), measured[r]));
  return list;
}

std::vector<Knob> at_a_point(std::vector<Knob> knobs) {
  for (Knob& knob : knobs) knob.width = 0;
  return knobs;
}

void weigh_by(const Signature& signature, const Candidate& candidate, ScreenedEffect& effect) {
  const StrengthPosterior found = posterior_of(signature, candidate.strengths);
  effect.weighed = true;
  effect.log_evidence = found.log_evidence;
  effect.gain = found.gain;
  effect.value = candidate.value_of(found.strength);
  effect.seen.gain = found.gain;
  effect.seen.value = effect.seen.one_sided ? std::abs(found.strength) : found.strength;
  effect.seen.error = found.error;
}

void name_look_alikes(const std::vector<Eigen::VectorXd>& changes, std::vector<ScreenedEffect>& list) {
  for (std::size_t a = 0; a < list.size(); ++a)
    for (std::size_t b = 0; b < list.size(); ++b) {
      if (a == b || list[a].effect == list[b].effect || changes[a].size() == 0 || changes[b].size() == 0)
        continue;
      const double cosine =
          changes[a].dot(changes[b]) / std::max(1e-300, changes[a].norm() * changes[b].norm());
      if (std::abs(cosine) > 0.9) list[a].look_alikes.push_back(list[b].effect);
    }
}

/// Where a level is simulated.
struct LevelPoint {
  std::vector<Knob> fitted;  ///< the fitted parameters, moved to where they go beside it
  Knob knob;                 ///< of the candidate
};

/// Levels of a candidate as far as they were simulated.
struct Looked {
  std::vector<SignatureLevel> levels{};
  std::map<double, LevelPoint> points{};  ///< by strength
  int count = 0;                          ///< simulations of each level, of each different setup
  std::string reason{};
  bool exact = false;

  bool has(double strength) const {
    return std::any_of(levels.begin(), levels.end(),
                       [&](const SignatureLevel& level) { return level.strength == strength; });
  }
  /// The mean of those before and of `more` simulations.
  void add(const SignatureLevel& level, int more) {
    const double before = count, all = count + more;
    for (SignatureLevel& one : levels)
      if (one.strength == level.strength) {
        one.change = (before * one.change + more * level.change) / all;
        one.noise = (before * before * one.noise + double(more) * more * level.noise) / (all * all);
      }
  }
};

/// The cheapest first, so that where simulations run out most have been looked at.
std::vector<std::size_t> by_cost(const std::vector<Candidate>& candidates) {
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto cost = [&](std::size_t c) { return candidates[c].dear ? 2 : candidates[c].slow ? 1 : 0; };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cost(a) < cost(b); });
  return order;
}

}  // namespace

/// All that one screening shares.
class EffectScreen::Simulated {
 public:
  Simulated(std::vector<MeasuredFeatures> measured, std::vector<Knob> fitted, const Workshop& workshop,
            const ScreenEffort& effort, int first_run, const ScreenStart& start)
      : measured_(std::move(measured)),
        fitted_(std::move(fitted)),
        workshop_(workshop),
        effort_(effort),
        first_run_(first_run) {
    const bool simulates = start.emulators.empty();
    const std::vector<Emulator> nothing =
        simulates ? emulate(measured_, at_a_point(fitted_), effort.nothing, next_run(), workshop)
                  : start.emulators;
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

  /// Simulates the candidate's levels so many times more. Those that the engine cannot simulate are left out,
  /// with the reason.
  void look(const Candidate& candidate, const LevelEffort& effort, Looked& looked) {
    const bool is_first = looked.count == 0;
    if (candidate.fitted_knobs().front().exact) {
      if (is_first) looked.levels = {exact_level(candidate)}, looked.count = 1, looked.exact = true;
      return;
    }
    const int count = candidate.dear ? effort.dear : candidate.slow ? effort.slow : effort.plain;
    // Far from what is measured already where it is weak: what is stronger, of the same sign, is farther.
    constexpr double hopeless = -100;  // ln of its likelihood over that of nothing
    bool is_hopeless[2] = {false, false};
    std::vector<SignatureLevel> levels;
    for (const Candidate::Level& level : candidate.levels) try {
        bool& none_of_this_sign = is_hopeless[level.strength < 0];
        if (is_first ? none_of_this_sign : !looked.has(level.strength)) continue;
        levels.push_back(simulated_level(candidate, level, count, looked));
        none_of_this_sign = Signature({levels.back()}, without_).log_likelihood(level.strength) < hopeless;
      } catch (const PhysicsError& error) {
        looked.reason = error.what();
      } catch (const InputError& error) {
        looked.reason = error.what();
      }
    if (is_first)
      looked.levels = std::move(levels);
    else
      for (const SignatureLevel& level : levels) looked.add(level, count);
    looked.count += count;
  }

  Screening weigh(const std::vector<Candidate>& candidates);

  double log_likelihood_ratio(const std::vector<MeasuredFeatures>& other, const std::vector<Knob>& values,
                              int count) {
    const std::vector<Emulator> there = emulate(other, at_a_point(values), count, next_run(), workshop_);
    // Where parameters were moved, what is known of them beforehand counts from there.
    const OtherModel model{change_at(there, values, of_runs_), chaos_of(there, of_runs_) / count,
                           variances(there, count)};
    return shakedown::log_likelihood_ratio(model, of_runs_.model);
  }

 private:
  /// One metric for all: coordinates of each run, and what the model without candidates leaves in them.
  struct Frame {
    std::vector<Coordinates> coordinates;
    FirstModel model;
  };

  int next_run() { return first_run_ + 1000 * batches_++; }

  Frame frame_of(const std::vector<Eigen::MatrixXd>& covariances, const std::vector<Knob>& about,
                 const std::vector<Emulator>& slopes, const std::vector<Emulator>& nothing) const {
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

  /// In the coordinates, all runs below each other and a zero for each free parameter.
  Eigen::VectorXd stacked(const std::vector<Eigen::VectorXd>& runs, const Frame& frame) const {
    Eigen::Index total = std::ssize(fitted_), at = 0;
    for (const Eigen::VectorXd& run : runs) total += run.size();
    Eigen::VectorXd column = Eigen::VectorXd::Zero(total);
    for (std::size_t r = 0; r < runs.size(); ++r) {
      column.segment(at, runs[r].size()) = frame.coordinates[r](runs[r]);
      at += runs[r].size();
    }
    return column;
  }

  Eigen::VectorXd change_to(const std::vector<Emulator>& there, const Frame& frame) const {
    std::vector<Eigen::VectorXd> changes;
    for (std::size_t r = 0; r < there.size(); ++r)
      changes.push_back(there[r].coefficients.row(0).transpose() - means_[r]);
    return stacked(changes, frame);
  }

  /// Of so many simulations at most: an estimate's error is to be the same in two models that are compared.
  Eigen::ArrayXd variances(const std::vector<Emulator>& there, int count) const {
    Eigen::Index total = std::ssize(fitted_), at = 0;
    for (const Emulator& e : there) total += e.residuals.cols();
    Eigen::ArrayXd column = Eigen::ArrayXd::Ones(total);
    for (std::size_t r = 0; r < there.size(); ++r) {
      const Eigen::MatrixXd& residuals = there[r].residuals;
      const Eigen::ArrayXd of_run = of_runs_.coordinates[r].variance(
          residuals.topRows(std::min<Eigen::Index>(residuals.rows(), count)));
      column.segment(at, of_run.size()) = of_run;
      at += of_run.size();
    }
    return column;
  }

  /// Simulations x features.
  Eigen::MatrixXd filmed(const std::vector<Emulator>& there) const {
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

  /// Expected square of one simulation's chaos.
  static double chaos_of(const std::vector<Emulator>& there, const Frame& frame) {
    double sum = 0;
    for (std::size_t r = 0; r < there.size(); ++r) sum += frame.coordinates[r].chaos(there[r].residuals);
    return sum;
  }

  /// Of the means, all fitted parameters at these points; below them, where these are from what is known.
  Eigen::VectorXd change_at(const std::vector<Emulator>& there, const std::vector<Knob>& fitted,
                            const Frame& frame) const {
    Eigen::VectorXd change = change_to(there, frame);
    const Eigen::Index features = change.size() - std::ssize(fitted_);
    for (std::size_t k = 0; k < fitted_.size(); ++k)
      for (const Knob& moved : fitted)
        if (moved.key == fitted_[k].key && !moved.exact && fitted_[k].believed_error > 0)
          change[features + static_cast<Eigen::Index>(k)] =
              (moved.centre - fitted_[k].centre) / fitted_[k].believed_error;
    return change;
  }

  std::vector<Emulator> simulated_at(const Candidate& candidate, const LevelPoint& point, int count) {
    std::vector<MeasuredFeatures> with =
        candidate.slow || candidate.dear ? kicked_rarely(measured_) : measured_;
    for (MeasuredFeatures& m : with) {
      m.setup = prepared(m.setup, candidate, workshop_.known);
      set_knob(m.setup, point.knob, workshop_.known);
    }
    return emulate(with, at_a_point(point.fitted), count, next_run(), workshop_);
  }

  /// The fitted parameters where their slopes see the best fit beside this change of the features, and the
  /// candidate as strong beside them; none where they hardly move.
  std::optional<LevelPoint> moved_along(const Eigen::VectorXd& change, LevelPoint point) const {
    constexpr double beyond = 0.25;  // widths of the box whose slopes they are: a line errs by its square
    const Eigen::VectorXd z = outside_->taken_of(-change);
    bool far = false;
    for (std::size_t k = 0; k < fitted_.size(); ++k) {
      if (fitted_[k].exact) continue;
      const double by = z[static_cast<Eigen::Index>(k)] * about_[k].width;
      far = far || std::abs(z[static_cast<Eigen::Index>(k)]) > beyond;
      Knob& moved = point.fitted[k];
      moved.centre = std::clamp(moved.centre + by, moved.low, moved.high);
      if (moved.key == point.knob.absent_key)
        point.knob.centre =
            std::clamp(point.knob.centre + moved.centre - fitted_[k].centre, point.knob.low, point.knob.high);
    }
    if (!far) return std::nullopt;
    return point;
  }

  /// Beside an effect that restitutions imitate they lie elsewhere, farther than a line tells: the level is
  /// simulated again there.
  SignatureLevel simulated_level(const Candidate& candidate, const Candidate::Level& level, int count,
                                 Looked& looked) {
    const bool is_first = !looked.points.contains(level.strength);
    LevelPoint& point = looked.points[level.strength];
    if (is_first) {
      point = {fitted_, candidate.fitted_knobs().front()};
      point.knob.centre = level.value;
    }
    std::vector<Emulator> there = simulated_at(candidate, point, count);
    Eigen::VectorXd change = change_at(there, point.fitted, of_means_);
    if (const auto moved = is_first ? moved_along(change, point) : std::nullopt) {
      there = simulated_at(candidate, *moved, count);
      point = *moved;
      change = change_at(there, point.fitted, of_means_);
    }
    return {level.strength, (*outside_)(change), chaos_of(there, of_means_) / count};
  }

  /// A camera's error is arithmetic on the recording.
  SignatureLevel exact_level(const Candidate& candidate) const {
    const Knob& knob = candidate.fitted_knobs().front();
    std::vector<Eigen::VectorXd> changes;
    for (const MeasuredFeatures& m : measured_) changes.push_back(knob.width * m.by_camera.at(knob.key));
    return {knob.width, (*outside_)(stacked(changes, of_means_)), 0};
  }

  std::vector<MeasuredFeatures> measured_;
  std::vector<Knob> fitted_, about_;  ///< at their values; those whose slopes are known
  const Workshop& workshop_;
  ScreenEffort effort_;
  int first_run_, batches_ = 0;
  std::vector<Eigen::VectorXd> means_;  ///< of the model without candidates, m
  Frame of_means_, of_runs_;            ///< for changes of the means, and for how likely one run is
  std::optional<Outside> outside_;      ///< of the means' frame
  SignatureResidual without_;
};

EffectScreen::EffectScreen(std::vector<MeasuredFeatures> measured, std::vector<Knob> fitted,
                           const Workshop& workshop, const ScreenEffort& effort, int first_run,
                           const ScreenStart& start)
    : simulated_(std::make_unique<Simulated>(std::move(measured), std::move(fitted), workshop, effort,
                                             first_run, start)) {}

EffectScreen::~EffectScreen() = default;

Screening EffectScreen::weigh(const std::vector<Candidate>& candidates) {
  return simulated_->weigh(candidates);
}

double EffectScreen::log_likelihood_ratio(const std::vector<MeasuredFeatures>& other,
                                          const std::vector<Knob>& values, int count) {
  return simulated_->log_likelihood_ratio(other, values, count);
}

Screening EffectScreen::Simulated::weigh(const std::vector<Candidate>& candidates) {
  struct Weighed {
    ScreenedEffect effect;
    Looked looked;
    Eigen::VectorXd change{};  ///< at the strength found
  };
  std::vector<Weighed> list;
  Screening screening;
  const auto weigh_again = [&](Weighed& one) {
    const Candidate& candidate = candidates[one.effect.candidate];
    const Signature signature(one.looked.levels, without_, one.looked.exact);
    weigh_by(signature, candidate, one.effect);
    one.change = signature.change(candidate.strength_of(one.effect.value));
  };
  bool spent = false;
  for (const std::size_t c : by_cost(candidates)) {
    const Candidate& candidate = candidates[c];
    Weighed one{{c, candidate.effect, 0, candidate.levels.front().value, 0, candidate.prior}, {}};
    if (!spent) try {
        look(candidate, effort_.glance, one.looked);
        if (one.looked.levels.empty()) {
          screening.left_out.push_back({candidate.effect, one.looked.reason});
          continue;
        }
        weigh_again(one);
      } catch (const BudgetSpent&) {
        spent = true;
      }
    list.push_back(std::move(one));
  }
  std::stable_sort(list.begin(), list.end(), [](const Weighed& a, const Weighed& b) {
    return a.effect.log_evidence > b.effect.log_evidence;
  });
  // Beside the most probable or nothing less than the odds at which a model is doubted. A glance of few
  // simulations may see half of an evidence (seen: 200 where 226 was to beat).
  constexpr double glance_sees = 0.5;
  double most = 0;
  for (const Weighed& one : list)
    if (one.effect.weighed) most = std::max(most, one.effect.log_evidence);
  const double left_open = glance_sees * most + std::log(rules::doubtful);
  try {
    for (Weighed& one : list)
      if (!spent && one.effect.weighed && one.effect.log_evidence > left_open) {
        look(candidates[one.effect.candidate], effort_.look, one.looked);
        weigh_again(one);
      }
  } catch (const BudgetSpent&) {  // a glance has to do
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Weighed& a, const Weighed& b) { return a.effect.gain > b.effect.gain; });
  std::vector<Eigen::VectorXd> changes;
  for (Weighed& one : list) {
    screening.list.push_back(std::move(one.effect));
    changes.push_back(std::move(one.change));
  }
  name_look_alikes(changes, screening.list);
  return screening;
}

}  // namespace shakedown
