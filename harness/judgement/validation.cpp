// SPDX-License-Identifier: MIT
#include "validation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace shakedown {

double Validation::uncertainty() const { return std::hypot(numerical, input, data); }

double Validation::model_error() const {
  const double u = uncertainty();
  if (!std::isfinite(error) || !std::isfinite(u)) return std::nan("");
  return error <= u ? 0 : std::sqrt(error * error - u * u);
}

std::vector<Difference> differences_of(const std::vector<Validation>& rows) {
  std::vector<Difference> list;
  for (const Validation& row : rows)
    list.push_back({row.observable + " of run " + row.run, row.error, row.uncertainty()});
  return list;
}

std::string validation_text(const std::vector<Validation>& rows) {
  if (rows.empty()) return "";
  std::string text = fmt::format("  {:<16} {:<7} {:>8} {:>8} {:>8} {:>8} {:>8}  {}\n", "V&V 20, mm", "", "E",
                                 "u_num", "u_input", "u_D", "u_val", "error of the model");
  for (const Validation& row : rows) {
    const double left = row.model_error();
    const std::string said =
        !std::isfinite(left) ? "could not be computed"
        : left == 0          ? "within u_val"
        : row.error <= most_left * row.uncertainty()
            ? fmt::format("not told from none ({:.2g} u_val)", row.error / row.uncertainty())
            : fmt::format("about {:.3f}", left * 1e3);
    text += fmt::format("  {:<16} {:<7} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.3f}  {}\n", row.run,
                        row.observable, row.error * 1e3, row.numerical * 1e3, row.input * 1e3, row.data * 1e3,
                        row.uncertainty() * 1e3, said);
  }
  return text;
}

nlohmann::ordered_json validation_json(const std::vector<Validation>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Validation& row : rows)
    list.push_back({{"run", row.run},
                    {"observable", row.observable},
                    {"error_mm", row.error * 1e3},
                    {"u_num_mm", row.numerical * 1e3},
                    {"u_input_mm", row.input * 1e3},
                    {"u_data_mm", row.data * 1e3},
                    {"u_val_mm", row.uncertainty() * 1e3},
                    {"model_error_mm", row.model_error() * 1e3}});
  return list;
}

}  // namespace shakedown
