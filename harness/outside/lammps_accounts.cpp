// SPDX-License-Identifier: MIT
#include "lammps_accounts.hpp"

#include <fmt/format.h>

namespace shakedown {

namespace {

using Of = LammpsAccount::Of;

/// Returns a component of what the fixes between two stores have added: "(f_ends[1]-f_pairs[1])".
std::string added(const char* after, const char* before, int axis) {
  return fmt::format("(f_{}[{}]-f_{}[{}])", after, axis, before, axis);
}

/// Returns the power of the forces between two stores on grains that slip past walls which move with the box.
std::string past_walls(const char* after, const char* before) {
  return added(after, before, 1) + "*(vx-v_box_v)+" + added(after, before, 2) + "*vy+" +
         added(after, before, 3) + "*vz";
}

/// Returns the power of their torque. The wall across `axis` is touched at radius times the direction away
/// from the middle, `side`, which LAMMPS tells by no name.
std::string turning(const char* after, const char* before, int axis, const std::string& side, double radius) {
  const int next = axis % 3 + 1, last = next % 3 + 1;
  return fmt::format("-{}*{}*({}*c_spin[{}]-{}*c_spin[{}])", radius, side, added(after, before, last), next,
                     added(after, before, next), last);
}

void frictionless(std::string& text) {
  text +=
      "variable        in_pairs atom f_sum_pairs[1]*vx+f_sum_pairs[2]*vy+f_sum_pairs[3]*vz\n"
      "variable        at_ends atom (f_sum_ends[1]-f_sum_pairs[1])*(vx-v_box_v)\n"
      "variable        at_sides atom (f_sum_all[2]-f_sum_ends[2])*vy+(f_sum_all[3]-f_sum_ends[3])*vz\n";
}

void with_friction(double radius, std::string& text) {
  const auto say = [&](const std::string& line) { text += line + "\n"; };
  say("# Friction turns the grains: power of torques too. Its lever at a wall is the radius.");
  say("compute         spin grains property/atom omegax omegay omegaz tqx tqy tqz");
  say("variable        turned_at_ends atom " +
      turning("sum_ends", "sum_pairs", 1, "(2*(x>v_box_x)-1)", radius));
  say("variable        turned_at_sides atom " + turning("sum_y", "sum_ends", 2, "(2*(y>0)-1)", radius) +
      turning("sum_all", "sum_y", 3, "(2*(z>0)-1)", radius));
  say("variable        in_pairs atom f_sum_pairs[1]*vx+f_sum_pairs[2]*vy+f_sum_pairs[3]*vz"
      "+c_spin[1]*c_spin[4]+c_spin[2]*c_spin[5]+c_spin[3]*c_spin[6]-v_turned_at_ends-v_turned_at_sides");
  say("variable        at_ends atom v_turned_at_ends+" + past_walls("sum_ends", "sum_pairs"));
  say("variable        at_sides atom v_turned_at_sides+" + past_walls("sum_all", "sum_ends"));
}

}  // namespace

std::vector<LammpsAccount> lammps_accounts(const LammpsGrains& grains, const LammpsForces& forces,
                                           std::string& text) {
  std::vector<LammpsAccount> accounts;
  text += "# Energy: power of each kind of contact and of each effect, averaged over all steps of a sample\n";
  if (grains.any) {
    if (grains.friction)
      with_friction(grains.radius, text);
    else
      frictionless(text);
    text += "compute         work grains reduce sum v_in_pairs v_at_ends v_at_sides\n";
    accounts = {{Of::grain_grain, -1, "c_work[1]"},
                {Of::end_wall, -1, "c_work[2]"},
                {Of::side_wall, -1, "c_work[3]"}};
  }
  for (const LammpsForces::Power& power : forces.powers) {
    text += fmt::format("variable        power_{} equal {}\n", power.effect + 1, power.formula);
    accounts.push_back({Of::effect, power.effect, fmt::format("v_power_{}", power.effect + 1)});
  }
  return accounts;
}

}  // namespace shakedown
