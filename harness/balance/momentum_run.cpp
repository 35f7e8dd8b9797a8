// SPDX-License-Identifier: MIT
#include "momentum_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "camera.hpp"
#include "experiment.hpp"
#include "known_effects.hpp"
#include "least_squares.hpp"
#include "local_polynomial.hpp"
#include "physics.hpp"

namespace shakedown {

namespace {

constexpr double longest_filled_gap =
    0.03;  // s; the cubic through 30 ms misses k x_box'' by less than 1e-5 kg m
constexpr double smoothing_half_time =
    0.02;  // s; longer smears the landings, shorter leaves 10 mm/s of noise in v

/// Fills in values at the grid's places from the frames next to each; where these lie more than `longest`
/// frames apart the place is not usable.
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
    for (int j = 0; j < places.size(); ++j) {
      places[j] = known_place[next - 2 + static_cast<std::size_t>(j)];
      values[j] = known_value[next - 2 + static_cast<std::size_t>(j)];
    }
    out[i] = cubic_weights(places, at).dot(values);
  }
}

/// Tells whether a run has frames enough and, with grains, their centre.
bool tells_momentum(const Measurement::Run& run) {
  return run.recorded.time.size() >= MomentumRun::fewest_frames &&
         (run.setup.grains.count == 0 || run.recorded.has_com());
}

/// Returns the first frame of the motion: before the release something holds the box, and those frames are no
/// motion of the model's.
std::size_t first_of_the_motion(const Measurement::Run& run) {
  const double found = run.audit.release.start;
  const double start = starts_anywhere(run.recorded, run.setup) ? found : std::max(0.0, found);
  const std::vector<double>& time = run.recorded.time;
  return static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), start) - time.begin());
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

/// Returns the force on the box of joints that yield, N, along its smoothed path. Where it turns between two
/// frames comes from the velocities there.
Eigen::ArrayXd yielding_force(const MomentumRun& run, const std::vector<DahlFriction>& joints) {
  DahlState state(joints);
  Eigen::ArrayXd force = Eigen::ArrayXd::Zero(run.time.size());
  double at = run.x_smooth[0];
  const auto go = [&](double to) {
    state.turn(at, to > at ? 1 : -1);
    at = to;
  };
  for (Eigen::Index i = 1; i < force.size(); ++i) {
    const double before = run.v_smooth[i - 1], after = run.v_smooth[i];
    if (before * after < 0) go(run.x_smooth[i - 1] + before * run.interval * before / (before - after) / 2);
    go(run.x_smooth[i]);
    force[i] = state.newton(at);
  }
  return force;
}

/// Tells whether a force of no closed form turns with the motion faster than the velocity is known, as
/// friction does: its slope at rest is then far above the one over the velocity's noise.
bool turns_unseen(const std::vector<FreeForce>& forces, const MomentumRun& run) {
  constexpr Eigen::Index looks = 16;
  constexpr double small = 1e-5, steeper = 2;  // m/s, below any noise of v; a tanh of half the noise has 2.1
  for (Eigen::Index look = 0; look < std::min(looks, run.time.size()); ++look) {
    const Eigen::Index i = look * run.time.size() / looks;
    const auto slope = [&](double dv) {
      double jump = 0;
      for (const FreeForce& force : forces)
        jump += force.newton(run.x_box[i], dv, run.time[i]) - force.newton(run.x_box[i], -dv, run.time[i]);
      return std::abs(jump / (2 * dv));
    };
    if (run.v_noise > small && slope(small) > steeper * slope(run.v_noise)) return true;
  }
  return false;
}

void add_model_forces(const Physics& physics, int grains, MomentumRun& run) {
  const Eigen::Index n = run.time.size();
  run.model_force = run.model_force_dx = run.model_force_dv = Eigen::ArrayXd::Zero(n);
  const BoxForces& box = physics.box;
  const double on_grains = run.grain_mass * physics.grains.constant.sum().x();
  const auto smooth_force = [&](double x, double v, double t) {
    // The viscous drag is left out: its impulse needs no velocity.
    double force = box.newton(x, v, t, on_grains - run.stiffness * physics.spring_cubic * x * x * x) +
                   box.viscous.sum() * v;
    for (const auto& h : physics.grains.harmonics) force += run.grain_mass * h.at(t).x();
    for (const FreeForce& f : physics.grains.free)
      force += grains * f.newton(x, v, t);  // each grain near the box: no better known
    return force;
  };
  run.dry_friction = box.dry_friction.sum() > 0 || !box.dahl.empty() || turns_unseen(box.free, run);
  run.viscous = box.viscous.sum();
  const double dry = box.dry_friction.sum();
  const KnownSign direction = known_sign(run);
  const Eigen::ArrayXd blur = velocity_blur(run);
  constexpr double dx = 1e-5;  // m, below the noise of x, far above rounding
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = run.x_box[i], v = run.v_smooth[i], t = run.time[i], dv = blur[i];
    run.model_force[i] = smooth_force(x, v, t) - dry * direction.sign[i];
    run.model_force_dx[i] = (smooth_force(x + dx, v, t) - smooth_force(x - dx, v, t)) / (2 * dx);
    run.model_force_dv[i] =
        (smooth_force(x, v + dv, t) - smooth_force(x, v - dv, t)) / (2 * dv) - dry * direction.slope[i];
  }
  if (!box.dahl.empty()) run.model_force += yielding_force(run, box.dahl);
}

}  // namespace

