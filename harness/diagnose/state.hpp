// SPDX-License-Identifier: MIT
// Holds a diagnosis on its way: states, which are values, and the tools that make the next one from it. To go
// back is to take the state before.
#pragma once
#include <chrono>
#include <ctime>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "damper_errors.hpp"
#include "diagnosis.hpp"
#include "effort.hpp"
#include "evidence.hpp"
#include "known_effects.hpp"
#include "refit_options.hpp"
#include "slow_wander.hpp"

namespace shakedown {

/// Holds the model as far as it has been amended, and how it fits.
struct DiagnosisState {
  Setup setup;                       ///< with the effects found
  std::vector<Knob> theta;           ///< what the user may refit
  std::vector<Knob> found;           ///< strengths of the effects found
  std::vector<Knob> camera;          ///< what is known of the camera to an error
  std::vector<std::string> missing;  ///< effects found, in the order added
  Refit fit;
  bool dear = false;                ///< an effect makes runs cost several times a plain one
  std::vector<Knob> before_fits{};  ///< theta before any fit
  /// Refit::scatter of the model where a fit of this state begins; infinite where nobody has simulated it.
  double scatter_at_start = std::numeric_limits<double>::infinity();

  /// Returns all that a fit of it varies.
  std::vector<Knob> knobs() const;
  /// Returns the same with its knobs at the values of its fit, and what was found in its setup.
  DiagnosisState settled(KnownEffects known) const;
};

/// Holds what all steps share; counts simulations and numbers the batches of random microstates.
class DiagnosisTools {
 public:
  /// Measurement, engine and options must outlive it.
  DiagnosisTools(const Measurement& measurement, const Engine& engine, const DiagnoseOptions& options);
  DiagnosisTools(const DiagnosisTools&) = delete;
  DiagnosisTools& operator=(const DiagnosisTools&) = delete;

  /// Return what the steps were given, and what simulates for all of them.
  const Measurement& measurement() const { return measurement_; }
  const DiagnoseOptions& options() const { return options_; }
  KnownEffects known() const { return options_.known; }
  Workshop& workshop() { return workshop_; }
  /// Returns how many simulations were made.
  std::int64_t runs() const { return runs_; }
  /// Returns the share of the simulations or of the time that was spent, whichever is more.
  double share_spent() const;
  /// From now on BudgetSpent is thrown where this share of the simulations or of the time would be passed.
  void limit_to(double share);
  /// From now on nothing is refused.
  void without_limit();
  /// Returns the share that was set last; 1 where there is no limit.
  double limit() const { return limit_; }
  /// Tells whether the time that may be spent is over.
  bool time_is_up() const { return share_of_time() > 1; }
  /// Returns the number of the first run in a new batch of random microstates.
  int next_batch() { return 100000 * ++batch_; }
  /// Begins a stage and tells of it.
  void begin(const std::string& stage) {
    stage_ = stage;
    if (options_.progress) options_.progress(stage_, share_spent());
  }

  /// From now on features tell what release and masses are uncertain by. Returns knobs of what all runs
  /// share.
  std::vector<Knob> weigh_damper(const Setup& setup);

  /// From now on features have tracks that wander so.
  void set_wander(const Wander& wander) { wander_ = wander; }

  /// Returns the measured runs beside this setup, with what the camera does to them.
  std::vector<MeasuredFeatures> features(const Setup& setup) const;
  /// Fits the measured runs up to so many seconds after release, by this engine; its simulations stay apart
  /// from those of other fits.
  Refit fit_of_first(double seconds, const DiagnosisState& state, const Engine& engine, Effort effort);
  /// Fits these knobs to all measured runs. `judged_by`: the fit whose covariances judge this one; null: its
  /// own. Where the emulator promised much more than its solution keeps, the fit looks again if the
  /// judged_chi2 that was promised is below `look_again_below`. BudgetSpent, PhysicsError and Interrupted
  /// pass.
  Refit fit(const DiagnosisState& state, const std::string& stage, const std::vector<Knob>& knobs,
            Effort effort, const Refit* judged_by = nullptr,
            double look_again_below = std::numeric_limits<double>::infinity());
  /// Returns the effort of the last fit of all, which may take all that is left: `usual` where that suffices
  /// for it and a round more, by what simulations of the same effects took, else `in_haste`.
  Effort affordable(const DiagnosisState& state, const Effort& usual, const Effort& in_haste) const;
  /// Looks beside the state's own fit, where that is doubtful, and returns the better of both.
  Refit look_beside(const DiagnosisState& state, const std::string& stage);

 private:
  const Measurement& measurement_;
  const DiagnoseOptions& options_;
  /// Returns the share of the time that was spent; 0 where there is no limit.
  double share_of_time() const;
  /// Returns the options of a fit of this effort; it makes fewer simulations where runs are dear.
  RefitOptions options_of(const DiagnosisState& state, Effort effort);
  std::vector<MeasuredFeatures> features_of(const Measurement& measurement, const Setup& setup) const;

