// SPDX-License-Identifier: MIT
#include "steady_forcing.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "physics.hpp"
#include "statistic.hpp"

namespace shakedown {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double samples_a_cycle = 200;  // an extremum between two samples is off by 1e-4 of the amplitude

/// Sampled values at a time between samples.
double value_at(const std::vector<double>& values, double place) {
  const auto i = std::min(static_cast<std::size_t>(place), values.size() - 2);
  const double part = place - static_cast<double>(i);
  return (1 - part) * values[i] + part * values[i + 1];
}

/// Integral of f(k) over samples from place `from` to `to` (fractional), trapezoids with cut ends; in units
/// of one sample.
template <class F>
auto integral(F f, double from, double to) {
  const auto first = static_cast<std::size_t>(std::ceil(from)),
             last = static_cast<std::size_t>(std::floor(to));
  auto sum = 0.5 * (static_cast<double>(first) - from) * (f(from) + f(static_cast<double>(first)));
  for (std::size_t k = first; k < last; ++k)
    sum += 0.5 * (f(static_cast<double>(k)) + f(static_cast<double>(k + 1)));
  return sum + 0.5 * (to - static_cast<double>(last)) * (f(static_cast<double>(last)) + f(to));
}

}  // namespace

std::optional<SteadyForcing> steady_forcing_of(const Setup& setup) {
  std::optional<SteadyForcing> found;
  for (const EffectChoice& choice : setup.effects) {
    const auto& harmonic = choice.record->search.harmonic;
    if (!harmonic || !harmonic->rate.empty()) continue;
    const double amplitude = choice.vector(harmonic->amplitude.substr(0, harmonic->amplitude.find('.'))).x();
    if (amplitude == 0) continue;
    if (found) return {};
    found = {amplitude, choice.number(harmonic->frequency), choice.number(harmonic->phase)};
  }
  return found;
}

Setup long_enough_for_forcing(const Setup& setup) {
  const std::optional<SteadyForcing> forcing = steady_forcing_of(setup);
  if (!forcing) return setup;
  Setup changed = setup;
  changed.run.duration = forcing_cycles / forcing->frequency;
  changed.run.sample_rate = std::max(setup.run.sample_rate, samples_a_cycle * forcing->frequency);
  return changed;
}

SteadyState steady_state(const Setup& setup, const Trajectory& trajectory) {
  const std::optional<SteadyForcing> forcing = steady_forcing_of(setup);
  EXPECT(forcing && trajectory.time.size() > 2);
  const Physics physics = physics_of(setup);
  const double rate = static_cast<double>(trajectory.time.size() - 1) / trajectory.time.back();
  const double omega = two_pi * forcing->frequency, cycle = rate / forcing->frequency;
  const double end = static_cast<double>(trajectory.time.size() - 1), begin = end - steady_cycles * cycle;
  EXPECT(begin >= 0);
  const double grains = setup.grains.count * setup.grains.mass;
  const auto angle = [&](double place) { return omega * place / rate + forcing->phase; };
  /// First moment of mass: its acceleration is what the forcing works on.
  const auto moment = [&](double place) {
    return physics.box_mass * value_at(trajectory.x_box, place) +
           (grains > 0 ? grains * value_at(trajectory.x_com, place) : 0.0);
  };

  std::vector<double> amplitudes;
  for (int c = 0; c < steady_cycles; ++c) {
    const auto from = trajectory.x_box.begin() + static_cast<std::ptrdiff_t>(begin + c * cycle);
    const auto to = trajectory.x_box.begin() + static_cast<std::ptrdiff_t>(begin + (c + 1) * cycle) + 1;
    const auto [lowest, highest] = std::minmax_element(from, to);
    amplitudes.push_back((*highest - *lowest) / 2);
  }
  const Statistic amplitude = statistic_of(amplitudes);
  SteadyState state{amplitude.mean, amplitude.sd / amplitude.mean, 0, 0};

  const std::complex<double> fundamental = integral(
      [&](double place) { return value_at(trajectory.x_box, place) * std::polar(1.0, -angle(place)); }, begin,
      end);
  // x = A sin(wt + phi - lag) has the Fourier component A/(2i) exp(-i lag).
  state.phase_lag = -std::arg(fundamental * std::complex<double>(0, 1));

  const auto boundary = [&](double place) { return std::sin(angle(place)) * moment(place); };
  const double work =
      forcing->acceleration *
      (boundary(end) - boundary(begin) -
       omega / rate *
           integral([&](double place) { return std::cos(angle(place)) * moment(place); }, begin, end));
  const double growth = value_at(trajectory.total_energy, end) - value_at(trajectory.total_energy, begin);
  state.loss_factor =
      (work - growth) / steady_cycles / (two_pi * physics.stiffness * state.amplitude * state.amplitude / 2);
  return state;
}

}  // namespace shakedown
