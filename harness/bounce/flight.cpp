// SPDX-License-Identifier: MIT
#include "flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "errors.hpp"

namespace shakedown {

namespace {

// Speeds of the tables: equal steps of the logarithm.
constexpr double slowest = 0.02, fastest = 30;
constexpr int points = 160;
const double log_step = std::log(fastest / slowest) / (points - 1);
constexpr std::array factors{0.8, 1.0, 1.2};

struct Air {
  double gravity, drag_by_coefficient, reynolds_by_speed;
  double drag(double speed, double factor) const {
    if (speed <= 0) return 0;
    return factor * drag_by_coefficient * sphere_drag_coefficient(reynolds_by_speed * speed);
  }
};

/// Time and height of the rising half of a flight, integrated in steps of the speed from the highest point
/// back: dt/dv and dh/dv are smooth.
struct Half {
  double time = 0, height = 0;
};

/// Returns dt/dv and dh/dv. `direction` +1: fall (drag against gravity), -1: rise.
Half slope(const Air& air, double speed, double factor, int direction) {
  const double rate = air.gravity - direction * air.drag(speed, factor) * speed * speed;
  return {1 / rate, speed / rate};
}

Half risen(const Air& air, double speed, double factor) {
  constexpr int steps = 60;
  Half sum;
  const double h = speed / steps;
  for (int i = 0; i < steps; ++i) {  // Simpson's rule
    const Half a = slope(air, i * h, factor, -1), b = slope(air, (i + 0.5) * h, factor, -1),
               c = slope(air, (i + 1) * h, factor, -1);
    sum.time += h / 6 * (a.time + 4 * b.time + c.time);
    sum.height += h / 6 * (a.height + 4 * b.height + c.height);
  }
  return sum;
}

/// Time and speed of a fall from rest through a height, by Runge-Kutta of fourth order in the root of the
/// depth, in which speed and time are smooth.
struct Fall {
  double time = 0, speed = 0;
};
Fall fallen(const Air& air, double height, double factor) {
  constexpr int steps = 60;
  // v^2 = y, depth z = s^2: dy/ds = 4 s (g - k y), dt/ds = 2 s/sqrt(y)
  const double h = std::sqrt(height) / steps;
  double y = 0, time = 0;
  const auto rate = [&](double s, double square) {
    const double speed = std::sqrt(std::max(square, 0.0));
    return 4 * s * (air.gravity - air.drag(speed, factor) * square);
  };
  const auto pace = [&](double s, double square) {
    return s > 0 ? 2 * s / std::sqrt(square) : 2 / std::sqrt(2 * air.gravity);
  };
  for (int i = 0; i < steps; ++i) {
    const double s = i * h, before = pace(s, y);
    const auto stepped = [&](double from, double at, double length) {
      const double k1 = rate(at, from), k2 = rate(at + length / 2, from + length / 2 * k1),
                   k3 = rate(at + length / 2, from + length / 2 * k2),
                   k4 = rate(at + length, from + length * k3);
      return from + length / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    };
    const double middle = stepped(y, s, h / 2), end = stepped(middle, s + h / 2, h / 2);
    time += h / 6 * (before + 4 * pace(s + h / 2, middle) + pace(s + h, end));
    y = end;
  }
  return {time, std::sqrt(y)};
}

}  // namespace

double sphere_drag_coefficient(double reynolds) {
  return 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687)) +
         0.42 / (1 + 42500 * std::pow(reynolds, -1.16));
}

/// Interpolates a table by four points of Lagrange in the logarithm of the speed; below the first speed the
/// correction falls with it.
double Flight::correction(const std::vector<double>& table, double speed) const {
  const double place = std::log(speed / slowest) / log_step;
  if (place <= 0) return 1 + (table.front() - 1) * speed / slowest;
  const int first = std::clamp(static_cast<int>(place) - 1, 0, points - 4);
  const double x = place - first;
  const double* y = table.data() + first;
  return -y[0] * (x - 1) * (x - 2) * (x - 3) / 6 + y[1] * x * (x - 2) * (x - 3) / 2 -
         y[2] * x * (x - 1) * (x - 3) / 2 + y[3] * x * (x - 1) * (x - 2) / 6;
}