  std::int64_t budget_, runs_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::clock_t clock_at_start_;
  SimulationPool pool_;
  Workshop workshop_;
  double limit_ = 1;
  std::map<std::vector<std::string>, double> share_of_a_simulation_;  ///< beside these effects
  std::string stage_;
  int batch_ = 0;
  std::vector<DamperError> damper_errors_;
  std::vector<FeatureColumns> damper_columns_;
  Wander wander_;
};

/// Gives back the limit that held when it was made, however its scope is left.
class KeptLimit {
 public:
  /// The tools must outlive it, and be limited.
  explicit KeptLimit(DiagnosisTools& tools) : tools_(tools), share_(tools.limit()) {}
  ~KeptLimit() { tools_.limit_to(share_); }
  KeptLimit(const KeptLimit&) = delete;
  KeptLimit& operator=(const KeptLimit&) = delete;
  double share() const { return share_; }

 private:
  DiagnosisTools& tools_;
  double share_;
};

/// Holds one round of the search: what was weighed, and the state with the effect that was added (none: as
/// before).
struct SearchRound {
  std::vector<Hypothesis> table;  ///< beside the state before; weighed
  std::vector<RankedEffect> ranking;
  std::vector<std::string> notes;
  std::vector<std::string> not_tried;  ///< for want of simulations or time
  bool added = false;
  DiagnosisState next;
  std::optional<PromisedEffect> promised{};  ///< where nothing was added for want of time
  std::string runner_up;  ///< the effect that explains nearly as well as the one added; empty: none
  Setup runner_up_setup;  ///< as it was fitted
};
/// Makes one round. `seen_by_balance`: keys that the momentum balance has judged better. An effect that the
/// engine cannot simulate here is left out and named in the notes; PhysicsError and InputError are of the
/// model itself.
SearchRound search_round(const DiagnosisState& state, DiagnosisTools& tools,
                         const std::vector<std::string>& seen_by_balance);

/// Returns what a round would weigh, each effect at its prior: the table where no round was held.
std::vector<Hypothesis> not_looked_at(const DiagnosisState& state, DiagnosisTools& tools,
                                      const std::vector<std::string>& seen_by_balance);

/// Returns the state fitted with full effort; strengths that were looked for as one are fitted by themselves
/// where the data bear it.
DiagnosisState concluded(const DiagnosisState& state, DiagnosisTools& tools, const std::string& stage);

/// Returns the state without the effects that the later ones have made needless. `added`: how many of the
/// last were added at once.
DiagnosisState pruned(const DiagnosisState& state, DiagnosisTools& tools,
                      const std::vector<std::string>& from_balance, std::size_t added);

/// Returns the missing effects that a fit tells by less than two standard errors, least told first, but those
/// of the balance and one that was added last by itself: that one was weighed alone; of two at once only
/// their sum was, and one may be nothing.
std::vector<std::string> hardly_told(const DiagnosisState& state,
                                     const std::vector<std::string>& from_balance, std::size_t added);

/// Tells whether the data reject the model by more than two codes of the same physics differ.
bool is_rejected(const Refit& fit);

/// Tells whether they reject it by so much that more simulations would not make it fit, and that no line from
/// its parameters reaches what is missing.
bool is_far_off(const Refit& fit);

/// Tells whether the data reject the model and what imitates an effect has led its restitutions to where
/// hardly anything tells of effects: about restitutions of .345 and .999 neither friction nor attraction
/// shows.
bool is_led_astray(const DiagnosisState& state);

/// Returns the state with its parameters back at what was believed of them before a fit led them astray, each
/// as wide as a line reaches there. Measured on one film of 50 mN of attraction: of 64 mN a screen with boxes
/// as wide as those of a first fit sees ln evidence -31, with these +357; a frequency 0.06 % off turns the
/// phase by a hundredth in fifteen swings.
DiagnosisState as_believed(DiagnosisState state);

/// Returns a fit as a step of the ladder.
LadderStep step_of(const std::string& name, const Refit& fit);

/// Appends b to a.
std::vector<Knob> together(std::vector<Knob> a, const std::vector<Knob>& b);

/// Returns the strength of the effect of this fitted value, from its absence, and its standard error; of a
/// length the curvature, 1/m^2.
std::pair<double, double> strength_of(const Refit& fit, std::size_t value);

/// Returns by how many standard errors the strength of the effect differs from its absence; of several
/// strengths by the most, of one that is not in the fit by 0.
double told_by(const Refit& fit, const std::string& effect);

/// Tells whether the strength of the effect differs from its absence by more than so many standard errors.
bool is_told(const Refit& fit, const std::string& effect, double standard_errors);

/// Tells whether it is a parameter of the setup, such as a restitution, of which something is believed.
bool is_believed(const Knob& knob);

}  // namespace shakedown
