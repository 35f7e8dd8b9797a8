// SPDX-License-Identifier: MIT
#include "linear_screen.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "errors.hpp"
#include "feature_covariance.hpp"
#include "linear_model.hpp"
#include "refit.hpp"

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

/// Below the features a row for each of the first `fitted` knobs: what is known of it beforehand.
LinearModel whitened(const std::vector<MeasuredFeatures>& measured, const std::vector<Emulator>& emulators,
                     const std::vector<Knob>& knobs, std::size_t fitted, const Roots& roots) {
  LinearModel model =
      linear_model(measured, emulators, knobs.size(),
                   [&](std::size_t r, Eigen::MatrixXd& block) { roots[r].matrixL().solveInPlace(block); });
  const Eigen::Index features = model.residual.size(), count = static_cast<Eigen::Index>(fitted);
  model.columns.conservativeResize(features + count, Eigen::NoChange);
  model.residual.conservativeResize(features + count);
  model.columns.bottomRows(count).setZero();
  model.residual.tail(count).setZero();
  for (Eigen::Index k = 0; k < count; ++k) {
    const Knob& knob = knobs[static_cast<std::size_t>(k)];
    if (!(knob.believed_error > 0)) continue;
    model.columns(features + k, k) = knob.width / knob.believed_error;
    model.residual[features + k] = (knob.believed - knob.centre) / knob.believed_error;
  }
  return model;
}

/// An effect that stands for a parameter of its own where the setup has one for all (the side walls'
/// restitution) is absent where it equals that one. In the simulations it was held still while the other
/// moved: without the effect both move together.
void move_together(LinearModel& model, const std::vector<Knob>& knobs, std::size_t fitted) {
  for (std::size_t k = fitted; k < knobs.size(); ++k)
    for (std::size_t j = 0; j < fitted; ++j)
      if (!knobs[k].absent_key.empty() && knobs[k].absent_key == knobs[j].key)
        model.columns.col(static_cast<Eigen::Index>(j)) +=
            knobs[j].width / knobs[k].width * model.columns.col(static_cast<Eigen::Index>(k));
}

/// Chaos that went into each regression, whitened: its coefficients err by this times (X'X)^-1.
std::vector<double> chaos_of(const std::vector<Emulator>& emulators, const Roots& roots) {
  std::vector<double> chaos;
  for (std::size_t r = 0; r < emulators.size(); ++r) {
    const Eigen::MatrixXd& residuals = emulators[r].residuals;
    chaos.push_back(roots[r].matrixL().solve(residuals.transpose()).squaredNorm() /
                    static_cast<double>(residuals.rows()));
  }
  return chaos;
}

/// Expected inner product of the errors of two terms of the regressions, whitened, over all runs.
double shared_error(const std::vector<Emulator>& emulators, const std::vector<double>& chaos, Eigen::Index a,
                    Eigen::Index b) {
  double sum = 0;
  for (std::size_t r = 0; r < emulators.size(); ++r) sum += chaos[r] * emulators[r].inverse_normal(a, b);
  return sum;
}

/// What the fitted parameters cannot take up of a column.
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

/// What the fitted parameters alone leave.
struct Left {
  Outside outside;
  Eigen::VectorXd residual;
  double own_error = 0;  ///< expected square of the residual's error by the simulations
};

/// Candidates with knobs, scattered together beside the fitted parameters.
struct Scattered {
  std::vector<Knob> knobs;  ///< the fitted parameters first
  std::vector<std::size_t> candidate_of;
  LinearModel linear;
  std::vector<Emulator> emulators;
  std::vector<double> chaos;
  Eigen::Index fitted = 0;

  Left left() const {
    const Outside outside(linear.columns.leftCols(fitted));
    return {outside, outside(residual_without(linear, knobs, static_cast<std::size_t>(fitted))),
            shared_error(emulators, chaos, 0, 0)};
  }
};

/// All that one screening shares.
struct Screen {
  const std::vector<Knob>& fitted;
  const std::vector<Candidate>& candidates;
  const Workshop& workshop;
  int first_run;
  Roots roots{};  ///< one metric for all
  int batches = 0;
  Screening result{};
  std::vector<Eigen::VectorXd> signatures{};  ///< of each in the list, whitened, with the fitted parameters
                                              ///< projected out; empty: not weighed

