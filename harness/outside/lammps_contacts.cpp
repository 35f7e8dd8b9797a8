// SPDX-License-Identifier: MIT
#include "lammps_contacts.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "spring_dashpot.hpp"

namespace shakedown {

LammpsContacts::LammpsContacts(const Setup& setup, const Physics& physics, const State& initial, bool held)
    : setup_(setup),
      physics_(physics),
      mass_(initial.mass.front()),
      radius_(initial.radius.front()),
      held_(held) {}

double LammpsContacts::reduced_mass(ContactClass kind) const {
  if (kind == ContactClass::grain_grain) return mass_ / 2;
  const double box = physics_.box_mass;
  return kind == ContactClass::end_wall && !held_ ? mass_ * box / (mass_ + box) : mass_;
}

/// The viscoelastic law of the effect is mu K (xi^(3/2) + D xi^(1/2) xi'), mu the reduced mass of the
/// contact, and never attracts. `hertz k eta damping viscoelastic limit_damping` is k R^(1/2) xi^(3/2) + eta
/// m_eff (R xi)^(1/2) xi', cut at zero, with LAMMPS's own R and m_eff: half a radius and half a mass for two
/// alike grains, those of the grain at a wall, whose mass LAMMPS does not know (manual of LAMMPS, pair_style
/// granular and fix wall/gran). So k = mu K / R^(1/2) and eta = mu K D / (m_eff R^(1/2)).
std::string LammpsContacts::hertz(ContactClass kind) const {
  const double mu = reduced_mass(kind), deep = 1e-4, fast = 1;
  const double still = physics_.contact.push(kind, deep, 0, 0, mu),
               moving = physics_.contact.push(kind, deep, fast, 0, mu);
  const double stiffness = still / (deep * std::sqrt(deep)),
               damping = (moving - still) / (fast * std::sqrt(deep));
  const double share = kind == ContactClass::grain_grain ? 0.5 : 1, root = std::sqrt(share * radius_);
  return fmt::format("hertz {} {} damping viscoelastic ", stiffness / root, damping / (share * mass_ * root));
}

std::string LammpsContacts::normal(ContactClass kind) const {
  if (physics_.contact.pushes(kind)) return hertz(kind);
  const SpringDashpot contact = spring_dashpot(physics_.contact.restitution[static_cast<std::size_t>(kind)],
                                               reduced_mass(kind), setup_.soft.contact_time);
  return fmt::format("hooke {} {} damping velocity ", contact.stiffness, contact.damping);
}

std::string LammpsContacts::law(ContactClass kind) const {
  const auto index = static_cast<std::size_t>(kind);
  const double friction = physics_.contact.friction[index],
               stiffness = spring_dashpot(physics_.contact.restitution[index], reduced_mass(kind),
                                          setup_.soft.contact_time)
                               .stiffness;
  const std::string tangential = friction == 0
                                     ? "tangential linear_nohistory 0 0"
                                     : fmt::format("tangential linear_history {} 0 {}",
                                                   physics_.contact.stiffness_ratio * stiffness, friction);
  return normal(kind) + tangential + (physics_.contact.pushes(kind) ? " limit_damping" : "");
}

std::vector<std::string> LammpsContacts::remarks() const {
  std::vector<std::string> lines;
  if (physics_.contact.push) {
    lines.push_back(fmt::format(
        "# Contacts: Hertz's force and its dashpot, of a duration of {} s and the restitution {} at the "
        "reference speed. `limit_damping`: the force never attracts.",
        setup_.soft.contact_time, physics_.contact.restitution[0]));
  } else {
    lines.push_back(fmt::format(
        "# Contacts: spring (N/m) and dashpot (N s/m) of a duration of {} s and the restitution {}. "
        "`velocity`: the dashpot is not multiplied by a mass.",
        setup_.soft.contact_time, physics_.contact.restitution[0]));
  }
  if (physics_.contact.has_friction())
    lines.push_back(
        fmt::format("# Friction: a tangential spring of {} of the normal one, which slides at mu times the "
                    "normal force.",
                    physics_.contact.stiffness_ratio));
  if (physics_.contact.has_attraction())
    lines.push_back(fmt::format(
        "# Attraction: {} N up to a gap of {} m, in contacts too: a table of two equal forces beside them.",
        physics_.contact.attraction_force, physics_.contact.attraction_range));
  return lines;
}

std::vector<std::string> LammpsContacts::pairs() const {
  const std::string law_of_pairs = law(ContactClass::grain_grain);
  if (!physics_.contact.has_attraction())
    return {"pair_style      granular", "pair_coeff      * * " + law_of_pairs};
  return {"pair_style      hybrid/overlay granular table linear 1000",
          "pair_coeff      * * granular " + law_of_pairs,
          fmt::format("pair_coeff      * * table {} ATTRACTION {}", lammps_table_file,
                      2 * radius_ + physics_.contact.attraction_range)};
}

std::string LammpsContacts::table() const {
  if (!physics_.contact.has_attraction()) return {};
  const double far = 2 * radius_ + physics_.contact.attraction_range, near = radius_,
               force = physics_.contact.attraction_force;
  return fmt::format(
      "# Attraction of two grains: number, distance of centres (m), energy (J), force (N)\n\nATTRACTION\n"
      "N 2 R {0} {1}\n\n1 {0} {2} {3}\n2 {1} 0 {3}\n",
      near, far, -force * (far - near), -force);
}

std::vector<std::string> LammpsContacts::walls_pull(int axis) const {
  if (!physics_.contact.walls_attract()) return {};
  const char name = "xyz"[axis];
  const double width = axis == 0 ? setup_.box.length : setup_.box.width[static_cast<std::size_t>(axis - 1)];
  const double beyond = width / 2 - radius_ - physics_.contact.attraction_range,
               force = physics_.contact.attraction(ContactClass::end_wall);
  const std::string place = axis == 0 ? "(x-v_box_x)" : std::string(1, name);
  return {
      fmt::format("variable        pull_{0} atom {1}*(({2}>{3})-({2}<-{3}))", name, force, place, beyond),
      fmt::format("fix             pull_{0} grains addforce {1} {2} {3}   # the walls attract", name,
                  axis == 0 ? "v_pull_x" : "0", axis == 1 ? "v_pull_y" : "0", axis == 2 ? "v_pull_z" : "0")};
}

}  // namespace shakedown
