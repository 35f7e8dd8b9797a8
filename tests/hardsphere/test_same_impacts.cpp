// SPDX-License-Identifier: MIT
// Whatever finds the next event, it is the same event: pairs tested one and all, neighbour lists of any
// shell, end walls watched by every grain or through windows.
#include <gtest/gtest.h>

#include <cstdio>

#include "all_pairs.hpp"
#include "cell_crossings.hpp"
#include "cell_lists.hpp"
#include "driven_box.hpp"
#include "event_loop.hpp"
#include "fluid.hpp"
#include "initial_state.hpp"
#include "random.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

EventLoop<AllPairs, BoxMotion> with_all_pairs(const shakedown::Setup& setup, const State& state) {
  return {state, physics_of(setup), setup, AllPairs(state, {setup.box.width[0] / 2, setup.box.width[1] / 2})};
}

template <bool Periodic>
EventLoop<CellLists<Periodic>, BoxMotion> with_lists(const shakedown::Setup& setup, const State& state,
                                                     double shell) {
  CellListsPlan plan{
      {setup.box.length, setup.box.width[0], setup.box.width[1]}, Periodic, {never, never}, 0.4, shell};
  if (!Periodic) plan.half_width = {setup.box.width[0] / 2, setup.box.width[1] / 2};
  return {state, physics_of(setup), setup, CellLists<Periodic>(state, plan)};
}

EventLoop<CellCrossings, BoxMotion> with_crossings(const shakedown::Setup& setup, const State& state,
                                                   double edge) {
  return {state, physics_of(setup), setup,
          CellCrossings(state, {setup.box.length, setup.box.width[0], setup.box.width[1]}, edge)};
}

/// Impact for impact the same time and class; at the end the same state.
template <class A, class B>
void expect_same_impacts(A a, B b, std::int64_t impacts, const Vec3& cell) {
  for (std::int64_t n = 0; n < impacts; ++n) {
    a.advance_impacts(1);
    b.advance_impacts(1);
    ASSERT_WITHIN(a.time(), b.time(), 1e-10, 6.3e-12) << "impact " << n;
    ASSERT_EQ(a.collisions(), b.collisions()) << "impact " << n;
  }
  const State left = a.state(a.time()), right = b.state(a.time());
  double worst = 0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    Vec3 apart = left.position[i] - right.position[i];
    for (int axis = 0; axis < 3; ++axis) apart[axis] = std::remainder(apart[axis], cell[axis]);
    worst = std::max({worst, apart.norm(), (left.velocity[i] - right.velocity[i]).norm()});
  }
  worst = std::max({worst, std::abs(left.x_box - right.x_box), std::abs(left.v_box - right.v_box)});
  std::printf("%lld impacts of %zu grains: states differ by %.1e\n", static_cast<long long>(impacts),
              left.size(), worst);
  EXPECT_LE(worst, 1e-9);
}

shakedown::Setup closed_box(double restitution) {
  shakedown::Setup setup;
  setup.domain = Domain::closed;
  setup.grains.count = 200;
  setup.box.length = 0.07;
  setup.box.width = {0.08, 0.09};
  setup.restitution = {restitution, restitution};
  setup.release.packing = Packing::random;
  return setup;
}

TEST(SameImpacts, PairByPairAndThroughLists) {
  const Vec3 open = Vec3::Constant(1e9);
  for (const double restitution : {1.0, 0.8}) {
    const shakedown::Setup setup = closed_box(restitution);
    const State state = initial_state(setup);
    expect_same_impacts(with_all_pairs(setup, state), with_lists<false>(setup, state, 0), 200, open);
    expect_same_impacts(with_all_pairs(setup, state), with_lists<false>(setup, state, 1.2), 200, open);
  }
  shakedown::Setup damper;
  damper.release.kinetic_energy_fraction = 1e-2;
  const State state = initial_state(damper);
  expect_same_impacts(with_all_pairs(damper, state), with_lists<false>(damper, state, 0), 37, open);
}

