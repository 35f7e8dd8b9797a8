// SPDX-License-Identifier: MIT
// What acts on box and grains beside spring and plain contacts, against closed forms. Effects are written
// into the physics directly, so these are tests of the engine, not of the effects' records.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "scratch_folder.hpp"
#include "soft_engine.hpp"

using namespace shakedown;

namespace {

using Apply = void (*)(const EffectChoice&, int, Physics&);

class SoftEffects : public ::testing::Test {
 protected:
  /// A setup with effects as they would come from records.
  shakedown::Setup with(std::vector<Apply> effects) {
    shakedown::Setup setup;
    setup.run.duration = 1;
    for (const Apply apply : effects) {
      auto record = std::make_unique<EffectRecord>();
      record->name = "test_effect";
      record->soft = {Fidelity::exact, ""};
      record->apply = apply;
      setup.effects.push_back({record.get(), {}, {}});
      records.push_back(std::move(record));
    }
    return setup;
  }

  shakedown::Setup empty_box(std::vector<Apply> effects) {
    shakedown::Setup setup = with(std::move(effects));
    setup.grains.count = 0;
    return setup;
  }

  /// Grains x, y, z, vx, vy, vz in a closed cube of 0.2 m.
  shakedown::Setup closed_cube(std::vector<Apply> effects, const std::vector<std::array<double, 6>>& grains) {
    shakedown::Setup setup = with(std::move(effects));
    setup.domain = Domain::closed;
    setup.box.length = setup.box.width[0] = setup.box.width[1] = 0.2;
    setup.grains.count = static_cast<int>(grains.size());
    const std::filesystem::path file = folder / "grains.csv";
    std::ofstream out(file);
    out.precision(17);
    out << "id,x,y,z,vx,vy,vz\n";
    for (std::size_t i = 0; i < grains.size(); ++i) {
      out << i + 1;
      for (const double value : grains[i]) out << ',' << value;
      out << '\n';
    }
    setup.release.initial_grains = file.string();
    return setup;
  }

  Trajectory run(const shakedown::Setup& setup, double ledger_error = 1e-12) const {
    Trajectory result = make_soft_engine()->run(setup);
    EXPECT_LE(result.health.ledger_error, ledger_error);
    EXPECT_LE(result.health.momentum_error, 1e-12);
    EXPECT_EQ(result.ledger.effect_loss.size(), setup.effects.size());
    return result;
  }

  std::vector<std::unique_ptr<EffectRecord>> records;
  ScratchFolder folder;
};

const double angular_frequency = 2 * std::numbers::pi * 1.23;
constexpr double mass = 0.434, start = 0.1075;

double stiffness() { return mass * angular_frequency * angular_frequency; }

}  // namespace

// ---- the box
// -------------------------------------------------------------------------------------------------------------------

TEST_F(SoftEffects, ViscousBoxDecaysExponentially) {
  shakedown::Setup setup = empty_box({[](const EffectChoice&, int index, Physics& physics) {
    physics.box.viscous = 0.3;
    physics.box.viscous_effect = index;
  }});
  setup.run.duration = 5;
  const Trajectory result = run(setup);
  const double decay = 0.3 / (2 * mass),
               rate = std::sqrt(angular_frequency * angular_frequency - decay * decay);
  for (std::size_t k = 0; k < result.time.size(); k += 50) {
    const double t = result.time[k];
    EXPECT_NEAR(result.x_box[k],
                start * std::exp(-decay * t) * (std::cos(rate * t) + decay / rate * std::sin(rate * t)),
                1e-13);
  }
  EXPECT_NEAR(result.ledger.effect_loss[0] + result.total_energy.back(), result.initial_energy, 1e-14);
}

