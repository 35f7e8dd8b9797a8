// SPDX-License-Identifier: MIT
// What an event loop moves: the grains, the box and the frame in which the grains fly, at one moment.
#pragma once
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "box_motion.hpp"
#include "damper_state.hpp"
#include "errors.hpp"
#include "grain_event.hpp"
#include "wall_motion.hpp"

namespace shakedown {

/// Makes the box at the place and with the velocity of a state.
template <class Motion>
Motion make_box(const Physics& physics, const State& state) {
  if constexpr (std::is_same_v<Motion, DrivenBox>)
    return DrivenBox(physics, state.x_box, state.v_box);
  else
    return BoxMotion(physics.box_mass, physics.stiffness, state.x_box, state.v_box);
}

/// `Grains` finds pair and side-wall events; `Motion` is the box: BoxMotion on its spring alone (the paper's
/// damper, kept free of everything else), or DrivenBox with effects.
template <class Grains, class Motion>
class Scene {
 public:
  static constexpr bool driven = std::is_same_v<Motion, DrivenBox>;
  /// Events come from a log: nothing is predicted.
  static constexpr bool scripted = requires { Grains::scripted; };

  Scene(const State& state, const Physics& physics, const Setup& setup, Grains its_grains);

  /// Returns the box at `now` in the lab; the answer is kept for others who ask during one event.
  BoxMotion::Point box_now() {
    if (now != box_time_) {
      if constexpr (driven) {
        box_point_ = box.at(now);
      } else {
        const BoxMotion::PointAndImpulse here = box.at_with_impulse(now);
        box_point_ = here.point;
        spring_impulse_ = here.spring_impulse;
      }
      box_time_ = now;
    }
    return box_point_;
  }
  /// Returns the walls across an axis as the grains see them.
  DrivenWalls walls_across(int axis) const {
    if constexpr (driven)
      return {&box, &frame, axis, arc_curvature, release_x};
    else
      return {};
  }
  /// Returns the box's own velocity across (on its arc) now, in the lab, m/s.
  double speed_across() const { return walls_across(2).at(now).v + frame.velocity(now).z(); }

  /// Gives the box a velocity jump, m/s, at `now`; box_now() must have been asked for that moment.
  void kick_box(double jump) {
    const BoxMotion::Point here = box_now();
    box.restart(now, here.x, here.v + jump);
    ++flights;
    box_point_.v += jump;
    spring_impulse_ = 0;
  }
  /// Lets the box go on with the next piece of its motion.
  void next_piece_of_box() {
    box.go_on();
    ++flights;
    box_time_ = -1;
  }
  /// Returns the impulse of the spring alone from the last kick to the moment of box_now(), N s.
  double spring_impulse() const { return spring_impulse_; }

  /// Returns grains and box at time t, s: across the axis as seen from the box, along it as seen from the
  /// lab.
  State state(double t) const;

  double now = 0;            ///< s
  std::int64_t flights = 0;  ///< of the box, begun by kicks and pieces
  Grains grains;
  Motion box;
  const FallingFrame frame;
  const bool falling, has_walls, has_spring;
  const double arc_curvature, release_x;  ///< 1/m: 0.6 over the blade's length; m

 private:
  double box_time_ = -1;
  BoxMotion::Point box_point_{};
  double spring_impulse_ = 0;
};

template <class Grains, class Motion>
Scene<Grains, Motion>::Scene(const State& state, const Physics& physics, const Setup& setup,
                             Grains its_grains)
    : grains(std::move(its_grains)),
      box(make_box<Motion>(physics, state)),
      frame(physics.grains),
      falling(!frame.at_rest()),
      has_walls(setup.domain != Domain::periodic),
      has_spring(setup.domain == Domain::damper),
      arc_curvature(physics.grains.arc_length != 0 ? 0.6 / physics.grains.arc_length : 0),
      release_x(state.x_box) {
  EXPECT(driven || (!falling && !physics.contact.has_attraction() && arc_curvature == 0));
  if (const double across = 2 * arc_curvature * state.x_box * state.v_box; across != 0)
    for (int i = 0; i < grains.size(); ++i) {  // states are as seen from the box, flights are in the lab
      Flight3 flight = grains.flight(i);
      flight.v[2] += across;
      grains.move_to(i, flight);
    }
}

template <class Grains, class Motion>
State Scene<Grains, Motion>::state(double t) const {
  State state;
  const Vec3 frame_x = frame.displacement(t), frame_v = frame.velocity(t);
  for (int i = 0; i < grains.size(); ++i) {
    Flight3 flight = grains.flight(i);
    flight.advance(t);
    state.position.push_back(Vec3(flight.x[0], flight.x[1], flight.x[2]) + frame_x);
    state.velocity.push_back(Vec3(flight.v[0], flight.v[1], flight.v[2]) + frame_v);
    state.radius.push_back(grains.radius(i));
    state.mass.push_back(grains.mass(i));
  }
  const BoxMotion::Point here = box.at(t);
  state.x_box = here.x;
  state.v_box = here.v;
  for (std::size_t i = 0; arc_curvature != 0 && i < state.size(); ++i) {
    state.position[i].z() -= arc_curvature * (here.x * here.x - release_x * release_x);
    state.velocity[i].z() -= 2 * arc_curvature * here.x * here.v;
  }
  return state;
}

}  // namespace shakedown
