// SPDX-License-Identifier: MIT
#include "driven_box.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace shakedown {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// s: pieces of a polynomial get no shorter at a corner or a jump of a force.
constexpr double shortest_piece = 1e-8;

double sign_of(double value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

[[noreturn]] void refuse_force(double x, double v, double t) {
  throw PhysicsError("the force on the box is not finite at x = " + std::to_string(x) +
                     " m, v = " + std::to_string(v) + " m/s, t = " + std::to_string(t) +
                     " s; check the formulas of user_force");
}

}  // namespace

bool is_driven(const Physics& physics) {
  return physics.contact.has_friction() || physics.contact.has_attraction() || physics.spring_cubic != 0 ||
         !physics.box.none() || !physics.grains.none();
}

DrivenBox::DrivenBox(const Physics& physics, double x, double v, double time)
    : mass_(physics.box_mass),
      stiffness_(physics.stiffness),
      angular_frequency_(std::sqrt(physics.stiffness / physics.box_mass)),
      cubic_(physics.spring_cubic),
      forces_(physics.box),
      dahl_(physics.box.dahl),
      accounted_(time) {
  const double damping = forces_.viscous.sum() / (2 * mass_), w2 = angular_frequency_ * angular_frequency_;
  decay_ = damping;
  damped_frequency_ = std::sqrt(w2 - damping * damping);
  needs_dense_ = cubic_ != 0 || !forces_.free.empty() || dahl_.any() || damping >= 0.99 * angular_frequency_;
  for (const Harmonic& harmonic : forces_.harmonics) {
    const double drive = 2 * std::numbers::pi * harmonic.frequency, detuning = w2 - drive * drive;
    const double width = 2 * damping * drive, size = detuning * detuning + width * width;
    // Near an undamped resonance the closed form is a difference of large numbers.
    if (size < 1e-4 * w2 * w2) needs_dense_ = true;
    const double force = harmonic.amplitude / mass_;
    if (size > 0)
      responses_.push_back({force * detuning / size, -force * width / size, drive, harmonic.phase});
  }
  const auto grow = [this](int effect) {
    if (effect >= static_cast<int>(work_.size())) work_.resize(static_cast<std::size_t>(effect) + 1, 0.0);
  };
  for (const auto* slot : {&forces_.viscous, &forces_.dry_friction, &forces_.constant})
    for (const auto& share : slot->shares()) grow(share.effect);
  for (const Harmonic& harmonic : forces_.harmonics) grow(harmonic.effect);
  for (const FreeForce& force : forces_.free) grow(force.effect);
  for (const DahlFriction& joint : forces_.dahl) grow(joint.effect);
  restart(time, x, v);
}

void DrivenBox::restart(double t, double x, double v) {
  dahl_.turn(x, 0);
  time_ = t;
  x_ = x;
  v_ = v;
  const double of_swing = x * angular_frequency_;
  top_speed_ = std::sqrt(of_swing * of_swing + v * v);
  begin();
}

void DrivenBox::go_on() {
  const Point point = at(valid_until_);
  account(valid_until_);
  // A standstill closer than the resolution of time counts as now: else pieces would begin without end.
  const double least = std::max(1e-12 * (top_speed() + 1e-6), 5e-16 * valid_until_ * top_acceleration_);
  const bool turning = rubs() && std::abs(point.v) <= least;
  restart(valid_until_, point.x, turning ? 0.0 : point.v);
}

/// Returns the sum of all forces on the box but dry friction (-F sgn v) and grains, N.
double DrivenBox::smooth_force(double x, double v, double t) const {
  const double force = forces_.newton(x, v, t, -stiffness_ * x * (1 + cubic_ * x * x)) + dahl_.newton(x);
  if (!std::isfinite(force)) refuse_force(x, v, t);
  return force;
}

void DrivenBox::begin() {
  here_ = {};
  booked_ = {};
  double friction = 0;
  if (rubs()) {
    const double most = forces_.dry_friction.sum(), pull = smooth_force(x_, v_, time_);
    if (v_ == 0 && std::abs(pull) <= most * (1 + 1e-13)) return begin_stuck();
    direction_ = sign_of(v_ != 0 ? v_ : pull);
    friction = -most * direction_;
    dahl_.turn(x_, direction_);
  }
  if (needs_dense_)
    begin_dense(friction);
  else
    begin_closed(friction);
}