  int next_run() { return first_run + 5000 * batches++; }
  void keep(ScreenedEffect effect, Eigen::VectorXd signature) {
    result.list.push_back(std::move(effect));
    signatures.push_back(std::move(signature));
  }
};

/// In `count` runs of each setup. Sets the metric, if none is there.
Scattered scattered(Screen& s, const std::vector<MeasuredFeatures>& measured,
                    const std::vector<std::size_t>& members, int count) {
  auto [knobs, candidate_of, with] =
      beside_fitted(measured, s.fitted, s.candidates, members, s.workshop.known);
  std::vector<Emulator> emulators = emulate(with, knobs, count, s.next_run(), s.workshop);
  if (s.roots.empty()) s.roots = roots_of(with, emulators);
  LinearModel linear = whitened(with, emulators, knobs, s.fitted.size(), s.roots);
  move_together(linear, knobs, s.fitted.size());
  std::vector<double> chaos = chaos_of(emulators, s.roots);
  return {std::move(knobs),     std::move(candidate_of), std::move(linear),
          std::move(emulators), std::move(chaos),        std::ssize(s.fitted)};
}

/// What the engine cannot simulate is left out: a group that it refuses is halved until what it refuses
/// stands alone. Elsewhere, in batches of those that it can.
std::vector<Scattered> what_runs(Screen& s, const std::vector<MeasuredFeatures>& measured,
                                 const std::vector<std::size_t>& members, int count) {
  const auto apart = [&](const std::string& reason) -> std::vector<Scattered> {
    if (members.size() == 1) {
      s.result.left_out.push_back({s.candidates[members.front()].effect, reason});
      return {};
    }
    const auto middle = members.begin() + std::ssize(members) / 2;
    std::vector<Scattered> both = what_runs(s, measured, {members.begin(), middle}, count);
    for (Scattered& other : what_runs(s, measured, {middle, members.end()}, count))
      both.push_back(std::move(other));
    return both;
  };
  std::vector<Scattered> whole;
  try {
    whole.push_back(scattered(s, measured, members, count));
  } catch (const PhysicsError& error) {
    if (members.empty()) throw;  // the model itself, whatever the candidates
    return apart(error.what());
  } catch (const InputError& error) {
    if (members.empty()) throw;
    return apart(error.what());
  }
  return whole;
}

/// Each scattered candidate by what the fitted parameters leave without them: in the same runs (`same_runs`),
/// or, where they are few and what is scattered is far from linear, in others.
void judge_scattered(Screen& s, const Scattered& scattered, const Left& without, bool same_runs) {
  const auto& [outside, residual, error_of_residual] = without;
  for (std::size_t k = 0; k < scattered.candidate_of.size(); ++k) {
    const Eigen::Index column = scattered.fitted + static_cast<Eigen::Index>(k);
    const Knob& knob = scattered.knobs[static_cast<std::size_t>(column)];
    const Eigen::VectorXd signature = outside(scattered.linear.columns.col(column));
    // The regression's noise in the signature lengthens it, and where the residual has the same noise in it
    // the two seem to agree.
    const double absent = knob.z_of(knob.absent),
                 own = knob.exact
                           ? 0
                           : shared_error(scattered.emulators, scattered.chaos, column + 1, column + 1),
                 with_constant =
                     knob.exact ? 0 : shared_error(scattered.emulators, scattered.chaos, 0, column + 1),
                 square = signature.squaredNorm(), true_square = square - own,
                 along = signature.dot(residual) + (same_runs ? with_constant + absent * own : 0.0);
    const bool seen_at_all = true_square > 0;  // else all that is there is noise
    const double by = seen_at_all ? along / true_square : 0, z = absent + by;
    const bool allowed = by == 0 || knob.at(z) != knob.absent;  // a drag cannot push
    const Candidate& candidate = s.candidates[scattered.candidate_of[k]];
    StrengthSeen seen = candidate.prior;
    seen.gain = allowed && seen_at_all ? along * along / square : 0;
    seen.value = knob.at(z) - knob.absent;
    if (seen.one_sided) seen.value = std::abs(seen.value);
    seen.error = seen_at_all ? knob.width * std::sqrt(square) / true_square : 0;
    s.keep({scattered.candidate_of[k], candidate.effect, seen.gain, knob.at(z), seen, {}, seen_at_all},
           signature);
  }
}

