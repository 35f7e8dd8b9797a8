// SPDX-License-Identifier: MIT
#include "steady_forcing.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "physics.hpp"
#include "statistic.hpp"

namespace shakedown {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// Returns the value at a place between samples, counted in samples, on the straight line between them.
double value_at(const std::vector<double>& values, double place) {
  const auto i = std::min(static_cast<std::size_t>(place), values.size() - 2);
  const double part = place - static_cast<double>(i);
  return (1 - part) * values[i] + part * values[i + 1];
}

/// Returns the integral of f(k) over samples from place `from` to `to` (fractional), by trapezoids with cut
/// ends; in units of one sample.
template <class F>
auto integral(F f, double from, double to) {
  const auto first = static_cast<std::size_t>(std::ceil(from)),
             last = static_cast<std::size_t>(std::floor(to));
  auto sum = 0.5 * (static_cast<double>(first) - from) * (f(from) + f(static_cast<double>(first)));
  for (std::size_t k = first; k < last; ++k)
    sum += 0.5 * (f(static_cast<double>(k)) + f(static_cast<double>(k + 1)));
  return sum + 0.5 * (to - static_cast<double>(last)) * (f(static_cast<double>(last)) + f(to));
}

bool moves_base(const EffectChoice& choice) { return choice.record->name == "base_motion"; }

std::optional<SteadyForcing> forcing_of(const EffectChoice& choice) {
  const auto& harmonic = choice.record->search.harmonic;
  if (!harmonic || !harmonic->rate.empty()) return {};
  const double amplitude = choice.vector(harmonic->amplitude.substr(0, harmonic->amplitude.find('.'))).x();
  if (amplitude == 0) return {};
  return SteadyForcing{amplitude, choice.number(harmonic->frequency), choice.number(harmonic->phase)};
}

/// Returns the forcing by the far end of the spring where it moves at all, as its force on a box at rest in
/// the middle tells.
std::optional<SteadyForcing> forcing_by_base(const Setup& setup, const EffectChoice& choice) {
  Setup alone = setup;
  alone.effects = {choice};
  const Physics physics = physics_of(alone);
  constexpr int samples = 4000;
  const double step = setup.run.duration / samples;
  const auto base = [&](double t) { return physics.box.newton(0, 0, t) / physics.stiffness; };
  double low = base(0), high = low;
  for (int i = 0; i <= samples; ++i)
    low = std::min(low, base(i * step)), high = std::max(high, base(i * step));
  const double middle = (low + high) / 2, amplitude = (high - low) / 2;
  // Upward passages, along the chord of their step.
  std::vector<double> passed;
  for (int i = 0; i < samples; ++i) {
    const double before = base(i * step) - middle, after = base((i + 1) * step) - middle;
    if (before < 0 && after >= 0) passed.push_back(step * (i - before / (after - before)));
  }
  if (std::ssize(passed) < 3) return {};
  const double period = (passed.back() - passed.front()) / static_cast<double>(passed.size() - 1),
               omega = full_turn / period;
  const SteadyForcing found{0, 1 / period, -omega * passed.back(), amplitude};
  // A base that halts or swings otherwise has no steady state.
  double off = 0;
  for (int i = 0; i <= samples; ++i) {
    const double t = setup.run.duration - (1 - static_cast<double>(i) / samples) * steady_cycles * period;
    if (t < 0) continue;
    off = std::max(off, std::abs(base(t) - middle - amplitude * std::sin(omega * t + found.phase)));
  }
  constexpr double much = 0.05;
  return off < much * amplitude ? std::optional(found) : std::nullopt;
}

}  // namespace

bool is_shaken(const Setup& setup) {
  return std::any_of(setup.effects.begin(), setup.effects.end(), [](const EffectChoice& choice) {
    return moves_base(choice) || forcing_of(choice).has_value();
  });
}

std::optional<SteadyForcing> steady_forcing_of(const Setup& setup) {
  std::optional<SteadyForcing> found;
  for (const EffectChoice& choice : setup.effects) {
    const std::optional<SteadyForcing> one =
        moves_base(choice) ? forcing_by_base(setup, choice) : forcing_of(choice);
    if (!one && !moves_base(choice)) continue;
    if (found || !one) return {};
    found = one;
  }
  return found;
}

Setup long_enough_for_forcing(const Setup& setup) {
  const std::optional<SteadyForcing> forcing = steady_forcing_of(setup);
  // A recorded base moves as long as it was recorded.
  if (!forcing || forcing->base != 0) return setup;
  Setup changed = setup;
  changed.run.duration = forcing_cycles / forcing->frequency;
  changed.run.sample_rate = std::max(setup.run.sample_rate, samples_a_cycle * forcing->frequency);
  return changed;
}

