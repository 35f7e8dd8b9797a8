// SPDX-License-Identifier: MIT
#include "unlisted_score.hpp"

#include <algorithm>

#include "effects.hpp"
#include "force_likeness.hpp"

namespace shakedown {

namespace {

const EffectChoice& formula_of(const Setup& setup) {
  const auto found = std::find_if(setup.effects.begin(), setup.effects.end(),
                                  [](const EffectChoice& choice) { return choice.record->takes_formula(); });
  EXPECT(found != setup.effects.end());
  return *found;
}

template <class T>
const T& value_of_kind(const EffectChoice& choice, ParameterKind kind) {
  const auto& parameters = choice.record->parameters;
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& parameter) { return parameter.kind == kind; });
  EXPECT(found != parameters.end());
  return std::get<T>(choice.values.find(found->name)->second);
}

/// Tells whether one of the formulas offered is the hidden force to within its strength.
bool form_is_offered(const OpenedCase& one, const TrialTools& tools) {
  if (one.lost || one.forces.empty()) return false;
  Setup truth = parse_setup(one.setup, one.name, tools.known);
  truth.run.duration = 8;
  const Trajectory motion = tools.model->run(truth);
  const EffectChoice& hidden = formula_of(truth);  // beside what is believed
  const std::vector<double> force =
      force_along(value_of_kind<std::string>(hidden, ParameterKind::text),
                  value_of_kind<std::map<std::string, double>>(hidden, ParameterKind::constants), motion);
  for (const OfferedForce& offered : one.forces)
    for (const std::string& form : offered.forms) {
      try {
        if (force_likeness(force, force_along(form, offered.constants, motion), motion.x_box) > 0.95)
          return true;
      } catch (const FormulaProblem&) {  // a look-alike with constants of its own
      }
    }
  return false;
}

/// Tells whether the form is one that a diagnosis offers; so it is taken to be where the answer does not say
/// which force was hidden.
bool of_the_dictionary(const OpenedCase& one) {
  const Hideable* force = one.ids.empty() ? nullptr : find_hideable(one.ids.front());
  return force == nullptr || force->of_the_dictionary;
}

}  // namespace

void unlisted_forces(const std::vector<OpenedCase>& cases, const TrialTools& tools, ScoreTable& table) {
  Count told, offered, told_of_none;
  for (const OpenedCase& one : cases) {
    if (one.kind != BlindKind::unlisted) continue;
    told.add(one.exact());
    if (of_the_dictionary(one))
      offered.add(form_is_offered(one, tools));
    else
      told_of_none.add(one.exact());
  }
  table.at_least("a force in no list: \"none of the known effects\"", told, 0.85);
  table.at_least("its form, where there is one, among those offered (cosine above 0.95)", offered, 0.80);
  table.beside("a force of no form that is offered: \"none of the known effects\"", told_of_none);
}

}  // namespace shakedown
