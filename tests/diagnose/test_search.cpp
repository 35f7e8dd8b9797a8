// SPDX-License-Identifier: MIT
// One round of the search beside a model that is far off, on a stand-in whose motion is a formula: what it
// adds while simulations suffice, and what it says where they do not.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "effects.hpp"
#include "random.hpp"
#include "state.hpp"

using namespace shakedown;

namespace {

double strength(const Setup& setup, std::string_view effect, std::string_view parameter) {
  for (const EffectChoice& choice : setup.effects)
    if (choice.record->name == effect) return choice.number(parameter);
  return 0;
}

/// A decay by the restitutions, which a law of restitution slows with time, and drag speeds up; two shapes of
/// chaos.
class StandIn final : public Engine {
 public:
  std::string_view name() const override { return "stand-in"; }
  Capability can_model(const EffectRecord&) const override { return {Fidelity::exact, ""}; }
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    Random random(setup.run.seed, static_cast<std::uint64_t>(options.run), Stream::velocities);
    const double early = 3e-4 * random.normal(), late = 3e-4 * random.normal();
    const double w = 2 * std::numbers::pi * setup.spring.frequency,
                 rate = 0.3 * (1 - setup.restitution.grain_grain),
                 law = strength(setup, "velocity_dependent_restitution", "exponent"),
                 drag = strength(setup, "grain_air_drag", "linear") / 1e-3;
    Trajectory trajectory;
    for (int k = 0; k <= static_cast<int>(setup.run.duration * 500); ++k) {
      const double t = k / 500.0, turned = law * std::sin(1.1 * t), faster = 0.02 * drag * std::sin(0.5 * t);
      const double x = 0.1 * std::exp(-(rate + faster) * t) * std::cos(w * t + turned);
      trajectory.time.push_back(t);
      trajectory.x_box.push_back(x + early * std::sin(1.3 * t) + late * std::sin(0.7 * t + 1));
      trajectory.x_com.push_back(0.9 * x + 0.01 * setup.restitution.grain_wall + late * std::cos(2 * t));
    }
    trajectory.v_box = trajectory.total_energy = trajectory.x_box;
    return trajectory;
  }
};

Setup as_believed() {
  Setup setup;
  setup.run.duration = 8;
  return setup;
}

/// Two films of a law that is not in what is believed.
Measurement two_films() {
  Setup truth = as_believed();
  const EffectRecord& law = *all_effects().find("velocity_dependent_restitution");
  truth.effects.push_back(with_defaults(law));
  truth.effects.back().values["exponent"] = 0.12;
  Experiment experiment;
  for (const int number : {1, 2}) {
    MeasuredRun run;
    run.name = number == 1 ? "a" : "b";
    run.frame_rate = 500;
    RunOptions options;
    options.run = 1000 + number;
    const Trajectory seen = StandIn{}.run(truth, options);
    Random noise(7, static_cast<std::uint64_t>(number), Stream::camera);
    run.time = seen.time, run.x_box = seen.x_box, run.x_com = seen.x_com;
    for (double& x : run.x_box) x += 1e-4 * noise.normal();
    for (double& x : run.x_com) x += 1e-4 * noise.normal();
    experiment.runs.push_back(run);
  }
  return measurement_of({as_believed(), as_believed()}, experiment);
}

struct Searched {
  DiagnosisState before;
  SearchRound round;
};

/// A round that may take so many simulations.
Searched searched(int simulations) {
  static const Measurement measurement = two_films();
  static const StandIn engine;
  DiagnoseOptions options;
  options.known = all_effects();
  options.effects = {"velocity_dependent_restitution", "grain_air_drag"};
  options.threads = 1;
  options.budget = simulations;
  DiagnosisTools tools(measurement, engine, options);
  Searched result;
  DiagnosisState& state = result.before;
  state.setup = as_believed();
  state.theta = {{"restitution.grain_grain", 0.75, 0.15, 0.2, 0.999, true},
                 {"spring.frequency", 1.23, 0.01, 1, 1.5, true}};
  state.fit = tools.fit(state, "refitting", state.knobs(), effort::refit);
  const auto before_round = tools.runs();
  tools.limit_to(rules::for_the_search);
  result.round = search_round(state, tools, {});
  std::cout << simulations << ": far off " << is_far_off(state.fit) << " p " << state.fit.p_value << " took "
            << before_round << " then " << tools.runs() << " added " << result.round.added << " promised "
            << result.round.promised.has_value();
  for (const std::string& note : result.round.notes) std::cout << " | " << note;
  for (const std::string& one : result.round.not_tried) std::cout << " # " << one;
  for (const Hypothesis& h : result.round.table)
    std::cout << " ; " << (h.effects.empty() ? "nothing" : h.effects.front()) << " " << h.probability;
  std::cout << std::endl;
  return result;
}

}  // namespace

TEST(Search, Shows) {
  for (const int simulations :
       {4000, 1800, 1600, 1500, 1400, 1300, 1200, 1150, 1100, 1050, 1000, 950, 900, 850, 800})
    searched(simulations);
}
