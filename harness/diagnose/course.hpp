// SPDX-License-Identifier: MIT
// Runs the course of a diagnosis: every step makes a new state from the one before.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "conclusion.hpp"
#include "errors.hpp"
#include "state.hpp"

namespace shakedown {

/// Makes one diagnosis.
class Course {
 public:
  /// `recorded`: as the films show it; `measurement`: each run from where simulations of it begin. All must
  /// outlive it.
  Course(const Setup& user, const Measurement& recorded, const Measurement& measurement, const Engine& engine,
         const DiagnoseOptions& options)
      : user_(user), recorded_(recorded), tools_(measurement, engine, options) {}

  /// Runs the whole course; may be called once. InputError, PhysicsError and Interrupted pass.
  Diagnosis run();

 private:
  /// Compares amplitude, lag, loss factor and effective mass of forced runs with the final model's; does
  /// nothing once the time is up.
  void compare_forced_runs();
  /// Judges boxes without grains. Formulas are looked for where no law of the list explains the waveform.
  void judge_empty_box(const MomentumOptions& whole);
  /// Judges boxes with grains: from the model as given to the answer.
  void judge();
  /// Returns the first state, with the packing and the camera that the recordings show.
  DiagnosisState with_packing();
  /// Returns the state as the user gave it, compared with the measurements; nothing is fitted.
  DiagnosisState compared_as_given(const DiagnosisState& state);
  /// Chooses the engine that simulates from now on, by the question which engine makes what the films show.
  DiagnosisState with_engine(DiagnosisState state);
  /// Returns the spring's frequency that the balance found, or else the setup's, Hz.
  double frequency_found() const;
  /// Returns the state with its parameters free, and with these strengths that the balance found; about what
  /// the first periods told, where they were fitted.
  DiagnosisState with_terms(DiagnosisState state, const std::vector<FoundTerm>& terms, double frequency);
  /// Returns with_terms(), with the formula that the balance wrote for a force of no list.
  DiagnosisState with_what_was_found(DiagnosisState state, const std::vector<FoundTerm>& terms,
                                     double frequency);
  /// Returns the state with its parameters and what the balance found fitted.
  DiagnosisState refit_of(const DiagnosisState& before);
  /// Makes a fit that an answer cannot do without, in this share of simulations and time; with the least
  /// effort where they do not suffice.
  Refit fit_within(double share, const DiagnosisState& state, const std::string& stage, Effort effort);
  /// Returns what `step` makes of a state, or `otherwise` where simulations or time do not suffice or the
  /// engine gives up.
  template <typename Step>
  DiagnosisState unless_spent(const std::string& name, const DiagnosisState& otherwise, Step&& step) {
    try {
      return step();
    } catch (const BudgetSpent&) {
      leave_out(name);
    } catch (const PhysicsError& error) {
      result_.notes.push_back(name + ": could not be simulated: " + error.what());
    }
    return otherwise;
  }
  /// Names a step among those that were left out, once.
  void leave_out(const std::string& step);
  /// Takes an effect back in the table of hypotheses (taken_back()).
  void take_back(const std::string& effect);
  /// Takes back those of the effects that are not kept.
  void take_back_others(const std::vector<std::string>& effects, const std::vector<std::string>& kept);
  /// Returns the state with the formula's force on the grains, where the model with it on the box fails and
  /// that one is better.
  DiagnosisState with_the_force_on_its_body(const DiagnosisState& on_box);
  /// Tries the sets that the balance could not rule out, where what it found leaves the whole motion
  /// unexplained: the balance weighs impulses alone. The most probable one with the motion counted in is
  /// kept.
  DiagnosisState settled_by_ensembles(const DiagnosisState& before, const DiagnosisState& found);
  /// Looks beside a doubtful fit of parameters, which may have ended at the wrong place of a valley. Returns
  /// the state with the better fit; the ladder follows.
  DiagnosisState& beside(DiagnosisState& refitted);
  /// Adds effects one after the other, while something more is probably missing. Looks beside `refitted`, the
  /// state without any of them, where it is doubtful and nothing was found that is sure.
  DiagnosisState search(DiagnosisState& refitted);
  /// Returns the state fitted with full effort, or as it is where that is worse or there is no time for it.
  DiagnosisState with_full_effort(DiagnosisState state);
  /// Returns the state without what later effects have made needless; `added`: how many were added last at
  /// once.
  DiagnosisState still_needed(DiagnosisState state, std::size_t added);
  /// Takes back an effect that was added to a model which the data accept, where the last fit finds next to
  /// nothing of it or no error falls with it; and what was added between two models that the data reject,
  /// where no error falls.
  DiagnosisState without_untold(DiagnosisState state, const DiagnosisState& refitted);
  /// Takes back, with a note, what `state` has beyond `refitted`, which it returns.
  DiagnosisState without_added(const DiagnosisState& state, const DiagnosisState& refitted);
  /// Keeps an effect of the ranking; a fitted one stands in for one that was not.
  void keep_ranked(const RankedEffect& ranked);
  /// Adds what was not looked at to the hypotheses, as probable as it was beforehand.
  void keep_priors(const DiagnosisState& state);

  const Setup& user_;
  const Measurement& recorded_;
  DiagnosisTools tools_;
  Diagnosis result_;
  RunnerUp runner_up_;
  std::optional<Refit> first_periods_;      ///< the fit that chose the engine
  std::optional<DiagnosisState> accepted_;  ///< before the last effect was added, where the data accept that
  std::size_t added_last_ = 1;              ///< how many effects at once
  std::vector<std::string> wholly_fitted_;  ///< effects beside which the last fit was made already
};

/// Tells whether no run has grains, whether the setup says so or the runs do.
bool is_empty(const Setup& setup, const Measurement& measurement);

/// Returns the name of the ladder's step with these effects: "refitted + ...".
std::string step_name(const std::vector<std::string>& effects);

}  // namespace shakedown