double Flight::duration(double takeoff) const {
  if (!longer_.empty()) return 2 * takeoff / gravity_ * correction(longer_, takeoff);
  if (drag_ <= 0) return 2 * takeoff / gravity_;
  const double terminal = std::sqrt(gravity_ / drag_), x = takeoff / terminal;
  return terminal / gravity_ * (std::atan(x) + std::asinh(x));
}

double Flight::landing(double takeoff) const {
  if (!slower_.empty()) return takeoff * correction(slower_, takeoff);
  return takeoff / std::sqrt(1 + drag_ / gravity_ * takeoff * takeoff);
}

double Flight::height(double takeoff) const {
  const double vacuum = takeoff * takeoff / (2 * gravity_);
  if (!lower_.empty()) return vacuum * correction(lower_, takeoff);
  const double square = drag_ / gravity_ * takeoff * takeoff;
  return square > 0 ? vacuum * std::log1p(square) / square : vacuum;
}

double Flight::duration_slope(double takeoff) const {
  const double h = 1e-5 * takeoff;
  return (duration(takeoff + h) - duration(takeoff - h)) / (2 * h);
}

namespace {
/// Returns the speed at which a function that grows with it has this value, by secants from the vacuum's.
template <class Function>
double solved(Function of_speed, double value, double start) {
  double a = start, fa = of_speed(a) - value, b = start * 1.02;
  for (int i = 0; i < 60; ++i) {
    const double fb = of_speed(b) - value;
    if (std::abs(fb) <= 1e-14 * value || fb == fa) break;
    const double next = std::max(b - fb * (b - a) / (fb - fa), b / 4);
    a = b, fa = fb, b = next;
    if (std::abs(b - a) <= 1e-14 * b) break;
  }
  return b;
}
}  // namespace

double Flight::takeoff(double duration_wanted) const {
  const double vacuum = gravity_ * duration_wanted / 2;
  if (longer_.empty() && drag_ <= 0) return vacuum;
  return solved([this](double v) { return duration(v); }, duration_wanted, vacuum);
}

double Flight::fall(double from) const {
  const double vacuum = std::sqrt(2 * gravity_ * from);
  if (longer_.empty() && drag_ <= 0) return vacuum;
  return landing(solved([this](double v) { return height(v); }, from, vacuum));
}

BallFlights::BallFlights(const Ball& ball, double gravity) {
  const double volume = std::numbers::pi / 6 * std::pow(ball.diameter, 3),
               area = std::numbers::pi / 4 * ball.diameter * ball.diameter, displaced = air_density * volume;
  if (ball.mass <= displaced)
    throw InputError(
        {{{},
          "--mass, --diameter",
          "make a ball that is lighter than the air it displaces",
          "give mass and diameter with their units, e.g. --mass \"2.7 g\" --diameter \"40 mm\""}});
  const double inertia = ball.mass + displaced / 2;
  gravity_ = gravity * (ball.mass - displaced) / inertia;
  const Air air{gravity_, air_density * area / (2 * inertia), air_density * ball.diameter / air_viscosity};
  for (const double factor : factors) {
    Flight flight(gravity_);
    for (int i = 0; i < points; ++i) {
      const double speed = slowest * std::exp(i * log_step);
      const Half up = risen(air, speed, factor);
      const Fall down = fallen(air, up.height, factor);
      flight.longer_.push_back((up.time + down.time) * gravity_ / (2 * speed));
      flight.slower_.push_back(down.speed / speed);
      flight.lower_.push_back(up.height * 2 * gravity_ / (speed * speed));
    }
    tabulated_.push_back(flight);
  }
}

Flight BallFlights::at(double factor) const {
  const double x = (factor - factors[1]) / (factors[2] - factors[1]);
  const double a = x * (x - 1) / 2, b = 1 - x * x, c = x * (x + 1) / 2;
  const auto blended = [&](std::vector<double> Flight::*table) {
    std::vector<double> values(static_cast<std::size_t>(points));
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] =
          a * (tabulated_[0].*table)[i] + b * (tabulated_[1].*table)[i] + c * (tabulated_[2].*table)[i];
    return values;
  };
  Flight flight(gravity_);
  flight.longer_ = blended(&Flight::longer_);
  flight.slower_ = blended(&Flight::slower_);
  flight.lower_ = blended(&Flight::lower_);
  return flight;
}

}  // namespace shakedown
