// SPDX-License-Identifier: MIT
#include "lammps_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lammps_accounts.hpp"
#include "lammps_contacts.hpp"
#include "lammps_forces.hpp"

namespace shakedown {

namespace {

/// A region extends this far along axes on which it shall have no walls, m.
constexpr double far_away = 100;

class Writer {
 public:
  Writer(const Setup& setup, const Physics& physics, const State& initial)
      : setup_(setup),
        physics_(physics),
        initial_(initial),
        steps_(lammps_steps(setup)),
        held_(setup.domain != Domain::damper),
        grains_(static_cast<int>(initial.size())) {}

  LammpsScript script() {
    begin();
    if (grains_ > 0) contacts();
    box();
    gravity();
    motion();
    accounts_ = lammps_accounts({physics_.contact.has_friction(), grains_ > 0, setup_.grains.diameter / 2},
                                forces_, text_);
    output();
    return {std::move(text_), bodies(), std::move(table_), std::move(accounts_)};
  }

 private:
  template <class... Values>
  void say(fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format(format, std::forward<Values>(values)...) + "\n";
  }

  void begin() {
    say("# A granular damper for LAMMPS with the package GRANULAR, written by shakedown: `lmp -in {}` in "
        "this "
        "folder repeats the run.",
        lammps_script_file);
    say("# Numbers are SI. Grains are atoms 1 to {}, the box is atom {}: a point with the mass of the box, "
        "whose x is that of the box's centre.\n",
        grains_, grains_ + 1);
    say("units           si");
    say("atom_style      sphere");
    say("atom_modify     map array              # x[{}] below is the x of the box", grains_ + 1);
    say("boundary        m m m                  # the walls hold the grains; LAMMPS's own cell grows where "
        "they "
        "go");
    say("newton          off");
    say("comm_modify     vel yes");
    say("read_data       {}", lammps_bodies_file);
    say("group           grains type 1");
    say("group           box type 2");
    if (grains_ > 0) say("set             group grains mass {}", initial_.mass.front());
    say("set             group box mass {}", physics_.box_mass);
    say("timestep        {}", steps_.step);
    say("\n# Where the box is, and how fast");
    say("variable        box_x equal x[{}]", grains_ + 1);
    say("variable        box_v equal vx[{}]", grains_ + 1);
    if (grains_ == 0) {
      say("\n# No grains: nothing touches");
      say("pair_style      zero 0.01");
      say("pair_coeff      * *");
    }
  }

  void contacts() {
    const LammpsContacts words(setup_, physics_, initial_, held_);
    table_ = words.table();
    const double length = setup_.box.length / 2;
    const auto [y, z] = setup_.box.width;
    const std::string move = held_ ? "" : " move v_shift NULL NULL",
                      slide = held_ || !physics_.contact.has_friction() ? "" : move;
    say("");
    for (const std::string& remark : words.remarks()) say("{}", remark);
    for (const std::string& line : words.pairs()) say("{}", line);
    say("neighbor        {} bin", 0.2 * setup_.grains.diameter);
    say("neigh_modify    delay 0 every 1 check yes exclude type 1 2   # no grain touches the point that is "
        "the box");
    say("\n# Walls: end walls along x (restitution {}), side walls (restitution {}) that reach past them. "
        "They move with the box.",
        physics_.contact.restitution[1], physics_.contact.restitution[2]);
    if (!held_) say("variable        shift equal v_box_x-({})", initial_.x_box);
    say("region          ends block {} {} {} {} {} {} side in{} units box", initial_.x_box - length,
        initial_.x_box + length, -far_away, far_away, -far_away, far_away, held_ ? "" : move);
    say("region          sides_y block {0} {1} {2} {3} {0} {1} side in{4} units box", -far_away, far_away,
        -y / 2, y / 2, slide);
    say("region          sides_z block {0} {1} {0} {1} {2} {3} side in{4} units box", -far_away, far_away,
        -z / 2, z / 2, slide);
    say("# The order of these fixes is that of the forces: `store/force` remembers the sum so far, so that "
        "differences are the share of each kind of contact.");
    say("fix             sum_pairs grains store/force");
    say("fix             w_ends grains wall/gran/region granular {} region ends",
        words.law(ContactClass::end_wall));
    pull(words, 0);
    say("fix             sum_ends grains store/force");
    say("fix             w_y grains wall/gran/region granular {} region sides_y",
        words.law(ContactClass::side_wall));
    pull(words, 1);
    if (physics_.contact.has_friction()) say("fix             sum_y grains store/force");
    say("fix             w_z grains wall/gran/region granular {} region sides_z",
        words.law(ContactClass::side_wall));
    pull(words, 2);
    say("fix             sum_all grains store/force");
  }

  void pull(const LammpsContacts& words, int axis) {
    for (const std::string& line : words.walls_pull(axis)) say("{}", line);
  }

  void box() {
    forces_ = lammps_forces(setup_, physics_, steps_.step, grains_ > 0 ? initial_.mass.front() : 0, held_);
    for (const std::string& line : forces_.on_grains_with_reaction) say("{}", line);
    if (held_) return;
    say("\n# The box: its spring, and the reaction to all that walls{} have done to the grains (in the sum "
        "over grains the forces of pairs cancel).",
        forces_.on_grains_with_reaction.empty() ? "" : " and air");
    std::string spring = fmt::format("-{}*v_box_x", physics_.stiffness);
    if (physics_.spring_cubic != 0) spring += fmt::format("*(1+({})*v_box_x^2)", physics_.spring_cubic);
    if (grains_ > 0) spring += "-fcm(grains,x)";
    for (const auto& [name, formula, effect] : forces_.on_box) {
      say("variable        {} equal {}   # {}", name, formula,
          setup_.effects[static_cast<std::size_t>(effect)].record->label);
      spring += "+v_" + name;
    }
    say("variable        box_force equal {}", spring);
    say("fix             push box addforce v_box_force 0 0");
  }