TEST(SameImpacts, WithGrainsOfDifferentSizes) {
  const shakedown::Setup setup = closed_box(0.9);
  State state = initial_state(setup);
  Random random(3, 0, Stream::diameters);
  for (std::size_t i = 0; i < state.size(); ++i) {
    state.radius[i] *= 0.5 + 0.5 * random.uniform();
    state.mass[i] *= std::pow(state.radius[i] / 0.005, 3);
  }
  expect_same_impacts(with_all_pairs(setup, state), with_lists<false>(setup, state, 0), 200,
                      Vec3::Constant(1e9));
}

TEST(SameImpacts, ThroughListsOfAnyShellInAPeriodicCell) {
  for (const double packing_fraction : {0.1, 0.45}) {
    const shakedown::Setup setup = periodic_fluid(1000, packing_fraction);
    const State state = initial_state(setup);
    expect_same_impacts(with_lists<true>(setup, state, 1.3), with_lists<true>(setup, state, 2.4), 1000,
                        Vec3::Constant(setup.box.length));
  }
}

TEST(SameImpacts, ThroughCellsOfAnyWidthAndThroughLists) {
  for (const double packing_fraction : {0.05, 0.2, 0.45})
    for (const double edge : {0.0, 1.3, 3.2}) {  // 3.2: three cells across
      shakedown::Setup setup = periodic_fluid(256, packing_fraction);
      const State state = initial_state(setup);
      expect_same_impacts(with_lists<true>(setup, state, 1.4), with_crossings(setup, state, edge), 400,
                          Vec3::Constant(setup.box.length));
    }
  // cells that are no cubes; grains thrown far out of the cell they are described in
  shakedown::Setup setup = periodic_fluid(500, 0.2);
  setup.box.length *= 3;
  setup.box.width[0] /= 2;
  State state = initial_state(setup);
  for (std::size_t i = 0; i < state.size(); i += 3) state.position[i].x() += 5 * setup.box.length;
  expect_same_impacts(with_lists<true>(setup, state, 1.3), with_crossings(setup, state, 0), 500,
                      Vec3(setup.box.length, setup.box.width[0], setup.box.width[1]));
}

/// Cells one diameter wide would be 1e12 of them.
TEST(SameImpacts, OfADiluteGasNeedNoCellsForEmptySpace) {
  shakedown::Setup setup = periodic_fluid(100, 0.1);
  setup.box.length = setup.box.width[0] = setup.box.width[1] = 1e4;
  setup.release.packing = Packing::fcc;
  HardSphereSystem gas(setup);
  EXPECT_LT(gas.bytes_per_grain(), 1e6);
  // Neighbours on the lattice are 2400 m apart.
  EXPECT_TRUE(gas.advance_to(10));
  EXPECT_EQ(gas.collisions()[0], 0);
  State near = gas.state();
  for (std::size_t i = 0; i < near.size(); i += 2) {
    near.position[i + 1] = near.position[i] + Vec3(1.5, 0, 0);
    near.velocity[i] = Vec3(1, 0, 0);
    near.velocity[i + 1] = Vec3(-1, 0, 0);
  }
  HardSphereSystem pairs(setup, near);
  EXPECT_TRUE(pairs.advance_to(1));
  EXPECT_EQ(pairs.collisions()[0], 50);
}

TEST(SameImpacts, NeedAPeriodOfThreeGrains) {
  shakedown::Setup setup = periodic_fluid(20, 0.1);
  for (const double width : {1.5, 2.9, 3.0}) {
    setup.box.width[0] = width;
    setup.box.length = 100;
    EXPECT_THROW(HardSphereSystem{setup}, InputError) << width;
  }
  setup.box.width[0] = 3.1;
  EXPECT_NO_THROW(HardSphereSystem{setup}.advance_impacts(20));
  setup.grains.count = 0;
  EXPECT_THROW(HardSphereSystem{setup}, InputError);
}

