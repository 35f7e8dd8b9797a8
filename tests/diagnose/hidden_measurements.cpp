// SPDX-License-Identifier: MIT
#include "hidden_measurements.hpp"

#include "effects.hpp"
#include "engines.hpp"

namespace shakedown {

Setup believed(const std::string& duration) {
  return parse_setup("[run]\nduration = \"" + duration + "\"\n", "believed", all_effects());
}

Measurement as_measured(const Experiment& experiment, const Setup& setup) {
  return measurement_of(setup, experiment, all_effects());
}

Experiment measured(const Hidden& hidden, const std::string& laboratory) {
  std::vector<Override> overrides = hidden.parameters;
  for (const std::string& effect : hidden.effects)
    for (const Override& override : overrides_of_effect(effect)) overrides.push_back(override);
  overrides.push_back({"run.duration", hidden.duration});
  const std::unique_ptr<Engine> engine = engine_named(laboratory);
  const Laboratory with{engine.get(), all_effects(), hidden.seed, 2, nullptr};
  return make_measurements(parse_setup("", "truth", all_effects(), overrides),
                           runs_of_lengths(hidden.lengths), hidden.recording, with);
}

}  // namespace shakedown
