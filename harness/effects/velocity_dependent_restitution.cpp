// SPDX-License-Identifier: MIT
// Restitution that falls with the closing speed at first touch.
#include <array>
#include <cmath>

#include "physics.hpp"
#include "power_restitution.hpp"
#include "viscoelastic_contact.hpp"

namespace shakedown::effect {

namespace {

using PerClass = std::array<double, contact_classes>;

constexpr std::size_t index_of(ContactClass kind) { return static_cast<std::size_t>(kind); }

void apply_power(const EffectChoice& choice, Physics& physics) {
  const double exponent = choice.number("exponent"), reference = choice.number("reference_speed");
  physics.contact.restitution_at = [at_reference = physics.contact.restitution, exponent, reference](
                                       ContactClass kind, double speed) {
    return power_restitution(at_reference[index_of(kind)], exponent, reference, speed);
  };
}

/// Stiffness over reduced mass from the contact time of the soft engine at the reference speed, damping from
/// the restitution there.
struct HertzContact {
  double stiffness = 0;  ///< k/m, m^(-1/2) s^-2
  PerClass damping{};    ///< (3/2) A, s
};

HertzContact hertz_contact(const PerClass& b, double reference, double contact_time) {
  HertzContact hertz;
  hertz.stiffness = std::pow(hertz_duration / contact_time, 2.5) / std::sqrt(reference);
  for (std::size_t kind = 0; kind < b.size(); ++kind)
    hertz.damping[kind] = b[kind] / (std::pow(hertz.stiffness, 0.4) * std::pow(reference, 0.2));
  return hertz;
}

void apply_viscoelastic(const EffectChoice& choice, Physics& physics) {
  const double reference = choice.number("reference_speed");
  PerClass b{};
  for (std::size_t kind = 0; kind < b.size(); ++kind)
    b[kind] = viscoelastic_damping(physics.contact.restitution[kind]);
  physics.contact.restitution_at = [b, reference](ContactClass kind, double speed) {
    return viscoelastic_restitution(b[index_of(kind)] * std::pow(speed / reference, 0.2));
  };
  const HertzContact hertz = hertz_contact(b, reference, physics.soft_contact_time);
  physics.contact.push = [hertz](ContactClass kind, double overlap, double rate, double,
                                 double reduced_mass) {
    const double force = overlap + hertz.damping[index_of(kind)] * rate;
    return overlap > 0 && force > 0 ? reduced_mass * hertz.stiffness * std::sqrt(overlap) * force : 0.0;
  };
  physics.contact.stored_energy = [hertz](ContactClass, double overlap, double, double reduced_mass) {
    return overlap > 0 ? 0.4 * reduced_mass * hertz.stiffness * overlap * overlap * std::sqrt(overlap) : 0.0;
  };
}

/// Returns what an engine makes of this law: no contact of LAMMPS remembers the speed at which it began.
Capability capability_of_restitution(const EffectChoice& choice, std::string_view engine,
                                     Capability general) {
  if (engine != "lammps" || choice.text("law") == "viscoelastic") return general;
  return {Fidelity::not_modelled,
          "LAMMPS has no restitution that falls as a power of the speed; take law = \"viscoelastic\", or "
          "--engine hard or soft"};
}

void apply_velocity_dependent_restitution(const EffectChoice& choice, int, Physics& physics) {
  choice.text("law") == "power" ? apply_power(choice, physics) : apply_viscoelastic(choice, physics);
}

}  // namespace

extern const EffectRecord velocity_dependent_restitution{
    .name = "velocity_dependent_restitution",
    .label = "restitution that falls with the speed",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence =
        "Normal restitution that falls with the closing speed; the setup's values hold at the reference "
        "speed.",
    .formula =
        "power: eps(v) = eps (v/v_ref)^-p, at most 0.98; viscoelastic: F = k (xi^(3/2) + (3/2) A xi^(1/2) "
        "xi'), eps the value at "
        "v_ref, 1 - eps ~ v^(1/5) for small losses; v is the closing speed at first touch",
    .source =
        "power: K. L. Johnson, Contact Mechanics (Cambridge, 1985), p = 1/4 for full plasticity; "
        "viscoelastic: N. V. Brilliantov et "
        "al., Phys. Rev. E 53, 5382 (1996), delayed recovery: T. Schwager and T. Poeschel, Phys. Rev. E 78, "
        "051304 (2008)",
    .limits =
        "Depends on the impact alone, not on what happened before; real grains cross from viscoelastic "
        "(below some mm/s) to plastic. "
        "The exponent belongs to the law power. Side walls with a law of their own: side_wall_restitution.",
    .parameters = {{.name = "law",
                    .kind = ParameterKind::choice,
                    .default_value = std::string("power"),
                    .sentence = "Which law.",
                    .choices = {"power", "viscoelastic"}},
                   {.name = "exponent",
                    .default_value = 0.12,
                    .low = 0,
                    .high = 1,
                    .neutral = 0,
                    .typical = 0.1,
                    .sentence = "Exponent p of the law power."},
                   {.name = "reference_speed",
                    .unit = "m/s",
                    .default_value = 0.3,
                    .low = 1e-3,
                    .high = 10,
                    .typical = 0.3,
                    .sentence = "Closing speed at which the setup's restitution holds."}},
    .claims = "normal restitution",
    .engines = {{"hard", {Fidelity::exact, "viscoelastic: restitution from a table, to 1e-10"}},
                {"soft",
                 {Fidelity::to_stated_error,
                  "power: linear spring-dashpot of the restitution at the closing speed; viscoelastic: "
                  "Hertz's force "
                  "itself, first order in the time step"}},
                {"lammps",
                 {Fidelity::to_stated_error,
                  "viscoelastic only: hertz with damping viscoelastic and limit_damping, first order in the "
                  "time step"}}},
    .search = {.strengths = {{.parameters = "exponent", .strongest = 0.5}}, .hides_in_restitution = true},
    .apply = &apply_velocity_dependent_restitution,
    .applied_last = true,
    .capability_of = &capability_of_restitution};

}  // namespace shakedown::effect
