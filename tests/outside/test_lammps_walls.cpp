// SPDX-License-Identifier: MIT
// Impacts on a granular wall of LAMMPS scanned over the angle: does any leave with more energy than it came
// with? `fix wall/gran hooke/history` did so in versions before June 2026 (LAMMPS, pull request 5007), by 34
// % at a coefficient of 0.5 and 76 degrees. The scripts of this engine use another style, `granular`.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <sstream>

#include "child_program.hpp"
#include "lammps.hpp"
#include "number_table.hpp"
#include "outside_errors.hpp"
#include "spring_dashpot.hpp"
#include "within.hpp"
#include "work_folder.hpp"

using namespace shakedown;

namespace {

constexpr double radius = 0.005, grain_mass = 4.04e-3, speed = 0.5, contact_time = 3e-4;
constexpr int angles = 36;  // 0 to 87.5 degrees

double angle_of(int i) { return i * 2.5 * std::numbers::pi / 180; }

/// What is left of an impact, velocities over the speed before it.
struct Left {
  double energy = 0, slip = 0, rebound = 0;
};

Left left_of(const Vec3& velocity, const Vec3& spin) {
  const Vec3 surface = velocity + Vec3(0, radius * spin.z(), -radius * spin.y());
  return {(velocity.squaredNorm() + 0.4 * radius * radius * spin.squaredNorm()) / (speed * speed),
          std::hypot(surface.y(), surface.z()) / speed, -velocity.x() / speed};
}

struct Wall {
  double friction, restitution, steps;
  double gain;  ///< of the energy, that steps may make where nothing is lost
};
void PrintTo(const Wall& wall, std::ostream* out) {
  *out << "friction " << wall.friction << ", restitution " << wall.restitution << ", steps " << wall.steps;
}

/// By the scripts that the engine writes: 36 grains side by side touch the end wall of a box that is held.
std::vector<Left> by_the_engine(const Engine& engine, const Wall& wall) {
  shakedown::Setup setup;
  setup.domain = Domain::closed;
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.1;
  setup.restitution.grain_wall = wall.restitution;
  setup.soft.contact_time = contact_time;
  setup.soft.steps_per_contact = wall.steps;
  setup.run.duration = 2e-3;
  setup.run.sample_rate = 500;
  add_effect(setup, "grain_friction", {{"grain_grain", 0.0}, {"grain_wall", wall.friction}});
  std::vector<PlacedGrain> grains;
  for (int i = 0; i < angles; ++i) {
    const double across = speed * std::sin(angle_of(i)), along = speed * std::cos(angle_of(i));
    grains.push_back({Vec3(0.05 - radius - 1e-3 * along, 0.014 * (i % 6) - 0.036, 0.014 * (i / 6) - 0.036),
                      Vec3(along, across, 0)});
  }
  const Trajectory run = run_with(engine, setup, grains);
  std::vector<Left> left;
  for (std::size_t i = 0; i < grains.size(); ++i)
    left.push_back(left_of(run.end_state.velocity[i], run.end_state.spin[i]));
  return left;
}

/// By a script of its own: the styles of other people's input files.
std::string script_of(const Wall& wall, const std::string& style) {
  std::string text =
      "units si\natom_style sphere\natom_modify map array\nboundary f f f\nnewton off\ncomm_modify vel yes\n"
      "region all block -1 1 -1 5 -1 1 units box\ncreate_box 1 all\n";
  for (int i = 0; i < angles; ++i)
    text += fmt::format("create_atoms 1 single {} {} 0 units box\n",
                        -radius - 1e-3 * speed * std::cos(angle_of(i)), 0.1 * i);
  text += fmt::format("set atom * diameter {}\nset atom * mass {}\n", 2 * radius, grain_mass);
  for (int i = 0; i < angles; ++i)
    text += fmt::format("set atom {} vx {} vy {}\n", i + 1, speed * std::cos(angle_of(i)),
                        speed * std::sin(angle_of(i)));
  return text + "pair_style gran/hooke/history 1e5 NULL 0 NULL 0.5 0\npair_coeff * *\nneighbor 0.001 bin\n" +
         fmt::format(
             "fix wall all wall/gran {} xplane NULL 0\nfix move all nve/sphere\ntimestep {}\nrun {}\n", style,
             contact_time / wall.steps, static_cast<int>(2e-3 / contact_time * wall.steps)) +
         "write_dump all custom end id vx vy vz omegax omegay omegaz modify sort id format float %.17g\n";
}

std::vector<Left> by_a_style(const Wall& wall, const std::string& style) {
  const WorkFolder folder("");
  folder.write("in", script_of(wall, style));
  ChildProgram child;
  child.words = {"lmp", "-in", "in"};
  child.folder = folder.path();
  child.output = folder / "output";
  child.error = folder / "error";
  EXPECT_EQ(run_child(child).exit_code, 0) << contents_of(folder / "output");
  const std::string text = contents_of(folder / "end");
  std::vector<Left> left;
  for (const std::vector<double>& row :
       number_table(std::string_view(text).substr(text.find('\n', text.find("ITEM: ATOMS")) + 1), ' ', 7, 1))
    left.push_back(left_of({row[1], row[2], row[3]}, {row[4], row[5], row[6]}));
  return left;
}

double most_energy(const std::vector<Left>& left) {
  double most = 0;
  for (const Left& one : left) most = std::max(most, one.energy);
  return most;
}

class SlowLammpsWalls : public WithLammps, public testing::WithParamInterface<Wall> {};

TEST_P(SlowLammpsWalls, GiveNoEnergyAndRubAsRigidSpheresDo) {
  const auto [friction, restitution, steps, gain] = GetParam();
  const std::vector<Left> left = by_the_engine(*lammps, GetParam());
  EXPECT_LT(most_energy(left), 1 + gain);  // seen: 1.8e-3 with 20 steps, 4e-6 with 100
  for (int i = 0; i < angles; ++i) {
    const double along = std::cos(angle_of(i)), across = std::sin(angle_of(i)),
                 slid = across - 3.5 * friction * (1 + restitution) * along;
    if (slid > 0) {
      WITHIN(left[static_cast<std::size_t>(i)].slip, slid, 0.05, 0.021) << i;
    }
  }
  std::printf("  granular, friction %g, restitution %g, %g steps: largest energy after over before %.6f\n",
              friction, restitution, steps, most_energy(left));
}

/// Debian 12's version is older than the model that gained. Another version may have it: it is told.
TEST_P(SlowLammpsWalls, OfTheOlderStyleGiveNoneInTheVersionOfDebian12) {
  const auto [friction, restitution, steps, gain] = GetParam();
  const SpringDashpot contact = spring_dashpot(restitution, grain_mass, contact_time);
  const double per_mass = contact.damping / grain_mass;
  const WorkFolder folder("");
  for (const auto& [damped, words] : {std::pair{0, "undamped"}, std::pair{1, "damped"}}) {
    const std::vector<Left> left =
        by_a_style(GetParam(), fmt::format("hooke/history {} {} {} {} {} {}", contact.stiffness,
                                           2.0 / 7 * contact.stiffness, per_mass, damped * per_mass / 2,
                                           friction, damped));
    std::printf("  hooke/history, %s across, friction %g, restitution %g, %g steps: %.6f\n", words, friction,
                restitution, steps, most_energy(left));
    ChildProgram asked;
    asked.words = {"lmp", "-help"};
    asked.output = folder / "help";
    asked.error = folder / "error";
    run_child(asked);
    const bool of_debian_12 = contents_of(folder / "help").find("29 Sep 2021") != std::string::npos;
    if (of_debian_12) {
      EXPECT_LT(most_energy(left), 1 + gain);  // seen: 1.6e-4 with 20 steps, none with 100
    } else if (most_energy(left) > 1 + gain) {
      std::printf("  this version of LAMMPS gains energy at walls of the style hooke/history\n");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Impacts, SlowLammpsWalls,
                         testing::Values(Wall{0.5, 0.76, 20, 0}, Wall{0.5, 0.76, 100, 0},
                                         Wall{0.2, 0.5, 100, 0}, Wall{0.5, 1, 20, 2e-2},
                                         Wall{0.5, 1, 100, 8e-5}, Wall{1, 0.9, 100, 0}));

}  // namespace