void DrivenBox::begin_closed(double friction_force) {
  piece_ = Piece::closed;
  friction_ = friction_force;
  const double w = angular_frequency_;
  centre_ = (forces_.constant.sum() + friction_force) / stiffness_;
  double x = x_ - centre_, v = v_, response_reach = 0, response_speed = 0, response_acceleration = 0,
         response_jerk = 0;
  for (const Response& r : responses_) {
    const double phase = r.frequency * time_ + r.phase, s = std::sin(phase), c = std::cos(phase);
    x -= r.p * s + r.q * c;
    v -= r.frequency * (r.p * c - r.q * s);
    const double reach = std::hypot(r.p, r.q), size = reach * r.frequency * r.frequency;
    response_reach += reach;
    response_speed += reach * r.frequency;
    response_acceleration += size;
    response_jerk += size * r.frequency;
  }
  a_ = x;
  b_ = (v + decay_ * x) / damped_frequency_;
  // Each derivative of exp((-g + i w_d) s) multiplies by a number of modulus w.
  const double amplitude = std::sqrt(a_ * a_ + b_ * b_);
  top_acceleration_ = w * w * amplitude + response_acceleration;
  top_reach_ = {std::abs(centre_) + amplitude + response_reach, w * amplitude + response_speed};
  valid_until_ =
      forces_.dry_friction.sum() > 0 ? first_standstill(w * w * w * amplitude + response_jerk) : infinity;
}

void DrivenBox::begin_stuck() {
  piece_ = Piece::stuck;
  friction_ = -smooth_force(x_, 0, time_);
  top_acceleration_ = 0;
  top_reach_ = {std::abs(x_), 0};
  valid_until_ = infinity;
  if (forces_.harmonics.empty() && forces_.free.empty()) return;
  // The pull changes with time: look again where it may first exceed friction, where formulas act every 10
  // us, and at least once a second.
  double rate = 0;
  for (const Harmonic& h : forces_.harmonics)
    rate += std::abs(h.amplitude) * 2 * std::numbers::pi * h.frequency;
  const double margin = forces_.dry_friction.sum() - std::abs(friction_);
  const double safe = forces_.free.empty() && rate > 0 ? margin / rate : 0;
  valid_until_ = time_ + std::clamp(safe, 1e-5, 1.0);
}

/// Returns the first time after the start at which the box stands still, s, found from below with a bound on
/// its jerk, m/s^3.
double DrivenBox::first_standstill(double jerk_bound) const {
  if (jerk_bound <= 0) return infinity;
  double t = time_;
  const double end = piece_ == Piece::dense ? time_ + length_ : infinity;
  for (int iteration = 0; iteration < 1000; ++iteration) {
    const double speed = std::max(0.0, direction_ * at(t).v), rate = direction_ * acceleration_at(t);
    const double root = std::sqrt(rate * rate + 2 * jerk_bound * speed);
    const double step = rate >= 0 ? (rate + root) / jerk_bound : 2 * speed / (root - rate);
    t += step;
    if (t >= end) return end;
    if (step <= 1e-15 * std::max(t, 1e-3) && iteration > 0) break;
  }
  return t;
}

double DrivenBox::acceleration_at(double t) const {
  if (piece_ == Piece::stuck) return 0;
  const Point point = at(t);
  return (smooth_force(point.x, point.v, t) + friction_) / mass_;
}

void DrivenBox::begin_dense(double friction_force) {
  piece_ = Piece::dense;
  friction_ = friction_force;
  double length = std::min(planned_length_ * 1.5, 8e-3);
  while (!try_dense(length, friction_force)) {
    length /= 2;
    if (length < 1e-9)
      throw PhysicsError("the forces on the box change too fast near t = " + std::to_string(time_) +
                         " s, x = " + std::to_string(x_) + " m; make the formula of user_force smoother");
  }
  // Past a jump they grow again by half each; ten thousand short ones are a millisecond of motion at most,
  // and a tenth of a second of computing.
  constexpr int most_short_pieces = 10000;
  short_pieces_ = length <= 10 * shortest_piece ? short_pieces_ + 1 : 0;
  if (short_pieces_ > most_short_pieces)
    throw PhysicsError(
        "the force on the box jumps to and fro near t = " + std::to_string(time_) +
        " s, x = " + std::to_string(x_) +
        " m; write friction as clamp_dry_friction, and make jumps in the formula of user_force smooth");
  planned_length_ = length_ = length;
  double jerk = 0;
  top_acceleration_ = 0;
  for (std::size_t k = 0; k < nodes; ++k) {
    top_acceleration_ += std::abs(acceleration_[k]);
    jerk += static_cast<double>(k) * std::abs(acceleration_[k]) / length;
  }
  const double gained = top_acceleration_ * length;
  top_reach_ = {std::abs(x_) + (std::abs(v_) + gained) * length, std::abs(v_) + gained};
  valid_until_ = time_ + length;
  if (!rubs()) return;
  // Where yielding alone resists, the force has no jump at a turning point: one that comes at once is passed
  // by less than 1e-17 m, lest pieces without length follow each other.
  const double at_once = forces_.dry_friction.sum() > 0 ? time_ : time_ + 1e-9;
  valid_until_ = std::min(valid_until_, std::max(first_standstill(jerk), at_once));
}