  void gravity() {
    if (forces_.on_grains.empty() || grains_ == 0) return;
    say("\n# Forces on the grains that the box does not feel come after it.");
    for (const std::string& line : forces_.on_grains) say("{}", line);
  }

  void motion() {
    say("\n# Velocity Verlet for grains{}.", held_ ? "; the box is held" : " and box");
    say("fix             move {} nve/sphere\n", held_ ? "grains" : "all");
  }

  void output() {
    say("\n# Samples: {} steps each", steps_.in_a_sample);
    if (grains_ > 0) {
      say("variable        centre equal xcm(grains,x)");
      if (physics_.contact.has_friction()) say("compute         turning grains erotate/sphere");
      say("variable        kinetic equal ke(grains){}", physics_.contact.has_friction() ? "+c_turning" : "");
    } else {
      say("variable        centre equal 0");
      say("variable        kinetic equal 0");
    }
    say("variable        steps equal step");
    std::string title = "step,x_box_m,v_box_m_s,centre_m,kinetic_J",
                row = "$(v_steps),$(v_box_x:%.17g),$(v_box_v:%.17g),$(v_centre:%.17g),$(v_kinetic:%.17g)";
    for (std::size_t i = 0; i < accounts_.size(); ++i) {
      const std::string mean = accounts_.size() == 1 ? "f_means" : fmt::format("f_means[{}]", i + 1);
      say("variable        mean_{} equal {}", i + 1, mean);
      say("variable        now_{} equal {}", i + 1, accounts_[i].variable);
      title += fmt::format(",mean_{0}_W,now_{0}_W", i + 1);
      row += fmt::format(",$(v_mean_{0}:%.17g),$(v_now_{0}:%.17g)", i + 1);
    }
    if (!accounts_.empty()) {
      std::string means = fmt::format("fix             means all ave/time 1 {0} {0}", steps_.in_a_sample);
      for (const LammpsAccount& account : accounts_) means += " " + account.variable;
      say("{}", means);
    }
    say("fix             out all print {} \"{}\" file {} screen no title \"{}\"", steps_.in_a_sample, row,
        lammps_motion_file, title);
    say("thermo          {}", std::max<std::int64_t>(steps_.in_a_sample, 1'000'000'000));
    say("run             {}", steps_.in_a_sample * steps_.samples);
    say("write_dump      all custom {} id x y z vx vy vz omegax omegay omegaz modify sort id format float "
        "%.17g",
        lammps_end_file);
  }

  std::string bodies() const {
    const double x = std::abs(initial_.x_box) + setup_.box.length;
    const auto [y, z] = setup_.box.width;
    std::string text = fmt::format(
        "Bodies of a granular damper, SI: grains, then the box. The densities are no densities: the script "
        "sets masses.\n\n{} atoms\n2 atom types\n\n{} {} xlo xhi\n{} {} ylo yhi\n{} {} zlo zhi\n\nAtoms # "
        "sphere\n\n",
        grains_ + 1, -x, x, -y, y, -z, z);
    for (int i = 0; i < grains_; ++i) {
      const Vec3& place = initial_.position[static_cast<std::size_t>(i)];
      text += fmt::format("{} 1 {} 1 {} {} {}\n", i + 1, 2 * initial_.radius[static_cast<std::size_t>(i)],
                          place.x(), place.y(), place.z());
    }
    text += fmt::format("{} 2 0.001 1 {} 0 0\n\nVelocities\n\n", grains_ + 1, initial_.x_box);
    for (int i = 0; i < grains_; ++i) {
      const Vec3& velocity = initial_.velocity[static_cast<std::size_t>(i)];
      const Vec3 spin =
          initial_.spin.empty() ? Vec3(Vec3::Zero()) : initial_.spin[static_cast<std::size_t>(i)];
      text += fmt::format("{} {} {} {} {} {} {}\n", i + 1, velocity.x(), velocity.y(), velocity.z(), spin.x(),
                          spin.y(), spin.z());
    }
    return text + fmt::format("{} {} 0 0 0 0 0\n", grains_ + 1, initial_.v_box);
  }

  const Setup& setup_;
  const Physics& physics_;
  const State& initial_;
  LammpsSteps steps_;
  bool held_;
  int grains_;
  LammpsForces forces_;
  std::vector<LammpsAccount> accounts_;
  std::string text_, table_;
};

}  // namespace

LammpsSteps lammps_steps(const Setup& setup) {
  // Without contacts only the swing has to be followed: its frequency is then right to (2 pi / 10^4)^2 / 24.
  constexpr double steps_of_a_swing = 1e4;
  const double interval = 1 / setup.run.sample_rate,
               longest = setup.grains.count == 0 && setup.spring.frequency > 0
                             ? 1 / (steps_of_a_swing * setup.spring.frequency)
                             : setup.soft.contact_time / setup.soft.steps_per_contact;
  const auto whole = [](double number) { return static_cast<std::int64_t>(number); };
  LammpsSteps steps;
  steps.in_a_sample = std::max<std::int64_t>(1, whole(std::ceil(interval / longest * (1 - 1e-12))));
  steps.step = interval / static_cast<double>(steps.in_a_sample);
  steps.samples = whole(std::floor(setup.run.duration * setup.run.sample_rate * (1 + 1e-12)));
  return steps;
}

LammpsScript lammps_script(const Setup& setup, const Physics& physics, const State& initial) {
  return Writer(setup, physics, initial).script();
}

}  // namespace shakedown
