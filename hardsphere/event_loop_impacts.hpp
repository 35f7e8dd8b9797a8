// SPDX-License-Identifier: MIT
// Part of event_loop.hpp: what happens when grains touch each other or a wall.
#pragma once
#include "event_loop.hpp"
#include "event_loop_start.hpp"

namespace shakedown {

inline Vec3 vec(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }
inline void add(std::array<double, 3>& to, const Vec3& what) {
  for (std::size_t axis = 0; axis < 3; ++axis) to[axis] += what[static_cast<int>(axis)];
}

template <class Grains, class Motion>
double EventLoop<Grains, Motion>::restitution(ContactClass contact, double closing, double elastic_below,
                                              std::int64_t& rescues) const {
  const double law = contact_.restitution_at ? contact_.restitution_at(contact, closing)
                                             : contact_.restitution[static_cast<std::size_t>(contact)];
  if (closing >= elastic_below || law >= 1) return law;
  ++rescues;
  return 1;
}

/// Below which closing speed an impact of grain i (and j) is elastic; in wells only where they touch in quick
/// succession.
template <class Grains, class Motion>
double EventLoop<Grains, Motion>::elastic_below(double limit, int i, int j) const {
  if constexpr (driven)
    if (contact_.has_attraction()) return held_.elastic_below(limit, i, j, now_);
  return limit;
}

/// Whether this impact rubs, where impacts below `elastic_below` are elastic. A layer pressed on a wall
/// consists of such impacts, and without friction in them it slips as none of soft contacts does: with
/// coefficients of 0.41 (restitution 0.66, 128 runs) the peaks at 40 mm fell by 9.00 mm/s; soft contacts of
/// 0.1 ms give 8.78, friction down to 0.3, 0.1 and 0.03 of the limit 8.85, 8.83 and 8.83, and first peaks
/// within 0.15, 0.02 mm and less of each other. Down to nothing the layer collapses. And where grains touch
/// again at once, as in a row that just fits between the side walls, friction takes what pushes the row
/// apart: one run in 4000 made 22 million impacts of it. 1 us to 10 us without friction forbid that and give
/// the same peaks within 0.1 mm.
template <class Grains, class Motion>
bool EventLoop<Grains, Motion>::rubs(double closing, double elastic_below, int i, int j) {
  constexpr double slow = 0.1, at_once = 1e-5;  // s
  double& touched = touched_[static_cast<std::size_t>(i)];
  double before = touched;
  touched = now_;
  if (j >= 0) {
    before = std::max(before, touched_[static_cast<std::size_t>(j)]);
    touched_[static_cast<std::size_t>(j)] = now_;
  }
  return closing >= elastic_below || (closing >= slow * elastic_below && now_ - before > at_once);
}

template <class Grains, class Motion>
void EventLoop<Grains, Motion>::note_touch(std::uint64_t bond, double momentum, int i, int j) {
  held_.touched(bond, momentum, now_);
  held_.touches(i, now_);
  if (j >= 0) held_.touches(j, now_);
}

/// A bond gives way without paying for it.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::let_go() {
  --wells_;
  ++let_go_;
  ledger_.effect_loss[static_cast<std::size_t>(attraction_effect_)] -=
      contact_.attraction_force * contact_.attraction_range;
}

/// m; some thousand units in the last place of a position, a tenth of the overlap that is promised.
constexpr double lowest_bounce = 1e-13;

/// A bounce on an accelerated wall lower than positions resolve would never end, so every rebound goes at
/// least `lowest_bounce` far. What that takes is booked (a loss below zero, 1e-14 of E0).
inline double resolved(double restitution, double closing, double wall_acceleration) {
  return std::max(restitution, std::sqrt(2 * wall_acceleration * lowest_bounce) / closing);
}

/// A predicted meeting turned out receding (rounding): look again a little later. 1 ns of a box's
/// acceleration is 3e-18 m.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::refuse(int i, Flight3 flight, EndWalls* walls) {
  ++refused_;
  grains_.move_to(i, flight);
  grains_.predict(i);
  after(i);
  if (walls && !scripted) walls->put_off(i, now_ + 1e-9);
}

template <class Grains, class Motion>
typename EventLoop<Grains, Motion>::Pair EventLoop<Grains, Motion>::pair_now(int i, int j) const {
  Pair pair{grains_.flight(i), grains_.flight(j), {}, 0, 0, 0};
  auto& [a, b, r, distance, opening, opening_rate] = pair;
  a.advance(now_);
  b.advance(now_);
  r = grains_.separation(a, b);
  const double squared = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  distance = std::sqrt(squared);
  opening_rate = (r[0] * (b.v[0] - a.v[0]) + r[1] * (b.v[1] - a.v[1]) + r[2] * (b.v[2] - a.v[2])) / squared;
  opening = opening_rate * distance;
  return pair;
}