// --- End walls alone: grains that do not meet each other, thrown about now and then, in a box that feels
// every impact. ----------------

struct WallImpact {
  double time;
  int grain, side;
};

/// A pair impact's effect, made up: at `time` a grain gets a new velocity.
struct Throw {
  double time, v;
  int grain;
};

constexpr double room = 0.05, top_throw = 0.6;

template <class Motion>
struct Crowd {
  std::vector<EndWalls::Flight> flights;
  std::vector<Throw> throws;
  double mass;  // of a grain, kg
  Motion box;

  Crowd(int grains, double grain_mass, const Motion& at_release) : mass(grain_mass), box(at_release) {
    Random random(9, 0, Stream::other);
    for (int i = 0; i < grains; ++i)
      flights.push_back(
          {0.1075 + 2 * room * (random.uniform() - 0.5), top_throw * (2 * random.uniform() - 1), 0});
    for (double time = 0; throws.size() < 4000; time -= std::log(random.uniform()) / (10.0 * grains))
      throws.push_back(
          {time, top_throw * (2 * random.uniform() - 1), static_cast<int>(random.uniform() * grains)});
  }

  EndWalls::Flight& fly(int i, double now) {
    EndWalls::Flight& flight = flights[static_cast<std::size_t>(i)];
    flight = {flight.x + flight.v * (now - flight.time), flight.v, now};
    return flight;
  }
  /// Elastic; returns the jump of the box's velocity.
  double impact(const WallImpact& hit) {
    EndWalls::Flight& flight = fly(hit.grain, hit.time);
    const BoxMotion::Point at = box.at(hit.time);
    const double impulse = 2 * mass * box.mass() / (mass + box.mass()) * (flight.v - at.v);
    flight.v -= impulse / mass;
    box.restart(hit.time, at.x, at.v + impulse / box.mass());
    return impulse / box.mass();
  }
};

template <class Motion>
std::vector<WallImpact> impacts_by_end_walls(Crowd<Motion> crowd, bool watch_all, std::size_t count,
                                             std::size_t& most_watched) {
  EndWalls walls(std::vector<double>(crowd.flights.size(), room), watch_all);
  const auto flight_of = [&](int i) { return crowd.flights[static_cast<std::size_t>(i)]; };
  walls.open(EndWalls::now(crowd.box, 0), flight_of);
  std::vector<WallImpact> impacts;
  std::size_t windows = 0, watched = 0;
  for (std::size_t next_throw = 0; impacts.size() < count;) {
    const Throw& thrown = crowd.throws.at(next_throw);
    const double earliest = std::min(walls.next().time, thrown.time), piece_end = crowd.box.valid_until();
    if (piece_end <= std::min(earliest, walls.window_end())) {
      if constexpr (std::is_same_v<Motion, DrivenBox>) crowd.box.go_on();
      walls.kicked(EndWalls::now(crowd.box, piece_end), 0);
    } else if (walls.window_end() <= earliest) {
      walls.open(EndWalls::now(crowd.box, walls.window_end()), flight_of);
      watched += walls.watched();
      ++windows;
    } else if (thrown.time <= walls.next().time) {
      crowd.fly(thrown.grain, thrown.time).v = thrown.v;
      walls.grain_changed(thrown.grain, flight_of(thrown.grain), EndWalls::now(crowd.box, thrown.time));
      ++next_throw;
    } else if (walls.next().meeting == Meeting::none) {
      walls.refine(crowd.box, std::min(thrown.time, piece_end));
    } else {
      const WallImpact hit{walls.next().time, walls.next().grain, walls.next().side};
      impacts.push_back(hit);
      const double jump = crowd.impact(hit);
      walls.grain_changed(hit.grain, flight_of(hit.grain), EndWalls::now(crowd.box, hit.time));
      walls.kicked(EndWalls::now(crowd.box, hit.time), jump);
    }
  }
  EXPECT_LE(walls.deepest_overlap(), 1e-15);
  most_watched = windows > 0 ? watched / windows : crowd.flights.size();
  return impacts;
}

