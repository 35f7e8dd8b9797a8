// SPDX-License-Identifier: MIT
// One ball in the box under each effect that acts on grains, in every engine that models it, against closed
// forms.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "setups.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

using std::numbers::pi;
constexpr double mass = 4.04e-3, radius = 0.005;
const double w0 = 2 * pi * 1.23;

/// A large box at rest, too heavy to notice the ball.
shakedown::Setup large_box(double duration) {
  shakedown::Setup setup;
  setup.release.displacement = 0;
  setup.box.length = 1;
  setup.box.width[0] = setup.box.width[1] = 0.5;
  setup.run.duration = duration;
  return setup;
}

void in_every_engine(const shakedown::Setup& setup, const PlacedGrain& ball, double ledger,
                     const std::function<void(const Trajectory&, bool hard)>& check) {
  for (const EngineUnderTest& tested : engines_that_model(setup.effects.front().record->name)) {
    SCOPED_TRACE(tested.name);
    const Trajectory result = run_with(*tested.make(), setup, {ball});
    EXPECT_LE(result.health.ledger_error, ledger);
    EXPECT_LE(result.health.momentum_error, 1e-12);
    check(result, tested.name == "hard");
  }
}

void expect_near(const Vec3& one, const Vec3& other, Tolerance within) {
  for (int axis = 0; axis < 3; ++axis) WITHIN(one[axis], other[axis], within) << "xyz"[axis];
}

}  // namespace

TEST(Ball, FliesParabolasInConstantAcceleration) {
  const Vec3 a(0.3, -0.2, 0.1), x(0.1, 0.05, -0.1), v(-0.2, 0.1, 0.15);
  shakedown::Setup setup = large_box(1.2);
  add_effect(setup, "constant_acceleration", {{"acceleration", a}});
  in_every_engine(setup, {x, v}, 1e-11, [&](const Trajectory& result, bool) {
    for (std::size_t k = 0; k < result.time.size(); ++k) {
      const double t = result.time[k];
      WITHIN(result.x_com[k], x.x() + v.x() * t + a.x() * t * t / 2, 2e-12, 1.8e-13);
      WITHIN(result.x_box[k], a.x() / (w0 * w0) * (1 - std::cos(w0 * t)), 6e-15, 3.2e-16);
    }
    expect_near(result.end_state.position[0], x + 1.2 * v + 0.72 * a, {2e-12, 2.1e-13});
    expect_near(result.end_state.velocity[0], v + 1.2 * a, {2e-12, 2.1e-13});
  });
}

TEST(Ball, FollowsAHarmonicAcceleration) {
  const Vec3 a(2, -1, 0.5), x(0.1, 0.05, -0.1), v(-0.2, 0.1, 0.1);
  const double f = 3, phase = 0.7, w = 2 * pi * f;
  shakedown::Setup setup = large_box(1);
  add_effect(setup, "oscillating_acceleration", {{"amplitude", a}, {"frequency", f}, {"phase", phase}});
  in_every_engine(setup, {x, v}, 1e-11, [&](const Trajectory& result, bool) {
    const auto swing = [&](double t) {
      return (std::cos(phase) * t + (std::sin(phase) - std::sin(w * t + phase)) / w) / w;
    };
    for (std::size_t k = 0; k < result.time.size(); ++k)
      WITHIN(result.x_com[k], x.x() + v.x() * result.time[k] + a.x() * swing(result.time[k]), 4e-12, 2e-13);
    expect_near(result.end_state.position[0], x + v + a * swing(1), {5e-12, 1.2e-12});
    expect_near(result.end_state.velocity[0], v + a * (std::cos(phase) - std::cos(w + phase)) / w,
                {5e-12, 1.2e-12});
  });
}

TEST(Ball, BouncesOnASideWallUnderGravity) {
  const double g = 1, height = 0.005, fall = std::sqrt(2 * height / g), e = 0.76;
  shakedown::Setup setup = large_box(fall + e * fall);  // the top of the first bounce
  add_effect(setup, "constant_acceleration", {{"acceleration", Vec3(0, 0, -g)}});
  in_every_engine(setup, {{0, 0, -0.25 + radius + height}, {0, 0, 0}}, 1e-9,
                  [&](const Trajectory& result, bool hard) {
                    EXPECT_EQ(result.collisions[2], 1);
                    WITHIN(result.ledger.contact_loss[2] / (mass * g * height), 1 - e * e,
                           hard ? Tolerance(4e-15, 2.3e-16) : Tolerance(1e-2, 2.1e-3));
                    WITHIN(result.end_state.position[0].z(), -0.25 + radius + e * e * height,
                           hard ? Tolerance(1e-15, 5.5e-17) : Tolerance(1e-4, 1.1e-5));
                  });
}

