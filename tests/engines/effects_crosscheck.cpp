// SPDX-License-Identifier: MIT
// Are the hard and the soft engine the same damper with each effect on? Ensembles of both at L = 40 and 104
// mm, each effect at its typical strength or as given; differences hard - soft with 95 % intervals against
// the margins of equivalence. Not a test: it takes minutes and informs. Hard runs are cheap, so there are
// eight of them for each soft one, which nearly halves the variance that soft runs alone decide.
//   effects_crosscheck [RUNS=8] [EFFECT | KEY=VALUE,KEY=VALUE... ...]     e.g. 32 none grain_friction
//   grain_friction.grain_grain=0.3
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "catalogue.hpp"
#include "crosscheck.hpp"
#include "effects.hpp"
#include "hard_engine.hpp"
#include "setup_file.hpp"
#include "soft_engine.hpp"

using namespace shakedown;

namespace {

constexpr int hard_runs_for_a_soft_one = 8;

struct Quantity {
  const char* name;
  double per_si;  ///< SI to what is printed
  double margin;  ///< SI; 0: that of the slope for this box
  double (*of)(const RunResult&);
};

const std::array<Quantity, 5> quantities{{
    {"slope mm/s", 1e3, 0, [](const RunResult& run) { return run.observables.slope; }},
    {"frequency Hz", 1, Margins{}.frequency, [](const RunResult& run) { return run.observables.frequency; }},
    {"grain-grain", 1, Margins{}.share, [](const RunResult& run) { return run.observables.energy_loss[0]; }},
    {"end wall", 1, Margins{}.share, [](const RunResult& run) { return run.observables.energy_loss[1]; }},
    {"side wall", 1, Margins{}.share, [](const RunResult& run) { return run.observables.energy_loss[2]; }},
}};

const char* in_a_word(const Equivalence& found) {
  if (found.verdict == Agreement::equivalent) return "equal";
  return found.verdict == Agreement::differ ? "DIFFER" : "open";
}

/// "none", the name of an effect, or keys with their values, separated by commas.
Setup setup_of(const std::string& what, double length) {
  std::vector<Override> overrides;
  std::string text;
  if (find_effect(what) != nullptr)
    text = example_of(*find_effect(what));
  else if (what != "none")
    for (std::size_t at = 0; at < what.size();) {
      const std::size_t end = std::min(what.find(',', at), what.size());
      overrides.push_back(parse_override(what.substr(at, end - at), "argument"));
      at = end + 1;
    }
  Setup setup = parse_setup(text, "example", all_effects(), overrides);
  setup.box.length = length;
  setup.run.duration = length < 0.07 ? 8.5 : 5;
  return setup;
}

void compare(const std::string& what, double length, int runs) {
  const Setup setup = setup_of(what, length);
  EnsembleOptions options;
  options.runs = runs;
  const Ensemble soft = run_ensemble(*make_soft_engine(), setup, options);
  options.runs = hard_runs_for_a_soft_one * runs;
  const Ensemble hard = run_ensemble(*make_hard_engine(), setup, options);
  std::printf("%-31s %3.0f", what.c_str(), length * 1e3);
  for (const Quantity& quantity : quantities) {
    const Statistic of_hard = hard.over_runs(quantity.of), of_soft = soft.over_runs(quantity.of);
    const double margin = quantity.margin > 0 ? quantity.margin : slope_margin({}, length, of_hard.mean);
    const Equivalence found = equivalence_of(of_hard, of_soft, margin);
    std::printf(" | %8.4f %8.4f +- %6.4f %-6s", quantity.per_si * of_hard.mean,
                quantity.per_si * found.difference, quantity.per_si * (found.high - found.low) / 2,
                in_a_word(found));
  }
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  const int runs = count > 1 ? std::max(2, std::atoi(arguments[1])) : 8;
  std::vector<std::string> wanted(arguments + std::min(count, 2), arguments + count);
  if (wanted.empty()) {
    wanted.push_back("none");
    for (const EffectRecord* record : all_effects())
      if (record->acts_on != ActsOn::camera) wanted.emplace_back(record->name);
  }
  try {
    for (const std::string& what : wanted) setup_of(what, 0.04);
    std::printf(
        "hard, and hard - soft +- 95 %%; %d soft runs, %d hard ones; shares of E0 after 8.5 s (40 mm) and 5 "
        "s (104 mm)\n%-31s %3s",
        runs, hard_runs_for_a_soft_one * runs, "effect", "mm");
    for (const Quantity& quantity : quantities) std::printf(" | %-34s", quantity.name);
    std::printf("\n");
    for (const std::string& what : wanted)
      for (const double length : {0.040, 0.104}) compare(what, length, runs);
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
