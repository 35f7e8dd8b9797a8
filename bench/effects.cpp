// SPDX-License-Identifier: MIT
// The price of each effect in the event-driven engine: 10 s of the paper's damper with the effect at its
// typical strength, in CPU time of the same run without it ("times_plain"). Both are measured in turn, so
// that a busy machine slows both. "times_plain_per_impact": the same for an impact, as effects change their
// number too.
#include <benchmark/benchmark.h>

#include <ctime>

#include "catalogue.hpp"
#include "effects.hpp"
#include "hard_engine.hpp"
#include "setup_file.hpp"

using namespace shakedown;

namespace {

struct Cost {
  double seconds = 0, impacts = 0;
};

void add_run(const Setup& setup, int run, Cost& cost) {
  RunOptions options;
  options.run = run;
  const std::clock_t start = std::clock();
  const Trajectory trajectory = make_hard_engine()->run(setup, options);
  cost.seconds += static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  for (const std::int64_t impacts : trajectory.collisions) cost.impacts += static_cast<double>(impacts);
}

void price(benchmark::State& state, const std::string& effects) {
  Setup with = parse_setup(effects, "example", all_effects());
  with.run.duration = 10;
  Setup plain = with;
  plain.effects.clear();
  Cost costs, base;
  int run = 0;
  constexpr int different = 8;  // the same few runs over and over, however long it is measured
  for (auto _ : state) {
    add_run(with, run % different, costs);
    state.PauseTiming();
    add_run(plain, run % different, base);
    ++run;
    state.ResumeTiming();
  }
  state.counters["times_plain"] = costs.seconds / base.seconds;
  state.counters["times_plain_per_impact"] = costs.seconds / costs.impacts / (base.seconds / base.impacts);
  state.counters["impacts"] = costs.impacts / run;
}

}  // namespace

int main(int count, char** arguments) {
  benchmark::RegisterBenchmark("plain", price, std::string())->Unit(benchmark::kMillisecond);
  for (const EffectRecord* effect : all_effects())
    if (effect->acts_on != ActsOn::camera)
      benchmark::RegisterBenchmark(std::string(effect->name).c_str(), price, example_of(*effect))
          ->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
