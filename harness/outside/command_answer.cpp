// SPDX-License-Identifier: MIT
#include "command_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "command_question.hpp"
#include "errors.hpp"
#include "number_table.hpp"
#include "text.hpp"
#include "work_folder.hpp"

namespace shakedown {

namespace {

constexpr double not_told = std::numeric_limits<double>::quiet_NaN();

enum Column : std::size_t { time, x_box, v_box, x_com, energy, lost_pairs, lost_ends, lost_sides, columns };
constexpr std::array<std::string_view, columns> names{"t_s",
                                                      "x_box_m",
                                                      "v_box_m_s",
                                                      "x_com_m",
                                                      "energy_J",
                                                      "lost_grain_grain_J",
                                                      "lost_end_wall_J",
                                                      "lost_side_wall_J"};
constexpr std::size_t nowhere = columns;

/// The first row must be as near as this to the state that was given, m.
constexpr double same_place = 1e-6;

class Answer {
 public:
  Answer(const std::filesystem::path& table, const std::string& who, const Setup& setup, const State& initial)
      : who_(who), setup_(setup), initial_(initial) {
    const std::string text = contents_of(table);
    if (trimmed(text).empty())
      fail("the table was not written", "write the columns " + due() + " to the file of the last argument");
    read_header(std::string_view(text).substr(0, text.find('\n')));
    try {
      rows_ = number_table(text, ',', count_, 2);
    } catch (const TableProblem& problem) {
      fail(problem.text, "write finite numbers, one for each column");
    }
    check_times();
    check_first();
  }

  std::size_t size() const { return rows_.size(); }
  bool tells(Column column) const { return place_[column] != nowhere; }
  double at(std::size_t row, Column column) const {
    return tells(column) ? rows_[row][place_[column]] : not_told;
  }

 private:
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy) const {
    throw PhysicsError(fmt::format("{}: MOTION.csv: {}. Remedy: {}.", who_, problem, remedy));
  }

  std::string due() const {
    return initial_.size() > 0 ? "t_s,x_box_m,v_box_m_s,x_com_m" : "t_s,x_box_m,v_box_m_s";
  }

  void read_header(std::string_view header) {
    place_.fill(nowhere);
    for (bool more = true; more; ++count_) {
      const std::size_t end = header.find(',');
      const std::string_view name = trimmed(header.substr(0, end));
      more = end != std::string_view::npos;
      if (more) header.remove_prefix(end + 1);
      const auto known = std::ranges::find(names, name);
      if (known == names.end())
        fail(fmt::format("line 1: there is no column '{}'", printable(name.substr(0, 40))),
             "the columns are " + joined({names.begin(), names.end()}));
      std::size_t& place = place_[static_cast<std::size_t>(known - names.begin())];
      if (place != nowhere) fail(fmt::format("line 1: column '{}' is there twice", name), "write it once");
      place = count_;
    }
    for (const Column column : {time, x_box, v_box, x_com})
      if (!tells(column) && (column != x_com || initial_.size() > 0))
        fail(fmt::format("line 1: column '{}' is missing", names[column]), "the first line is " + due());
  }

  void check_times() const {
    const std::size_t asked = command_rows(setup_);
    if (rows_.size() != asked)
      fail(fmt::format("{} rows where {} are asked for", rows_.size(), asked),
           "write `rows` of them, `sample_rate` a second, the first at 0");
    for (std::size_t k = 0; k < asked; ++k) {
      const double due_at = static_cast<double>(k) / setup_.run.sample_rate;
      if (std::abs(at(k, time) - due_at) * setup_.run.sample_rate > 1e-3)
        fail(fmt::format("row {}: the time is {:.9g} s where {:.9g} s is asked for", k + 1, at(k, time),
                         due_at),
             "row k, counted from 0, is at k / sample_rate");
    }
  }

  void check_first() const {
    const auto check = [&](Column column, double due_there) {
      if (tells(column) && std::abs(at(0, column) - due_there) > same_place)
        fail(fmt::format("row 1: {} is {:.9g} where the run begins at {:.9g}", names[column], at(0, column),
                         due_there),
             "the first row is the state that SETUP.json gives");
    };
    check(x_box, initial_.x_box);
    if (initial_.size() > 0) check(x_com, centre_of_mass_x(initial_));
  }

  std::string who_;
  const Setup& setup_;
  const State& initial_;
  std::array<std::size_t, columns> place_{};
  std::size_t count_ = 0;
  NumberTable rows_;
};

void put_health(const Answer& answer, Trajectory& trajectory) {
  Health& health = trajectory.health;
  health.momentum_error = health.deepest_overlap = health.ledger_error = not_told;
  trajectory.collisions.fill(-1);
  std::string missing;
  for (std::size_t column = energy; column < columns; ++column)
    if (!answer.tells(static_cast<Column>(column)))
      missing += (missing.empty() ? "" : ", ") + std::string(names[column]);
  if (!missing.empty()) health.notes.push_back("the command does not tell " + missing);
}

}  // namespace

Trajectory command_answer(const std::filesystem::path& table, const std::string& who, const Setup& setup,
                          const Physics& physics, const State& initial) {
  const Answer answer(table, who, setup, initial);
  Trajectory trajectory;
  for (std::size_t k = 0; k < answer.size(); ++k) {
    trajectory.time.push_back(static_cast<double>(k) / setup.run.sample_rate);
    trajectory.x_box.push_back(answer.at(k, x_box));
    trajectory.v_box.push_back(answer.at(k, v_box));
    trajectory.x_com.push_back(initial.size() > 0 ? answer.at(k, x_com) : not_told);
    trajectory.total_energy.push_back(answer.at(k, energy));
    for (std::size_t kind = 0; kind < contact_classes; ++kind)
      trajectory.loss[kind].push_back(answer.at(k, static_cast<Column>(lost_pairs + kind)));
  }
  for (std::size_t kind = 0; kind < contact_classes; ++kind)
    trajectory.ledger.contact_loss[kind] = trajectory.loss[kind].back();
  trajectory.ledger.effect_loss.assign(setup.effects.size(), not_told);
  const bool held = setup.domain != Domain::damper;
  const double x = initial.x_box;
  trajectory.initial_energy =
      kinetic_energy(initial, held ? 0 : physics.box_mass) +
      (held ? 0 : physics.stiffness * x * x * (0.5 + 0.25 * physics.spring_cubic * x * x));
  trajectory.end_state.x_box = trajectory.x_box.back();
  trajectory.end_state.v_box = trajectory.v_box.back();
  trajectory.end_time = trajectory.time.back();
  put_health(answer, trajectory);
  return trajectory;
}

}  // namespace shakedown
