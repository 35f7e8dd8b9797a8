// SPDX-License-Identifier: MIT
// Simulates the model without candidates and each candidate at its levels, in one metric.
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "candidates.hpp"
#include "feature_coordinates.hpp"
#include "model_ratio.hpp"
#include "outside.hpp"
#include "screen_effort.hpp"
#include "screen_start.hpp"
#include "signature.hpp"

namespace shakedown {

/// Says where a level is simulated.
struct LevelPoint {
  std::vector<Knob> fitted;  ///< the fitted parameters, moved to where they go beside it
  Knob knob;                 ///< of the candidate
};

/// Holds the levels of a candidate as far as they were simulated.
struct Looked {
  std::vector<SignatureLevel> levels{};
  std::map<double, LevelPoint> points{};  ///< by strength
  int count = 0;                          ///< simulations of a level's first look, of each different setup
  std::map<double, int> simulated{};      ///< of each level so far, by strength
  bool whole = false;                     ///< all levels were looked at, not the middle one alone
  std::string reason{};                   ///< why a level could not be simulated; empty: none failed
  bool exact = false;                     ///< its change is arithmetic on the recording

  /// Tells whether this level was simulated.
  bool has(double strength) const {
    return std::any_of(levels.begin(), levels.end(),
                       [&](const SignatureLevel& level) { return level.strength == strength; });
  }
  /// Takes the mean of the simulations before and of `more` new ones into the level.
  void add(const SignatureLevel& level, int more) {
    int& so_far = simulated[level.strength];
    const double before = so_far, all = so_far + more;
    so_far += more;
    for (SignatureLevel& one : levels)
      if (one.strength == level.strength) {
        one.change = (before * one.change + more * level.change) / all;
        one.noise = (before * before * one.noise + double(more) * more * level.noise) / (all * all);
      }
  }
};

/// Makes the simulations of one screening, and holds what they share.
class ScreenSimulations {
 public:
  /// Simulates the model without candidates, as far as `start` has not what is needed. `fitted`: knobs at
  /// their fitted values; `first_run` addresses the random numbers. The workshop must outlive this.
  ScreenSimulations(std::vector<MeasuredFeatures> measured, std::vector<Knob> fitted,
                    const Workshop& workshop, const ScreenEffort& effort, int first_run,
                    const ScreenStart& start);

  /// Simulates the candidate's middle level alone, of each sign that it has, so many times.
  void look_at_the_middle(const Candidate& candidate, const LevelEffort& effort, Looked& looked);

  /// Simulates the candidate's levels so many times more; those not looked at yet as often as the middle ones
  /// were, where only those were. Those that the engine cannot simulate are left out, with the reason.
  void look(const Candidate& candidate, const LevelEffort& effort, Looked& looked);

  /// Returns a candidate's signature as far as it was looked at, beside what the model without candidates
  /// leaves.
  Signature signature_of(const Looked& looked) const { return {looked.levels, without_, looked.exact}; }

  /// Does what EffectScreen::log_likelihood_ratio() says.
  double log_likelihood_ratio(const std::vector<MeasuredFeatures>& other, const std::vector<Knob>& values,
                              int count);

 private:
  /// Holds one metric for all: coordinates of each run, and what the model without candidates leaves in them.
  struct Frame {
    std::vector<Coordinates> coordinates;
    FirstModel model;
  };

  /// Returns the first run of the next batch; up to 400 batches of up to 250 share none, nor with what comes
  /// after.
  int next_run() { return first_run_ + 250 * batches_++; }

  /// Returns the metric of these covariances (m^2, of each run), with the slopes by the widths of `about`.
  Frame frame_of(const std::vector<Eigen::MatrixXd>& covariances, const std::vector<Knob>& about,
                 const std::vector<Emulator>& slopes, const std::vector<Emulator>& nothing) const;

  /// Returns changes of the features (m, of each run) in the coordinates: all runs below each other and a
  /// zero for each free parameter.
  Eigen::VectorXd stacked(const std::vector<Eigen::VectorXd>& runs, const Frame& frame) const;

  /// Returns the change of the means from the model without candidates to these, stacked.
  Eigen::VectorXd change_to(const std::vector<Emulator>& there, const Frame& frame) const;

  /// Returns the variance of each coordinate, of `count` simulations at most: an estimate's error is to be
  /// the same in two models that are compared.
  Eigen::ArrayXd variances(const std::vector<Emulator>& there, int count) const;

  /// Returns what single simulations leave of their mean, as a camera would have filmed it: simulations x
  /// coordinates.
  Eigen::MatrixXd filmed(const std::vector<Emulator>& there) const;

  /// Returns the expected square of one simulation's chaos.
  static double chaos_of(const std::vector<Emulator>& there, const Frame& frame);

  /// Returns the change of the means with the fitted parameters at these points; below it, how far these lie
  /// from where they were fitted, in errors of what is believed.
  Eigen::VectorXd change_at(const std::vector<Emulator>& there, const std::vector<Knob>& fitted,
                            const Frame& frame) const;

  /// Adds the levels chosen, weakest first, that are not there; none of a sign beyond one that is hopeless.
  void add_levels(const Candidate& candidate, const std::vector<Candidate::Level>& chosen, int count,
                  Looked& looked);

  /// Simulates the candidate at this point, `count` times for each different setup.
  std::vector<Emulator> simulated_at(const Candidate& candidate, const LevelPoint& point, int count);

  /// Returns the point with the fitted parameters moved by these steps as far as their bounds allow, the
  /// candidate as strong beside them.
  LevelPoint moved_by(LevelPoint point, const Eigen::VectorXd& steps) const;

  /// Returns where a level is simulated first: the parameters as far in proportion as the strongest weaker
  /// level of the same sign has moved them.
  LevelPoint start_of(const Candidate& candidate, const Candidate::Level& level, const Looked& looked) const;

  /// Returns the point where the effect has this strength: what it replaces a part of (the wall's restitution
  /// of side walls) is moved where the bounds of its parameter do not allow as much there.
  static LevelPoint within_reach(LevelPoint point, double strength);

  /// Returns the point with the fitted parameters where by their slopes they take up what they can of this
  /// change of the features (not of the residual: a weaker effect moves them less, and none not at all); none
  /// where they hardly move.
  std::optional<LevelPoint> moved_along(const Eigen::VectorXd& change, const LevelPoint& point) const;

  /// Simulates a level. Beside an effect that restitutions imitate these lie elsewhere, farther than a line
  /// tells: the level is simulated again there.
  SignatureLevel simulated_level(const Candidate& candidate, const Candidate::Level& level, int count,
                                 Looked& looked);

  /// Returns the level of a camera's error, which is arithmetic on the recording.
  SignatureLevel exact_level(const Candidate& candidate) const;

  std::vector<MeasuredFeatures> measured_;
  std::vector<Knob> fitted_, about_;  ///< at their values; those whose slopes are known
  const Workshop& workshop_;
  int first_run_, batches_ = 0;
  std::vector<Eigen::VectorXd> means_;  ///< of the model without candidates, m
  Frame of_means_, of_runs_;            ///< for changes of the means, and for how likely one run is
  std::optional<Outside> outside_;      ///< of the means' frame
  SignatureResidual without_;
};

}  // namespace shakedown