namespace {

/// Returns mean and spread of half the way from the lowest to the highest place of each of the last cycles,
/// which have `cycle` samples from sample `begin` on.
Statistic amplitude_of_cycles(const std::vector<double>& x, double begin, double cycle) {
  std::vector<double> amplitudes;
  for (int c = 0; c < steady_cycles; ++c) {
    const auto from = x.begin() + static_cast<std::ptrdiff_t>(begin + c * cycle);
    const auto to = x.begin() + static_cast<std::ptrdiff_t>(begin + (c + 1) * cycle) + 1;
    const auto [lowest, highest] = std::minmax_element(from, to);
    amplitudes.push_back((*highest - *lowest) / 2);
  }
  return statistic_of(amplitudes);
}

}  // namespace

SteadyState steady_state(const Setup& setup, const Trajectory& trajectory) {
  const std::optional<SteadyForcing> forcing = steady_forcing_of(setup);
  EXPECT(forcing && trajectory.time.size() > 2);
  const Physics physics = physics_of(setup);
  const double rate = static_cast<double>(trajectory.time.size() - 1) / trajectory.time.back();
  const double omega = full_turn * forcing->frequency, cycle = rate / forcing->frequency;
  const double end = static_cast<double>(trajectory.time.size() - 1), begin = end - steady_cycles * cycle;
  EXPECT(begin >= 0);
  const double grains = setup.grains.count * setup.grains.mass;
  const auto angle = [&](double place) { return omega * place / rate + forcing->phase; };
  /// First moment of mass: its acceleration is what the forcing works on.
  const auto moment = [&](double place) {
    return physics.box_mass * value_at(trajectory.x_box, place) +
           (grains > 0 ? grains * value_at(trajectory.x_com, place) : 0.0);
  };

  const Statistic amplitude = amplitude_of_cycles(trajectory.x_box, begin, cycle);
  SteadyState state{amplitude.mean, amplitude.sd / amplitude.mean};

  using Complex = std::complex<double>;
  // Grains that drift would leave a slope in it.
  const auto fundamental = [&](const std::vector<double>& values) {
    const double from = value_at(values, begin), slope = (value_at(values, end) - from) / (end - begin);
    return integral(
               [&](double place) {
                 return (value_at(values, place) - from - slope * (place - begin)) *
                        std::polar(1.0, -angle(place));
               },
               begin, end) /
           (0.5 * (end - begin));
  };
  // x = A sin(wt + phi - lag) has the Fourier component A exp(-i lag)/i.
  const Complex box = fundamental(trajectory.x_box) * Complex(0, 1);
  state.phase_lag = -std::arg(box);
  // What the forcing gives to a mass by itself is not a force of box or grains upon each other.
  const auto acceleration = [&](const Complex& place) {
    return -omega * omega * place - forcing->acceleration;
  };
  state.effective_mass = std::numeric_limits<double>::quiet_NaN();
  if (grains > 0)
    state.effective_mass =
        (grains * acceleration(fundamental(trajectory.x_com) * Complex(0, 1)) / acceleration(box)).real();

  // What the forcing works on: masses, or the spring whose far end moves.
  const double driving = forcing->base != 0 ? physics.stiffness * forcing->base : forcing->acceleration;
  const auto worked_on = [&](double place) {
    return forcing->base != 0 ? value_at(trajectory.x_box, place) : moment(place);
  };
  const auto boundary = [&](double place) { return std::sin(angle(place)) * worked_on(place); };
  const double work =
      driving *
      (boundary(end) - boundary(begin) -
       omega / rate *
           integral([&](double place) { return std::cos(angle(place)) * worked_on(place); }, begin, end));
  const std::vector<double>& energy = trajectory.total_energy;
  const double growth = energy.empty() ? 0 : value_at(energy, end) - value_at(energy, begin);
  state.loss_factor = (work - growth) / steady_cycles /
                      (full_turn * physics.stiffness * state.amplitude * state.amplitude / 2);
  return state;
}

std::optional<SteadyState> steady_state_if_any(const Setup& setup, const Trajectory& trajectory) {
  const std::optional<SteadyForcing> forcing = steady_forcing_of(setup);
  if (!forcing || trajectory.time.size() < 3 || trajectory.interrupted) return {};
  const double cycles = trajectory.time.back() * forcing->frequency,
               samples = static_cast<double>(trajectory.time.size() - 1) / cycles;
  if (cycles < steady_cycles || samples < fewest_samples_a_cycle) return {};
  return steady_state(setup, trajectory);
}

}  // namespace shakedown