TEST_F(SoftEffects, DryFrictionTakesTheSameFromEveryExtremumAndThenSticks) {
  shakedown::Setup setup = empty_box({[](const EffectChoice&, int index, Physics& physics) {
    physics.box.dry_friction = 0.3;
    physics.box.dry_friction_effect = index;
  }});
  setup.run.duration = 4;
  const Trajectory result = run(setup);
  const double drop = 2 * 0.3 / stiffness();
  // Extrema at half periods; it sticks at the first one within F / k of the centre: 107.5 - 4 x 23.1 = 14.9
  // -> -(-8.2) ...
  int half_periods = 0;
  double extremum = start;
  while (extremum > 0.3 / stiffness()) {
    extremum -= drop;
    ++half_periods;
  }
  const double rest = (half_periods % 2 == 0 ? 1 : -1) * extremum;
  EXPECT_NEAR(result.x_box.back(), rest, 1e-10);
  EXPECT_EQ(result.v_box.back(), 0);
  EXPECT_EQ(result.x_box.back(), result.x_box[result.x_box.size() - 100]);
  const double rate = angular_frequency, offset = 0.3 / stiffness();
  for (std::size_t k = 0; result.time[k] < 0.4; k += 20)
    EXPECT_NEAR(result.x_box[k], offset + (start - offset) * std::cos(rate * result.time[k]), 1e-13);
}

TEST_F(SoftEffects, ForcedBoxFollowsTheClosedForm) {
  shakedown::Setup setup = empty_box({[](const EffectChoice&, int index, Physics& physics) {
    physics.box.constant = 0.2;
    physics.box.constant_effect = index;
    physics.box.harmonics.push_back({0.1, 2.0, 0.4, index});
  }});
  setup.run.duration = 3;
  const Trajectory result = run(setup);
  const double w = angular_frequency, drive = 2 * std::numbers::pi * 2.0;
  const double forced = 0.1 / mass / (w * w - drive * drive), shift = 0.2 / stiffness();
  const double a = start - shift - forced * std::sin(0.4), b = -forced * drive * std::cos(0.4) / w;
  for (std::size_t k = 0; k < result.time.size(); k += 50) {
    const double t = result.time[k];
    EXPECT_NEAR(result.x_box[k],
                shift + forced * std::sin(drive * t + 0.4) + a * std::cos(w * t) + b * std::sin(w * t),
                1e-13);
  }
}

TEST_F(SoftEffects, CubicSpringHasDuffingsPeriod) {
  shakedown::Setup setup = empty_box({[](const EffectChoice&, int index, Physics& physics) {
    physics.spring_cubic = 0.5 / (start * start);
    physics.spring_cubic_effect = index;
  }});
  setup.run.duration = 3;
  setup.run.sample_rate = 5000;
  const Trajectory result = run(setup);
  // Quarter period = integral of dx / v by the substitution x = A sin(s), to which the midpoint rule
  // converges geometrically.
  double quarter = 0;
  constexpr int points = 60;
  for (int k = 0; k < points; ++k) {
    const double s = (k + 0.5) / points * std::numbers::pi / 2;
    quarter += std::numbers::pi / 2 / points /
               (angular_frequency * std::sqrt(1 + 0.25 * (1 + std::sin(s) * std::sin(s))));
  }
  std::size_t k = 1;
  while (result.x_box[k] > 0) ++k;
  const double share = result.x_box[k - 1] / (result.x_box[k - 1] - result.x_box[k]);
  EXPECT_NEAR(result.time[k - 1] + share / 5000, quarter, 1e-9);
  EXPECT_NEAR(result.total_energy.back() / result.initial_energy, 1, 1e-12);
}

TEST_F(SoftEffects, FormulasOnTheBoxEnterTheirLine) {
  const Trajectory result = run(empty_box({[](const EffectChoice&, int index, Physics& physics) {
    physics.box.free.push_back({[](double, double v, double) { return -0.8 * v * std::abs(v); }, index});
  }}));
  EXPECT_GT(result.ledger.effect_loss[0], 0.1 * result.initial_energy);
}

// ---- the grains
// ----------------------------------------------------------------------------------------------------------------

