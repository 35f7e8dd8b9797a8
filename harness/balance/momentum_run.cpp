// SPDX-License-Identifier: MIT
#include "momentum_run.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "camera.hpp"
#include "known_effects.hpp"

namespace shakedown {

namespace {

constexpr double longest_filled_gap =
    0.03;  // s; the cubic through 30 ms misses k x_box'' by less than 1e-5 kg m
constexpr double smoothing_half_time =
    0.02;  // s; longer smears the landings, shorter leaves 10 mm/s of noise in v

/// Values at the grid's places from the frames next to each; false where they are too far apart.
void fill(const std::vector<double>& place, const std::vector<double>& value, Eigen::ArrayXd& out,
          std::vector<char>& usable, std::vector<char>& filled, double longest) {
  std::vector<double> known_place, known_value;
  for (std::size_t i = 0; i < value.size(); ++i)
    if (std::isfinite(value[i])) known_place.push_back(place[i]), known_value.push_back(value[i]);
  std::size_t next = 0;
  for (Eigen::Index i = 0; i < out.size(); ++i) {
    const double at = static_cast<double>(i);
    while (next < known_place.size() && known_place[next] < at - 0.25) ++next;
    const std::size_t flag = static_cast<std::size_t>(i);
    if (next < known_place.size() && known_place[next] < at + 0.25) {
      out[i] = known_value[next];
      continue;
    }
    filled[flag] = 1;
    out[i] = 0;
    if (next < 2 || next + 1 >= known_place.size() || known_place[next] - known_place[next - 1] > longest) {
      usable[flag] = 0;
      continue;
    }
    Eigen::Vector4d places, values;
    for (int j = 0; j < 4; ++j) {
      places[j] = known_place[next - 2 + static_cast<std::size_t>(j)];
      values[j] = known_value[next - 2 + static_cast<std::size_t>(j)];
    }
    out[i] = cubic_weights(places, at).dot(values);
  }
}

void smooth(MomentumRun& run) {
  const int half = smoothing_half_width(run.interval);
  const LocalCubic weights = local_cubic(half);
  const Eigen::Index n = run.x_box.size();
  run.v_noise = run.box_noise.standard_deviation * weights.slope.norm() / run.interval;
  run.x_smooth = run.v_smooth = Eigen::ArrayXd::Zero(n);
  // Beyond the ends the series is continued by its point reflection, which keeps value and slope.
  const auto at = [&](Eigen::Index i) {
    if (i < 0) return 2 * run.x_box[0] - run.x_box[std::min(-i, n - 1)];
    if (i >= n) return 2 * run.x_box[n - 1] - run.x_box[std::max<Eigen::Index>(2 * (n - 1) - i, 0)];
    return run.x_box[i];
  };
  for (Eigen::Index i = 0; i < n; ++i)
    for (int j = -half; j <= half; ++j) {
      run.x_smooth[i] += weights.value[j + half] * at(i + j);
      run.v_smooth[i] += weights.slope[j + half] * at(i + j) / run.interval;
    }
}

void add_model_forces(const Physics& physics, int grains, MomentumRun& run) {
  const Eigen::Index n = run.time.size();
  run.model_force = run.model_force_dx = run.model_force_dv = Eigen::ArrayXd::Zero(n);
  const BoxForces& box = physics.box;
  const double constant = box.constant + run.grain_mass * physics.grains.constant.x();
  const auto smooth_force = [&](double x, double v, double t) {
    double force = constant - box.viscous * v - run.stiffness * physics.spring_cubic * x * x * x;
    for (const Harmonic& h : box.harmonics)
      force += h.amplitude * std::sin(2 * std::numbers::pi * h.frequency * t + h.phase);
    for (const auto& h : physics.grains.harmonics)
      force += run.grain_mass * h.amplitude.x() * std::sin(2 * std::numbers::pi * h.frequency * t + h.phase);
    for (const FreeForce& f : box.free) force += f.newton(x, v, t);
    for (const FreeForce& f : physics.grains.free)
      force += grains * f.newton(x, v, t);  // each grain near the box: no better known
    return force;
  };
  run.dry_friction = box.dry_friction > 0;
  const Eigen::ArrayXd sign = known_sign(run).sign;
  constexpr double dx = 1e-5, dv = 1e-4;  // below the noise of x and v, far above rounding
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = run.x_box[i], v = run.v_smooth[i], t = run.time[i];
    run.model_force[i] = smooth_force(x, v, t) - box.dry_friction * sign[i];
    run.model_force_dx[i] = (smooth_force(x + dx, v, t) - smooth_force(x - dx, v, t)) / (2 * dx);
    run.model_force_dv[i] = (smooth_force(x, v + dv, t) - smooth_force(x, v - dv, t)) / (2 * dv);
  }
}

}  // namespace

