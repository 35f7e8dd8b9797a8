// SPDX-License-Identifier: MIT
// Tells which effects are worth a fit, and how probable each is: every candidate is simulated at a few
// strengths beside the fitted model, with its parameters as they are fitted, and the measured features say
// which strength they ask for when those parameters move along. A fit only confirms.
#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "candidates.hpp"
#include "screen_effort.hpp"
#include "screen_start.hpp"

namespace shakedown {

/// Says what the signature of one candidate tells.
struct ScreenedEffect {
  std::size_t candidate = 0;  ///< index among the candidates
  std::string effect;
  double gain = 0;          ///< of chi2
  double value = 0;         ///< estimate of the parameter, SI
  double log_evidence = 0;  ///< ln of its likelihood, averaged over the prior, over that of nothing
  StrengthSeen seen{};      ///< the strength from its absence, with its error and prior
  std::vector<std::string>
      look_alikes{};      ///< candidates whose signature after refitting has a cosine above 0.9 with its own
  bool weighed = false;   ///< false: not simulated, for want of simulations or time
  double share_seen = 1;  ///< of the gain, that the noise of the simulations leaves
};

/// Tells whether another look may make it more than doubtful: beside the best one, whose ln evidence is
/// `most`, and beside nothing with its prior among as many effects as are searched for. What the noise of its
/// simulations hides counts for it.
bool is_left_open(const ScreenedEffect& effect, double most, double searched);

/// Tells whether the noise of its simulations is what keeps it from being said to be there, or not.
bool is_undecided(const ScreenedEffect& effect, double searched);

/// Holds the candidates that were weighed, and those that could not be.
struct Screening {
  std::vector<ScreenedEffect> list;  ///< best first
  struct LeftOut {
    std::string effect, reason;
  };
  std::vector<LeftOut> left_out;  ///< candidates that the engine could not simulate
};

/// Says what the signatures of two effects at once tell, which add.
struct ScreenedPair {
  std::size_t first = 0, second = 0;               ///< indices among the candidates
  double first_strength = 0, second_strength = 0;  ///< from absence, most likely ones
  double log_evidence = 0;                         ///< as of one
};

class ScreenSimulations;

/// Holds the model without candidates, simulated once, and weighs candidates beside it.
class EffectScreen {
 public:
  /// Simulates the model without candidates, as far as `start` has not what is needed. `fitted` stand at
  /// their fitted values, in the order of the knobs that were fitted. `first_run` addresses the random
  /// numbers. PhysicsError and InputError are of the model without candidates.
  EffectScreen(std::vector<MeasuredFeatures> measured, std::vector<Knob> fitted, const Workshop& workshop,
               const ScreenEffort& effort, int first_run, const ScreenStart& start = {});
  ~EffectScreen();
  EffectScreen(const EffectScreen&) = delete;
  EffectScreen& operator=(const EffectScreen&) = delete;

  /// Weighs each candidate by simulations at its levels, best first. What there is no time for is in the
  /// list, not weighed.
  Screening weigh(const std::vector<Candidate>& candidates);

  /// Returns the pairs of different effects among those weighed last whose signatures were simulated, best
  /// first; makes no simulations of its own.
  std::vector<ScreenedPair> pairs(const std::vector<Candidate>& candidates) const;

  /// Returns ln of the likelihood of another model of the same runs over that of the model without
  /// candidates, both by their means and spreads, camera and what else is free moved along. `other` is
  /// simulated `count` times at `values`, parameters among them wherever a fit put them. BudgetSpent,
  /// PhysicsError and InputError pass.
  double log_likelihood_ratio(const std::vector<MeasuredFeatures>& other, const std::vector<Knob>& values,
                              int count);

 private:
  struct Weighed;
  /// Weighs a candidate by all simulations that it has.
  void weigh_again(const Candidate& candidate, Weighed& one);
  /// Weighs a candidate by a few simulations. Returns false where it cannot be simulated here.
  bool glance(const Candidate& candidate, Weighed& one);
  /// Tells whether more simulations may make the effect probable beside one of ln evidence `best`.
  bool may_be_missing(const ScreenedEffect& effect, double best) const;
  /// Simulates those that are worth more than a glance, best first.
  void look_closer(const std::vector<Candidate>& candidates, std::vector<Weighed>& list);

  std::unique_ptr<ScreenSimulations> simulations_;
  std::map<std::size_t, Signature> signatures_;  ///< of candidates that were simulated, by index
  ScreenEffort effort_;
  std::size_t searched_;  ///< number of effects that are looked for
};

}  // namespace shakedown
