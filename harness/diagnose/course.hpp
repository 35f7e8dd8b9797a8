// SPDX-License-Identifier: MIT
// The course of a diagnosis: every step makes a new state from the one before.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "conclusion.hpp"
#include "errors.hpp"
#include "state.hpp"

namespace shakedown {

class Course {
 public:
  /// `recorded`: as the films show it; `measurement`: each run from where simulations of it begin. All must
  /// outlive it.
  Course(const Setup& user, const Measurement& recorded, const Measurement& measurement, const Engine& engine,
         const DiagnoseOptions& options)
      : user_(user), recorded_(recorded), tools_(measurement, engine, options) {}

  /// Once. InputError, PhysicsError and Interrupted pass.
  Diagnosis run();

 private:
  /// Amplitude, lag, loss factor and effective mass beside the final model's; nothing once the time is up.
  void compare_forced_runs();
  /// Formulas are looked for where no law of the list explains the waveform.
  void judge_empty_box(const MomentumOptions& whole);
  void judge();
  DiagnosisState with_packing();
  /// Who simulates from now on, after the question which engine makes what the films show.
  DiagnosisState with_engine(DiagnosisState state);
  double frequency_found() const;
  /// Parameters free, and these strengths that the balance found; about what the first periods told, where
  /// they were fitted.
  DiagnosisState with_terms(DiagnosisState state, const std::vector<FoundTerm>& terms, double frequency);
  /// with_terms, and the formula that the balance wrote for a force of no list.
  DiagnosisState with_what_was_found(DiagnosisState state, const std::vector<FoundTerm>& terms,
                                     double frequency);
  DiagnosisState refit_of(const DiagnosisState& before);
  /// A fit that an answer cannot do without, in this share of simulations and time: with less effort where
  /// they do not suffice.
  Refit fit_within(double share, const DiagnosisState& state, const std::string& stage, Effort effort);
  /// What `step` makes of a state, or the state as it is where simulations or time do not suffice.
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
  void leave_out(const std::string& step);
  void take_back(const std::string& effect);
  /// The balance weighs impulses alone. Where what it found leaves the whole motion unexplained, the sets
  /// that it could not rule out are tried, and the most probable one with the motion counted in is kept.
  DiagnosisState with_the_force_on_its_body(const DiagnosisState& on_box);
  DiagnosisState settled_by_ensembles(const DiagnosisState& before, const DiagnosisState& found);
  /// The fit of parameters may have ended at the wrong place of a valley. The state with the better fit; the
  /// ladder follows.
  DiagnosisState& beside(DiagnosisState& refitted);
  /// Effects one after the other, while something more is probably missing. `refitted`, without any of them,
  /// is looked beside where it is doubtful and nothing was found that is sure.
  DiagnosisState search(DiagnosisState& refitted);
  DiagnosisState with_full_effort(DiagnosisState state);
  /// Without what later effects have made needless; `added`: how many were added last at once.
  DiagnosisState still_needed(DiagnosisState state, std::size_t added);
  /// An effect that was added to a model which the data accept, and of which the last fit finds next to
  /// nothing, is taken back; so is what was added between two models that the data reject, where no error
  /// falls.
  DiagnosisState without_untold(DiagnosisState state, const DiagnosisState& refitted);
  /// Says so of what `state` has beyond `refitted`, which is what stands.
  DiagnosisState without_added(const DiagnosisState& state, const DiagnosisState& refitted);
  void keep_ranked(const RankedEffect& ranked);
  /// What was not looked at stays as probable as it was.
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

/// No run has grains, whether the setup says so or the runs do.
bool is_empty(const Setup& setup, const Measurement& measurement);

/// Of the ladder.
std::string step_name(const std::vector<std::string>& effects);

}  // namespace shakedown
