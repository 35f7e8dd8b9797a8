// SPDX-License-Identifier: MIT
// Steps per second of the engines on Bullet, and one run of the paper's damper over 30 s. CPU time is the
// number to read.
#include <benchmark/benchmark.h>

#include <cmath>

#include "bullet_engine.hpp"
#include "soft_engine.hpp"

using namespace shakedown;

namespace {

/// Returns the paper's damper at L = 40 mm, scaled to N grains at the same filling.
Setup damper(int grains, double duration) {
  Setup setup;
  const double times = grains / 37.0;
  setup.grains.count = grains;
  setup.box.mass *= times;
  setup.box.width[0] = setup.box.width[1] = 0.05 * std::sqrt(times);
  setup.run.duration = duration;
  return setup;
}

void run(benchmark::State& state, const Engine& engine, const Setup& setup) {
  double steps = 0;
  for (auto _ : state) {
    const Trajectory result = engine.run(setup);
    steps += static_cast<double>(result.events);
    state.counters["ledger_error"] = result.health.ledger_error;
  }
  state.counters["steps/s"] = benchmark::Counter(steps, benchmark::Counter::kIsRate);
  state.counters["s/step"] =
      benchmark::Counter(steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Runs the dense phase, in which the layer is carried by the wall: the dearest second of a run.
void soft_dense_phase(benchmark::State& state) {
  const auto grains = static_cast<int>(state.range(0));
  run(state, *make_soft_engine(), damper(grains, grains > 1000 ? 0.02 : 0.6));
}
void soft_asking_bullet_every_step(benchmark::State& state) {
  const auto grains = static_cast<int>(state.range(0));
  run(state, *make_soft_engine(PairSearch::every_step), damper(grains, grains > 1000 ? 0.004 : 0.2));
}
void bullet_dense_phase(benchmark::State& state) {
  const auto grains = static_cast<int>(state.range(0));
  run(state, *make_bullet_engine(), damper(grains, grains > 1000 ? 0.01 : 0.6));
}

void soft_whole_run(benchmark::State& state) { run(state, *make_soft_engine(), damper(37, 30)); }
void soft_whole_run_precise(benchmark::State& state) {
  Setup setup = damper(37, 30);
  setup.soft.contact_time = 1e-4;
  setup.soft.steps_per_contact = 50;
  run(state, *make_soft_engine(), setup);
}
void bullet_whole_run(benchmark::State& state) { run(state, *make_bullet_engine(), damper(37, 30)); }

BENCHMARK(soft_dense_phase)->Arg(37)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(soft_asking_bullet_every_step)->Arg(37)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(bullet_dense_phase)->Arg(37)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(soft_whole_run)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(soft_whole_run_precise)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(bullet_whole_run)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