Eigen::ArrayXd velocity_blur(const MomentumRun& run) {
  const Eigen::Index n = run.time.size();
  Eigen::ArrayXd blur(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double next = run.v_smooth[std::min(i + 1, n - 1)],
                 last = run.v_smooth[std::max<Eigen::Index>(i - 1, 0)];
    blur[i] = std::hypot(run.v_noise, (next - last) / (2 * std::sqrt(12.0))) + 1e-9;
  }
  return blur;
}

KnownSign known_sign(const MomentumRun& run) {
  const Eigen::ArrayXd blur = velocity_blur(run), u = run.v_smooth / (std::numbers::sqrt2 * blur);
  return {u.unaryExpr([](double at) { return std::erf(at); }),
          std::sqrt(2 / std::numbers::pi) / blur * (-u.square()).exp()};
}

int smoothing_half_width(double interval) {
  return std::max(3, static_cast<int>(std::lround(smoothing_half_time / interval)));
}

Eigen::Vector4d cubic_weights(const Eigen::Vector4d& places, double at) {
  Eigen::Vector4d weights = Eigen::Vector4d::Ones();
  for (int j = 0; j < places.size(); ++j)
    for (int l = 0; l < places.size(); ++l)
      if (l != j) weights[j] *= (at - places[l]) / (places[j] - places[l]);
  return weights;
}

LocalCubic local_cubic(int half) {
  const Eigen::MatrixXd fit = least_squares_weights(powers_of(even_places(half), 4));
  return {fit.row(0).transpose(), fit.row(1).transpose() / half};
}

namespace {

/// Returns the positions before the camera.
Recording before_the_camera(const Measurement::Run& measurement) {
  const MeasuredRun& measured = measurement.recorded;
  const RunAudit& audit = measurement.audit;
  const Setup& setup = measurement.setup;
  const bool empty = setup.grains.count == 0;
  return undone(physics_of(setup).camera, {measured.time, audit.x_box, empty ? audit.x_box : audit.x_com});
}

/// Fills in what the setup says besides forces.
void set_constants(const Setup& setup, const Physics& physics, MomentumRun& run) {
  run.box_mass = physics.box_mass;
  run.grain_mass = setup.grains.count * setup.grains.mass;
  run.stiffness = physics.stiffness;
  run.displacement = setup.release.displacement;
  run.effects.clear();
  for (const EffectChoice& choice : setup.effects) run.effects.emplace_back(choice.record->name);
  run.com_gain = 1 / (1 - physics.camera.centre_bias);
  // A scale of the whole picture is left out: it scales the balance too, which would take up whatever is
  // there.
  run.plateau_gain = (1 - physics.camera.centre_bias) * (1 + physics.camera.depth);
}

/// Fills in the frames, on an even clock, from the first of the motion; leaves them out where they are few.
void set_frames(const Measurement::Run& measurement, const Physics& physics, MomentumRun& run) {
  const MeasuredRun& measured = measurement.recorded;
  const std::size_t first = first_of_the_motion(measurement);
  if (measured.time.size() < first + MomentumRun::fewest_frames) return;
  const Recording motion = before_the_camera(measurement);
  std::vector<double> place;
  for (std::size_t i = first; i < measured.time.size(); ++i)
    place.push_back((measured.time[i] - measured.time[first]) / run.interval);
  const std::vector<double> x_box(motion.x_box.begin() + static_cast<std::ptrdiff_t>(first),
                                  motion.x_box.end()),
      x_com(motion.x_com.begin() + static_cast<std::ptrdiff_t>(first), motion.x_com.end());
  const Eigen::Index n = static_cast<Eigen::Index>(std::lround(place.back())) + 1;
  run.time = measured.time[first] - physics.camera.time_offset +
             run.interval * Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1));
  run.usable.assign(static_cast<std::size_t>(n), 1);
  run.box_filled.assign(static_cast<std::size_t>(n), 0);
  run.com_filled.assign(static_cast<std::size_t>(n), 0);
  run.x_box.resize(n);
  run.x_com.resize(n);
  const double longest = std::max(longest_filled_gap / run.interval, 2.5);
  fill(place, x_box, run.x_box, run.usable, run.box_filled, longest);
  fill(place, x_com, run.x_com, run.usable, run.com_filled, longest);
  smooth(run);
}

}  // namespace

MomentumRun momentum_run(const Measurement::Run& measurement) {
  const RunAudit& audit = measurement.audit;
  MomentumRun run;
  run.name = measurement.recorded.name;
  run.interval = audit.frame_interval;
  run.box_noise = audit.box;
  run.com_noise = audit.com;
  if (tells_momentum(measurement)) set_frames(measurement, physics_of(measurement.setup), run);
  return with_forces_of(measurement.setup, std::move(run));
}

MomentumRun with_forces_of(const Setup& setup, MomentumRun run) {
  const Physics physics = physics_of(setup);
  set_constants(setup, physics, run);
  if (run.time.size() > 0) add_model_forces(physics, setup.grains.count, run);
  return run;
}

}  // namespace shakedown
