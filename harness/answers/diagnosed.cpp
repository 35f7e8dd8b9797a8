// SPDX-License-Identifier: MIT
#include "diagnosed.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "diagnose_report.hpp"
#include "drawn_curves.hpp"
#include "effects.hpp"
#include "engine_differences.hpp"
#include "parameter_knobs.hpp"
#include "setup_file.hpp"

namespace shakedown {

void check_diagnosed_names(const std::vector<std::string>& effects, const std::vector<std::string>& fixed) {
  std::vector<Violation> found;
  for (const std::string& name : effects)
    if (find_effect(name) == nullptr)
      found.push_back({{"--effects", 0, 0}, name, "is not an effect", "`shakedown effects` lists them"});
  std::vector<std::string> fitted;
  for (const Knob& knob : free_parameters(Setup{})) fitted.push_back(knob.key);
  for (const std::string& name : fixed)
    if (std::find(fitted.begin(), fitted.end(), name) == fitted.end())
      found.push_back({{"--fixed", 0, 0},
                       name,
                       "is not fitted anyway",
                       "restitution.grain_grain, restitution.grain_wall and spring.frequency are"});
  if (!found.empty()) throw InputError(std::move(found));
}

DiagnoseOptions usual_diagnose_options() {
  DiagnoseOptions options;
  options.known = all_effects();
  options.strength_uncertainty = &strength_uncertainty;
  return options;
}

std::string amended_setup(const Diagnosis& diagnosis) {
  std::string text = "# Amended by `shakedown diagnose`: " + diagnosis.sentence + "\n";
  for (const DiagnosedParameter& p : diagnosis.parameters)
    text += p.word.empty() ? fmt::format("#   {} = {:.6g} {} (95 %: {:.6g} to {:.6g})\n", p.name, p.value,
                                         p.unit, p.low, p.high)
                           : fmt::format("#   {} = {}\n", p.name, p.word);
  return text + write_setup(diagnosis.amended);
}

Report report_of(const Diagnosis& diagnosis, const Measurement& measurement, const Setup& given,
                 const Engine& engine, int threads, const std::atomic<bool>* stop) {
  return report_of(diagnosis, measurement, given,
                   drawn_curves(measurement, &given, diagnosis.amended, engine, threads, stop));
}

}  // namespace shakedown
