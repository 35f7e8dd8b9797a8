// SPDX-License-Identifier: MIT
// Coulomb friction with spin: an impulse at right angles to the normal one, at most mu times it.
#include "physics.hpp"

namespace shakedown::effect {

namespace {
void apply_grain_friction(const EffectChoice& choice, int, Physics& physics) {
  const double wall = choice.number("grain_wall");
  physics.contact.friction = {choice.number("grain_grain"), wall, wall};
  physics.contact.tangential_restitution = choice.number("tangential_restitution");
  physics.contact.stiffness_ratio = choice.number("stiffness_ratio");
}

/// Returns what an engine makes of these parameters: a spring with a dashpot turns the slip round or stops
/// it, and cannot leave part of it in its old direction.
Capability capability_of_friction(const EffectChoice& choice, std::string_view engine, Capability general) {
  const double tangential = choice.number("tangential_restitution");
  const bool compliant = choice.number("stiffness_ratio") != ContactLaw::turning_ratio;
  if (engine == "lammps" && tangential != 1)
    return {
        Fidelity::not_modelled,
        "LAMMPS is given the tangential spring alone, tangential_restitution 1; use --engine soft or hard"};
  if (engine == "soft" && tangential < 0)
    return {Fidelity::not_modelled,
            "the soft engine takes a tangential_restitution from 0 to 1; use --engine hard"};
  if (engine == "hard" && compliant)
    return tangential < 0
               ? Capability{Fidelity::not_modelled,
                            "a tangential spring of its own stiffness_ratio goes with a "
                            "tangential_restitution "
                            "from 0 to 1; leave out one of the two"}
               : Capability{
                     Fidelity::to_stated_error,
                     "what the soft engine's springs leave of the slip, integrated over each impact in "
                     "the limit of short contacts, to 1e-3 of the slip"};
  return general;
}
}  // namespace

extern const EffectRecord grain_friction{
    .name = "grain_friction",
    .label = "friction of the grains",
    .family = "contact",
    .acts_on = ActsOn::contact,
    .sentence = "Coulomb friction between grains and at the walls, with rotation of the grains.",
    .formula =
        "|J_t| <= mu J_n; where that suffices the slip u_t becomes -beta u_t (of a tangential spring of "
        "another ratio q to the normal one than 2/7: u_t cos(pi (3.5 q)^(1/2)), less what slides at the "
        "beginning and at the end); 1/m_t = 7/2 (1/m_i + 1/m_j) "
        "for "
        "solid spheres, 7/(2 m) at a wall, plus 1/M along the axis at side walls, which pull the box",
    .source =
        "O. R. Walton and R. L. Braun, J. Rheol. 30, 949 (1986); S. F. Foerster et al., Phys. Fluids 6, 1108 "
        "(1994); the tangential spring of 2/7 k_n: L. E. Silbert et al., Phys. Rev. E 64, 051302 (2001); "
        "that of elastic "
        "bodies, 2 (1 - nu)/(2 - nu): R. D. Mindlin, J. Appl. Mech. 16, 259 (1949)",
    .limits =
        "One coefficient for rest and motion; rolling resistance is grain_rolling_resistance. Of the impacts "
        "that the regularisation "
        "of inelastic collapse makes elastic those slower than a tenth of its limit, or less than 10 us "
        "after another, are frictionless. Slip after an impact and after a soft contact agree to 0.07 of the "
        "slip "
        "before. An impulse and a tangential spring agree for free flight between impacts; in a pressed "
        "layer they come within 0.6 % of the slope of the decay (coefficients of 0.41, restitution 0.66).",
    .parameters = {{.name = "grain_grain",
                    .low = 0,
                    .high = 1,
                    .neutral = 0,
                    .typical = 0.2,
                    .sentence = "Coefficient of friction between grains."},
                   {.name = "grain_wall",
                    .low = 0,
                    .high = 1,
                    .neutral = 0,
                    .typical = 0.2,
                    .sentence = "Coefficient of friction of a grain and the box, end walls and side walls."},
                   {.name = "tangential_restitution",
                    .default_value = 1.0,
                    .low = -1,
                    .high = 1,
                    .sentence = "Slip after an impact that sticks, reversed and divided by the slip before; "
                                "1 is what a tangential spring of 2/7 of the normal one does."},
                   {.name = "stiffness_ratio",
                    .default_value = ContactLaw::turning_ratio,
                    .low = 0.05,
                    .high = 1,
                    .typical = 0.82,
                    .sentence =
                        "Tangential spring over the normal one; of elastic bodies 2 (1 - nu)/(2 - nu) "
                        "with Poisson's ratio nu: 0.82 of steel (0.3), 0.87 of alumina (0.23)."}},
    .claims = "friction of grains",
    .dissipative = true,
    .engines =
        {{"hard", {Fidelity::exact}},
         {"soft",
          {Fidelity::to_stated_error,
           "tangential spring of stiffness_ratio times the normal stiffness, stretched up to sliding at mu "
           "times the normal spring's force, with a dashpot for tangential_restitution from 0 to 1"}},
         {"lammps",
          {Fidelity::to_stated_error,
           "tangential spring of stiffness_ratio times the normal stiffness, stretched up to sliding at mu "
           "times the whole normal force, dashpot included"}}},
    // The first tenth does as much as the next two, and more than 0.25 dissipates less again (restitutions
    // fitted to frictional runs): no parabola. Found as one number, for grains and walls alike.
    .search = {.strengths = {{.parameters = "grain_grain&grain_wall",
                              .typical = 0.2,
                              .levels = {0.05, 0.1, 0.2, 0.35, 0.6}}},
               .cost = Search::Cost::dear,
               .hides_in_restitution = true},
    .apply = &apply_grain_friction,
    .capability_of = &capability_of_friction};

}  // namespace shakedown::effect
