// SPDX-License-Identifier: MIT
#include "effect_screen.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "errors.hpp"
#include "feature_covariance.hpp"
#include "linear_model.hpp"
#include "refit.hpp"
#include "signature.hpp"

namespace shakedown {

namespace {

using Roots = std::vector<Eigen::LLT<Eigen::MatrixXd>>;

/// Of each run's chaos, camera noise and difference of two codes, as a fit weighs them.
Roots roots_of(const std::vector<MeasuredFeatures>& measured, const std::vector<Emulator>& emulators) {
  Roots roots;
  for (std::size_t r = 0; r < measured.size(); ++r) {
    const double model_error = RefitOptions{}.model_error * measured[r].setup.release.displacement;
    Eigen::MatrixXd covariance = feature_covariance(emulators[r].residuals, measured[r].plan, model_error);
    if (measured[r].own.cols() > 0) covariance += measured[r].own * measured[r].own.transpose();
    roots.emplace_back(covariance);
  }
  return roots;
}

/// What free parameters cannot take up of a whitened column. Below the features stands a row for each of
/// them: what is known of it beforehand.
class Outside {
 public:
  explicit Outside(const Eigen::MatrixXd& free)
      : free_(free),
        normal_(free.transpose() * free + 1e-9 * Eigen::MatrixXd::Identity(free.cols(), free.cols())) {}
  Eigen::VectorXd operator()(const Eigen::VectorXd& column) const {
    return column - free_ * normal_.solve(free_.transpose() * column);
  }

 private:
  Eigen::MatrixXd free_;
  Eigen::LDLT<Eigen::MatrixXd> normal_;
};

std::vector<Knob> at_a_point(std::vector<Knob> knobs) {
  for (Knob& knob : knobs) knob.width = 0;
  return knobs;
}

/// All that one screening shares.
class Screen {
 public:
  Screen(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
         const Workshop& workshop, const ScreenEffort& effort, int first_run,
         const std::vector<Eigen::MatrixXd>& metric)
      : measured_(measured), fitted_(fitted), workshop_(workshop), first_run_(first_run) {
    const std::vector<Emulator> nothing =
        emulate(measured, at_a_point(fitted), effort.nothing, next_run(), workshop);
    const std::vector<Knob> about = straight(fitted, 0.5);
    const std::vector<Emulator> slopes = emulate(measured, about, effort.slopes, next_run(), workshop);
    for (const Eigen::MatrixXd& covariance : metric) roots_.emplace_back(covariance);
    if (roots_.empty()) roots_ = roots_of(measured, nothing);
    for (const Emulator& e : nothing) means_.push_back(e.coefficients.row(0).transpose());
    for (std::size_t r = 0; r < nothing.size(); ++r)
      chaos_ += roots_[r].matrixL().solve(nothing[r].residuals.transpose()).squaredNorm() /
                static_cast<double>(nothing[r].residuals.rows());
    set_free_parameters(about, slopes);
    without_.noise = chaos_ / static_cast<double>(nothing.front().residuals.rows());
  }

  /// The posterior of the candidate's strength, from simulations at its levels; nothing where the engine
  /// could simulate none, with the reason.
  std::optional<Signature> signature_of(const Candidate& candidate, int count, std::string& reason) {
    if (candidate.fitted_knobs().front().exact) return Signature({exact_level(candidate)}, without_, true);
    std::vector<SignatureLevel> levels;
    for (const Candidate::Level& level : candidate.levels) try {
        levels.push_back(simulated_level(candidate, level, count));
      } catch (const PhysicsError& error) {
        reason = error.what();
      } catch (const InputError& error) {
        reason = error.what();
      }
    if (levels.empty()) return std::nullopt;
    return Signature(levels, without_);
  }

 private:
  int next_run() { return first_run_ + 1000 * batches_++; }

  /// Whitened, all runs below each other and a zero for each free parameter.
  Eigen::VectorXd stacked(const std::vector<Eigen::VectorXd>& runs) const {
    Eigen::Index total = std::ssize(fitted_), at = 0;
    for (const Eigen::VectorXd& run : runs) total += run.size();
    Eigen::VectorXd column = Eigen::VectorXd::Zero(total);
    for (std::size_t r = 0; r < runs.size(); ++r) {
      column.segment(at, runs[r].size()) = roots_[r].matrixL().solve(runs[r]);
      at += runs[r].size();
    }
    return column;
  }