TEST_F(SoftEffects, AccelerationsBendTheFlightExactly) {
  shakedown::Setup setup =
      closed_cube({[](const EffectChoice&, int index, Physics& physics) {
                     physics.grains.constant = Vec3(0.3, 0, -0.1);
                     physics.grains.constant_effect = index;
                   },
                   [](const EffectChoice&, int index, Physics& physics) {
                     physics.grains.harmonics.push_back({Vec3(2, 1, 0), 5.0, 0.7, index});
                   }},
                  {{-0.05, 0, 0, 0.02, 0.01, 0}});
  setup.run.duration = 0.5;
  const Trajectory result = run(setup, 1e-10);  // of a start energy that the fields multiply by a hundred
  const double w = 2 * std::numbers::pi * 5;
  for (std::size_t k = 0; k < result.time.size(); k += 10) {
    const double t = result.time[k];
    const double harmonic = 2 / w * (std::cos(0.7) * t - (std::sin(w * t + 0.7) - std::sin(0.7)) / w);
    EXPECT_NEAR(result.x_com[k], -0.05 + 0.02 * t + 0.15 * t * t + harmonic, 1e-13);
  }
}

TEST_F(SoftEffects, DragBringsAGrainToItsTerminalVelocity) {
  shakedown::Setup setup = closed_cube({[](const EffectChoice&, int index, Physics& physics) {
                                          physics.grains.constant = Vec3(2, 0, 0);
                                          physics.grains.constant_effect = index;
                                        },
                                        [](const EffectChoice&, int index, Physics& physics) {
                                          physics.grains.linear_drag = 0.08;
                                          physics.grains.drag_effect = index;
                                        }},
                                       {{-0.09, 0, 0, 0, 0, 0}});
  setup.run.duration = 0.6;
  const Trajectory result = run(setup);
  const double rate = 0.08 / 4.04e-3, terminal = 2 / rate;
  for (std::size_t k = 0; k < result.time.size(); k += 20) {
    const double t = result.time[k];
    // second order in the step
    EXPECT_NEAR(result.x_com[k], -0.09 + terminal * (t - (1 - std::exp(-rate * t)) / rate), 2e-9);
  }
  EXPECT_GT(result.ledger.effect_loss[1], 0);
  EXPECT_LT(result.ledger.effect_loss[0], 0);
}

TEST_F(SoftEffects, DragInTheDamperActsOnTheBoxToo) {
  shakedown::Setup setup = with({[](const EffectChoice&, int index, Physics& physics) {
    physics.grains.linear_drag = 1e-3;
    physics.grains.quadratic_drag = 1e-2;
    physics.grains.drag_effect = index;
  }});
  setup.box.length = 0.104;
  const Trajectory result = run(setup);
  EXPECT_GT(result.ledger.effect_loss[0], 1e-4 * result.initial_energy);
}

TEST_F(SoftEffects, FormulasOnTheGrainsEnterTheirLine) {
  shakedown::Setup setup = with({[](const EffectChoice&, int index, Physics& physics) {
    physics.grains.free.push_back(
        {[](double x, double v, double t) { return -0.02 * v - 0.05 * x + 1e-3 * std::sin(9 * t); }, index});
  }});
  const Trajectory result = run(setup);
  EXPECT_NE(result.ledger.effect_loss[0], 0);
}

TEST_F(SoftEffects, ArcPushesGrainsAcross) {
  shakedown::Setup setup = with({[](const EffectChoice&, int index, Physics& physics) {
    physics.grains.arc_length = 0.59;
    physics.grains.arc_effect = index;
  }});
  setup.box.length = 0.104;
  const Trajectory result = run(setup);
  EXPECT_NE(result.ledger.effect_loss[0], 0);
}

// ---- contacts
// ------------------------------------------------------------------------------------------------------------------

TEST_F(SoftEffects, SlidingBallComesToRollAtFiveSevenths) {
  shakedown::Setup setup = closed_cube({[](const EffectChoice&, int index, Physics& physics) {
                                         physics.contact.friction = {0.3, 0.3, 0.3};
                                         physics.grains.constant = Vec3(0, 0, -9.81);
                                         physics.grains.constant_effect = index;
                                       }},
                                       {{-0.08, 0, -0.095, 0.5, 0, 0}});
  setup.run.duration = 0.25;
  const Trajectory result = run(setup);
  const std::size_t last = result.time.size() - 1;
  const double speed =
      (result.x_com[last] - result.x_com[last - 25]) / (result.time[last] - result.time[last - 25]);
  EXPECT_NEAR(speed / 0.5, 5.0 / 7, 1e-3);              // lever R - overlap
  const double sliding = 2.0 / 7 * 0.5 / (0.3 * 9.81);  // s
  const auto k = static_cast<std::size_t>(std::lround(0.5 * sliding * 500));
  const double t = result.time[k];
  EXPECT_NEAR(result.x_com[k], -0.08 + 0.5 * t - 0.5 * 0.3 * 9.81 * t * t, 1e-5);
}

