// SPDX-License-Identifier: MIT
#include "engine_differences.hpp"

#include <cmath>
#include <vector>

#include "embedded_table.hpp"

namespace shakedown {

extern const std::string_view engine_differences_csv;

namespace {

constexpr double mm = 1e-3;

std::vector<EngineDifference> read_table() {
  std::vector<EngineDifference> read;
  for (const std::vector<std::string>& row : embedded_rows(engine_differences_csv))
    read.push_back({row.at(0) == "none" ? "" : row.at(0), row.at(1), std::stod(row.at(2)) * mm,
                    std::stod(row.at(3)) * mm, std::stod(row.at(4)) * mm, std::stod(row.at(5)) * mm});
  return read;
}

const EngineDifference* row_of(std::string_view effect, double box_length) {
  for (const EngineDifference& row : engine_differences())
    if (row.effect == effect && std::abs(row.box_length - box_length) < 1e-6) return &row;
  return nullptr;
}

}  // namespace

std::span<const EngineDifference> engine_differences() {
  static const std::vector<EngineDifference> measured = read_table();
  return measured;
}

std::optional<AddedDifference> added_difference(std::string_view effect, double box_length) {
  const EngineDifference *plain = row_of("", box_length),
                         *with = effect.empty() ? nullptr : row_of(effect, box_length);
  if (plain == nullptr || with == nullptr) return std::nullopt;
  return AddedDifference{with->hard_slope - plain->hard_slope, with->hard_minus_soft - plain->hard_minus_soft,
                         std::hypot(with->half_width, plain->half_width)};
}

double strength_uncertainty(std::string_view effect) {
  double squares = 0, weights = 0;
  for (const EngineDifference& row : engine_differences()) {
    if (row.effect != effect) continue;
    const std::optional<AddedDifference> found = added_difference(effect, row.box_length);
    if (!found) continue;
    const double weight = std::pow(found->change / found->half_width, 2);
    weights += weight;
    if (std::abs(found->added) > found->half_width)
      squares += weight * std::pow(found->added / found->change, 2);
  }
  return weights > 0 ? std::sqrt(squares / weights) : 0;
}

}  // namespace shakedown