/// The plain way: an exact root for every grain and side after every event.
std::vector<WallImpact> impacts_by_brute_force(Crowd<BoxMotion> crowd, std::size_t count) {
  std::vector<WallImpact> impacts;
  double now = 0;
  for (std::size_t next_throw = 0; impacts.size() < count;) {
    WallImpact first{never, -1, 0};
    const BoxMotion::Point at = crowd.box.at(now);
    const double w = crowd.box.angular_frequency();
    for (int i = 0; i < static_cast<int>(crowd.flights.size()); ++i) {
      const EndWalls::Flight& flight = crowd.fly(i, now);
      for (const int side : {1, -1}) {
        const double time =
            now + first_wall_root({side * at.x, side * at.v / w, w, room - side * flight.x, side * flight.v});
        if (time < first.time) first = {time, i, side};
      }
    }
    const Throw& thrown = crowd.throws.at(next_throw);
    now = std::min(first.time, thrown.time);
    if (thrown.time <= first.time) {
      crowd.fly(thrown.grain, now).v = thrown.v;
      ++next_throw;
    } else {
      crowd.impact(first);
      impacts.push_back(first);
    }
  }
  return impacts;
}

TEST(SameImpacts, AtEndWallsWatchedByAllThroughWindowsAndByBruteForce) {
  const Crowd crowd(700, 1e-5, BoxMotion(0.434, 25.92, 0.1075, 0));
  const std::size_t count = 250;
  std::size_t of_all = 0, of_windows = 0;
  const auto brute = impacts_by_brute_force(crowd, count),
             all = impacts_by_end_walls(crowd, true, count, of_all),
             windows = impacts_by_end_walls(crowd, false, count, of_windows);
  for (std::size_t n = 0; n < count; ++n)
    for (const WallImpact& seen : {all[n], windows[n]}) {
      ASSERT_WITHIN(seen.time, brute[n].time, 5e-14, 2.6e-15) << n;  // second
      ASSERT_EQ(seen.grain, brute[n].grain) << n;
      ASSERT_EQ(seen.side, brute[n].side) << n;
    }
  std::printf("%zu impacts in %.3f s, %zu of 700 grains watched in a window\n", count, brute.back().time,
              of_windows);
  EXPECT_LT(of_windows, 350u);
}

/// A box that sticks and slides, and one on a cubic spring: what holds on one piece of their motion may not
/// on the next. Light grains kick little, so windows get longer than pieces.
TEST(SameImpacts, AtEndWallsOfADrivenBoxThroughWindows) {
  Physics sticks, cubic;
  sticks.box_mass = cubic.box_mass = 0.434;
  sticks.stiffness = cubic.stiffness = 25.92;
  sticks.box.dry_friction.add(2, 0);  // N; the spring pulls with 2.8 N at release
  sticks.box.harmonics.push_back({1.5, 3, 0, -1});
  cubic.spring_cubic = 50;
  for (const Physics& physics : {sticks, cubic}) {
    const Crowd crowd(700, 1e-9, DrivenBox(physics, 0.1075, 0));
    const std::size_t count = 1500;
    std::size_t of_all = 0, of_windows = 0;
    const auto all = impacts_by_end_walls(crowd, true, count, of_all),
               windows = impacts_by_end_walls(crowd, false, count, of_windows);
    for (std::size_t n = 0; n < count; ++n) {
      ASSERT_WITHIN(windows[n].time, all[n].time, 1e-12, 5.2e-14) << n;  // second
      ASSERT_EQ(windows[n].grain, all[n].grain) << n;
      ASSERT_EQ(windows[n].side, all[n].side) << n;
    }
    std::printf("%zu impacts in %.3f s, %zu of 700 grains watched in a window\n", count, all.back().time,
                of_windows);
    EXPECT_LT(of_windows, 500u);
  }
}

}  // namespace