TEST_F(SoftEffects, ObliqueImpactSlipsByCoulombsLaw) {
  const double normal = 0.5, across = 1.0, m = 4.04e-3;
  shakedown::Setup setup = closed_cube({[](const EffectChoice&, int, Physics& physics) {
                                         physics.contact.friction = {0, 0, 0.1};
                                       }},
                                       {{0, 0, -0.0949, across, 0, -normal}});
  setup.soft.steps_per_contact = 50;
  setup.run.duration = 4e-3;
  const Trajectory result = run(setup);
  const double impulse = 0.1 * 1.76 * normal;  // per mass
  const double spin = 2.5 * impulse / 0.005;
  const double before = m / 2 * (normal * normal + across * across);
  const double after = m / 2 * (0.76 * 0.76 * normal * normal + (across - impulse) * (across - impulse)) +
                       0.2 * m * 0.005 * 0.005 * spin * spin;
  EXPECT_NEAR(result.ledger.contact_loss[2] / (before - after), 1, 0.01);
}

TEST_F(SoftEffects, FrictionWithoutSlidingReversesTheSlipAndLosesNothing) {
  const double normal = 0.5, across = 0.1, m = 4.04e-3;
  shakedown::Setup setup = closed_cube({[](const EffectChoice&, int, Physics& physics) {
                                         physics.contact.friction = {0, 0, 10};
                                       }},
                                       {{0, 0, -0.0949, across, 0, -normal}});
  setup.soft.steps_per_contact = 50;
  setup.run.duration = 4e-3;
  const Trajectory result = run(setup);
  EXPECT_NEAR(result.ledger.contact_loss[2] / (m / 2 * normal * normal * (1 - 0.76 * 0.76)), 1, 5e-3);
  const std::size_t last = result.time.size() - 1;
  const double speed =
      (result.x_com[last] - result.x_com[last - 1]) / (result.time[last] - result.time[last - 1]);
  // Slip u' = -u with solid spheres: v' = v - (2/7)(1 + 1) u = (3/7) v.
  EXPECT_NEAR(speed / across, 3.0 / 7, 0.02);
}

TEST_F(SoftEffects, FrictionInTheDamperKeepsTheBooks) {
  shakedown::Setup setup = with({[](const EffectChoice&, int, Physics& physics) {
    physics.contact.friction = {0.3, 0.2, 0.1};
    physics.contact.tangential_restitution = 0.5;
  }});
  const Trajectory result = run(setup);
  EXPECT_GT(result.ledger.contact_loss[2], 0);
}

TEST_F(SoftEffects, AttractionCapturesSlowPairs) {
  const auto attraction = [](const EffectChoice&, int, Physics& physics) {
    physics.contact.attraction_force = 0.1;
    physics.contact.attraction_range = 1e-4;
  };
  // Well of 1e-5 J; a pair at speed v leaves it when mu (eps v_in)^2 / 2 > 1e-5 J, v_in^2 = v^2 + 2e-5 J /
  // mu.
  const double mu = 2.02e-3, well = 1e-5;
  const double limit = std::sqrt(2 * well / mu * (1 / (0.75 * 0.75) - 1));
  for (const double factor : {0.8, 1.2}) {
    const double v = factor * limit;
    shakedown::Setup setup =
        closed_cube({attraction}, {{-0.0053, 0, 0, v / 2, 0, 0}, {0.0053, 0, 0, -v / 2, 0, 0}});
    setup.run.duration = 0.1;
    const Trajectory result = run(setup);
    if (factor > 1) {
      EXPECT_EQ(result.collisions[0], 1);
      const double inside = v * v + 2 * well / mu;
      EXPECT_NEAR(result.ledger.contact_loss[0] / (mu / 2 * inside * (1 - 0.75 * 0.75)), 1, 0.05);
    } else {
      EXPECT_GT(result.collisions[0], 1);
      EXPECT_LT(result.total_energy.back(), -0.9 * well);
    }
  }
}

