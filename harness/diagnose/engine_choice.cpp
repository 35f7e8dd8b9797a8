// SPDX-License-Identifier: MIT
#include "engine_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "effort.hpp"
#include "errors.hpp"

namespace shakedown {

namespace {

/// A layer lands twice a period, and contacts that last cost a hundred times a hard impact. Of one experiment
/// of fourteen grains and soft contacts (bench/results/2026-11-27-exam-770915.md) fits to the first 1, 2, 3
/// and 5 periods left 24, 24, 20 and 17 times the misfit of own runs by hard spheres, 4.3, 2.4, 1.8 and 1.6
/// by soft contacts: two tell them apart.
constexpr double first_periods = 2;
/// Half as many simulations as a fit elsewhere has at least: an assumption; the misfits in question differ by
/// tens.
constexpr Effort first_look{1, effort::least.count / 2, 0, false, true};

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

EngineChoice chosen_engine(const DiagnosisState& model, DiagnosisTools& tools) {
  EngineChoice choice;
  const DiagnoseOptions& options = tools.options();
  const Measurement& measurement = tools.measurement();
  if (options.lasting_contacts == nullptr || !lie_in_one_layer(measurement) ||
      tools.workshop().engine->name() == options.lasting_contacts->name())
    return choice;
  // The question counts in the limits: where they are too narrow for it, it is not asked.
  if (options.budget > 0 &&
      options.budget < least_budget(measurement) + 2 * first_look.count * std::ssize(measurement.runs))
    return choice;
  const double first = first_periods / model.setup.spring.frequency;
  tools.begin("which engine");
  tools.limit_to(share::engine_choice);
  try {
    const Refit hard = tools.fit_of_first(first, model, *tools.workshop().engine, first_look);
    if (!is_rejected(hard)) return choice;
    const Refit soft = tools.fit_of_first(first, model, *options.lasting_contacts, first_look);
    choice.lasting_contacts = soft.scatter < hard.scatter;
    choice.note = fmt::format(
        "all grains lie in one layer, which lands at once: fitted to the first {:.0f} periods "
        "the model leaves {:.2g} times the misfit of its own runs by hard spheres, {:.2g} times "
        "by contacts that last, so that {} are simulated",
        first_periods, hard.scatter, soft.scatter,
        choice.lasting_contacts ? "these (engine soft, which takes longer)" : "hard spheres");
    if (choice.lasting_contacts) choice.fit = soft;
  } catch (const BudgetSpent&) {
    choice.note =
        "all grains lie in one layer, which lands at once where contacts last; there was no time to ask "
        "whether hard spheres make what the films show: allow more --seconds";
  } catch (const InputError&) {  // an effect of the setup that it does not model
  } catch (const PhysicsError&) {
  }
  return choice;
}

}  // namespace shakedown
