// SPDX-License-Identifier: MIT
// The walls that an event loop asks for their next meeting: the end walls, and the side walls where they
// move as the grains see it, or attract. Side walls at rest are found by the grains themselves.
#pragma once
#include <algorithm>
#include <vector>

#include "end_walls.hpp"
#include "scene.hpp"

namespace shakedown {

/// Returns for each grain half the inner length less its radius, m: how far its centre can get from the
/// middle.
inline std::vector<double> rooms(const State& state, double length) {
  std::vector<double> room;
  for (const double radius : state.radius) room.push_back(length / 2 - radius);
  return room;
}

template <class Scene>
class LoopWalls {
 public:
  /// Dampers up to this size sweep all wall bounds after a kick; larger ones open windows.
  static constexpr std::size_t always_watched = 256;

  LoopWalls(Scene& scene, const State& state, const Physics& physics, const Setup& setup);

  /// Returns the walls across an axis; 1 and 2 only where has_sides().
  EndWalls& across(int axis) {
    return axis == 0 ? end_walls_ : side_walls_[static_cast<std::size_t>(axis - 1)];
  }
  const EndWalls& across(int axis) const {
    return axis == 0 ? end_walls_ : side_walls_[static_cast<std::size_t>(axis - 1)];
  }
  bool has_sides() const { return !side_walls_.empty(); }
  /// Returns the walls across an axis of a driven box at the scene's time; kept, as an impact asks six to
  /// nine times.
  const EndWalls::Now& now(int axis) {
    Kept& kept = kept_[static_cast<std::size_t>(axis)];
    if (kept.now.time != scene_.now || kept.flight != scene_.flights)
      kept = {scene_.flights, EndWalls::now(scene_.walls_across(axis), scene_.now)};
    return kept.now;
  }
  /// Returns the velocity of a driven box now, in the frame of the grains, m/s: along each axis that of the
  /// walls across it.
  Vec3 velocity() { return {now(0).point.v, now(1).point.v, now(2).point.v}; }

  struct First {
    int axis;           ///< of the walls with the earliest meeting or bound
    double time;        ///< of it, or `before`
    double window_end;  ///< s, at which a window must be opened
  };
  /// Returns the walls with the earliest meeting or bound, or `before`, s, where that is earlier.
  First first(double before) const {
    First found{0, std::min(before, end_walls_.next().time), end_walls_.window_end()};
    if constexpr (Scene::driven)
      for (int a = 1; a <= sides(); ++a) {
        found.window_end = std::min(found.window_end, across(a).window_end());
        if (across(a).next().time < std::min(found.time, across(found.axis).next().time)) found.axis = a;
        found.time = std::min(found.time, across(a).next().time);
      }
    return found;
  }
  /// Makes the earliest bound of the walls across an axis sharper, or replaces it by the exact time of the
  /// meeting. `limit`: s, time of the next other event.
  void refine(int axis, double limit) {
    if constexpr (Scene::driven)
      across(axis).refine(scene_.walls_across(axis), limit);
    else
      end_walls_.refine(scene_.box, limit);
  }

  /// Opens the windows that have ended, or all.
  void open_windows(bool all = false);
  /// Renews every bound after a kick of the box (jump != 0), or when its motion goes on with another piece.
  void renew(double jump);
  /// Tells the walls that grain i is on a new flight, after every change of it. `kick_follows`: renew() is
  /// called next, which renews the bounds of the end walls, so that this grain's need not be found here.
  void after(int i, bool kick_follows = false);

  /// Returns how deep a grain was seen in a wall, m; 0: never.
  double deepest_overlap() const {
    double deepest = end_walls_.deepest_overlap();
    for (const EndWalls& walls : side_walls_) deepest = std::max(deepest, walls.deepest_overlap());
    return deepest;
  }
  /// Returns the memory held for each of `grains`, B.
  double bytes_per_grain(int grains) const {
    return grains == 0 ? 0 : static_cast<double>(end_walls_.bytes()) / grains;
  }

 private:
  /// Returns the number of axes with side walls that move or attract.
  int sides() const { return static_cast<int>(side_walls_.size()); }
  /// Returns the end walls at the present time of the scene.
  EndWalls::Now end_walls_now() {
    if constexpr (Scene::driven)
      return now(0);
    else
      return {scene_.now, scene_.box_now(), scene_.box.top_acceleration(), scene_.box.top_speed(), true};
  }

  Scene& scene_;
  EndWalls end_walls_;
  std::vector<EndWalls> side_walls_;  // across y and z; empty: they are at rest
  struct Kept {
    std::int64_t flight = -1;
    EndWalls::Now now{};
  };
  std::array<Kept, 3> kept_{};  // of each axis, of the box's present flight
};

template <class Scene>
LoopWalls<Scene>::LoopWalls(Scene& scene, const State& state, const Physics& physics, const Setup& setup)
    : scene_(scene),
      end_walls_(scene.has_walls ? rooms(state, setup.box.length) : std::vector<double>{},
                 state.size() <= always_watched, physics.contact.reach(ContactClass::end_wall)) {
  const bool attract = physics.contact.walls_attract();
  if (Scene::driven && scene.has_walls && (scene.falling || scene.arc_curvature != 0 || attract))
    for (const double width : setup.box.width)
      side_walls_.emplace_back(rooms(state, width), state.size() <= always_watched,
                               physics.contact.reach(ContactClass::side_wall));
  if (!side_walls_.empty()) scene.grains.forget_side_walls();
}

template <class Scene>
void LoopWalls<Scene>::open_windows(bool all) {
  const auto along = [this](int axis) {
    return [this, axis](int i) -> EndWalls::Flight {
      const Flight3 flight = scene_.grains.flight(i);
      const auto k = static_cast<std::size_t>(axis);
      return {flight.x[k], flight.v[k], flight.time};
    };
  };
  if (all || end_walls_.window_end() <= scene_.now) end_walls_.open(end_walls_now(), along(0));
  if constexpr (Scene::driven)
    for (int axis = 1; axis <= sides(); ++axis)
      if (all || across(axis).window_end() <= scene_.now) across(axis).open(now(axis), along(axis));
}

template <class Scene>
void LoopWalls<Scene>::renew(double jump) {
  if (Scene::scripted) return;
  end_walls_.kicked(end_walls_now(), jump);
  if constexpr (Scene::driven)
    if (scene_.arc_curvature != 0)
      side_walls_[1].kicked(now(2), 2 * scene_.arc_curvature * scene_.box_now().x * jump);
}

template <class Scene>
void LoopWalls<Scene>::after(int i, bool kick_follows) {
  if (Scene::scripted || !scene_.has_walls) return;
  const Flight3 flight = scene_.grains.flight(i);
  const EndWalls::Flight along{flight.x[0], flight.v[0], flight.time};
  if (kick_follows)
    end_walls_.grain_flies(i, along, end_walls_now());
  else
    end_walls_.grain_changed(i, along, end_walls_now(), Scene::driven);
  if constexpr (Scene::driven)
    for (int axis = 1; axis <= sides(); ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      across(axis).grain_changed(i, {flight.x[k], flight.v[k], flight.time}, now(axis), true);
    }
}

}  // namespace shakedown