TEST_F(SoftEffects, RestitutionFollowsTheClosingSpeed) {
  const auto law = [](const EffectChoice&, int, Physics& physics) {
    physics.contact.restitution_at = [](ContactClass, double v) { return 0.9 / (1 + v); };
  };
  for (const double v : {0.05, 0.5}) {
    shakedown::Setup setup = closed_cube({law}, {{-0.0051, 0, 0, v / 2, 0, 0}, {0.0051, 0, 0, -v / 2, 0, 0}});
    setup.run.duration = 0.01;
    const Trajectory result = run(setup);
    const double energy = 2.02e-3 * v * v / 2, wanted = 0.9 / (1 + v);
    EXPECT_NEAR(std::sqrt(1 - result.ledger.contact_loss[0] / energy), wanted, 4e-3);
  }
}

TEST_F(SoftEffects, OwnForceByOverlapKeepsTheBooks) {
  // Hertz with a dashpot of Tsuji's kind: restitution does not depend on speed.
  const auto law = [](const EffectChoice&, int, Physics& physics) {
    physics.contact.push = [](ContactClass, double overlap, double rate, double, double reduced_mass) {
      const double k = 5e7;
      return k * std::pow(overlap, 1.5) + 0.3 * std::sqrt(reduced_mass * k) * std::pow(overlap, 0.25) * rate;
    };
    physics.contact.stored_energy = [](ContactClass, double overlap, double, double) {
      return 0.4 * 5e7 * std::pow(overlap, 2.5);
    };
  };
  std::vector<double> restitution;
  for (const double v : {0.05, 0.5}) {
    shakedown::Setup setup = closed_cube({law}, {{-0.0051, 0, 0, v / 2, 0, 0}, {0.0051, 0, 0, -v / 2, 0, 0}});
    setup.run.duration = 0.01;
    setup.soft.steps_per_contact = 100;
    restitution.push_back(std::sqrt(1 - run(setup).ledger.contact_loss[0] / (2.02e-3 * v * v / 2)));
  }
  EXPECT_NEAR(restitution[0], restitution[1], 2e-3);
  EXPECT_LT(restitution[0], 0.9);
  EXPECT_GT(restitution[0], 0.5);
}

TEST_F(SoftEffects, GrainsOfManySizesKeepTheBooks) {
  const Trajectory result = run(with({[](const EffectChoice&, int, Physics& physics) {
    physics.relative_diameter_deviation = 0.05;
    physics.packing = Packing::random;
  }}));
  EXPECT_GT(result.collisions[0], 1000);
}

TEST_F(SoftEffects, AddUp) {
  shakedown::Setup setup = with({[](const EffectChoice&, int index, Physics& physics) {
                                   physics.contact.friction = {0.2, 0.2, 0.2};
                                   physics.box.dry_friction = 0.05;
                                   physics.box.dry_friction_effect = index;
                                 },
                                 [](const EffectChoice&, int index, Physics& physics) {
                                   physics.grains.constant = Vec3(0.1, 0, -0.2);
                                   physics.grains.constant_effect = index;
                                   physics.box.constant += physics.box_mass * 0.1;
                                   physics.box.constant_effect = index;
                                 },
                                 [](const EffectChoice&, int index, Physics& physics) {
                                   physics.grains.linear_drag = 1e-4;
                                   physics.grains.drag_effect = index;
                                   physics.contact.attraction_force = 1e-3;
                                   physics.contact.attraction_range = 1e-5;
                                   physics.spring_cubic = -10;
                                 }});
  const Trajectory result = run(setup);
  EXPECT_GT(result.ledger.effect_loss[0], 0);
  EXPECT_NE(result.ledger.effect_loss[1], 0);
  EXPECT_GT(result.ledger.effect_loss[2], 0);
}