/// They part with an impulse along r, given per metre of r, and all who are concerned hear of it.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::finish_pair(int i, int j, Pair& pair, double impulse_per_length) {
  const double of_a = impulse_per_length / grains_.mass(i), of_b = impulse_per_length / grains_.mass(j);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    pair.a.v[axis] -= of_a * pair.r[axis];
    pair.b.v[axis] += of_b * pair.r[axis];
  }
  grains_.set_flight(i, pair.a);
  grains_.set_flight(j, pair.b);
  grains_.predict(i, j);
  after(i);
  after(j);
}

/// A wall has thrown a grain back, and the box has taken `jump`.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::finish_wall(int i, const Flight3& flight, double jump) {
  grains_.set_flight(i, flight);
  if (jump != 0) kick_box(jump);
  grains_.predict(i);
  after(i, jump != 0);
  if (jump != 0) renew_walls(jump);
}

/// Inelastic impact of two spheres: normal impulse mu (1 + eps) times the closing speed along the line of
/// centres.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::pair_impact(int i, int j) {
  Pair pair = pair_now(i, j);
  auto& [a, b, r, distance, opening, opening_rate] = pair;
  const double closing = -opening;
  if (closing <= 0) return refuse(i, a, nullptr);
  const double limit = elastic_below(limits_.pair_speed, i, j),
               e = restitution(ContactClass::grain_grain, closing, limit, elastic_pairs_);
  const double ma = grains_.mass(i), mb = grains_.mass(j), reduced = ma * mb / (ma + mb);
  const double impulse = reduced * (1 + e) * closing;
  double loss = reduced / 2 * (1 - e * e) * closing * closing;
  if constexpr (driven)
    if (contact_.friction[0] > 0 && rubs(closing, limit, i, j)) {
      const Vec3 normal = vec(r) / distance, apart = vec(b.v) - vec(a.v);
      const double ra = grains_.radius(i), rb = grains_.radius(j);
      Vec3 &spin_a = spin_[static_cast<std::size_t>(i)], &spin_b = spin_[static_cast<std::size_t>(j)];
      Vec3 slip = apart - (rb * spin_b + ra * spin_a).cross(normal);
      slip -= slip.dot(normal) * normal;
      const Friction friction = friction_impulse(slip, Vec3::Constant(reduced / 3.5), contact_.friction[0],
                                                 contact_.tangential_restitution, impulse);
      add(a.v, -friction.impulse / ma);
      add(b.v, friction.impulse / mb);
      spin_a += spin_change(normal, ra, ma, -friction.impulse);
      spin_b += spin_change(-normal, rb, mb, friction.impulse);
      loss += friction.loss;
    }
  lose(0, loss);
  ++collisions_[0];
  if constexpr (driven)
    if (contact_.has_attraction()) note_touch(HeldBonds::of_pair(i, j), reduced * e * closing, i, j);
  virial_ += impulse * distance;
  // impulse / distance, without waiting for the root
  finish_pair(i, j, pair, -reduced * (1 + e) * opening_rate);
}

/// The edge of the square well around a grain: depth attraction force times range, gained on capture and paid
/// back on escape; too slow to pay, the grain is thrown back.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::pair_well(int i, int j, Meeting meeting) {
  Pair pair = pair_now(i, j);
  const double opening = pair.opening;
  const double ma = grains_.mass(i), mb = grains_.mass(j), reduced = ma * mb / (ma + mb);
  const double depth = contact_.attraction_force * contact_.attraction_range;
  double next = opening;
  if (meeting == Meeting::capture) {
    next = -std::sqrt(opening * opening + 2 * depth / reduced);
    grains_.set_bond(i, j, true);
    ++wells_;
  } else if (reduced / 2 * opening * opening > depth) {
    next = std::sqrt(opening * opening - 2 * depth / reduced);
    grains_.set_bond(i, j, false);
    --wells_;
  } else if (held_.gives_way(HeldBonds::of_pair(i, j), reduced, opening, now_)) {
    grains_.set_bond(i, j, false);
    let_go();
  } else {
    next = -opening;
  }
  finish_pair(i, j, pair, reduced * (next - opening) / pair.distance);
}

