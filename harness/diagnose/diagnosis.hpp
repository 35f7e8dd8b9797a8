// SPDX-License-Identifier: MIT
// Diagnoses which effects a model lacks, from measurements. It has two likelihoods: the momentum balance (no
// simulation) sees forces on the box, ensembles of the hard engine see everything else. Each hypothesis
// (nothing, an effect, several, the camera, a force of no list) gets a probability; the most probable one is
// fitted, and what remains is tested.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "candidates.hpp"
#include "contact_curve.hpp"
#include "decay_comparison.hpp"
#include "evidence.hpp"
#include "execution.hpp"
#include "known_effects.hpp"
#include "momentum.hpp"
#include "refit.hpp"

namespace shakedown {

/// Stands in Diagnosis::not_tried where there was no time to look for any further effect.
constexpr const char* no_round_held = "one more effect";

/// Says what explains the data. adequate: the model holds as given. refit: with other values of its
/// parameters. measurement: with errors of camera or clock within what is known of them. missing: effects are
/// missing. unknown: none that is known explains the data.
enum class Verdict { adequate, refit, measurement, missing, unknown };

/// Holds a parameter of the answer's model, SI, with its 95 % interval.
struct DiagnosedParameter {
  std::string name;  ///< setup path
  double value = 0, low = 0, high = 0;
  std::string unit;
  std::string word;  ///< value in words (a packing); empty for numbers
};

/// Says how much one effect would explain.
struct RankedEffect {
  std::string effect;
  double gain = 0;  ///< fall of chi2 when it joins, everything else refitted
  double held_out_gain =
      0;  ///< fall of the chi2 of box lengths left out of the fit; NaN: not fitted, or one length only
  double standard_error = 0;  ///< of held_out_gain
  double value = 0;           ///< its strength
  std::vector<std::string> look_alikes{};
  bool fitted = false;      ///< its gain is that of a fit, not of its signature at a few strengths
  bool by_balance = false;  ///< its gain is that of the momentum balance, which needs no simulation
};

/// Says what one of the models that were tried leaves: rms of all runs.
struct LadderStep {
  std::string step;
  double error_box = 0, error_centre = 0, held_out_error_box = 0;  ///< m
  double floor_box = 0, floor_centre = 0;                          ///< m
  double p_value = 1, scatter = 1;
};

/// Holds restitution as a free function of the closing speed, beside a model that no known effect mends.
struct FreeRestitution {
  ContactCurve curve;
  Setup setup;               ///< with the effect user_restitution and what else was fitted, ready to try
  LadderStep without, with;  ///< the model that fails, and the same with the curve
};

/// Names what explains the data nearly as well as the effect that was added, as it was fitted.
struct RunnerUp {
  std::string added, effect;  ///< empty: none
  Setup setup;
};

/// Names the most probable effect, where there was no time to fit it, with what its signature says of it.
struct PromisedEffect {
  std::string effect;
  std::vector<std::pair<std::string, double>> besides;  ///< setup paths and values (SI) that it needs
  std::vector<DiagnosedParameter> strengths;
};

struct LastFit;

/// Holds all that a diagnosis says.
struct Diagnosis {
  std::string engine;  ///< that simulated
  Verdict verdict = Verdict::adequate;
  std::string sentence;
  std::vector<std::string> missing;     ///< effect ids in the order added
  std::vector<Hypothesis> hypotheses;   ///< most probable first, those that hold 99 % together
  std::vector<Hypothesis> answers;      ///< the fewest of them that hold 95 %
  ModelJudgement judgement;             ///< of the final model
  std::vector<Difference> left;         ///< by the final model, all runs together first
  std::vector<Validation> validation;   ///< of the final model, each run
  std::vector<DecayComparison> forced;  ///< of each forced run: measured, and the final model
  double explained = 0;                 ///< share of chi2 as given that the final model takes away
  std::vector<NuisanceFound> camera;    ///< what the data say of camera and weights
  std::vector<DiagnosedParameter> parameters;
  std::vector<RankedEffect> ranking;
  std::vector<LadderStep> ladder;  ///< what was tried, in that order; the last is the answer's model
  /// Where the model fails before any effect is added, worst first: family-wise p below 0.05.
  std::vector<FailureCell> where;
  MomentumAudit momentum;
  std::string force_formula;  ///< for unknown forces: a user_force ready to try
  std::optional<FreeRestitution>
      free_restitution;  ///< for what lies inside the contacts, where a curve explains it
  std::vector<std::string> next_experiments;
  RunnerUp runner_up;
  /// The effect among what is missing that was not fitted for want of time.
  std::optional<PromisedEffect> promised;
  std::vector<std::string> notes;
  Setup amended;  ///< the user's setup with effects and refitted values
  double seconds = 0;
  std::int64_t runs_simulated = 0;
  std::vector<std::string> not_tried;       ///< steps left out, for want of simulations or time
  std::shared_ptr<const LastFit> last_fit;  ///< last_fit.hpp; null where nothing was fitted
};

/// Says what a diagnosis may do.
struct DiagnoseOptions {
  std::vector<std::string> effects;  ///< only these may be added; empty: all
  std::int64_t budget = 0;           ///< simulations at most; 0: usual_budget()
  double seconds = 0;  ///< at most, with its threads to itself; up to 1.6 times that beside others; 0: none
  Execution execution{};
  KnownEffects known;
  /// Is told the stage in words and the fraction of the budget used; may be empty.
  std::function<void(const std::string& stage, double fraction)> progress;
  std::vector<std::string> fixed{};  ///< of the restitutions and the spring's frequency: those known
                                     ///< otherwise (a drop test), not refitted
  /// Relative uncertainty of an effect's strength because data may be of the other engine's kind
  /// (effects/engine_differences.hpp); null: none.
  double (*strength_uncertainty)(std::string_view effect) = nullptr;
  /// An engine whose contacts last, asked where hard spheres may differ from it (engine_choice.hpp); null:
  /// none.
  std::shared_ptr<const Engine> lasting_contacts{};
  EnsembleCache* ensembles = nullptr;    ///< shared by diagnoses of one setup; may be null
  SimulationJournal* journal = nullptr;  ///< of this diagnosis, begun before or not; may be null
};

/// Returns the simulations that a diagnosis may make unless told otherwise: 10000 for each different setup
/// among the runs, for four at least.
std::int64_t usual_budget(const Measurement& measurement);

/// Returns the fewest simulations that make an answer: those of two fits of the least effort.
std::int64_t least_budget(const Measurement& measurement);

/// Tells which effects the setup lacks to explain the measurement, and how sure that is. Throws InputError
/// when the setup does not fit the experiment, Interrupted when stopped.
Diagnosis diagnose(const Setup& setup, const Measurement& measurement, const Engine& engine,
                   const DiagnoseOptions& options);

/// Returns the word of `verdict` in diagnosis.json.
std::string_view name_of(Verdict verdict);

/// Returns the whole diagnosis as JSON text.
std::string diagnosis_json(const Diagnosis& diagnosis);

/// Returns a line for a terminal that says where a model fails.
std::string line_of(const FailureCell& cell);

/// Returns the whole diagnosis as text for a terminal.
std::string diagnosis_text(const Diagnosis& diagnosis);

}  // namespace shakedown
