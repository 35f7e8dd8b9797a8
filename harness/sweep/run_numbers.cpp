// SPDX-License-Identifier: MIT
#include "run_numbers.hpp"

#include <array>
#include <cmath>

namespace shakedown {

namespace {

template <std::size_t n>
double peak_mm(const SeenRun& run) {
  return n < run.observables.peaks.size() ? 1e3 * std::abs(run.observables.peaks[n].position) : absent;
}
template <std::size_t i>
double seconds_to(const SeenRun& run) {
  return run.observables.seconds_to_energy_fraction[i];
}
template <std::size_t c>
double loss(const SeenRun& run) {
  return run.observables.energy_loss[c];
}

double energy_left(const SeenRun& run) {
  return run.trajectory.total_energy.empty()
             ? absent
             : run.trajectory.total_energy.back() / run.trajectory.initial_energy;
}

constexpr std::array table{
    RunNumber{"slope_mm_per_s", [](const SeenRun& run) { return 1e3 * run.observables.slope; }},
    RunNumber{"frequency_hz", [](const SeenRun& run) { return run.observables.frequency; }},
    RunNumber{"first_small_peak_s", [](const SeenRun& run) { return run.observables.first_small_peak; }},
    RunNumber{"peak_1_mm", peak_mm<0>},
    RunNumber{"peak_2_mm", peak_mm<1>},
    RunNumber{"peak_3_mm", peak_mm<2>},
    RunNumber{"peak_4_mm", peak_mm<3>},
    RunNumber{"rms_line_mm", [](const SeenRun& run) { return 1e3 * run.observables.decay.linear.rms; }},
    RunNumber{"rms_exponential_mm",
              [](const SeenRun& run) { return 1e3 * run.observables.decay.exponential.rms; }},
    RunNumber{"curvature_mm_per_s2",
              [](const SeenRun& run) { return 1e3 * run.observables.decay.curvature; }},
    RunNumber{"seconds_to_lose_50_percent", seconds_to<0>},
    RunNumber{"seconds_to_lose_75_percent", seconds_to<1>},
    RunNumber{"seconds_to_lose_90_percent", seconds_to<2>},
    RunNumber{"seconds_to_lose_95_percent", seconds_to<3>},
    RunNumber{"seconds_to_lose_99_percent", seconds_to<4>},
    RunNumber{"loss_grain_grain", loss<0>},
    RunNumber{"loss_end_wall", loss<1>},
    RunNumber{"loss_side_wall", loss<2>},
    RunNumber{"energy_left", energy_left},
    RunNumber{"steady_amplitude_mm", [](const SeenRun& run) { return 1e3 * run.steady.amplitude; }},
    RunNumber{"steady_variation", [](const SeenRun& run) { return run.steady.variation; }},
    RunNumber{"steady_phase_lag_rad", [](const SeenRun& run) { return run.steady.phase_lag; }},
    RunNumber{"loss_factor", [](const SeenRun& run) { return run.steady.loss_factor; }},
    RunNumber{"effective_mass_g", [](const SeenRun& run) { return 1e3 * run.steady.effective_mass; }},
    RunNumber{"ledger_error", [](const SeenRun& run) { return run.trajectory.health.ledger_error; }},
    RunNumber{"deepest_overlap_m", [](const SeenRun& run) { return run.trajectory.health.deepest_overlap; }},
    RunNumber{"elastic_rescues",
              [](const SeenRun& run) { return static_cast<double>(run.trajectory.health.elastic_rescues); }},
    RunNumber{"events", [](const SeenRun& run) { return static_cast<double>(run.trajectory.events); }},
};

}  // namespace

std::span<const RunNumber> run_numbers() { return table; }

std::vector<double> numbers_of_run(const Setup& setup, const Trajectory& trajectory) {
  const Observables observables = observe(trajectory, setup);
  const SteadyState steady = observables.steady.value_or(SteadyState{absent, absent, absent, absent, absent});
  std::vector<double> numbers;
  for (const RunNumber& number : table) numbers.push_back(number.of({trajectory, observables, steady}));
  return numbers;
}

}  // namespace shakedown
