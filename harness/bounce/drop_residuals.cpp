// SPDX-License-Identifier: MIT
#include "drop_residuals.hpp"

#include <cmath>
#include <limits>
#include <span>

namespace shakedown {

namespace {

// ln of the drag per mass, 1/m: a marble has 0.011, a tennis ball 0.016, a table tennis ball 0.11.
constexpr LawParameter free_drag{"ln_drag", -4.2, 1.0, -12, 0, -4.2};
// Clift and Gauvin's curve to 6 %, density of the air and size of the ball to some per cent.
constexpr LawParameter drag_factor{"drag_factor", 1, 0.08, 0.5, 1.5, 1};

struct Values {
  Flight flight;
  std::span<const double> law;
  double height_offset = 0;
};

Values values_of(const BounceModel& model, const Eigen::VectorXd& value) {
  const std::size_t own = law_of(model.law).parameters.size();
  return {model.flight(value), {value.data(), own}, model.heights ? value[value.size() - 1] : 0};
}

/// Returns the speed of impact after a flight of this duration (s), m/s.
double impact_speed(const Flight& flight, double duration) {
  return flight.landing(flight.takeoff(duration));
}

double next_duration(const BounceModel& model, const Values& values, double speed) {
  const double e = std::max(1e-3, restitution(model.law, values.law, speed, model.reference));
  return values.flight.duration(e * speed);
}

double foretold(const BounceModel& model, const Values& values, double duration) {
  return next_duration(model, values, impact_speed(values.flight, duration));
}

/// Returns the duration of the flight after a fall from this height (m), s.
double after_fall(const BounceModel& model, const Values& values, double height) {
  return next_duration(model, values, values.flight.fall(std::max(1e-4, height + values.height_offset)));
}

Eigen::VectorXd residuals(const std::vector<Flights>& all, const BounceModel& model, const Values& values,
                          std::size_t count) {
  Eigen::VectorXd residual(static_cast<Eigen::Index>(count));
  Eigen::Index row = 0;
  for (const Flights& flights : all) {
    if (std::isfinite(flights.height))
      residual[row++] = flights.interval[0] - after_fall(model, values, flights.height);
    for (std::size_t i = 1; i < flights.interval.size(); ++i)
      residual[row++] = flights.interval[i] - foretold(model, values, flights.interval[i - 1]);
  }
  return residual;
}

ImpactRow row_of_impact(const Values& values, double speed, double next) {
  ImpactRow row;
  row.speed = speed;
  const double takeoff = values.flight.takeoff(next);
  row.restitution = takeoff / speed;
  row.per_restitution = values.flight.duration_slope(takeoff) * speed;
  return row;
}

std::vector<ImpactRow> rows_of(const std::vector<Flights>& all, const BounceModel& model,
                               const Values& values) {
  std::vector<ImpactRow> rows;
  for (std::size_t f = 0; f < all.size(); ++f) {
    const Flights& flights = all[f];
    const auto add = [&](ImpactRow row, std::size_t i) {
      row.flights = f, row.drop = flights.drop, row.impact = flights.impact[i];
      rows.push_back(row);
    };
    if (std::isfinite(flights.height)) {
      ImpactRow row = row_of_impact(values, values.flight.fall(flights.height + values.height_offset),
                                    flights.interval[0]);
      row.instants = {0, -1, 1};
      const double h = 1e-3 * flights.height;
      const double slope =
          (after_fall(model, values, flights.height + h) - after_fall(model, values, flights.height - h)) /
          (2 * h);
      row.other_variance = std::pow(slope * model.release_error, 2);
      add(row, 0);
    }
    for (std::size_t i = 1; i < flights.interval.size(); ++i) {
      const double before = flights.interval[i - 1], h = 1e-4 * before;
      ImpactRow row = row_of_impact(values, impact_speed(values.flight, before), flights.interval[i]);
      const double slope =
          (foretold(model, values, before + h) - foretold(model, values, before - h)) / (2 * h);
      row.instants = {slope, -(1 + slope), 1};
      add(row, i);
    }
  }
  return rows;
}

}  // namespace

std::vector<LawParameter> BounceModel::parameters() const {
  std::vector<LawParameter> all = law_of(law).parameters;
  if (air == AirModel::free) all.push_back(free_drag);
  if (air == AirModel::ball) all.push_back(drag_factor);
  if (heights) all.push_back({"height_offset", 0, height_error, -1, 1, 0});
  return all;
}

Flight BounceModel::flight(const Eigen::VectorXd& value) const {
  if (air == AirModel::none) return Flight(gravity);
  const double of_air = value[value.size() - (heights ? 2 : 1)];
  return air == AirModel::free ? Flight(gravity, std::exp(of_air)) : ball->at(of_air);
}

Linearised linearised(const std::vector<Flights>& flights, const BounceModel& model,
                      const Eigen::VectorXd& value) {
  Linearised found;
  const Values here = values_of(model, value);
  found.value = value;
  found.rows = rows_of(flights, model, here);
  found.residual = residuals(flights, model, here, found.rows.size());
  found.slope.resize(found.residual.size(), value.size());
  const std::vector<LawParameter> parameters = model.parameters();
  for (Eigen::Index k = 0; k < value.size(); ++k) {
    const LawParameter& parameter = parameters[static_cast<std::size_t>(k)];
    const double step = parameter.name == "restitution" ? 1e-4 : 1e-3;
    Eigen::VectorXd low = value, high = value;
    low[k] = std::max(parameter.low, value[k] - step), high[k] = std::min(parameter.high, value[k] + step);
    found.slope.col(k) = (residuals(flights, model, values_of(model, high), found.rows.size()) -
                          residuals(flights, model, values_of(model, low), found.rows.size())) /
                         (high[k] - low[k]);
  }
  return found;
}

}  // namespace shakedown
