// SPDX-License-Identifier: MIT
#include "free_restitution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "errors.hpp"
#include "from_balance.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "setup_file.hpp"
#include "verdict.hpp"

namespace shakedown {

namespace {

constexpr const char* stage = "restitution as a function of speed";

/// Returns the model with a level curve in place of its own law, whose strength is no knob any more.
DiagnosisState with_curve(const DiagnosisState& failing, KnownEffects known) {
  DiagnosisState state = is_led_astray(failing) ? as_believed(failing) : failing;
  state.setup = with_contact_curve(restitution_against_speed(), state.setup, "all", known);
  std::erase_if(state.found, [&](const Knob& knob) {
    const std::string key = joined_keys(knob.key).front();
    return find_choice(state.setup, effect_of(key)) == nullptr;
  });
  return state;
}

/// Returns the setup with the fitted values, to four digits: people read them, and no interval is narrower.
Setup setup_at(Setup setup, const Refit& fit, KnownEffects known) {
  for (std::size_t k = 0; k < fit.values.size(); ++k)
    if (!fit.knobs[k].exact)
      for (const std::string& key : joined_keys(fit.values[k].key))
        set_number(setup, key,
                   key == "spring.frequency" ? fit.values[k].value
                                             : std::stod(fmt::format("{:.4g}", fit.values[k].value)),
                   known);
  return setup;
}

/// Tells whether the curve explains what the model without it leaves, and foretells box lengths that it was
/// not fitted to at least as well.
bool is_worth_offering(const FreeRestitution& law) {
  const LadderStep &without = law.without, &with = law.with;
  const bool foretells = !(with.held_out_error_box > without.held_out_error_box);  // NaN of one length only
  return foretells && explains(with.p_value, with.scatter, without.scatter, with.error_box, with.floor_box);
}

std::string mm(double metres) { return fmt::format("{:.2f} mm", 1e3 * metres); }

}  // namespace

FreeRestitution free_restitution_beside(const DiagnosisState& failing, DiagnosisTools& tools) {
  const KnownEffects known = tools.known();
  const DiagnosisState state = with_curve(failing, known);
  const std::vector<Knob> curve = knobs_of_curve(restitution_against_speed(), state.setup, known);
  const auto fitted = [&](const std::vector<Knob>& of_curve) {
    return tools.fit(state, stage, together(state.knobs(), of_curve), effort::attempt, &failing.fit);
  };
  Refit fit = fitted(curve);
  if (const std::optional<std::vector<Knob>> held =
          held_to_one_side(restitution_against_speed(), curve, fit.values, known))
    fit = fitted(*held);
  Setup setup = setup_at(state.setup, fit, known);
  ContactCurve told = contact_curve(restitution_against_speed(), setup, fit.values, fit.covariance, known);
  return {std::move(told), std::move(setup), step_of("without a curve of restitution", failing.fit),
          step_of("with a curve of restitution", fit)};
}

void offer_free_restitution(const Setup& user, const DiagnosisState& failing, DiagnosisTools& tools,
                            Diagnosis& d) {
  const EffectRecord* record = formula_for(restitution_against_speed(), tools.known());
  if (record == nullptr || !allowed(tools.options(), std::string(record->name))) return;
  if (tools.workshop().engine->can_model(*record).fidelity == Fidelity::not_modelled) return;
  try {
    FreeRestitution law = free_restitution_beside(failing, tools);
    if (is_worth_offering(law)) {
      law.setup.hard = user.hard,
      law.setup.soft = user.soft;  // a diagnosis simulates less exactly than it may
      d.free_restitution = std::move(law);
      return;
    }
    d.notes.push_back("restitution as a free function of the closing speed leaves " + mm(law.with.error_box) +
                      " of the box (without it " + mm(law.without.error_box) + ", noise and spread " +
                      mm(law.with.floor_box) + "): no law of restitution alone is what is missing");
  } catch (const BudgetSpent&) {
    d.not_tried.push_back(stage);
  } catch (const InputError& error) {  // a box that is not let go has no range of speeds
    d.notes.push_back(std::string(stage) + " could not be asked for: " + error.what());
  } catch (const PhysicsError& error) {
    d.notes.push_back(std::string(stage) + " could not be simulated: " + error.what());
  }
}

}  // namespace shakedown