/// Impact on a side wall at rest in the frame of the grains.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::fixed_side_impact(int i, std::int32_t face) {
  if constexpr (driven) return moving_side_impact(i, side_wall_axis(face), side_wall_sign(face));
  Flight3 flight = grains_.flight(i);
  flight.advance(now_);
  const std::size_t axis = static_cast<std::size_t>(side_wall_axis(face));
  const double closing = side_wall_sign(face) * flight.v[axis];
  EXPECT(closing > 0);
  const double e = restitution(ContactClass::side_wall, closing, limits_.wall_speed, elastic_walls_);
  flight.v[axis] *= -e;
  lose(2, grains_.mass(i) / 2 * (1 - e * e) * closing * closing);
  ++collisions_[2];
  finish_wall(i, flight, 0);
}

/// The box takes `jump` at now_.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::kick_box(double jump) {
  const BoxMotion::Point box = box_now();
  if constexpr (driven)
    account(now_);
  else
    outer_impulse_ += spring_impulse_;
  box_.restart(now_, box.x, box.v + jump);
  box_point_.v += jump;
  spring_impulse_ = 0;
}

/// Forced to swing wider than it was released, the box presses its layers with more than the setup's
/// accelerations. At resonance (1 m/s^2 at 1.05 Hz, L = 65 mm) pressed rows rattled 1.3 million times a
/// second by the time the box swung eight times as wide. An eighth of the swing's excess acceleration sets
/// limits that stop this (6 times fewer events at 15 s) and leave peaks within the spread of runs (811.0 for
/// 810.4 +- 0.5 mm); all of it would move them by 1 %.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::press_by_the_swing() {
  if (limits_.pull < 0) return;
  const double excess = box_.angular_frequency() * (box_.top_speed() - speed_at_release_);
  const double pull = std::max(limits_at_release_.pull, excess / 8);
  if (pull != limits_.pull) limits_ = pressed_by(pull, limits_at_release_, 2 * grains_.radius(0));
}

/// Impact on an end wall: the box takes the opposite impulse (paper, Sec. II B, with v_Box' = v_Box + dp /
/// M).
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::end_impact(int i, int side) {
  Flight3 flight = grains_.flight(i);
  flight.advance(now_);
  const double wall = driven ? walls_across(0).at(now_).v : box_now().v;
  const double closing = side * (flight.v[0] - wall);
  if (closing <= 0) return refuse(i, flight, &end_walls_);
  if constexpr (driven) press_by_the_swing();
  const double limit =
      elastic_below(std::max(limits_.wall_fraction * box_.top_speed(), limits_.wall_speed), i);
  const double e = resolved(restitution(ContactClass::end_wall, closing, limit, elastic_walls_), closing,
                            driven ? walls_across(0).top_acceleration() : box_.top_acceleration());
  const double m = grains_.mass(i), reduced = has_spring_ ? m * box_.mass() / (m + box_.mass()) : m;
  const double impulse = reduced * (1 + e) * closing;
  double loss = reduced / 2 * (1 - e * e) * closing * closing;
  if constexpr (driven) {
    Vec3 on_grain(-side * impulse, 0, 0);
    if (contact_.friction[1] > 0 && rubs(closing, limit, i)) {
      const Vec3 normal(side, 0, 0);
      Vec3& spin = spin_[static_cast<std::size_t>(i)];
      Vec3 slip = vec(flight.v) + spin.cross(normal) * grains_.radius(i);
      slip -= Vec3(0, walls_across(1).at(now_).v, walls_across(2).at(now_).v);
      slip.x() = 0;
      const Friction friction = friction_impulse(slip, Vec3::Constant(m / 3.5), contact_.friction[1],
                                                 contact_.tangential_restitution, impulse);
      add(flight.v, friction.impulse / m);
      spin += spin_change(normal, grains_.radius(i), m, friction.impulse);
      loss += friction.loss;
      on_grain += friction.impulse;
    }
    if (forces_.arc_effect >= 0)  // the side walls' motion along z does work on what rubs on the end walls
      ledger_.effect_loss[static_cast<std::size_t>(forces_.arc_effect)] -=
          on_grain.z() * (walls_across(2).at(now_).v + frame_.velocity(now_).z());
    account(now_);
    grain_momentum_ += on_grain;
  }
  flight.v[0] -= side * impulse / m;
  lose(1, loss);
  ++collisions_[1];
  if constexpr (driven)
    if (contact_.has_attraction()) note_touch(HeldBonds::of_wall(i, 0, side), reduced * e * closing, i);
  finish_wall(i, flight, has_spring_ ? side * impulse / box_.mass() : 0);
}

