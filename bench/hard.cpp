// SPDX-License-Identifier: MIT
// Impacts per CPU second of the event-driven engine: the paper's damper, larger ones, elastic fluids; memory
// per grain; the price of a wall root. Only impacts count: neither predictions that went stale nor renewals
// of lists.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "fluid.hpp"
#include "hard_engine.hpp"
#include "hard_sphere_system.hpp"
#include "random.hpp"
#include "wall_root.hpp"

using namespace shakedown;

namespace {

std::int64_t all_impacts(const std::array<std::int64_t, contact_classes>& collisions) {
  return collisions[0] + collisions[1] + collisions[2];
}

/// Adds the counters of a benchmark; rates are per CPU second.
void count(benchmark::State& state, std::int64_t impacts, std::int64_t events) {
  const double n = static_cast<double>(impacts);
  state.counters["impacts/s"] = benchmark::Counter(n, benchmark::Counter::kIsRate);
  state.counters["s/impact"] =
      benchmark::Counter(n, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["events/impact"] = static_cast<double>(events) / n;
}

/// Runs 30 s of the paper's damper with all its samples, as `shakedown run` does it.
void paper_damper(benchmark::State& state) {
  Setup setup;
  setup.box.length = static_cast<double>(state.range(0)) * 1e-3;
  setup.run.duration = 30;
  std::int64_t impacts = 0, events = 0;
  RunOptions options;
  for (auto _ : state) {
    const Trajectory trajectory = make_hard_engine()->run(setup, options);
    impacts += all_impacts(trajectory.collisions);
    events += trajectory.events;
    ++options.run;
  }
  count(state, impacts, events);
}

/// Runs the first milliseconds of the paper's damper scaled to N grains: the layer is hit by the wall, the
/// costliest part of a period.
void large_damper(benchmark::State& state) {
  Setup setup;
  setup.grains.count = static_cast<int>(state.range(0));
  const double ratio = setup.grains.count / 37.0;
  setup.box.mass *= ratio;
  setup.box.width[0] = setup.box.width[1] = 0.05 * std::sqrt(ratio);
  std::int64_t impacts = 0, events = 0;
  for (auto _ : state) {
    state.PauseTiming();
    HardSphereSystem system(setup);
    state.ResumeTiming();
    system.advance_to(static_cast<double>(state.range(1)) * 1e-3);
    impacts += all_impacts(system.collisions());
    events += system.events();
    state.counters["bytes/grain"] = system.bytes_per_grain();
  }
  count(state, impacts, events);
}

/// Returns a fluid that has molten. It is kept between the calls that the benchmark library makes to find its
/// number of iterations; one at a time.
HardSphereSystem& kept_fluid(int grains, int percent) {
  static std::unique_ptr<HardSphereSystem> kept;
  static std::pair<int, int> which;
  if (!kept || which != std::pair{grains, percent}) {
    kept.reset();
    kept = std::make_unique<HardSphereSystem>(shakedown::molten_fluid(grains, percent / 100.0));
    which = {grains, percent};
  }
  return *kept;
}

/// Runs elastic spheres in a periodic cube; an iteration is one impact a grain.
void periodic_fluid(benchmark::State& state) {
  const int grains = static_cast<int>(state.range(0));
  HardSphereSystem& system = kept_fluid(grains, static_cast<int>(state.range(1)));
  const std::int64_t impacts = all_impacts(system.collisions()), events = system.events();
  for (auto _ : state) system.advance_impacts(grains / 2);
  count(state, all_impacts(system.collisions()) - impacts, system.events() - events);
  state.counters["bytes/grain"] = system.bytes_per_grain();
}

std::vector<HarmonicGap> gaps_of_a_damper() {
  Random random(1, 0, Stream::other);
  std::vector<HarmonicGap> gaps;
  for (int n = 0; n < 4096; ++n) {
    const double w = 2 * std::numbers::pi * 1.23, amplitude = 0.1075 * random.uniform(),
                 phase = 2 * std::numbers::pi * random.uniform();
    const double a = amplitude * std::cos(phase);
    gaps.push_back({a, amplitude * std::sin(phase), w, 0.1 * random.uniform() - a, 0.8 * random.normal()});
  }
  return gaps;
}

void wall_root(benchmark::State& state) {
  const auto gaps = gaps_of_a_damper();
  std::size_t n = 0;
  for (auto _ : state) benchmark::DoNotOptimize(first_wall_root(gaps[n++ % gaps.size()]));
}

void wall_bound(benchmark::State& state) {
  const auto gaps = gaps_of_a_damper();
  std::size_t n = 0;
  for (auto _ : state) {
    const HarmonicGap& gap = gaps[n++ % gaps.size()];
    benchmark::DoNotOptimize(
        earliest_possible_root(gap.a + gap.c, gap.angular_frequency * gap.b - gap.u, 6.4));
  }
}

BENCHMARK(paper_damper)->ArgName("L_mm")->Arg(40)->Arg(311)->Unit(benchmark::kMillisecond);
BENCHMARK(large_damper)
    ->ArgNames({"N", "ms"})
    ->Args({100, 20})
    ->Args({1000, 20})
    ->Args({10'000, 20})
    ->Args({100'000, 20})
    ->Args({1'000'000, 20})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(periodic_fluid)
    ->ArgNames({"N", "percent"})
    ->ArgsProduct({{1372, 10'976, 97'556, 1'000'188}, {10, 30, 50}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(wall_root);
BENCHMARK(wall_bound);

}  // namespace
