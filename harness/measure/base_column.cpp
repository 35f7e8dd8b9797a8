// SPDX-License-Identifier: MIT
#include "base_column.hpp"

#include <algorithm>

#include "quantity.hpp"
#include "toml_string.hpp"

namespace shakedown {

bool is_driven(const MeasuredRun& run) {
  return std::any_of(run.overrides.begin(), run.overrides.end(),
                     [](const Override& one) { return one.key == base_samples_key; });
}

void add_base_motion(const std::vector<std::pair<double, double>>& base, MeasuredRun& run) {
  std::string samples;
  for (const auto& [when, place] : base)
    samples += (samples.empty() ? "" : " ") + write_number(when) + " " + write_number(place);
  run.overrides.push_back({std::string(base_samples_key), toml_string(samples), "column.base_position"});
}

}  // namespace shakedown
