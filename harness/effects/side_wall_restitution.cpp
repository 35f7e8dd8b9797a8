// SPDX-License-Identifier: MIT
// The side walls apart from the end walls.
#include "physics.hpp"
#include "power_restitution.hpp"

namespace shakedown::effect {

namespace {
void apply(const EffectChoice& choice, int, Physics& physics) {
  const double restitution = choice.number("restitution");
  physics.contact.restitution[static_cast<std::size_t>(ContactClass::side_wall)] = restitution;
  if (choice.text("law") == "constant")
    physics.contact.side_wall_restitution_at = [restitution](double) { return restitution; };
  if (choice.text("law") == "power")
    physics.contact.side_wall_restitution_at = [restitution, exponent = choice.number("exponent"),
                                                reference = choice.number("reference_speed")](double speed) {
      return power_restitution(restitution, exponent, reference, speed);
    };
}

Capability capability_of(const EffectChoice& choice, std::string_view engine, Capability general) {
  if (engine == "lammps" && choice.text("law") == "power")
    return {
        Fidelity::not_modelled,
        "LAMMPS's contacts have one restitution at all speeds; use --engine soft or hard, or law constant"};
  return general;
}
}  // namespace

extern const EffectRecord side_wall_restitution{
    .name = "side_wall_restitution",
    .label = "restitution of the side walls",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence = "Normal restitution of the side walls, apart from that of the end walls.",
    .formula =
        "eps of grain and side wall = restitution (law power: restitution (v/v_ref)^-p, at most 0.98); end "
        "walls "
        "keep restitution.grain_wall",
    .source =
        "M. N. Bannerman et al., Movers and shakers: granular damping in microgravity, Phys. Rev. E 84, "
        "011301 (2011); it uses one value for all walls",
    .limits =
        "With the law shared it depends on the speed, or scatters, as the restitution of the other contacts "
        "does. "
        "Exponent and reference speed belong to the law power.",
    .parameters = {{.name = "restitution",
                    .default_value = 0.76,
                    .required = true,
                    .low = 0,
                    .high = 1,
                    .typical = 0.6,
                    .sentence = "Coefficient of normal restitution of a grain and a side wall."},
                   {.name = "law",
                    .kind = ParameterKind::choice,
                    .default_value = std::string("shared"),
                    .sentence =
                        "How it depends on the speed: as at the other contacts, not at all, or by a power.",
                    .choices = {"shared", "constant", "power"}},
                   {.name = "exponent",
                    .default_value = 0.12,
                    .low = 0,
                    .high = 1,
                    .typical = 0.1,
                    .sentence = "Exponent p of the law power."},
                   {.name = "reference_speed",
                    .unit = "m/s",
                    .default_value = 0.3,
                    .low = 1e-3,
                    .high = 10,
                    .typical = 0.3,
                    .sentence = "Closing speed at which restitution holds, of the law power."}},
    .claims = "restitution of the side walls",
    .engines =
        {{"hard", {Fidelity::exact}},
         {"soft",
          {Fidelity::to_stated_error, "restitution to second order in the time step, as at the other walls"}},
         {"bullet", {Fidelity::exact}},
         {"lammps",
          {Fidelity::to_stated_error, "restitution to first order in the time step, as at the other walls"}}},
    // Known to 0.2 of that of the end walls; below 0.05 grains stay at the wall.
    .search = {.strengths = {{.parameters = "restitution",
                              .typical = -0.2,
                              .levels = {-0.1, 0.15, -0.2, -0.4, -0.6},
                              .low = 0.05,
                              .high = 0.999,
                              .absent_key = "restitution.grain_wall",
                              .strongest = -0.66}}},
    .apply = &apply,
    .capability_of = &capability_of};

}  // namespace shakedown::effect
