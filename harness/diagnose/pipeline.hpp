// SPDX-License-Identifier: MIT
// The steps of a diagnosis and what they know of each other; diagnosis.hpp is what others see.
#pragma once
#include <limits>
#include <optional>

#include "diagnosis.hpp"
#include "experiment_file.hpp"
#include "linear_screen.hpp"
#include "release_scale.hpp"

namespace shakedown {

/// Above this the model as given holds, and above the other nobody looks for what a single effect would take
/// away.
constexpr double holds = 0.03, holds_well = 0.3;
/// Misfit (chi2 over that of the model's own runs) that two codes of the same physics may have: soft contacts
/// of 0.2 to 0.43 ms, judged by hard impacts of the same parameters, 1.1 to 1.33.
constexpr double codes_differ = 1.4;
/// Below this an effect with a signature of its own is looked for.
constexpr double doubtful = 0.05;
/// A step up the ladder must bring chi2 down by this much and this share: a free parameter and the choice
/// among some twenty effects.
constexpr double least_gain = 14, least_share = 0.06;
/// What an effect must promise, and then bring (chi2), beside a model that is accepted. Where nothing is
/// hidden the best of some twelve promises 3 to 9.
constexpr double speaks_up = 17;
/// Errors of a strength that the balance convicts to which fits hold it: they are of noise alone, and the
/// form of the force may be another code's.
constexpr double balance_is_believed = 2;
constexpr int most_effects = 3;
constexpr std::size_t most_cells = 12;
constexpr std::size_t most_tried = 4;
/// Differences of chi2 below this are within the emulators' own noise.
constexpr double too_close = 15;
constexpr double quick_elastic_speed = 1e-2;  // m/s
constexpr double quick_kick_interval = 1e-2;  // s

/// Re-centrings at least, simulations of each different setup in a fit's last round, and at its solution;
/// whether a poor one looks beside it.
struct Effort {
  int rounds, count, confirming;
  bool beside = false;
};
constexpr Effort only_look{1, 128, 0}, to_refit{2, 160, 128, true}, to_try{2, 128, 96},
    to_try_dear{1, 72, 48}, to_look_again{2, 112, 96}, to_decide{1, 128, 128}, to_prune{2, 128, 96, true},
    to_conclude{1, 192, 160}, to_tell_apart{2, 160, 128};
/// Simulations of each different setup in a ranking; where an effect makes runs cost several times more, and
/// at most in a fit with it.
constexpr int to_rank = 192, ranked_when_dear = 128, most_when_dear = 80;

class Pipeline {
 public:
  Pipeline(const Setup& setup, const Experiment& experiment, const Engine& engine,
           const DiagnoseOptions& options);
  Diagnosis run();

 private:
  // diagnosis.cpp: the course of it
  std::vector<MeasuredFeatures> features() const {
    return features_of(experiment_, audit_, setups_of_runs(base_, experiment_, options_.known));
  }

  void choose_packing();
  void judge();
  void accept_as_given(const Refit& given);
  Refit fit(const std::string& step, const std::vector<Knob>& knobs, Effort effort,
            const Refit* judged_by = nullptr,
            double look_again_below = std::numeric_limits<double>::infinity());
  void add_momentum_terms();
  double whole_strength(const FoundTerm& term, const std::string& key) const;
  bool possible(const FoundTerm& term) const;
  void add_sine(const FoundTerm& term);
  void keep(const Refit& refit);
  void note_failures(const Refit& fit);

  // effect_search.cpp
  /// A candidate that was fitted.
  struct Rival {
    std::string effect;
    double doubt;
    Setup setup;
    std::vector<Knob> knobs;
    Refit fit;
    double gain, held_out_gain;
    bool decided;
    bool dear = false;  ///< its runs cost several times a plain one
    double score() const {
      const double most = std::abs(gain);
      return gain + 0.5 * (std::isfinite(held_out_gain) ? std::clamp(held_out_gain, -most, most) : 0.0) -
             doubt;
    }
  };
  /// What explains the data nearly as well as the effect that was added, as it was fitted.
  struct RunnerUp {
    std::string added, effect;
    Setup setup;
  };
  std::vector<Candidate> open_candidates() const;
  std::vector<Rival> rivals_among(const std::vector<Candidate>& candidates, const Refit& best);
  bool pays(const Rival& rival, const Refit& best) const;
  static bool alike(const Rival& better, const Rival& other);
  bool acts_on_camera(const std::string& effect) const;
  Refit conclude(const std::string& step, const Refit& so_far);
  bool take(const Rival& winner, Refit& best);
  bool add_best_candidate(Refit& best);
  Rival try_candidate(const ScreenedEffect& effect, const Candidate& candidate, const Setup& before,
                      const std::vector<Knob>& fitted, const Refit& best, double lowest);
  Rival decide(Rival rival, const Refit& best);
  void rank(Rival& rival, const Refit& best);
  void call_twins(const std::string& named, const std::string& other);
  void prune(Refit& best);

  // conclusion.cpp
  FittedValue allowing_for_engines(FittedValue value);
  std::string what_it_brings() const;
  std::string what_is_unknown() const;
  void finish();
  void complete_ranking();
  std::string told_from_by_nothing(const std::string& effect) const;
  void conclude_unknown();
  void advise_experiments();

  Setup user_, base_;
  const Experiment& experiment_;
  const DiagnoseOptions& options_;
  std::int64_t budget_;
  Audit audit_;
  SimulationPool pool_;
  Workshop workshop_;
  Diagnosis result_;
  std::string stage_;
  std::vector<Knob> chosen_;       // of the effects added
  std::vector<Knob> first_boxes_;  // of the effects that the ensembles added, where their fits began
  std::vector<Knob> theta_;        // what the user may refit, at its latest values
  Refit final_;
  bool refitted_ = false;
  std::optional<ReleaseScale> release_scale_;
  bool concluded_ = false;                                  // the latest fit was made with full effort
  std::optional<RunnerUp> runner_up_;                       // to the effect added last
  std::vector<std::pair<std::string, std::string>> twins_;  // named, and what explains the data as well
  bool dear_ = false;  // an effect was added whose runs cost several times a plain one
  int batch_ = 0;
};

/// A fit as a step of the ladder.
LadderStep step_of(const std::string& name, const Refit& fit);

std::vector<Knob> together(const std::vector<Knob>& a, const std::vector<Knob>& b);

/// A parameter of which the user believes something; what the balance knows of a force is no belief.
bool is_believed(const Knob& knob);

}  // namespace shakedown