/// Solves the collocation equations by fixed-point iteration; false when the piece is too long for the
/// promised errors of position and speed.
bool DrivenBox::try_dense(double length, double friction_force) {
  const Collocation& table = collocation();
  const double inverse_mass = 1 / mass_;
  const double first = (smooth_force(x_, v_, time_) + friction_force) * inverse_mass;
  Nodes value;
  value.fill(first);
  double change = infinity;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Nodes once = combined(table.once, value), twice = combined(table.twice, value);
    const double before = change;
    double scale = 0;
    change = 0;
    for (std::size_t j = 0; j < nodes; ++j) {
      const double s = length * table.node[j];
      const double now =
          (smooth_force(x_ + (v_ * s + length * length * twice[j]), v_ + length * once[j], time_ + s) +
           friction_force) *
          inverse_mass;
      change = std::max(change, std::abs(now - value[j]));
      scale = std::max(scale, std::abs(now));
      value[j] = now;
    }
    // What the next iteration would still change follows from how fast the changes fall.
    const double next = iteration > 0 && change < before ? change * change / before : change;
    if (next <= 4e-16 * scale + 1e-18) break;
  }
  length_ = length;
  write_dense(value);
  // The last coefficients bound what the next ones would add to the position.
  const double last = std::max(std::abs(acceleration_[nodes - 1]), std::abs(acceleration_[nodes - 2]) / 8);
  constexpr double promised = 1e-14;  // m
  if (last * length * length / (8 * 9) > promised || change * length * length > promised) return false;
  // Where a formula has a corner, short pieces keep the position long before the speed and with it the energy
  // (to 1e-11 of m v^2 a corner); at a jump no piece keeps the speed, and the shortest must do. Between the
  // ends and the nodes next to them no node sees a corner: there the force itself is asked.
  constexpr double promised_speed = 1e-11;  // m/s
  if (length <= shortest_piece) return true;
  if (last * length / 9 > promised_speed) return false;
  const Point end = at(time_ + length);
  const double final = (smooth_force(end.x, end.v, time_ + length) + friction_force) * inverse_mass;
  double sum = 0;
  for (const double coefficient : acceleration_) sum += coefficient;
  const double unseen = std::max(std::abs(first - acceleration_[0]), std::abs(final - sum));
  return unseen * table.node.front() * length <= promised_speed;
}

void DrivenBox::write_dense(const Nodes& value) {
  const Collocation& table = collocation();
  here_ = {};
  inverse_length_ = 1 / length_;
  for (std::size_t k = 0; k < nodes; ++k) {
    double sum = 0;
    for (std::size_t j = 0; j < nodes; ++j) sum += table.coefficient[k][j] * value[j];
    const double order = static_cast<double>(k);
    acceleration_[k] = sum;
    gained_speed_[k] = length_ * sum / (order + 1);
    displacement_[k] = length_ * gained_speed_[k] / (order + 2);
  }
}

/// Keeps the last answer, as an impact asks six to twelve times for one moment.
DrivenBox::Point DrivenBox::at(double t) const {
  if (t != here_.time) here_ = look(t);
  return here_.point;
}

DrivenBox::Here DrivenBox::look(double t) const {
  const double s = t - time_;
  if (piece_ == Piece::stuck) return {t, {x_, 0}, 1, 0, 1};
  if (piece_ == Piece::closed) {
    const double phase = damped_frequency_ * s, c = std::cos(phase), sn = std::sin(phase);
    const double shrink = decay_ == 0 ? 1 : std::exp(-decay_ * s);
    const double swing = shrink * (a_ * c + b_ * sn);
    double x = centre_ + swing, v = shrink * damped_frequency_ * (b_ * c - a_ * sn) - decay_ * swing;
    for (const Response& r : responses_) {
      const double drive = r.frequency * t + r.phase, ds = std::sin(drive), dc = std::cos(drive);
      x += r.p * ds + r.q * dc;
      v += r.frequency * (r.p * dc - r.q * ds);
    }
    return {t, {x, v}, c, sn, shrink};
  }
  const double u = s * inverse_length_;
  double x = 0, v = 0;
  for (std::size_t k = nodes; k-- > 0;) {
    x = x * u + displacement_[k];
    v = v * u + gained_speed_[k];
  }
  return {t, {x_ + v_ * s + u * u * x, v_ + u * v}, 1, 0, 1};
}

