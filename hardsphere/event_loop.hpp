// SPDX-License-Identifier: MIT
// The event loop: takes the earliest of what the grains and the walls announce, executes it, and asks those
// concerned for news. `Grains` finds pair and side-wall events (AllPairs for few grains, CellLists for many);
// EndWalls those with moving walls. `Motion` is the box: BoxMotion on its spring alone (the paper's damper,
// kept free of everything else), or DrivenBox with effects. Then grains are described in a frame that falls
// with them, and the side walls are EndWalls too where they move or attract.
#pragma once
#include <atomic>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "box_motion.hpp"
#include "end_walls.hpp"
#include "event_log.hpp"
#include "grain_event.hpp"
#include "hard_sphere_system.hpp"
#include "held_bonds.hpp"
#include "impact.hpp"
#include "open_book.hpp"
#include "wall_motion.hpp"

namespace shakedown {

template <class Grains, class Motion>
class EventLoop {
 public:
  static constexpr bool driven = std::is_same_v<Motion, DrivenBox>;
  /// Events come from a log: nothing is predicted, so nobody needs news.
  static constexpr bool scripted = requires { Grains::scripted; };

  EventLoop(const State& state, const Physics& physics, const Setup& setup, Grains grains);

  /// Executes every event before time t; returns false when `stop` was set.
  bool advance_to(double t, const std::atomic<bool>* stop = nullptr);
  /// Executes n more impacts (of any class).
  void advance_impacts(std::int64_t n);

  /// Every event from now on is written down there; the writer must outlive the loop.
  void write_events_to(EventWriter* writer) { writer_ = writer; }
  /// Executes an event of a log (scripted loops only).
  void execute(const LoggedEvent& event);
  /// Moves the clock on; no event of the log may lie before.
  void wait_until(double t) { now_ = t; }
  /// Of everything that the motion goes on from.
  std::uint64_t digest() const;

  double time() const { return now_; }
  /// At time().
  Observation observe();
  State state(double t) const;
  Ledger ledger() const;
  Health health() const;
  const std::array<std::int64_t, contact_classes>& collisions() const { return collisions_; }
  std::int64_t events() const { return events_; }
  double initial_energy() const { return initial_energy_; }
  /// Sum over pair impacts of impulse times distance, N s m: 3 N k T (Z - 1) times the time it was summed
  /// over.
  double virial() const { return virial_; }
  double bytes_per_grain() const { return grains_.bytes_per_grain() + end_walls_.bytes_per_grain(); }

 private:
  // The loop.
  void step(double limit);
  double next_event_time();
  void grain_event(int i);
  void wall_event(int axis, EndWalls& walls, const EndWalls::Next& next);
  void meet_wall(int axis, EndWalls& walls, const EndWalls::Next& next);
  void after(int i, bool kick_follows = false);
  void check_progress();
  void write_down(EventKind kind, int grain = 0, int partner = 0, int side = 1,
                  Meeting meeting = Meeting::touch) {
    if (writer_ != nullptr) [[unlikely]]
      if (writer_->add({now_, kind, grain, partner, side, meeting})) writer_->add_digest(digest());
  }

  // Impacts.
  void pair_impact(int i, int j);
  void pair_well(int i, int j, Meeting meeting);
  void fixed_side_impact(int i, std::int32_t face);
  void end_impact(int i, int side);
  void moving_side_impact(int i, int axis, int side);
  void wall_well(int i, int axis, int side, Meeting meeting, EndWalls& walls);
  void refuse(int i, Flight3 flight, EndWalls* walls);
  double restitution(ContactClass contact, double closing, double elastic_below, std::int64_t& rescues) const;
  double elastic_below(double limit, int i, int j = -1) const;
  bool rubs(double closing, double elastic_below, int i, int j = -1);
  void note_touch(std::uint64_t bond, double momentum, int i, int j = -1);
  void let_go();
  void kick_box(double jump);
  /// Two grains that meet now: both there, from the first to the second the vector r, and how fast they part
  /// along it.
  struct Pair {
    Flight3 a, b;
    std::array<double, 3> r;
    double distance, opening;
    double opening_rate;  ///< opening over distance, 1/s
  };
  Pair pair_now(int i, int j) const;
  void finish_pair(int i, int j, Pair& pair, double impulse_per_length);
  void finish_wall(int i, const Flight3& flight, double jump);

