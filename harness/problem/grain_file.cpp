// SPDX-License-Identifier: MIT
#include "grain_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "kept_files.hpp"
#include "text.hpp"

namespace shakedown {

namespace {

/// Returns the numbers of one line, or nothing when one of them is not a finite number.
std::vector<double> numbers_of(const std::string& line) {
  std::vector<double> numbers;
  std::stringstream cells(line);
  for (std::string cell; std::getline(cells, cell, ',');) {
    char* end = nullptr;
    const double number = std::strtod(cell.c_str(), &end);
    while (*end == ' ' || *end == '\r' || *end == '\t') ++end;
    if (end == cell.c_str() || *end != '\0' || !std::isfinite(number)) return {};
    numbers.push_back(number);
  }
  return numbers;
}

/// Tells whether a line leaves the bounds of the setup's keys (m, m/s), beyond which an engine does not keep
/// its promises.
bool is_absurd(const std::vector<double>& cells) {
  constexpr double longest = 1e3, fastest = 1e6;
  const auto beyond = [&](std::size_t first, double bound) {
    return std::any_of(cells.begin() + static_cast<std::ptrdiff_t>(first),
                       cells.begin() + static_cast<std::ptrdiff_t>(first + 3),
                       [&](double number) { return std::abs(number) > bound; });
  };
  return beyond(1, longest) || beyond(4, fastest);
}

void check_room(const Setup& setup, const State& state, const std::string& file,
                std::vector<Violation>& found) {
  const Vec3 half(setup.box.length / 2, setup.box.width[0] / 2, setup.box.width[1] / 2);
  constexpr double rounding = 1e-12;  // files are written in decimal
  for (std::size_t i = 0; i < state.size() && found.size() < 20; ++i) {
    const int line = static_cast<int>(i) + 2;
    Vec3 centre = state.position[i];
    centre.x() -= state.x_box;
    const double out = (centre.cwiseAbs().array() + state.radius[i] - half.array()).maxCoeff();
    if (setup.domain != Domain::periodic && out > rounding)
      found.push_back({{file, line, 1},
                       "grain " + std::to_string(i + 1),
                       "sticks out of the box by " + millimetres(out),
                       "move it inside; positions are lab positions with the box at release.displacement"});
    if (state.size() > 20000) continue;  // the engine's own check covers large systems
    for (std::size_t j = 0; j < i && found.size() < 20; ++j) {
      const double gap = (state.position[i] - state.position[j]).norm() - state.radius[i] - state.radius[j];
      if (gap < -rounding)
        found.push_back({{file, line, 1},
                         "grains " + std::to_string(j + 1) + " and " + std::to_string(i + 1),
                         "overlap by " + millimetres(-gap) + " (more than an error of measured positions, " +
                             millimetres(most_measured_overlap) + ", or there is no room to push them apart)",
                         "move them apart, or correct grains.diameter"});
    }
  }
}

struct Contact {
  std::size_t a, b;
};

/// Returns the pairs that overlap or could come to it while others are pushed apart.
std::vector<Contact> near_pairs(const State& state, double reach) {
  std::vector<Contact> pairs;
  for (std::size_t i = 0; i < state.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((state.position[i] - state.position[j]).norm() < state.radius[i] + state.radius[j] + reach)
        pairs.push_back({j, i});
  return pairs;
}

/// Makes one relaxation sweep: every overlapping pair moves apart by equal shares, and into the box. Returns
/// whether anything moved.
bool push_once(const Setup& setup, const std::vector<Contact>& pairs, State& state) {
  constexpr double spare = 1e-9;  // m, so that sweeps end
  bool moved = false;
  for (const auto& [a, b] : pairs) {
    const Vec3 apart = state.position[b] - state.position[a];
    const double distance = apart.norm(), overlap = state.radius[a] + state.radius[b] - distance;
    if (overlap <= 0 || distance <= 0) continue;
    const Vec3 step = apart * ((overlap + spare) / (2 * distance));
    state.position[a] -= step;
    state.position[b] += step;
    moved = true;
  }
  if (setup.domain == Domain::periodic) return moved;
  const Vec3 half(setup.box.length / 2, setup.box.width[0] / 2, setup.box.width[1] / 2);
  const Vec3 middle(state.x_box, 0, 0);
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3 room = half.array() - state.radius[i];
    const Vec3 off = state.position[i] - middle;
    if (!(room.array() > 0).all() || (off.cwiseAbs().array() <= room.array()).all()) continue;
    state.position[i] = middle + off.cwiseMax(-room).cwiseMin(room);
    moved = true;
  }
  return moved;
}

/// Returns the deepest overlap with a neighbour or a wall, m.
double deepest_overlap(const Setup& setup, const State& state) {
  double deepest = 0;
  for (const auto& [a, b] : near_pairs(state, 0))
    deepest =
        std::max(deepest, state.radius[a] + state.radius[b] - (state.position[b] - state.position[a]).norm());
  if (setup.domain == Domain::periodic) return deepest;
  const Vec3 half(setup.box.length / 2, setup.box.width[0] / 2, setup.box.width[1] / 2);
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3 off = state.position[i] - Vec3(state.x_box, 0, 0);
    deepest = std::max(deepest, (off.cwiseAbs() - half).maxCoeff() + state.radius[i]);
  }
  return deepest;
}

/// Returns by how much the largest grain is wider than the diameter with which positions were measured, m.
double growth(const Setup& setup, const State& state) {
  const double largest = *std::max_element(state.radius.begin(), state.radius.end());
  return std::max(0.0, 2 * largest - setup.grains.diameter);
}

/// Moves overlapping grains apart: measured positions err, and grains that touch then overlap. They are moved
/// as far as that error goes; grains of unequal sizes, which were measured as equal ones, by as much more as
/// they are larger.
void push_apart(const Setup& setup, State& state) {
  constexpr double rounding = 1e-12;  // m
  constexpr int most_sweeps = 2000;
  constexpr std::size_t most_grains = 20000;  // the engine's own check covers larger systems
  if (state.size() > most_grains) return;
  const double overlap = deepest_overlap(setup, state);
  const double most = most_measured_overlap + growth(setup, state);
  if (overlap <= rounding || overlap > most) return;
  State pushed = state;
  const std::vector<Contact> pairs = near_pairs(state, 10 * most);
  for (int sweep = 0; sweep < most_sweeps; ++sweep)
    if (!push_once(setup, pairs, pushed)) break;
  if (deepest_overlap(setup, pushed) > rounding) return;  // there is no room: the overlaps are reported
  for (std::size_t i = 0; i < state.size(); ++i)
    state.pushed_apart = std::max(state.pushed_apart, (pushed.position[i] - state.position[i]).norm());
  state.position = std::move(pushed.position);
}

}  // namespace