  void set_free_parameters(const std::vector<Knob>& about, const std::vector<Emulator>& slopes) {
    const auto count = std::ssize(fitted_);
    std::vector<Eigen::VectorXd> left;
    for (std::size_t r = 0; r < measured_.size(); ++r) left.push_back(measured_[r].values - means_[r]);
    Eigen::VectorXd residual = stacked(left);
    const Eigen::Index features = residual.size() - count;
    Eigen::MatrixXd free(residual.size(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
      std::vector<Eigen::VectorXd> column;
      for (const Emulator& e : slopes) column.push_back(e.coefficients.row(1 + k).transpose());
      free.col(k) = stacked(column);
      const Knob& knob = about[static_cast<std::size_t>(k)];
      if (!(knob.believed_error > 0)) continue;
      free(features + k, k) = knob.width / knob.believed_error;
      residual[features + k] = (knob.believed - knob.centre) / knob.believed_error;
    }
    outside_.emplace(free);
    without_.residual = (*outside_)(residual);
  }

  SignatureLevel simulated_level(const Candidate& candidate, const Candidate::Level& level, int count) {
    std::vector<MeasuredFeatures> with =
        candidate.slow || candidate.dear ? kicked_rarely(measured_) : measured_;
    Knob knob = candidate.fitted_knobs().front();
    knob.centre = level.value;
    for (MeasuredFeatures& m : with) {
      m.setup = prepared(m.setup, candidate, workshop_.known);
      set_knob(m.setup, knob, workshop_.known);
    }
    const std::vector<Emulator> there = emulate(with, at_a_point(fitted_), count, next_run(), workshop_);
    std::vector<Eigen::VectorXd> changes;
    for (std::size_t r = 0; r < there.size(); ++r)
      changes.push_back(there[r].coefficients.row(0).transpose() - means_[r]);
    return {level.strength, (*outside_)(stacked(changes)), chaos_ / count};
  }

  /// A camera's error is arithmetic on the recording.
  SignatureLevel exact_level(const Candidate& candidate) const {
    const Knob& knob = candidate.fitted_knobs().front();
    std::vector<Eigen::VectorXd> changes;
    for (const MeasuredFeatures& m : measured_) changes.push_back(knob.width * m.by_camera.at(knob.key));
    return {knob.width, (*outside_)(stacked(changes)), 0};
  }

  const std::vector<MeasuredFeatures>& measured_;
  const std::vector<Knob>& fitted_;
  const Workshop& workshop_;
  int first_run_, batches_ = 0;
  Roots roots_;                         ///< one metric for all
  std::vector<Eigen::VectorXd> means_;  ///< of the model without candidates, m
  double chaos_ = 0;                    ///< expected square of one simulation's chaos, whitened
  std::optional<Outside> outside_;
  SignatureResidual without_;
};

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

Screening screen(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
                 const std::vector<Candidate>& candidates, const Workshop& workshop,
                 const ScreenEffort& effort, int first_run, const std::vector<Eigen::MatrixXd>& metric) {
  Screen all(measured, fitted, workshop, effort, first_run, metric);
  Screening screening;
  std::vector<Eigen::VectorXd> changes;  // at the strength found, of each in the list
  bool spent = false;
  for (const std::size_t c : by_cost(candidates)) {
    const Candidate& candidate = candidates[c];
    ScreenedEffect effect{c, candidate.effect, 0, candidate.levels.front().value, 0, candidate.prior};
    Eigen::VectorXd change;
    if (!spent) try {
        std::string reason;
        const int count = candidate.dear ? effort.dear : candidate.slow ? effort.slow : effort.plain;
        const std::optional<Signature> signature = all.signature_of(candidate, count, reason);
        if (!signature) {
          screening.left_out.push_back({candidate.effect, reason});
          continue;
        }
        weigh_by(*signature, candidate, effect);
        change = signature->change(candidate.strength_of(effect.value));
      } catch (const BudgetSpent&) {
        spent = true;
      }
    screening.list.push_back(std::move(effect));
    changes.push_back(std::move(change));
  }
  name_look_alikes(changes, screening.list);
  std::stable_sort(screening.list.begin(), screening.list.end(),
                   [](const ScreenedEffect& a, const ScreenedEffect& b) { return a.gain > b.gain; });
  return screening;
}

}  // namespace shakedown