KnownSign known_sign(const MomentumRun& run) {
  const Eigen::Index n = run.time.size();
  KnownSign known{Eigen::ArrayXd(n), Eigen::ArrayXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const double next = run.v_smooth[std::min(i + 1, n - 1)],
                 last = run.v_smooth[std::max<Eigen::Index>(i - 1, 0)];
    const double width = std::hypot(run.v_noise, (next - last) / (2 * std::sqrt(12.0))) + 1e-9;
    const double u = run.v_smooth[i] / (std::numbers::sqrt2 * width);
    known.sign[i] = std::erf(u);
    known.slope[i] = std::sqrt(2 / std::numbers::pi) / width * std::exp(-u * u);
  }
  return known;
}

int smoothing_half_width(double interval) {
  return std::max(3, static_cast<int>(std::lround(smoothing_half_time / interval)));
}

Eigen::Vector4d cubic_weights(const Eigen::Vector4d& places, double at) {
  Eigen::Vector4d weights = Eigen::Vector4d::Ones();
  for (int j = 0; j < 4; ++j)
    for (int l = 0; l < 4; ++l)
      if (l != j) weights[j] *= (at - places[l]) / (places[j] - places[l]);
  return weights;
}

LocalCubic local_cubic(int half) {
  const int n = 2 * half + 1;
  Eigen::MatrixXd powers(n, 4);
  for (int i = 0; i < n; ++i)
    for (int p = 0; p < 4; ++p) powers(i, p) = std::pow(static_cast<double>(i - half) / half, p);
  const Eigen::MatrixXd fit = powers.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(n, n));
  return {fit.row(0).transpose(), fit.row(1).transpose() / half};
}

MomentumRun momentum_run(const RunAudit& audit, const MeasuredRun& measured, const Setup& setup) {
  const Physics physics = physics_of(setup);
  MomentumRun run;
  run.name = measured.name;
  run.box_mass = physics.box_mass;
  run.grain_mass = setup.grains.count * setup.grains.mass;
  run.stiffness = physics.stiffness;
  run.displacement = setup.release.displacement;
  if (const EffectChoice* cubic = find_choice(setup, "spring_cubic"); cubic && cubic->number("reference") > 0)
    run.displacement = cubic->number("reference");
  for (const EffectChoice& choice : setup.effects) run.effects.emplace_back(choice.record->name);
  run.interval = audit.frame_interval;
  run.box_noise = audit.box;
  run.com_noise = audit.com;
  run.com_gain = 1 / (1 - physics.camera.centre_bias);
  const bool empty = setup.grains.count == 0;
  if (measured.time.size() < 8 || (!empty && !measured.has_com())) return run;

  const Recording truth =
      undone(physics.camera, {measured.time, audit.x_box, empty ? audit.x_box : audit.x_com});
  std::vector<double> place;
  for (const double time : measured.time) place.push_back((time - measured.time[0]) / run.interval);
  const Eigen::Index n = static_cast<Eigen::Index>(std::lround(place.back())) + 1;
  run.time = measured.time[0] - physics.camera.time_offset +
             run.interval * Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  run.usable.assign(static_cast<std::size_t>(n), 1);
  run.box_filled.assign(static_cast<std::size_t>(n), 0);
  run.com_filled.assign(static_cast<std::size_t>(n), 0);
  run.x_box.resize(n);
  run.x_com.resize(n);
  const double longest = std::max(longest_filled_gap / run.interval, 2.5);
  fill(place, truth.x_box, run.x_box, run.usable, run.box_filled, longest);
  fill(place, truth.x_com, run.x_com, run.usable, run.com_filled, longest);
  smooth(run);
  add_model_forces(physics, setup.grains.count, run);
  return run;
}

}  // namespace shakedown