void read_grains(const Setup& setup, State& state) {
  const std::string& file = setup.release.initial_grains;
  const double moved =
      setup.release.displacement - setup.release.grains_measured_at.value_or(setup.release.displacement);
  keep_unchanged(file);
  std::ifstream input(file);
  if (!input) cannot_be_read(file, "release.initial_grains");
  std::vector<Violation> found;
  std::string line;
  int number = 0;
  while (std::getline(input, line)) {
    ++number;
    if (number == 1 && line.find_first_of("xX") != std::string::npos) continue;  // header
    if (line.find_first_not_of(" \r\t") == std::string::npos) continue;
    const std::vector<double> cells = numbers_of(line);
    if (cells.size() != 7) {
      found.push_back(
          {{file, number, 1}, "", "is not seven finite numbers", "write id,x,y,z,vx,vy,vz in m and m/s"});
      if (found.size() >= 20) break;
      continue;
    }
    if (is_absurd(cells)) {
      found.push_back({{file, number, 1},
                       "",
                       "holds a place beyond 1 km or a speed beyond 1e6 m/s",
                       "check the units: id,x,y,z,vx,vy,vz in m and m/s"});
      if (found.size() >= 20) break;
      continue;
    }
    state.position.emplace_back(cells[1] + moved, cells[2], cells[3]);
    state.velocity.emplace_back(cells[4], cells[5], cells[6]);
  }
  if (found.empty() && state.position.size() != static_cast<std::size_t>(setup.grains.count))
    found.push_back({{file, 0, 0},
                     "grains.count",
                     std::to_string(state.position.size()) + " grains in the file, " +
                         std::to_string(setup.grains.count) + " in the setup",
                     "make them the same"});
  if (found.empty()) push_apart(setup, state);
  if (found.empty()) check_room(setup, state, file, found);
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace shakedown