  // Walls.
  void open_windows();
  void renew_walls(double jump);
  DrivenWalls walls_across(int axis) const;
  EndWalls::Now end_walls_now();
  EndWalls& walls(int axis) {
    return axis == 0 ? end_walls_ : side_walls_[static_cast<std::size_t>(axis - 1)];
  }
  /// The box at now_ in the lab; several callers of one event share it.
  BoxMotion::Point box_now() {
    if (now_ != box_time_) {
      if constexpr (driven) {
        box_point_ = box_.at(now_);
      } else {
        const BoxMotion::PointAndImpulse here = box_.at_with_impulse(now_);
        box_point_ = here.point;
        spring_impulse_ = here.spring_impulse;
      }
      box_time_ = now_;
    }
    return box_point_;
  }

  // Effects between impacts.
  void kick_grains();
  void go_on();
  double air_speed_left(double speed, double mass, double h) const;
  void account(double t);
  void press_by_the_swing();

  // The ledger, with Neumaier's compensation: millions of small losses must not cost the closure its digits.
  void lose(std::size_t contact_class, double energy) {
    double& sum = ledger_.contact_loss[contact_class];
    const double next = sum + energy;
    ledger_rest_[contact_class] +=
        std::abs(sum) >= std::abs(energy) ? (sum - next) + energy : (energy - next) + sum;
    sum = next;
  }
  double total_loss() const;

  ContactLaw contact_;
  GrainForces forces_;
  ElasticLimits limits_, limits_at_release_;
  Grains grains_;
  Motion box_;
  double speed_at_release_;  // box's top speed then, m/s
  FallingFrame frame_;
  bool falling_, has_walls_, has_spring_;
  double arc_curvature_ = 0, release_x_ = 0;
  EndWalls end_walls_;
  // across y and z, where they move or attract; empty: fixed, found by Grains
  std::vector<EndWalls> side_walls_;
  std::vector<Vec3> spin_;       // empty without friction
  std::vector<double> touched_;  // latest impact of each grain, s; likewise
  HeldBonds held_;
  int attraction_effect_ = -1;  // its line in the ledger

  double now_ = 0, box_time_ = -1;
  BoxMotion::Point box_point_{};
  double spring_impulse_ = 0;  // since the last kick, at box_time_
  double kick_every_ = never, next_kick_ = never;

  Ledger ledger_;
  std::array<double, contact_classes> ledger_rest_{};
  std::array<std::int64_t, contact_classes> collisions_{};
  std::int64_t events_ = 0, refused_ = 0, elastic_walls_ = 0, elastic_pairs_ = 0, wells_ = 0, let_go_ = 0;
  double initial_energy_ = 0, initial_momentum_ = 0, outer_impulse_ = 0, virial_ = 0;
  double momentum_scale_;  // M Omega Delta0, or the sum of m |v| at release
  OpenBook energy_book_, momentum_book_;
  double grain_mass_ = 0, accounted_ = 0;
  Vec3 grain_momentum_ = Vec3::Zero();  // in the falling frame
  std::int64_t events_at_check_ = 0;
  double time_at_check_ = 0;
  EventWriter* writer_ = nullptr;
};

}  // namespace shakedown

#include "event_loop_effects.hpp"
#include "event_loop_impacts.hpp"
#include "event_loop_observe.hpp"
#include "event_loop_script.hpp"
#include "event_loop_start.hpp"
#include "event_loop_steps.hpp"
#include "event_loop_walls.hpp"
