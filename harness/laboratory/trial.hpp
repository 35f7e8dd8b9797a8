// SPDX-License-Identifier: MIT
// Tries out a diagnosis: measures what is hidden, diagnoses without the answer, compares with the answer.
#pragma once
#include <string>
#include <vector>

#include "diagnosis.hpp"
#include "execution.hpp"
#include "hidden_case.hpp"
#include "known_effects.hpp"
#include "shares.hpp"

namespace shakedown {

/// Says what is measured, and how.
struct Trial {
  HiddenCase hidden;
  std::vector<PlannedRun> runs;
  RecordingSettings recording;
  std::uint64_t seed = 1;
  std::vector<KnownValue> known{};  ///< what the experimenter weighed and measured
};

/// Holds what trials are made with.
struct TrialTools {
  const Engine* laboratory = nullptr;  ///< measures
  const Engine* model = nullptr;       ///< the diagnosis' engine
  KnownEffects known;
  std::int64_t budget = 0;  ///< simulations of one diagnosis at most; 0: usual_budget()
  Execution execution{};
  double (*strength_uncertainty)(std::string_view effect) = nullptr;  ///< DiagnoseOptions
  EnsembleCache* ensembles = nullptr;                ///< shared by the diagnoses; may be null
  std::vector<std::string> fixed{};                  ///< DiagnoseOptions
  void (*damage)(Experiment& experiment) = nullptr;  ///< done to what was measured before it is diagnosed
};

/// Returns the trial's measurements, in memory. Throws what make_measurements() throws.
Experiment measured_in(const Trial& trial, const TrialTools& tools);

/// Measures in memory and diagnoses the believed setup. Throws what these throw.
Diagnosis diagnose_trial(const Trial& trial, const TrialTools& tools);

/// Says how a diagnosis compares with the answer.
struct TrialJudgement {
  bool detected = false;  ///< it says that something is missing, known or unknown
  bool named =
      false;  ///< verdict and missing effects are exactly the hidden ones (of a hidden formula: "unknown")
  bool invented = false;  ///< an effect among the missing ones that is not hidden
};
/// Judges a diagnosis. With nothing hidden "adequate" and "refit" are right, with other parameters "refit"
/// alone. An error of the camera may be named as missing or, by the verdict `measurement`, be among the
/// numbers of the camera that stand out (`measured`: their effects).
TrialJudgement judge(const std::vector<std::string>& hidden, bool other_parameters, Verdict verdict,
                     const std::vector<std::string>& missing, const std::vector<std::string>& measured = {});

/// Returns the effects of the camera whose numbers stand out.
std::vector<std::string> effects_standing_out(const std::vector<NuisanceFound>& camera);

/// Returns those that act on box and grains: without errors of camera, clock and origin and without
/// nuisances. What is no effect of the list counts as physics. Sorted.
std::vector<std::string> physics_among(const std::vector<std::string>& effects, KnownEffects known);

/// Says what repeated trials of one hidden case come to.
struct Power {
  Share detected, named;
  /// Verdict and missing effects of each trial, e.g. "missing grain_friction", and how often.
  std::vector<std::pair<std::string, int>> answers;
};

/// Repeats the trial with seeds trial.seed, trial.seed + 1, ... `told` hears of each answer; may be empty.
Power power_of(Trial trial, int repeats, const TrialTools& tools,
               const std::function<void(int done, const std::string& answer)>& told);

}  // namespace shakedown