/// Returns the integrals from the start of a closed piece to time t, each without the difference of large
/// numbers that short times would make of it.
DrivenBox::Flown DrivenBox::flown(double t) const {
  const double s = t - time_, w = damped_frequency_, g = decay_;
  const Point here = at(t);
  const double c = here_.cosine, sn = here_.sine, shrink = here_.shrink;
  const double versine = c > 0 ? sn * sn / (1 + c) : 1 - c;
  if (g == 0) return {here.x - x_, centre_ * s + (a_ * sn + b_ * versine) / w, 0};
  const double lost = -std::expm1(-g * s);  // 1 - shrink
  const double moment = centre_ * s + (a_ * (g * lost + shrink * (g * versine + w * sn)) +
                                       b_ * (w * lost + shrink * (w * versine + -g * sn))) /
                                          (w * w + g * g);
  // v = shrink (p c + q sn), squared and written with twice the phase
  const double p = w * b_ + -g * a_, q = -w * a_ + -g * b_;
  const double lost_twice = lost * (1 + shrink), shrink_twice = shrink * shrink;
  const double versine_twice = 2 * sn * sn, sine_twice = 2 * sn * c;
  const double scale = 4 * (w * w + g * g);
  const double even = 2 * (g * lost_twice + shrink_twice * (g * versine_twice + w * sine_twice)) / scale,
               odd = 2 * (w * lost_twice + shrink_twice * (w * versine_twice + -g * sine_twice)) / scale;
  const double squares =
      (p * p + q * q) / 2 * lost_twice / (2 * g) + (p * p - q * q) / 2 * even + p * q * odd;
  return {here.x - x_, moment, squares};
}

/// Books work and impulse in closed form: constant forces and dry friction by the way, the spring's impulse
/// by the integral of x, the work of damping by that of v^2.
void DrivenBox::account_closed(double t) {
  const Flown now = flown(t);
  const double way = now.way - booked_.way, time = t - accounted_;
  for (const auto& share : forces_.viscous.shares()) {
    do_work(share.effect, -share.strength * (now.squares - booked_.squares));
    impulse_ -= share.strength * way;
  }
  for (const auto& share : forces_.constant.shares()) {
    do_work(share.effect, share.strength * way);
    impulse_ += share.strength * time;
  }
  if (const double most = forces_.dry_friction.sum(); most > 0)
    for (const auto& share : forces_.dry_friction.shares()) {
      const double force = friction_ * (share.strength / most);
      do_work(share.effect, force * way);
      impulse_ += force * time;
    }
  impulse_ -= stiffness_ * (now.moment - booked_.moment);
  booked_ = now;
  accounted_ = t;
}

void DrivenBox::account(double t) {
  if (!(accounted_ < t)) return;
  if (piece_ == Piece::closed && responses_.empty()) return account_closed(t);
  if (piece_ == Piece::stuck) {  // no way, and all forces balance
    accounted_ = t;
    return;
  }
  const Collocation& table = collocation();
  while (accounted_ < t) {
    // 8 nodes on 10 ms of a motion of some hertz are exact to rounding; fast forcing gets shorter steps.
    double longest = 1e-2;
    for (const Harmonic& h : forces_.harmonics)
      longest = std::min(longest, 0.1 / std::max(h.frequency, 1e-3));
    if (piece_ == Piece::dense) longest = std::min(longest, length_);
    const double h = std::min(t - accounted_, longest);
    for (std::size_t j = 0; j < nodes; ++j) {
      const double time = accounted_ + h * table.node[j], weight = h * table.weight[j];
      const Point p = at(time);
      double total = 0;
      const auto add = [&](double force, int effect) {
        total += force;
        do_work(effect, weight * force * p.v);
      };
      add(-stiffness_ * p.x, -1);
      if (cubic_ != 0) add(-stiffness_ * cubic_ * p.x * p.x * p.x, -1);  // stored, like the linear spring's
      forces_.each(p.x, p.v, time, add);
      dahl_.each(p.x, add);
      if (const double most = forces_.dry_friction.sum(); most > 0) {
        const double friction = piece_ == Piece::stuck ? -smooth_force(p.x, 0, time) : friction_;
        for (const auto& share : forces_.dry_friction.shares())
          add(friction * (share.strength / most), share.effect);
      }
      impulse_ += weight * total;
    }
    accounted_ = h < t - accounted_ ? accounted_ + h : t;
  }
}

}  // namespace shakedown
