// SPDX-License-Identifier: MIT
#include "lammps_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "lammps_formula.hpp"

namespace shakedown {

namespace {

/// Dry friction has to be smooth: below this speed it falls with the speed, and the box creeps where it
/// should stick, m/s. Ten micrometres a second move it by 0.1 mm in 10 s.
constexpr double slowest_slip = 1e-5;

/// Returns that speed for an explicit step, m/s: the friction's own rate must stay well below 1 / step.
double smooth_below(double friction, double box_mass, double step) {
  return std::max(slowest_slip, 10 * friction * step / box_mass);
}

std::string sine(double frequency, double phase) {
  return fmt::format("sin({}*step*dt+({}))", 2 * std::numbers::pi * frequency, phase);
}

std::string formula_of(const EffectChoice& choice, const LammpsNames& names) {
  try {
    return lammps_formula(choice.text("force"), choice.constants("constants"), names);
  } catch (const LammpsFormulaProblem& problem) {
    throw InputError({{choice.place, std::string(choice.record->name) + ".force",
                       "cannot be told to engine 'lammps': " + problem.text,
                       "write it with + - * / ^, comparisons, sin, cos, exp, sqrt, abs, tanh, min, max, "
                       "or use --engine hard or soft"}});
  }
}

/// A force on the box that the physics holds only as a function, N, of v_box_x, v_box_v and the time.
struct BoxForceInWords {
  std::string_view effect;
  std::string (*words)(const EffectChoice&, const Physics&);
};

constexpr std::array<BoxForceInWords, 5> box_forces{{
    {"blade_quadratic_drag",
     [](const EffectChoice& choice, const Physics&) {
       return fmt::format("-{}*v_box_v*abs(v_box_v)", choice.number("drag"));
     }},
    {"user_force",
     [](const EffectChoice& choice, const Physics&) {
       return formula_of(choice, {"v_box_x", "v_box_v", "(step*dt)"});
     }},
    {"pendulum",
     [](const EffectChoice& choice, const Physics& physics) {
       return fmt::format("{0}*(v_box_x-{1}*sin(v_box_x/{1}))", physics.stiffness, choice.number("length"));
     }},
    {"second_mode",
     [](const EffectChoice& choice, const Physics& physics) {
       return fmt::format("({})*exp(-{}*step*dt)*{}", physics.box_mass * choice.number("amplitude"),
                          choice.number("rate"), sine(choice.number("frequency"), choice.number("phase")));
     }},
    {"spring_quadratic",
     [](const EffectChoice& choice, const Physics& physics) {
       return fmt::format("({})*v_box_x^2",
                          -physics.stiffness * choice.number("coefficient") / choice.number("reference"));
     }},
}};

std::string in_words(const EffectChoice& choice, const Physics& physics) {
  const auto found = std::find_if(box_forces.begin(), box_forces.end(), [&](const BoxForceInWords& force) {
    return force.effect == choice.record->name;
  });
  if (found == box_forces.end())
    throw InputError({{choice.place, std::string(choice.record->name), "has no words for engine 'lammps'",
                       "leave it out, or use --engine hard or soft"}});
  return found->words(choice, physics);
}

class Forces {
 public:
  Forces(const Setup& setup, const Physics& physics, double step, double grain_mass, bool held)
      : setup_(setup), physics_(physics), step_(step), grain_mass_(grain_mass), held_(held) {}

  LammpsForces all() {
    if (!held_) on_box();
    if (grain_mass_ > 0) {
      air();
      for (const auto& share : physics_.grains.constant.shares())
        accelerate(share.strength, "", share.effect);
      for (const HarmonicVector& wave : physics_.grains.harmonics)
        accelerate(wave.amplitude, sine(wave.frequency, wave.phase), wave.effect);
      push_grains();
    }
    for (const auto& [effect, formula] : powers_) forces_.powers.push_back({formula, effect});
    return std::move(forces_);
  }

 private:
  void does_work(const std::string& formula, int effect) {
    std::string& sum = powers_[effect];
    sum += (sum.empty() ? "" : "+") + formula;
  }

  void push_box(const std::string& formula, int effect) {
    const std::string name = fmt::format("push_{}", ++count_);
    forces_.on_box.push_back({name, formula, effect});
    does_work("v_" + name + "*v_box_v", effect);
  }

