// SPDX-License-Identifier: MIT
// Are the hard and the soft engine the same damper with each effect on? Ensembles of both at L = 40 and 104 mm, each effect at its typical
// strength; differences hard - soft with 95 % intervals against the margins of equivalence. Not a test: it takes minutes and informs.
//   effects_crosscheck [RUNS=8] [EFFECT ...]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "catalogue.hpp"
#include "effects.hpp"
#include "ensemble.hpp"
#include "hard_engine.hpp"
#include "setup_file.hpp"
#include "soft_engine.hpp"

using namespace shakedown;

namespace {

struct Quantity {
  const char* name;
  double scale;  ///< SI to what is printed
  double margin_short, margin_long;  ///< printed units, L = 40 and 104 mm
  double (*of)(const RunResult&);
};

const std::array<Quantity, 5> quantities{{
    {"slope mm/s", 1e3, 0.10, 0.8, [](const RunResult& run) { return run.observables.slope; }},
    {"frequency Hz", 1, 0.003, 0.003, [](const RunResult& run) { return run.observables.frequency; }},
    {"grain-grain", 1, 0.01, 0.01, [](const RunResult& run) { return run.observables.energy_loss[0]; }},
    {"end wall", 1, 0.01, 0.01, [](const RunResult& run) { return run.observables.energy_loss[1]; }},
    {"side wall", 1, 0.01, 0.01, [](const RunResult& run) { return run.observables.energy_loss[2]; }},
}};

/// Two-sided 95 % of Student's t, to 0.5 % (Cornish-Fisher).
double student(double degrees) {
  const double z = 1.959964;
  return z + (z * z * z + z) / (4 * degrees) + (5 * std::pow(z, 5) + 16 * std::pow(z, 3) + 3 * z) / (96 * degrees * degrees);
}

/// Difference of two means with the half width of its interval (Welch).
struct Difference {
  double mean, half_width;
};
Difference difference(const Statistic& a, const Statistic& b) {
  const double va = a.sd * a.sd / a.n, vb = b.sd * b.sd / b.n;
  const double degrees = (va + vb) * (va + vb) / (va * va / (a.n - 1) + vb * vb / (b.n - 1));
  return {a.mean - b.mean, va + vb > 0 ? student(degrees) * std::sqrt(va + vb) : 0.0};
}

const char* verdict(const Difference& d, double margin) {
  if (std::abs(d.mean) + d.half_width <= margin) return "equal";
  return std::abs(d.mean) > margin + d.half_width ? "DIFFER" : std::abs(d.mean) > d.half_width ? "differ?" : "open";
}

Setup setup_of(std::string_view effect, double length) {
  Setup setup = effect == "none" ? Setup{} : parse_setup(example_of(*find_effect(effect)), "example", all_effects());
  setup.box.length = length;
  setup.run.duration = length < 0.07 ? 8.5 : 5;
  return setup;
}

void compare(std::string_view effect, double length, int runs) {
  const Setup setup = setup_of(effect, length);
  EnsembleOptions options;
  options.runs = runs;
  const Ensemble hard = run_ensemble(*make_hard_engine(), setup, options), soft = run_ensemble(*make_soft_engine(), setup, options);
  std::printf("%-31s %3.0f", std::string(effect).c_str(), length * 1e3);
  for (const Quantity& quantity : quantities) {
    const Difference d = difference(hard.over_runs(quantity.of), soft.over_runs(quantity.of));
    const double margin = length < 0.07 ? quantity.margin_short : quantity.margin_long;
    std::printf(" | %8.4f +- %6.4f %-7s", quantity.scale * d.mean, quantity.scale * d.half_width,
                verdict({quantity.scale * d.mean, quantity.scale * d.half_width}, margin));
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  const int runs = count > 1 ? std::max(2, std::atoi(arguments[1])) : 8;
  std::vector<std::string> effects(arguments + std::min(count, 2), arguments + count);
  if (effects.empty()) {
    effects.push_back("none");
    for (const EffectRecord* record : all_effects())
      if (record->acts_on != ActsOn::camera) effects.emplace_back(record->name);
  }
  for (const std::string& effect : effects)
    if (effect != "none" && !find_effect(effect)) {
      std::fprintf(stderr, "%s: no such effect\n", effect.c_str());
      return 2;
    }
  std::printf("hard - soft, %d runs each, mean +- 95 %%; shares of E0 after 8.5 s (40 mm) and 5 s (104 mm)\n%-31s %3s", runs, "effect", "mm");
  for (const Quantity& quantity : quantities) std::printf(" | %-26s", quantity.name);
  std::printf("\n");
  for (const std::string& effect : effects)
    for (const double length : {0.040, 0.104}) compare(effect, length, runs);
}
