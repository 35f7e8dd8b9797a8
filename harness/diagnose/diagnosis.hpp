// SPDX-License-Identifier: MIT
// From measurements to the missing effect. Two channels: the momentum balance (no simulation) convicts forces
// from outside, ensembles of the hard engine judge everything inside the contacts. Then: is the model as
// given within its spread? Does refitting suffice? Which effect, added and fitted, brings the error down, and
// does anything remain?
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "candidates.hpp"
#include "momentum.hpp"
#include "refit.hpp"

namespace shakedown {

enum class Verdict { adequate, refit, missing, unknown };

struct DiagnosedParameter {
  std::string name;  ///< setup path
  double value = 0, low = 0, high = 0;
  std::string unit;
  std::string word;  ///< value in words (a packing); empty for numbers
};

struct RankedEffect {
  std::string effect;
  double gain = 0;  ///< fall of chi2 when it joins, everything else refitted
  double held_out_gain =
      0;  ///< fall of the chi2 of box lengths left out of the fit; NaN: not fitted, or one length only
  double standard_error = 0;  ///< of held_out_gain
  double value = 0;           ///< its strength
  std::vector<std::string> look_alikes{};
  bool fitted = false;      ///< its gain is that of a fit, not of a linear estimate
  bool by_balance = false;  ///< its gain is that of the momentum balance, which needs no simulation
};

struct LadderStep {
  std::string step;
  double error_box = 0, error_centre = 0, held_out_error_box = 0;  ///< m
  double floor_box = 0, floor_centre = 0;                          ///< m
  double p_value = 1, scatter = 1;
};

struct Diagnosis {
  Verdict verdict = Verdict::adequate;
  std::string sentence;
  std::vector<std::string> missing;  ///< effect ids in the order added
  std::vector<DiagnosedParameter> parameters;
  std::vector<RankedEffect> ranking;
  std::vector<LadderStep> ladder;
  /// Where the model fails before any effect is added, worst first: family-wise p below 0.05.
  std::vector<FailureCell> where;
  MomentumAudit momentum;
  std::string force_formula;  ///< for unknown forces: a user_force ready to try
  std::vector<std::string> next_experiments;
  std::vector<std::string> notes;
  Setup amended;  ///< the user's setup with effects and refitted values
  double seconds = 0;
  std::int64_t runs_simulated = 0;
};

struct DiagnoseOptions {
  std::vector<std::string> effects;  ///< only these may be added; empty: all
  std::int64_t budget = 0;           ///< simulations at most; 0: usual_budget()
  int threads = 0;
  std::span<const EffectRecord* const> known;
  const std::atomic<bool>* stop = nullptr;
  /// Told of the stage in words and the fraction of the budget used; may be empty.
  std::function<void(const std::string& stage, double fraction)> progress;
  std::vector<std::string> fixed{};  ///< of the restitutions and the spring's frequency: those known
                                     ///< otherwise (a drop test), not refitted
  /// Relative uncertainty of an effect's strength because data may be of the other engine's kind
  /// (effects/engine_differences.hpp); null: none.
  double (*strength_uncertainty)(std::string_view effect) = nullptr;
  MethodFault fault = MethodFault::none;
  EnsembleCache* ensembles = nullptr;    ///< shared by diagnoses of one setup; may be null
  SimulationJournal* journal = nullptr;  ///< of this diagnosis, begun before or not; may be null
};

/// Simulations that a diagnosis may make unless told otherwise: 3500 for each different setup among the runs,
/// for four at least.
std::int64_t usual_budget(const Setup& setup, const Experiment& experiment,
                          std::span<const EffectRecord* const> known);

/// Throws InputError when the setup does not fit the experiment, Interrupted when stopped.
Diagnosis diagnose(const Setup& setup, const Experiment& experiment, const Engine& engine,
                   const DiagnoseOptions& options);

std::string_view name_of(Verdict verdict);

/// The whole diagnosis as JSON text.
std::string diagnosis_json(const Diagnosis& diagnosis);

/// Where a model fails, a line for a terminal.
std::string line_of(const FailureCell& cell);

/// The whole diagnosis as text for a terminal.
std::string diagnosis_text(const Diagnosis& diagnosis);

}  // namespace shakedown
