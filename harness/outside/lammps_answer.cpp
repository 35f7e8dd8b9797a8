// SPDX-License-Identifier: MIT
#include "lammps_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "errors.hpp"
#include "number_table.hpp"

namespace shakedown {

namespace {

constexpr std::size_t columns_before_accounts = 5;

[[noreturn]] void fail(const WorkFolder& folder, const char* file, const std::string& problem) {
  throw PhysicsError(
      fmt::format("engine 'lammps': {}: {}. Use a shorter soft.contact_time or more soft.steps_per_contact; "
                  "--keep DIR keeps the files.",
                  (folder / file).filename().string(), problem));
}

/// Returns the work of an account up to each sample, J. The velocity at a sample is half a kick ahead of the
/// last whole one, so that the ends of the sum count by half.
std::vector<double> work_of(const NumberTable& rows, std::size_t account, const LammpsSteps& steps) {
  const std::size_t mean = columns_before_accounts + 2 * account, now = mean + 1;
  const double interval = steps.step * static_cast<double>(steps.in_a_sample);
  std::vector<double> work;
  double whole = 0;
  for (const std::vector<double>& row : rows) {
    if (!work.empty()) whole += interval * row[mean];
    work.push_back(whole + steps.step / 2 * (rows.front()[now] - row[now]));
  }
  return work;
}

double spring_energy(const Physics& physics, double x) {
  return physics.stiffness * x * x * (0.5 + 0.25 * physics.spring_cubic * x * x);
}

void put_accounts(const NumberTable& rows, const LammpsScript& script, const LammpsSteps& steps,
                  Trajectory& trajectory) {
  for (std::vector<double>& loss : trajectory.loss) loss.assign(rows.size(), 0);
  std::vector<double> open = trajectory.total_energy;
  for (std::size_t i = 0; i < script.accounts.size(); ++i) {
    const LammpsAccount& account = script.accounts[i];
    const std::vector<double> work = work_of(rows, i, steps);
    for (std::size_t k = 0; k < work.size(); ++k) open[k] -= work[k];
    if (account.of == LammpsAccount::Of::effect) {
      trajectory.ledger.effect_loss[static_cast<std::size_t>(account.effect)] -= work.back();
      continue;
    }
    const auto kind = static_cast<std::size_t>(account.of);
    for (std::size_t k = 0; k < work.size(); ++k) trajectory.loss[kind][k] = -work[k];
    trajectory.ledger.contact_loss[kind] = -work.back();
  }
  const double most = std::ranges::max(trajectory.total_energy);
  for (const double balance : open)
    trajectory.health.ledger_error =
        std::max(trajectory.health.ledger_error, std::abs(balance - trajectory.initial_energy) / most);
  if (!(most > 0)) trajectory.health.ledger_error = 0;
}

/// Reads places and velocities of grains and box at the end.
State end_state(const WorkFolder& folder, const State& initial) {
  std::string text = contents_of(folder / lammps_end_file);
  const std::string_view heading = "ITEM: ATOMS";
  std::size_t from = text.find(heading);
  from = from == std::string::npos ? text.size() : text.find('\n', from) + 1;
  NumberTable rows;
  try {
    rows = number_table(std::string_view(text).substr(from), ' ', 10, 1);
  } catch (const TableProblem& problem) {
    fail(folder, lammps_end_file, problem.text);
  }
  if (rows.size() != initial.size() + 1)
    fail(folder, lammps_end_file,
         fmt::format("{} of {} bodies are left, the others are lost", rows.size(), initial.size() + 1));
  State state = initial;
  state.spin.assign(initial.size(), Vec3::Zero());
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const std::vector<double>& row = rows[i];
    state.position[i] = {row[1], row[2], row[3]};
    state.velocity[i] = {row[4], row[5], row[6]};
    state.spin[i] = {row[7], row[8], row[9]};
  }
  state.x_box = rows.back()[1];
  state.v_box = rows.back()[4];
  return state;
}

/// Throws PhysicsError for a grain whose centre has passed a wall, which touches it no more.
void expect_inside(const WorkFolder& folder, const Setup& setup, const State& state) {
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3& place = state.position[i];
    if (std::abs(place.x() - state.x_box) > setup.box.length / 2 ||
        std::abs(place.y()) > setup.box.width[0] / 2 || std::abs(place.z()) > setup.box.width[1] / 2)
      fail(folder, lammps_end_file, fmt::format("grain {} has gone through a wall", i + 1));
  }
}

