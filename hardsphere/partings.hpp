// SPDX-License-Identifier: MIT
// Grains leave a meeting with new velocities; grains, walls and box are told of them.
#pragma once
#include "loop_accounts.hpp"
#include "loop_walls.hpp"

namespace shakedown {

/// Returns the three numbers as a vector.
inline Vec3 vec(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }
/// Adds a vector to three numbers.
inline void add(std::array<double, 3>& to, const Vec3& what) {
  for (std::size_t axis = 0; axis < 3; ++axis) to[axis] += what[static_cast<int>(axis)];
}

/// Two grains that meet now: r from the first to the second, m, and how fast they part along it (below zero
/// when they close).
struct MeetingPair {
  Flight3 a, b;
  std::array<double, 3> r;
  double distance, opening;  ///< m, m/s
  double opening_rate;       ///< opening over distance, 1/s
};

template <class Scene>
class Partings {
 public:
  Partings(Scene& scene, LoopWalls<Scene>& walls, LoopAccounts<Scene>& accounts)
      : scene_(scene), walls_(walls), accounts_(accounts) {}

  /// Returns grains i and j as they meet at the scene's time.
  MeetingPair pair_now(int i, int j) const;
  /// Returns the flight of grain i as it goes on from the scene's time.
  Flight3 flight_now(int i) const {
    Flight3 flight = scene_.grains.flight(i);
    flight.advance(scene_.now);
    return flight;
  }

  /// Lets the two part with an impulse along r, given per metre of r (N s/m; above zero it drives them
  /// apart), and predicts their next events. `pair`: what else has changed their velocities is in it already.
  void part(int i, int j, MeetingPair& pair, double impulse_per_length);
  /// Enters the flight of grain i that a wall has thrown back, kicks the box by `jump` (m/s; 0: not at all),
  /// and predicts the next events.
  void part_from_wall(int i, const Flight3& flight, double jump);
  /// Predicts grain i anew after a predicted meeting turned out receding by rounding. `walls`: those that the
  /// grain was to meet, where it is looked for again after 1 ns (a box's acceleration makes 3e-18 m of that);
  /// nullptr: none that EndWalls finds.
  void refuse(int i, const Flight3& flight, EndWalls* walls);
  std::int64_t refused() const { return refused_; }  ///< number of such meetings so far

 private:
  Scene& scene_;
  LoopWalls<Scene>& walls_;
  LoopAccounts<Scene>& accounts_;
  std::int64_t refused_ = 0;
};

template <class Scene>
MeetingPair Partings<Scene>::pair_now(int i, int j) const {
  MeetingPair pair{scene_.grains.flight(i), scene_.grains.flight(j), {}, 0, 0, 0};
  auto& [a, b, r, distance, opening, opening_rate] = pair;
  a.advance(scene_.now);
  b.advance(scene_.now);
  r = scene_.grains.separation(a, b);
  const double squared = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  distance = std::sqrt(squared);
  opening_rate = (r[0] * (b.v[0] - a.v[0]) + r[1] * (b.v[1] - a.v[1]) + r[2] * (b.v[2] - a.v[2])) / squared;
  opening = opening_rate * distance;
  return pair;
}

template <class Scene>
void Partings<Scene>::part(int i, int j, MeetingPair& pair, double impulse_per_length) {
  const double of_a = impulse_per_length / scene_.grains.mass(i),
               of_b = impulse_per_length / scene_.grains.mass(j);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    pair.a.v[axis] -= of_a * pair.r[axis];
    pair.b.v[axis] += of_b * pair.r[axis];
  }
  scene_.grains.set_flight(i, pair.a);
  scene_.grains.set_flight(j, pair.b);
  scene_.grains.predict(i, j);
  walls_.after(i);
  walls_.after(j);
}

template <class Scene>
void Partings<Scene>::part_from_wall(int i, const Flight3& flight, double jump) {
  scene_.grains.set_flight(i, flight);
  if (jump != 0) {
    scene_.box_now();
    accounts_.before_kick();
    scene_.kick_box(jump);
  }
  scene_.grains.predict(i);
  walls_.after(i, jump != 0);
  if (jump != 0) walls_.renew(jump);
}

template <class Scene>
void Partings<Scene>::refuse(int i, const Flight3& flight, EndWalls* walls) {
  ++refused_;
  scene_.grains.move_to(i, flight);
  scene_.grains.predict(i);
  walls_.after(i);
  if (walls && !Scene::scripted) walls->put_off(i, scene_.now + 1e-9);
}

}  // namespace shakedown