  void on_box() {
    for (const auto& share : physics_.box.viscous.shares())
      push_box(fmt::format("-{}*v_box_v", share.strength), share.effect);
    for (const auto& share : physics_.box.constant.shares())
      push_box(fmt::format("({})", share.strength), share.effect);
    for (const Harmonic& wave : physics_.box.harmonics)
      push_box(fmt::format("({})*{}", wave.amplitude, sine(wave.frequency, wave.phase)), wave.effect);
    for (const auto& share : physics_.box.dry_friction.shares())
      push_box(fmt::format("-{0}*v_box_v/sqrt(v_box_v^2+{1}^2)", share.strength,
                           smooth_below(share.strength, physics_.box_mass, step_)),
               share.effect);
    for (const FreeForce& force : physics_.box.free)
      push_box(in_words(setup_.effects[static_cast<std::size_t>(force.effect)], physics_), force.effect);
  }

  /// Adds formulas on the grains, along x, each at its own place and speed.
  void push_grains() {
    for (const FreeForce& force : physics_.grains.free) {
      const EffectChoice& choice = setup_.effects[static_cast<std::size_t>(force.effect)];
      const int n = ++count_;
      forces_.on_grains.push_back(
          fmt::format("variable        formula_{} atom {}", n, formula_of(choice, {"x", "vx", "(step*dt)"})));
      forces_.on_grains.push_back(fmt::format(
          "fix             formula_{0} grains addforce v_formula_{0} 0 0   # {1}", n, choice.record->label));
      forces_.on_grains.push_back(
          fmt::format("variable        formula_power_{0} atom v_formula_{0}*vx\n"
                      "compute         formula_{0} grains reduce sum v_formula_power_{0}",
                      n));
      does_work(fmt::format("c_formula_{}", n), force.effect);
    }
  }

  void accelerate(const Vec3& acceleration, const std::string& wave, int effect) {
    std::string words, power;
    for (int axis = 0; axis < 3; ++axis) {
      if (acceleration(axis) == 0) {
        words += " 0";
        continue;
      }
      const std::string strength = fmt::format("({})", grain_mass_ * acceleration(axis)),
                        name = fmt::format("pull_{}", ++count_);
      forces_.on_grains.push_back(
          fmt::format("variable        {} equal {}{}", name, strength, wave.empty() ? "" : "*" + wave));
      words += " v_" + name;
      power +=
          fmt::format("{}v_{}*count(grains)*vcm(grains,{})", power.empty() ? "" : "+", name, "xyz"[axis]);
    }
    if (power.empty()) return;
    forces_.on_grains.push_back(fmt::format("fix             pull_{} grains addforce{}   # {}", ++count_,
                                            words,
                                            setup_.effects[static_cast<std::size_t>(effect)].record->label));
    does_work(power, effect);
  }

  void air() {
    for (const auto& share : physics_.grains.drag.shares()) {
      const std::string box_v = held_ ? "0" : "v_box_v";
      const auto line = [&](std::string text) { forces_.on_grains_with_reaction.push_back(std::move(text)); };
      const int n = ++count_;
      line(fmt::format(
          "\n# Air that moves with the box drags each grain.\nvariable        past_{} atom vx-{}", n, box_v));
      line(fmt::format("variable        air_{0} atom -({1}+{2}*sqrt(v_past_{0}^2+vy^2+vz^2))", n,
                       share.strength.linear, share.strength.quadratic));
      line(
          fmt::format("variable        air_x_{0} atom v_air_{0}*v_past_{0}\nvariable        air_y_{0} atom "
                      "v_air_{0}*vy\nvariable        air_z_{0} atom v_air_{0}*vz",
                      n));
      line(fmt::format("fix             air_{0} grains addforce v_air_x_{0} v_air_y_{0} v_air_z_{0}", n));
      line(fmt::format(
          "variable        air_power_{0} atom v_air_{0}*(v_past_{0}^2+vy^2+vz^2)\ncompute         "
          "air_{0} grains reduce sum v_air_power_{0}",
          n));
      does_work(fmt::format("c_air_{}", n), share.effect);
    }
  }

  const Setup& setup_;
  const Physics& physics_;
  double step_, grain_mass_;
  bool held_;
  int count_ = 0;
  std::map<int, std::string> powers_;
  LammpsForces forces_;
};

}  // namespace

LammpsForces lammps_forces(const Setup& setup, const Physics& physics, double step, double grain_mass,
                           bool held) {
  return Forces(setup, physics, step, grain_mass, held).all();
}

}  // namespace shakedown
