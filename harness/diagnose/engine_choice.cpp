// SPDX-License-Identifier: MIT
#include "engine_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "camera_features.hpp"
#include "errors.hpp"
#include "parameter_knobs.hpp"
#include "state.hpp"

namespace shakedown {

namespace {

constexpr int runs_of_each = 24;  // spread is known to a seventh, and the misfits in question differ by tens

Refit as_given_by(const Engine& engine, const Setup& user, const Measurement& measurement,
                  const DiagnoseOptions& options, int& runs) {
  RefitOptions refitting;
  refitting.count = runs_of_each;
  refitting.rounds = refitting.most_rounds = 1;
  const Workshop workshop{&engine, options.known, options.threads, options.stop, [&](int n) { runs += n; },
                          nullptr};
  std::vector<Knob> knobs = as_given(user, measurement.known, options.known);
  for (Knob& knob : camera_knobs(user, measurement, options.known)) knobs.push_back(std::move(knob));
  return refit(features_with_camera(measurement, options.known), knobs, workshop, refitting);
}

}  // namespace

bool lie_in_one_layer(const Measurement& measurement) {
  return !measurement.runs.empty() &&
         std::all_of(measurement.runs.begin(), measurement.runs.end(), [](const Measurement::Run& run) {
           const Setup& setup = run.setup;
           const double across = std::floor(setup.box.width[0] / setup.grains.diameter) *
                                 std::floor(setup.box.width[1] / setup.grains.diameter);
           return setup.grains.count > 0 && setup.grains.count <= across;
         });
}

EngineChoice chosen_engine(const Setup& user, const Measurement& measurement, const Engine& engine,
                           const DiagnoseOptions& options) {
  EngineChoice choice;
  if (options.lasting_contacts == nullptr || !lie_in_one_layer(measurement)) return choice;
  const Refit hard = as_given_by(engine, user, measurement, options, choice.runs);
  if (!is_rejected(hard)) return choice;
  Refit soft;
  try {
    soft = as_given_by(*options.lasting_contacts, user, measurement, options, choice.runs);
  } catch (const InputError&) {  // an effect of the setup that it does not model
    return choice;
  } catch (const PhysicsError&) {
    return choice;
  }
  choice.lasting_contacts = soft.scatter < hard.scatter;
  choice.note = fmt::format(
      "all grains lie in one layer, which lands at once: the model as given leaves {:.2g} times the misfit "
      "of its own "
      "runs by hard spheres, {:.2g} times with contacts that last, so that {} are simulated",
      hard.scatter, soft.scatter,
      choice.lasting_contacts ? "these (engine soft, which takes longer)" : "hard spheres");
  return choice;
}

}  // namespace shakedown
