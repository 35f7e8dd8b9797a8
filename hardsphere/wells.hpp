// SPDX-License-Identifier: MIT
// Attraction as a square well around every grain and along every wall: its depth, attraction force times
// range, is gained on capture and paid back on escape; a grain too slow to pay is thrown back.
#pragma once
#include "held_bonds.hpp"
#include "partings.hpp"

namespace shakedown {

template <class Scene>
class Wells {
 public:
  Wells(Scene& scene, LoopWalls<Scene>& walls, LoopAccounts<Scene>& accounts, Partings<Scene>& partings,
        const ContactLaw& law)
      : scene_(scene),
        walls_(walls),
        accounts_(accounts),
        partings_(partings),
        acts_(law.has_attraction()),
        force_(law.attraction_force),
        wall_force_(law.attraction(ContactClass::end_wall)),
        range_(law.attraction_range),
        effect_(law.attraction_effect),
        held_(acts_ ? static_cast<std::size_t>(scene.grains.size()) : 0, range_) {}

  /// Finds out who starts in a well; the grains must have predicted their events.
  void start(const State& state, const Setup& setup);

  /// Execute the arrival of grain i at the edge of the well of grain j, or of the wall across `axis` on this
  /// side (+1 or -1): it is captured, escapes, or is thrown back.
  void pair_edge(int i, int j, Meeting meeting);
  void wall_edge(int i, int axis, int side, Meeting meeting);

  bool act() const { return acts_; }  ///< whether grains attract each other
  /// Returns the energy that wells hold, J: below zero where any is filled.
  double energy() const {
    return -(static_cast<double>(filled_) * force_ + static_cast<double>(filled_at_walls_) * wall_force_) *
           range_;
  }
  /// Returns the closing speed below which an impact of grain i (and j) is elastic, m/s; `limit`, m/s, holds
  /// without attraction.
  double elastic_below(double limit, int i, int j = -1) const {
    if constexpr (Scene::driven)
      if (acts_)
        return std::max(j < 0 && wall_force_ == 0 ? limit : 0, held_.elastic_below(limit, i, j, scene_.now));
    return limit;
  }
  /// Notes that grains i and j (or i and a wall) have touched and part with this momentum, N s. `bond`: their
  /// key, HeldBonds::of_pair() or of_wall().
  void note_touch(std::uint64_t bond, double momentum, int i, int j = -1) {
    held_.touched(bond, momentum, scene_.now);
    held_.touches(i, scene_.now);
    if (j >= 0) held_.touches(j, scene_.now);
  }
  /// Tells whether any bond gave way without paying for it.
  bool let_any_go() const { return let_go_ > 0; }

 private:
  /// Return the opening speed, m/s, behind the edge of a well of this force, N: after a capture, and after an
  /// escape that can pay. `opening`: m/s, before; `reduced`: kg.
  double captured(double force, double opening, double reduced) const {
    return -std::sqrt(opening * opening + 2 * force * range_ / reduced);
  }
  double escaped(double force, double opening, double reduced) const {
    return std::sqrt(opening * opening - 2 * force * range_ / reduced);
  }
  /// Tells whether the energy of opening is enough to leave a well of this force.
  bool can_pay(double force, double opening, double reduced) const {
    return reduced / 2 * opening * opening > force * range_;
  }
  /// Books a bond of this force, N, that gives way without paying for it.
  void let_go(double force) {
    ++let_go_;
    accounts_.loss_of(effect_) -= force * range_;
  }

  Scene& scene_;
  LoopWalls<Scene>& walls_;
  LoopAccounts<Scene>& accounts_;
  Partings<Scene>& partings_;
  bool acts_;
  double force_, wall_force_, range_;  // N, N, m
  int effect_;
  HeldBonds held_;
  std::int64_t filled_ = 0, filled_at_walls_ = 0, let_go_ = 0;
};

template <class Scene>
void Wells<Scene>::start(const State& state, const Setup& setup) {
  filled_ += scene_.grains.bonds();
  if (wall_force_ == 0) return;
  for (int i = 0; i < scene_.grains.size(); ++i) {
    const Flight3 flight = scene_.grains.flight(i);
    const Vec3 position(flight.x[0] - state.x_box, flight.x[1], flight.x[2]);
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {1, -1}) {
        const double half =
            (axis == 0 ? setup.box.length : setup.box.width[static_cast<std::size_t>(axis - 1)]) / 2;
        const bool inside = half - scene_.grains.radius(i) - side * position[axis] < range_;
        walls_.across(axis).set_inside(i, side, inside);
        if (inside) ++filled_at_walls_;
      }
  }
}

template <class Scene>
void Wells<Scene>::pair_edge(int i, int j, Meeting meeting) {
  MeetingPair pair = partings_.pair_now(i, j);
  const double opening = pair.opening;
  const double ma = scene_.grains.mass(i), mb = scene_.grains.mass(j), reduced = ma * mb / (ma + mb);
  double next = opening;
  if (meeting == Meeting::capture) {
    next = captured(force_, opening, reduced);
    scene_.grains.set_bond(i, j, true);
    ++filled_;
  } else if (can_pay(force_, opening, reduced)) {
    next = escaped(force_, opening, reduced);
    scene_.grains.set_bond(i, j, false);
    --filled_;
  } else if (held_.gives_way(HeldBonds::of_pair(i, j), force_, reduced, opening, scene_.now)) {
    scene_.grains.set_bond(i, j, false);
    --filled_;
    let_go(force_);
  } else {
    next = -opening;
  }
  partings_.part(i, j, pair, reduced * (next - opening) / pair.distance);
}

template <class Scene>
void Wells<Scene>::wall_edge(int i, int axis, int side, Meeting meeting) {
  EndWalls& walls = walls_.across(axis);
  Flight3 flight = partings_.flight_now(i);
  const auto k = static_cast<std::size_t>(axis);
  const double opening = side * (walls_.now(axis).point.v - flight.v[k]);
  if (meeting == Meeting::capture ? opening >= 0 : opening <= 0) return partings_.refuse(i, flight, &walls);
  const bool box_yields = axis == 0 && scene_.has_spring;
  const double m = scene_.grains.mass(i), M = scene_.box.mass(), reduced = box_yields ? m * M / (m + M) : m;
  double next = -opening;
  if (meeting == Meeting::capture) {
    next = captured(wall_force_, opening, reduced);
    walls.set_inside(i, side, true);
    ++filled_at_walls_;
  } else if (can_pay(wall_force_, opening, reduced)) {
    next = escaped(wall_force_, opening, reduced);
    walls.set_inside(i, side, false);
    --filled_at_walls_;
  } else if (held_.gives_way(HeldBonds::of_wall(i, axis, side), wall_force_, reduced, opening, scene_.now)) {
    next = opening;
    walls.set_inside(i, side, false);
    --filled_at_walls_;
    let_go(wall_force_);
  }
  const double impulse = reduced * (next - opening);  // opens the gap further when positive
  Vec3 on_grain = Vec3::Zero();
  on_grain[axis] = -side * impulse;
  accounts_.wall_pushes_grain(on_grain);
  flight.v[k] -= side * impulse / m;
  partings_.part_from_wall(i, flight, box_yields ? side * impulse / M : 0);
}

}  // namespace shakedown