/// Slow impacts are made elastic where layers are pressed on walls, not where a grain hops alone.
TEST(Ball, LosesAtEachOfItsLowHopsWhatTheLawSays) {
  const double g = 1, height = 2e-4, fall = std::sqrt(2 * height / g), e = 0.76;
  shakedown::Setup setup = large_box(fall * (1 + 2 * e + 2 * e * e + e * e * e));  // the top of the third hop
  add_effect(setup, "constant_acceleration", {{"acceleration", Vec3(0, 0, -g)}});
  in_every_engine(setup, {{0, 0, -0.25 + radius + height}, {0, 0, 0}}, 1e-9,
                  [&](const Trajectory& result, bool hard) {
                    EXPECT_EQ(result.collisions[2], 3);
                    WITHIN(result.ledger.contact_loss[2] / (mass * g * height), 1 - std::pow(e, 6),
                           hard ? Tolerance(2e-13, 2.1e-14) : Tolerance(1e-2, 9.9e-4));
                  });
}

TEST(Ball, BouncesOnTheEndWallOfTheBoxThatFallsWithIt) {
  // Both accelerate along the axis; the box is held back by its spring, so the ball falls towards its wall.
  const double a = 0.4;
  const auto gap = [&](double t) { return 0.005 + a / (w0 * w0) * (1 - std::cos(w0 * t)) - a * t * t / 2; };
  double low = 0.05, high = 0.6;
  for (int i = 0; i < 100; ++i) (gap((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
  shakedown::Setup setup = large_box(low + 0.02);
  setup.box.length = 0.02;
  add_effect(setup, "constant_acceleration", {{"acceleration", Vec3(a, 0, 0)}});
  in_every_engine(setup, {{0, 0, 0}, {0, 0, 0}}, 1e-10, [&](const Trajectory& result, bool hard) {
    ASSERT_EQ(result.collisions[1], 1);
    std::size_t k = 0;
    while (result.loss[1][k] == 0) ++k;
    WITHIN(result.time[k], low, 2e-3, 1.6e-3);  // a sample
    const double closing = a * low - a / w0 * std::sin(w0 * low), reduced = mass * 0.434 / (mass + 0.434);
    WITHIN(result.ledger.contact_loss[1] / (reduced / 2 * closing * closing), 1 - 0.76 * 0.76,
           hard ? Tolerance(1.3e-14, 6.7e-16) : Tolerance(2e-2, 1.7e-3));
  });
}

TEST(Ball, ReachesItsTerminalSpeed) {
  const double g = 2;
  shakedown::Setup setup = large_box(0.5);
  const PlacedGrain ball{{0, 0, 0.2}, {0, 0, 0}};
  const double rate = 0.08 / mass;
  add_effect(setup, "grain_air_drag", {{"linear", 0.08}});
  add_effect(setup, "constant_acceleration", {{"acceleration", Vec3(0, 0, -g)}});
  in_every_engine(setup, ball, 1e-9, [&](const Trajectory& result, bool) {
    const double terminal = g / rate, t = result.end_time;
    WITHIN(-result.end_state.velocity[0].z() / terminal, 1 - std::exp(-rate * t), 2e-3, 1.4e-4);
    WITHIN((0.2 - result.end_state.position[0].z()) / (terminal * (t - (1 - std::exp(-rate * t)) / rate)), 1,
           1e-3, 1.2e-4);
  });
  shakedown::Setup quadratic = large_box(0.5);
  add_effect(quadratic, "grain_air_drag", {{"quadratic", 0.2}});
  add_effect(quadratic, "constant_acceleration", {{"acceleration", Vec3(0, 0, -g)}});
  in_every_engine(quadratic, ball, 1e-9, [&](const Trajectory& result, bool) {
    const double terminal = std::sqrt(mass * g / 0.2), t = result.end_time;
    WITHIN(-result.end_state.velocity[0].z() / terminal, std::tanh(g * t / terminal), 1e-3, 5e-5);
    WITHIN((0.2 - result.end_state.position[0].z()) /
               (terminal * terminal / g * std::log(std::cosh(g * t / terminal))),
           1, 8e-4, 4e-5);
  });
}

TEST(Ball, DragDecaysExponentiallyAndTheBoxFeelsIt) {
  shakedown::Setup setup = large_box(1);
  const double rate = 0.01 / mass, v = 0.4;
  add_effect(setup, "grain_air_drag", {{"linear", 0.01}});
  setup.box.mass = 1e4;  // the air stays at rest
  in_every_engine(setup, {{-0.3, 0, 0}, {v, 0, 0}}, 1e-9, [&](const Trajectory& result, bool) {
    for (std::size_t k = 0; k < result.time.size(); ++k)
      WITHIN(result.x_com[k], -0.3 + v / rate * (1 - std::exp(-rate * result.time[k])), 1e-6, 3.1e-7);
    const double swing =
        (rate * std::cos(w0) + w0 * std::sin(w0) - rate * std::exp(-rate)) / (rate * rate + w0 * w0);
    WITHIN(result.v_box.back() / (0.01 * v / 1e4 * swing), 1, 2e-4, 1.2e-5);
  });
}

TEST(Ball, IsDraggedAlongByTheAirOfASwingingBoxToSecondOrderInTheKicks) {
  // v' = -g (v - V), V = -A w sin(w t), from rest.
  const double amplitude = 0.1, g = 0.01 / mass, t = 1;
  shakedown::Setup setup = large_box(t);
  setup.release.displacement = amplitude;
  setup.box.mass = 1e6;  // the ball does not slow it
  add_effect(setup, "grain_air_drag", {{"linear", 0.01}});
  const double swing = amplitude * w0 * g / (g * g + w0 * w0);
  const double end =
      swing * (g / w0 * (std::cos(w0 * t) - 1) + std::sin(w0 * t) - w0 / g * (1 - std::exp(-g * t)));
  std::vector<double> errors;
  for (const double interval : {2e-2, 1e-2, 5e-3}) {
    setup.hard.kick_interval = interval;
    for (const EngineUnderTest& tested : engines_that_model("grain_air_drag"))
      if (tested.name == "hard")
        errors.push_back(
            std::abs(run_with(*tested.make(), setup, {{{amplitude, 0, 0}, {0, 0, 0}}}).x_com.back() -
                     amplitude - end));
  }
  ASSERT_EQ(errors.size(), 3);
  EXPECT_LT(errors[0], 5e-4);
  WITHIN(errors[0] / errors[1], 4, 0.02, 0.004);
  WITHIN(errors[1] / errors[2], 4, 0.005, 8.5e-4);
}

TEST(Ball, FollowsAFormulaOfTime) {
  shakedown::Setup setup = large_box(0.5);
  add_effect(setup, "user_force", {{"on", std::string("grains")}, {"force", std::string("0.004*sin(10*t)")}});
  in_every_engine(setup, {{0, 0, 0}, {0, 0, 0}}, 1e-9, [&](const Trajectory& result, bool) {
    const double a = 0.004 / mass;
    for (std::size_t k = 0; k < result.time.size(); ++k) {
      const double t = result.time[k];
      WITHIN(result.x_com[k], a * (t / 10 - std::sin(10 * t) / 100), 2e-6, 6.7e-7);
    }
  });
}

TEST(Ball, SlidesAcrossAndComesToRollAtFiveSevenths) {
  // Angular momentum about the points of contact is kept, so whatever the impacts were: v = 5/7 v0. Across
  // the axis, where the box cannot give way.
  const double v = 0.3;
  shakedown::Setup setup = large_box(0.6);
  add_effect(setup, "grain_friction", {{"grain_wall", 0.5}, {"tangential_restitution", 0.0}});
  add_effect(setup, "constant_acceleration", {{"acceleration", Vec3(0, 0, -9.81)}});
  in_every_engine(setup, {{0, -0.2, -0.25 + radius + 0.002}, {0, v, 0}}, 1e-9,
                  [&](const Trajectory& result, bool hard) {
                    WITHIN(result.end_state.velocity[0].y() / v, 5.0 / 7,
                           hard ? Tolerance(3e-15, 1.6e-16) : Tolerance(1e-3, 5.6e-4));
                    WITHIN(result.end_state.spin[0].x() * radius / v, -5.0 / 7,
                           hard ? Tolerance(3e-15, 1.6e-16) : Tolerance(1e-2, 5.5e-4));
                  });
}

TEST(Ball, MeetsTheSideWallThatTheArcBringsItWhenTheFormulaSays) {
  // Seen from the box the ball at rest accelerates by -(6/5)(v^2 + x a)/l = -(3/5) (x^2)''/l.
  const double l = 0.59, start = 0.1075, room = 0.008;
  shakedown::Setup setup = large_box(0.25);
  setup.release.displacement = start;
  setup.run.sample_rate = 20000;
  add_effect(setup, "blade_arc", {{"blade_length", l}});
  const PlacedGrain ball{{start, 0, 0.25 - radius - room}, {0, 0, 0}};
  const double meets = std::acos(std::sqrt(1 - room * l / 0.6 / (start * start))) / w0;
  in_every_engine(setup, ball, 1e-9, [&](const Trajectory& result, bool hard) {
    ASSERT_EQ(result.collisions[2], 1);
    std::size_t k = 0;
    while (result.loss[2][k] == 0) ++k;
    WITHIN(result.time[k], meets, 1e-4, 4.8e-5);
    const double wall = 0.6 / l * start * start * w0 * std::sin(2 * w0 * meets);  // speed of the box across
    WITHIN(result.ledger.contact_loss[2] / (mass / 2 * wall * wall), 1 - 0.76 * 0.76,
           hard ? Tolerance(4e-15, 2.3e-16) : Tolerance(1e-2, 6.5e-4));
  });
  setup.run.duration = 0.9 * meets;
  in_every_engine(setup, ball, 1e-9, [&](const Trajectory& result, bool hard) {
    const double x = result.end_state.x_box, u = result.end_state.v_box;
    WITHIN(result.end_state.position[0].z(), 0.25 - radius - room + 0.6 / l * (start * start - x * x),
           hard ? Tolerance(1e-15, 5.5e-17) : Tolerance(2e-6, 5.6e-7));
    WITHIN(result.end_state.velocity[0].z(), -1.2 / l * x * u, 4e-15, 2e-16);
  });
}

/// Seen from the box, whatever way it goes.
TEST(Ball, StartsWithItsVelocityAcrossOnTheArcOfAPushedBox) {
  const double l = 0.59, push = 0.4, across = 0.03, t = 0.1;
  shakedown::Setup setup = large_box(t);
  setup.release.displacement = 0.1;
  setup.box.mass = 1e6;  // the ball does not slow it
  add_effect(setup, "blade_arc", {{"blade_length", l}});
  add_effect(setup, "initial_box_velocity", {{"velocity", push}});
  in_every_engine(setup, {{0.1, 0, 0}, {0, 0, across}}, 1e-9, [&](const Trajectory& result, bool hard) {
    const double x = result.end_state.x_box, u = result.end_state.v_box;
    WITHIN(result.end_state.velocity[0].z(), across - 1.2 / l * (x * u - 0.1 * push), 5e-15, 5e-16);
    WITHIN(result.end_state.position[0].z(), (across + 1.2 / l * 0.1 * push) * t - 0.6 / l * (x * x - 0.01),
           hard ? Tolerance(3e-17, 1.8e-18) : Tolerance(2e-6, 1.1e-6));
  });
}

/// The air goes with the box also across: thick enough, it takes the ball with it.
TEST(Ball, IsDraggedAlongTheArcOfTheBox) {
  shakedown::Setup setup = large_box(0.3);
  setup.release.displacement = 0.1;
  setup.box.mass = 1e6;
  setup.hard.kick_interval = 2.5e-4;
  add_effect(setup, "blade_arc", {{"blade_length", 0.59}});
  add_effect(setup, "grain_air_drag", {{"linear", 0.4}});  // 10 ms
  std::vector<double> across;
  for (const EngineUnderTest& tested : engines_that_model("grain_air_drag")) {
    const Trajectory result = run_with(*tested.make(), setup, {{{0.1, 0, 0}, {0, 0, 0}}});
    EXPECT_LE(result.health.ledger_error, 3e-13) << tested.name;
    EXPECT_GT(result.ledger.effect_loss[1], 0) << tested.name;
    across.push_back(result.end_state.velocity[0].z());
    EXPECT_LT(std::abs(across.back()), 0.01) << tested.name;  // 0.07 in the lab
  }
  ASSERT_EQ(across.size(), 2u);
  WITHIN(across[0], across[1], 1e-6, 9.5e-8);
}

/// A ball that falls from rest and bounces, looked at only when it rests again at the height that the bounce
/// left: no sample has any energy, and the book closes to rounding all the same.
TEST(Ball, MayRestWheneverOneLooks) {
  const double drop = 0.1, g = 9.81, fall = std::sqrt(2 * drop / g), bounce = 0.76;
  const Vec3 start(0, 0, -0.25 + radius + drop);
  for (const EngineUnderTest& tested : engines_that_model("constant_acceleration")) {
    SCOPED_TRACE(tested.name);
    shakedown::Setup setup = large_box(fall * (1 + bounce));
    add_effect(setup, "constant_acceleration", {{"acceleration", Vec3(0, 0, -g)}});
    if (tested.name == "soft") setup.run.duration += setup.soft.contact_time;
    setup.run.sample_rate = 1 / setup.run.duration;
    const Trajectory result = run_with(*tested.make(), setup, {{start, Vec3::Zero()}});
    EXPECT_EQ(result.collisions[2], 1);
    WITHIN(result.end_state.position[0].z(), start.z() - drop * (1 - bounce * bounce), 4e-4, 2.2e-5);
    EXPECT_LE(result.health.ledger_error, checked_tolerance(5e-12, 4.3e-13));
  }
}
