// SPDX-License-Identifier: MIT
#include "engine_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>

#include "camera_features.hpp"
#include "effort.hpp"
#include "errors.hpp"
#include "judged_as_given.hpp"
#include "state.hpp"

namespace shakedown {

namespace {

constexpr int runs_of_each = 24;  // spread is known to a seventh, and the misfits in question differ by tens

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
  // It counts in the limits: where they are too narrow for the question it is not asked.
  if (options.budget > 0 &&
      options.budget < least_budget(measurement) + 2 * runs_of_each * std::ssize(measurement.runs))
    return choice;
  const auto start = std::chrono::steady_clock::now();
  const auto by = [&](const Engine& one) {
    Workshop workshop{&one,   options.known, options.threads, options.stop, [&](int n) { choice.runs += n; },
                      nullptr};
    workshop.ask_for = [&](std::int64_t) {
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
      if (options.seconds > 0 && spent.count() > share::model_as_given * options.seconds)
        throw BudgetSpent("the time is up");
    };
    return judged_as_given(user, measurement, features_with_camera(measurement, options.known), workshop,
                           runs_of_each);
  };
  try {
    const Refit hard = by(engine);
    if (!is_rejected(hard)) return choice;
    const Refit soft = by(*options.lasting_contacts);
    choice.lasting_contacts = soft.scatter < hard.scatter;
    choice.note = fmt::format(
        "all grains lie in one layer, which lands at once: the model as given leaves {:.2g} times the misfit "
        "of its "
        "own runs by hard spheres, {:.2g} times with contacts that last, so that {} are simulated",
        hard.scatter, soft.scatter,
        choice.lasting_contacts ? "these (engine soft, which takes longer)" : "hard spheres");
  } catch (const BudgetSpent&) {
    choice.note =
        "all grains lie in one layer, which lands at once where contacts last; there was no time to ask "
        "whether hard "
        "spheres make what the films show: allow more --seconds";
  } catch (const InputError&) {  // an effect of the setup that it does not model
  } catch (const PhysicsError&) {
  }
  return choice;
}

}  // namespace shakedown
