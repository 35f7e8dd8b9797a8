// SPDX-License-Identifier: MIT
// One damper, run by a program that uses the installed library; prints frequency and slope.
#include <cstdio>
#include <shakedown/effects.hpp>
#include <shakedown/engines.hpp>
#include <shakedown/ensemble.hpp>
#include <shakedown/setup_file.hpp>

int main() {
  const shakedown::Setup setup =
      shakedown::parse_setup("[run]\nduration = \"6 s\"\n", "here", shakedown::all_effects());
  const auto engine = shakedown::engine_named("hard");
  const shakedown::Ensemble ensemble = shakedown::run_ensemble(*engine, setup, {});
  const shakedown::Observables& seen = ensemble.runs.front().observables;
  std::printf("%.4f Hz %.3f mm/s\n", seen.frequency, 1e3 * seen.slope);
}