/// On or off: the model with it, beside the model without. The difference is its signature at the strength
/// that it is prepared with; what is fixed of it is a length, and its strength goes with the curvature.
void screen_switch(Screen& s, const std::vector<MeasuredFeatures>& measured, std::size_t c, int count,
                   const Left& without) {
  const Candidate& candidate = s.candidates[c];
  std::vector<MeasuredFeatures> with = measured;
  for (MeasuredFeatures& m : with) m.setup = prepared(m.setup, candidate, s.workshop.known);
  const std::vector<Knob> beside = straight(s.fitted, 0.5);
  const std::vector<Emulator> emulators = emulate(with, beside, count, s.next_run(), s.workshop);
  const Eigen::VectorXd signature =
      without.residual -
      without.outside(whitened(with, emulators, beside, s.fitted.size(), s.roots).residual);
  const double own = shared_error(emulators, chaos_of(emulators, s.roots), 0, 0),
               square = std::max(0.0, signature.squaredNorm() - own - without.own_error),
               along = signature.dot(without.residual) - without.own_error;
  const bool is_seen = square > 0 && along > 0;
  const double length = candidate.fixed.back().second * (is_seen ? std::sqrt(square / along) : 1);
  StrengthSeen seen = candidate.prior;
  seen.gain = is_seen ? along * along / signature.squaredNorm() : 0;
  seen.value = 1 / (length * length);
  seen.error = seen.gain > 0 ? seen.value / std::sqrt(seen.gain) : 0;
  s.keep({c, candidate.effect, seen.gain, length, seen, {}, true}, signature);
}

void name_look_alikes(Screen& s) {
  std::vector<ScreenedEffect>& list = s.result.list;
  for (std::size_t a = 0; a < list.size(); ++a)
    for (std::size_t b = 0; b < list.size(); ++b) {
      if (a == b || list[a].effect == list[b].effect || s.signatures[a].size() == 0 ||
          s.signatures[b].size() == 0)
        continue;
      const double cosine = s.signatures[a].dot(s.signatures[b]) /
                            std::max(1e-300, s.signatures[a].norm() * s.signatures[b].norm());
      if (std::abs(cosine) > 0.9) list[a].look_alikes.push_back(list[b].effect);
    }
}

}  // namespace

Screening screen(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& fitted,
                 const std::vector<Candidate>& candidates, const Workshop& workshop, int count, int first_run,
                 const std::vector<Eigen::MatrixXd>& metric) {
  Screen s{fitted, candidates, workshop, first_run};
  for (const Eigen::MatrixXd& covariance : metric) s.roots.emplace_back(covariance);
  const ScatterGroups groups = scatter_groups(candidates);
  std::vector<Scattered> cheap = what_runs(s, measured, groups.cheap, count);
  if (cheap.empty()) cheap.push_back(scattered(s, measured, {}, count));
  const Left without = cheap.front().left();
  for (const Scattered& group : cheap) judge_scattered(s, group, without, &group == &cheap.front());
  const int few = std::max(40, count / 8), fewest = std::max(24, few / 2);
  const std::vector<MeasuredFeatures> rough = kicked_rarely(measured);
  for (const std::vector<std::size_t>& members : groups.slow)
    for (const Scattered& group :
         what_runs(s, rough, members, std::max(few, count / 6 * static_cast<int>(members.size()))))
      judge_scattered(s, group, without, false);
  for (const std::vector<std::size_t>& members : groups.dear) {
    const Candidate& candidate = candidates[members.front()];
    if (candidate.always)
      s.keep(
          {members.front(), candidate.effect, 0, candidate.knobs.front().centre, candidate.prior, {}, false},
          {});
    else  // what is dear has a strong signature
      for (const Scattered& group : what_runs(s, measured, members, fewest))
        judge_scattered(s, group, without, false);
  }
  for (std::size_t c = 0; c < candidates.size(); ++c)
    if (candidates[c].knobs.empty()) try {
        screen_switch(s, measured, c, few, without);
      } catch (const PhysicsError& error) {
        s.result.left_out.push_back({candidates[c].effect, error.what()});
      } catch (const InputError& error) {
        s.result.left_out.push_back({candidates[c].effect, error.what()});
      }
  name_look_alikes(s);
  std::stable_sort(s.result.list.begin(), s.result.list.end(),
                   [](const ScreenedEffect& a, const ScreenedEffect& b) { return a.gain > b.gain; });
  return std::move(s.result);
}

}  // namespace shakedown
