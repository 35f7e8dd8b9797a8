// SPDX-License-Identifier: MIT
// Two effects that act in the same way add up, and each has its own line in the energy ledger.
#include <algorithm>
#include <cmath>

#include "setups.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// What one effect, or the first or second of two, writes into the physics. The strengths are binary
/// fractions, so that their sums are exact and one effect moves as two do.
using Apply = void (*)(const EffectChoice&, int, Physics&);
struct Slots {
  const char* name;
  Apply both, first, second;
  double share_of_first;  ///< of the work of both; below 0: varies with the speed
};

template <int Part>  // 3: both, 1: first, 2: second
void viscous(const EffectChoice&, int index, Physics& physics) {
  physics.box.viscous.add(0.0625 * Part, index);
}
template <int Part>
void dry(const EffectChoice&, int index, Physics& physics) {
  physics.box.dry_friction.add(0.0078125 * Part, index);
}
template <int Part>
void push(const EffectChoice&, int index, Physics& physics) {
  physics.box.constant.add(0.0625 * Part, index);
  physics.grains.constant.add(Vec3(0.125 * Part, 0, 0.0625 * Part), index);
}
template <int Part>
void drag(const EffectChoice&, int index, Physics& physics) {
  physics.grains.drag.add({0.0009765625 * Part, 0.001953125 * Part}, index);
}
template <int Part>
void unlike_drags(const EffectChoice&, int index, Physics& physics) {
  physics.grains.drag.add({Part & 1 ? 0.0009765625 : 0, Part & 2 ? 0.001953125 : 0}, index);
}

const std::vector<Slots> slots{{"viscous", viscous<3>, viscous<1>, viscous<2>, 1.0 / 3},
                               {"dry friction", dry<3>, dry<1>, dry<2>, 1.0 / 3},
                               {"constant", push<3>, push<1>, push<2>, 1.0 / 3},
                               {"drag", drag<3>, drag<1>, drag<2>, 1.0 / 3},
                               {"unlike drags", unlike_drags<3>, unlike_drags<1>, unlike_drags<2>, -1}};

EffectRecord record_of(std::string_view name, Apply apply) {
  EffectRecord record;
  record.name = name;
  record.engines = {{every_engine, {Fidelity::exact}}};
  record.apply = apply;
  return record;
}

Trajectory run(const Engine& engine, const std::vector<const EffectRecord*>& records) {
  Setup setup;
  setup.grains.count = 5;
  setup.run.duration = 0.3;
  for (const EffectRecord* record : records) setup.effects.push_back(with_defaults(*record));
  return engine.run(setup);
}

double worst_difference(const std::vector<double>& a, const std::vector<double>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0;
  for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::abs(a[k] - b[k]));
  return worst;
}

class SharedSlots : public testing::TestWithParam<EngineUnderTest> {};

TEST_P(SharedSlots, TwoEffectsAddUpAndEachIsBooked) {
  const auto engine = GetParam().make();
  for (const Slots& one : slots) {
    SCOPED_TRACE(one.name);
    const EffectRecord both = record_of("both", one.both), first = record_of("first", one.first),
                       second = record_of("second", one.second);
    const Trajectory together = run(*engine, {&both}), apart = run(*engine, {&first, &second});
    // The soft engine adds constant accelerations in turn, which rounds.
    EXPECT_LT(worst_difference(together.x_box, apart.x_box), 2e-14);  // seen: 1.1e-15
    EXPECT_LT(worst_difference(together.x_com, apart.x_com), 2e-13);  // seen: 1.6e-14
    EXPECT_LT(apart.health.ledger_error, 1e-12);
    const double whole = together.ledger.effect_loss[0];
    const std::vector<double>& parts = apart.ledger.effect_loss;
    ASSERT_NE(whole, 0);
    WITHIN((parts[0] + parts[1]) / whole, 1, 5e-14, 2.7e-15);
    if (one.share_of_first >= 0)
      WITHIN(parts[0] / whole, one.share_of_first, 1e-14, 8.9e-16);
    else
      EXPECT_TRUE(parts[0] / whole > 0.05 && parts[1] / whole > 0.05) << parts[0] << ' ' << parts[1];
  }
}

INSTANTIATE_TEST_SUITE_P(Engines, SharedSlots,
                         testing::Values(engines_under_test()[0], engines_under_test()[1]),
                         [](const auto& engine) { return engine.param.name; });

}  // namespace
