// SPDX-License-Identifier: MIT
// The walls that an event loop asks for their next meeting: the end walls, and the side walls where they
// move as the grains see it, or attract. Side walls at rest are found by the grains themselves.
#pragma once
#include <algorithm>
#include <vector>

#include "end_walls.hpp"
#include "scene.hpp"

namespace shakedown {

/// Half the inner length less each grain's radius, m.
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

  EndWalls& across(int axis) {
    return axis == 0 ? end_walls_ : side_walls_[static_cast<std::size_t>(axis - 1)];
  }
  const EndWalls& across(int axis) const {
    return axis == 0 ? end_walls_ : side_walls_[static_cast<std::size_t>(axis - 1)];
  }
  bool has_sides() const { return !side_walls_.empty(); }

  struct First {
    int axis;           ///< of the walls with the earliest meeting or bound
    double time;        ///< of it, or `before`
    double window_end;  ///< s, at which a window must be opened
  };
  /// What comes first, and no later than `before`.
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
  /// Makes the earliest bound of the walls across an axis sharper, or a time. `limit`: of the next other
  /// event.
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
  /// Tells the walls of a grain's new flight. A kick of the box that follows renews every bound of the end
  /// walls, also this grain's.
  void after(int i, bool kick_follows = false);

  double deepest_overlap() const {
    double deepest = end_walls_.deepest_overlap();
    for (const EndWalls& walls : side_walls_) deepest = std::max(deepest, walls.deepest_overlap());
    return deepest;
  }
  double bytes_per_grain() const { return end_walls_.bytes_per_grain(); }

 private:
  int sides() const { return static_cast<int>(side_walls_.size()); }
  EndWalls::Now end_walls_now() {
    if constexpr (Scene::driven)
      return EndWalls::now(scene_.walls_across(0), scene_.now);
    else
      return {scene_.now, scene_.box_now(), scene_.box.top_acceleration(), scene_.box.top_speed(), true};
  }
  EndWalls::Now side_walls_now(int axis) const {
    return EndWalls::now(scene_.walls_across(axis), scene_.now);
  }

  Scene& scene_;
  EndWalls end_walls_;
  std::vector<EndWalls> side_walls_;  // across y and z; empty: they are at rest
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
      if (all || across(axis).window_end() <= scene_.now)
        across(axis).open(side_walls_now(axis), along(axis));
}

template <class Scene>
void LoopWalls<Scene>::renew(double jump) {
  if (Scene::scripted) return;
  end_walls_.kicked(end_walls_now(), jump);
  if constexpr (Scene::driven)
    if (scene_.arc_curvature != 0)
      side_walls_[1].kicked(side_walls_now(2), 2 * scene_.arc_curvature * scene_.box_now().x * jump);
}

template <class Scene>
void LoopWalls<Scene>::after(int i, bool kick_follows) {
  if (Scene::scripted || !scene_.has_walls) return;
  const Flight3 flight = scene_.grains.flight(i);
  const EndWalls::Flight along{flight.x[0], flight.v[0], flight.time};
  if (kick_follows)
    end_walls_.grain_flies(i, along, end_walls_now());
  else
    end_walls_.grain_changed(i, along, end_walls_now());
  if constexpr (Scene::driven)
    for (int axis = 1; axis <= sides(); ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      across(axis).grain_changed(i, {flight.x[k], flight.v[k], flight.time}, side_walls_now(axis));
    }
}

}  // namespace shakedown
