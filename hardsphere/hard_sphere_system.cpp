// SPDX-License-Identifier: MIT
#include "hard_sphere_system.hpp"

#include <numbers>
#include <variant>

#include "all_pairs.hpp"
#include "event_loop.hpp"

namespace shakedown {

struct HardSphereSystem::Inside {
  EventLoop<AllPairs> loop;
  double momentum_scale;  // M Omega Delta0
};

namespace {

std::array<double, 2> half_widths(const Setup& setup) {
  return {setup.box.width[0] / 2, setup.box.width[1] / 2};
}

}  // namespace

HardSphereSystem::HardSphereSystem(const Setup& setup, int run) : HardSphereSystem(setup, initial_state(setup, run)) {}

HardSphereSystem::HardSphereSystem(const Setup& setup, const State& state) {
  const Physics physics = physics_of(setup);
  const double scale =
      setup.box.mass * 2 * std::numbers::pi * setup.spring.frequency * std::abs(setup.release.displacement);
  inside_.reset(new Inside{EventLoop<AllPairs>(state, physics, setup, AllPairs(state, half_widths(setup))), scale});
}

HardSphereSystem::~HardSphereSystem() = default;
HardSphereSystem::HardSphereSystem(HardSphereSystem&&) noexcept = default;

bool HardSphereSystem::advance_to(double t, const std::atomic<bool>* stop) { return inside_->loop.advance_to(t, stop); }
void HardSphereSystem::advance_impacts(std::int64_t n) { inside_->loop.advance_impacts(n); }
double HardSphereSystem::time() const { return inside_->loop.time(); }
Observation HardSphereSystem::observe() { return inside_->loop.observe(inside_->loop.time()); }
State HardSphereSystem::state() const { return inside_->loop.state(inside_->loop.time()); }
const Ledger& HardSphereSystem::ledger() const { return inside_->loop.ledger(); }
Health HardSphereSystem::health() const {
  Health health = inside_->loop.health();
  if (inside_->momentum_scale > 0) health.momentum_error /= inside_->momentum_scale;
  return health;
}
const std::array<std::int64_t, contact_classes>& HardSphereSystem::collisions() const { return inside_->loop.collisions(); }
std::int64_t HardSphereSystem::events() const { return inside_->loop.events(); }
double HardSphereSystem::initial_energy() const { return inside_->loop.initial_energy(); }
double HardSphereSystem::virial() const { return inside_->loop.virial(); }
double HardSphereSystem::bytes_per_grain() const { return 0; }

}  // namespace shakedown
