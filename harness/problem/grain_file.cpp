// SPDX-License-Identifier: MIT
#include "grain_file.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace shakedown {

namespace {

/// The numbers of one line, or nothing when one of them is not a finite number.
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

std::string in_mm(double metres) {
  std::ostringstream text;
  text.precision(3);
  text << metres * 1e3 << " mm";
  return text.str();
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
                       "sticks out of the box by " + in_mm(out),
                       "move it inside; positions are lab positions with the box at release.displacement"});
    if (state.size() > 20000) continue;  // the engine's own check covers large systems
    for (std::size_t j = 0; j < i && found.size() < 20; ++j) {
      const double gap = (state.position[i] - state.position[j]).norm() - state.radius[i] - state.radius[j];
      if (gap < -rounding)
        found.push_back({{file, line, 1},
                         "grains " + std::to_string(j + 1) + " and " + std::to_string(i + 1),
                         "overlap by " + in_mm(-gap),
                         "move them apart"});
    }
  }
}

}  // namespace

void read_grains(const Setup& setup, State& state) {
  const std::string& file = setup.release.initial_grains;
  std::ifstream input(file);
  if (!input)
    throw FileError(file + ": cannot be read (release.initial_grains); check the path and its permissions");
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
    state.position.emplace_back(cells[1], cells[2], cells[3]);
    state.velocity.emplace_back(cells[4], cells[5], cells[6]);
  }
  if (found.empty() && state.position.size() != static_cast<std::size_t>(setup.grains.count))
    found.push_back({{file, 0, 0},
                     "grains.count",
                     std::to_string(state.position.size()) + " grains in the file, " +
                         std::to_string(setup.grains.count) + " in the setup",
                     "make them the same"});
  if (found.empty()) check_room(setup, state, file, found);
  if (!found.empty()) throw InputError(std::move(found));
}

}  // namespace shakedown