/// Returns the first line that LAMMPS writes: "LAMMPS (29 Sep 2021 - Update 2)".
std::string version(const WorkFolder& folder) {
  const std::string text = contents_of(folder / "output.txt");
  const std::string line = text.substr(0, text.find('\n'));
  return line.starts_with("LAMMPS (") ? line : "LAMMPS (of no known version)";
}

void put_notes(const WorkFolder& folder, const Setup& setup, const LammpsSteps& steps,
               Trajectory& trajectory) {
  const double in_a_contact = setup.soft.contact_time / steps.step;
  trajectory.health.notes = {
      version(folder),
      fmt::format("LAMMPS is of first order at touch and separation: with {:.3g} steps in a contact the "
                  "restitution of an impact scatters by up to {:.2g}, its mean is right to {:.1g}",
                  in_a_contact, 0.45 / in_a_contact, 0.04 / in_a_contact),
      "LAMMPS tells no collisions, no overlaps and no energy of springs in contacts (it counts as lost until "
      "it "
      "is given back)"};
}

}  // namespace

double lammps_time_so_far(const WorkFolder& folder, const LammpsSteps& steps) {
  constexpr std::size_t a_few_rows = 4000;
  const std::string text = end_of(folder / lammps_motion_file, a_few_rows);
  const std::size_t last_end = text.rfind('\n');
  if (last_end == std::string::npos || last_end == 0) return 0;
  const std::size_t before = text.rfind('\n', last_end - 1);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  std::int64_t step = 0;
  std::from_chars(text.data() + begin, text.data() + last_end, step);
  return steps.step * static_cast<double>(step);
}

Trajectory lammps_answer(const WorkFolder& folder, const Setup& setup, const Physics& physics,
                         const State& initial, const LammpsScript& script) {
  const LammpsSteps steps = lammps_steps(setup);
  NumberTable rows;
  try {
    rows = number_table(contents_of(folder / lammps_motion_file), ',',
                        columns_before_accounts + 2 * script.accounts.size(), 2);
  } catch (const TableProblem& problem) {
    fail(folder, lammps_motion_file, problem.text);
  }
  if (rows.size() != static_cast<std::size_t>(steps.samples) + 1)
    fail(folder, lammps_motion_file,
         fmt::format("{} rows where {} were asked for", rows.size(), steps.samples + 1));
  Trajectory trajectory;
  trajectory.engine = "lammps";
  trajectory.collisions.fill(-1);
  trajectory.ledger.effect_loss.assign(setup.effects.size(), 0);
  const bool held = setup.domain != Domain::damper;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double x = rows[k][1], v = rows[k][2];
    trajectory.time.push_back(static_cast<double>(k) / setup.run.sample_rate);
    trajectory.x_box.push_back(x);
    trajectory.v_box.push_back(v);
    trajectory.x_com.push_back(initial.size() > 0 ? rows[k][3] : std::numeric_limits<double>::quiet_NaN());
    trajectory.total_energy.push_back(
        rows[k][4] + (held ? 0.0 : physics.box_mass * v * v / 2 + spring_energy(physics, x)));
  }
  trajectory.initial_energy = trajectory.total_energy.front();
  put_accounts(rows, script, steps, trajectory);
  trajectory.end_state = end_state(folder, initial);
  expect_inside(folder, setup, trajectory.end_state);
  trajectory.events = steps.samples * steps.in_a_sample;
  trajectory.end_time = trajectory.time.back();
  trajectory.health.momentum_error = std::numeric_limits<double>::quiet_NaN();
  trajectory.health.deepest_overlap = std::numeric_limits<double>::quiet_NaN();
  put_notes(folder, setup, steps, trajectory);
  return trajectory;
}

}  // namespace shakedown