/// Impact on a side wall that may move across (falling frame, arc) and along the axis (with the box, whom
/// friction pulls).
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::moving_side_impact(int i, int axis, int side) {
  if constexpr (driven) {
    Flight3 flight = grains_.flight(i);
    flight.advance(now_);
    const auto k = static_cast<std::size_t>(axis);
    const std::array<double, 3> wall{walls_across(0).at(now_).v, walls_across(1).at(now_).v,
                                     walls_across(2).at(now_).v};
    const double closing = side * (flight.v[k] - wall[k]);
    if (closing <= 0) return refuse(i, flight, side_walls_.empty() ? nullptr : &walls(axis));
    const double limit = elastic_below(limits_.wall_speed, i),
                 e = resolved(restitution(ContactClass::side_wall, closing, limit, elastic_walls_), closing,
                              walls_across(axis).top_acceleration());
    const double m = grains_.mass(i), impulse = m * (1 + e) * closing;
    double loss = m / 2 * (1 - e * e) * closing * closing, jump = 0;
    Vec3 on_grain = Vec3::Zero();
    if (contact_.friction[2] > 0 && rubs(closing, limit, i)) {
      Vec3 normal = Vec3::Zero();
      normal[axis] = side;
      Vec3& spin = spin_[static_cast<std::size_t>(i)];
      Vec3 slip = vec(flight.v) - vec(wall) + spin.cross(normal) * grains_.radius(i);
      slip[axis] = 0;
      Vec3 mass = Vec3::Constant(m / 3.5);
      if (has_spring_) mass.x() = 1 / (3.5 / m + 1 / box_.mass());
      const Friction friction =
          friction_impulse(slip, mass, contact_.friction[2], contact_.tangential_restitution, impulse);
      spin += spin_change(normal, grains_.radius(i), m, friction.impulse);
      loss += friction.loss;
      on_grain = friction.impulse;
      if (has_spring_) jump = -friction.impulse.x() / box_.mass();
    }
    on_grain[axis] -= side * impulse;
    // in the lab only the arc moves the side walls: what they do on grains is its work
    if (forces_.arc_effect >= 0)
      ledger_.effect_loss[static_cast<std::size_t>(forces_.arc_effect)] -=
          on_grain.z() * (wall[2] + frame_.velocity(now_).z());
    account(now_);
    grain_momentum_ += on_grain;
    add(flight.v, on_grain / m);
    lose(2, loss);
    ++collisions_[2];
    if (contact_.has_attraction()) note_touch(HeldBonds::of_wall(i, axis, side), m * e * closing, i);
    finish_wall(i, flight, jump);
  }
}

/// The edge of a wall's square well, as pair_well.
template <class Grains, class Motion>
void EventLoop<Grains, Motion>::wall_well(int i, int axis, int side, Meeting meeting, EndWalls& walls) {
  if constexpr (driven) {
    Flight3 flight = grains_.flight(i);
    flight.advance(now_);
    const auto k = static_cast<std::size_t>(axis);
    const double opening = side * (walls_across(axis).at(now_).v - flight.v[k]);
    if (meeting == Meeting::capture ? opening >= 0 : opening <= 0) return refuse(i, flight, &walls);
    const double m = grains_.mass(i), M = box_.mass(),
                 reduced = axis == 0 && has_spring_ ? m * M / (m + M) : m;
    const double depth = contact_.attraction_force * contact_.attraction_range;
    double next = -opening;
    if (meeting == Meeting::capture) {
      next = -std::sqrt(opening * opening + 2 * depth / reduced);
      walls.set_inside(i, side, true);
      ++wells_;
    } else if (reduced / 2 * opening * opening > depth) {
      next = std::sqrt(opening * opening - 2 * depth / reduced);
      walls.set_inside(i, side, false);
      --wells_;
    } else if (held_.gives_way(HeldBonds::of_wall(i, axis, side), reduced, opening, now_)) {
      next = opening;
      walls.set_inside(i, side, false);
      let_go();
    }
    const double impulse = reduced * (next - opening);  // opens the gap further when positive
    account(now_);
    grain_momentum_[axis] -= side * impulse;
    if (axis == 2 && forces_.arc_effect >= 0)
      ledger_.effect_loss[static_cast<std::size_t>(forces_.arc_effect)] +=
          side * impulse * (walls_across(2).at(now_).v + frame_.velocity(now_).z());
    flight.v[k] -= side * impulse / m;
    finish_wall(i, flight, axis == 0 && has_spring_ ? side * impulse / M : 0);
  }
}

}  // namespace shakedown
