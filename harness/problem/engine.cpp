// SPDX-License-Identifier: MIT
#include "engine.hpp"

namespace shakedown {

void refuse_what_is_not_modelled(const Engine& engine, const Setup& setup) {
  std::vector<Violation> found;
  for (const EffectChoice& choice : setup.effects) {
    Capability capability = engine.can_model(*choice.record);
    if (choice.record->capability_of != nullptr)
      capability = choice.record->capability_of(choice, engine.name(), capability);
    if (capability.fidelity != Fidelity::not_modelled) continue;
    found.push_back(
        {choice.place, std::string(choice.record->name),
         "is not modelled by engine '" + std::string(engine.name()) + "'",
         capability.note.empty() ? "choose another engine with --engine" : std::string(capability.note)});
  }
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace shakedown
