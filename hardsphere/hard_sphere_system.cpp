// SPDX-License-Identifier: MIT
#include "hard_sphere_system.hpp"

#include <algorithm>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <variant>

#include "all_pairs.hpp"
#include "cell_crossings.hpp"
#include "cell_lists.hpp"
#include "centre_cells.hpp"
#include "event_loop.hpp"
#include "initial_state.hpp"

namespace shakedown {

using Loop = std::variant<EventLoop<AllPairs, BoxMotion>, EventLoop<CellLists<false>, BoxMotion>,
                          EventLoop<CellLists<true>, BoxMotion>, EventLoop<AllPairs, DrivenBox>,
                          EventLoop<CellLists<false>, DrivenBox>, EventLoop<CellCrossings, BoxMotion>>;

struct HardSphereSystem::Inside {
  Loop loop;
  std::unique_ptr<EventWriter> writer;
};

namespace {

/// Up to this size testing every pair in vector lanes beats lists and queue.
constexpr std::size_t all_pairs_up_to = 128;
/// Packing fraction of a periodic fluid up to which small cells beat lists.
constexpr double crossings_below = 0.4;
/// Square wells need a table of all pairs.
constexpr std::size_t wells_up_to = 2000;

double grain_volume(const State& state) {
  double volume = 0;
  for (const double radius : state.radius) volume += 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
  return volume;
}

std::array<double, 3> cell_of(const Setup& setup) {
  return {setup.box.length, setup.box.width[0], setup.box.width[1]};
}

/// Throws InputError for a periodic cell that does not hold three list cells along each axis, each as wide as
/// a grain, or that holds no grain.
void check_cell(const Setup& setup, const State& state) {
  if (state.size() == 0)
    throw InputError({{place_of(setup, "grains.count"), "grains.count",
                       "is 0 (a periodic cell without grains holds nothing)", "take one grain or more"}});
  const double largest = 2 * *std::max_element(state.radius.begin(), state.radius.end());
  for (const double extent : cell_of(setup))
    if (!(extent > least_period_in_diameters * largest))
      throw InputError({{place_of(setup, "domain.kind"), "domain.kind",
                         "a periodic cell narrower than three of its largest grains is not modelled (a grain "
                         "would meet another and its image at once)",
                         "make box.length and box.width larger, or the grains smaller or less unequal"}});
}

/// Throws PhysicsError for grains that overlap by more than 1e-12 m, also in states read from a file. Looks
/// through cells, so that it costs no more than the first neighbour lists.
void check_overlap(const Setup& setup, const State& state) {
  if (state.size() < 2) return;
  constexpr double allowed = 1e-12;  // m
  const bool periodic = setup.domain == Domain::periodic;
  const std::array<double, 3> extent = cell_of(setup);
  const Period period(extent);
  const double reach = 2 * *std::max_element(state.radius.begin(), state.radius.end());
  CentreCells cells(state.size(), extent, reach, periodic);
  std::vector<std::int32_t> near;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Vec3& here = state.position[i];
    const CentreCells::Place place = cells.place({here.x(), here.y(), here.z()});
    const std::size_t count = cells.find(place, near);
    for (std::size_t n = 0; n < count; ++n) {
      const auto j = static_cast<std::size_t>(near[n]);
      Vec3 apart = state.position[j] - here;
      for (int axis = 0; periodic && axis < 3; ++axis)
        apart[axis] = period.nearest(apart[axis], static_cast<std::size_t>(axis));
      const double overlap = state.radius[i] + state.radius[j] - apart.norm();
      if (overlap <= allowed) continue;
      std::ostringstream text;
      text << "grains " << j + 1 << " and " << i + 1 << " overlap by " << std::setprecision(3)
           << 1e3 * overlap
           << " mm at release (hard grains cannot); move them apart, or take another packing";
      throw PhysicsError(text.str());
    }
    cells.put(static_cast<std::int32_t>(i), place);
  }
}

Loop loop_for(const Setup& setup, const Physics& physics, const State& state) {
  const std::array<double, 2> half_width{setup.box.width[0] / 2, setup.box.width[1] / 2};
  const std::array<double, 3> cell = cell_of(setup);
  const double fraction = grain_volume(state) / (cell[0] * cell[1] * cell[2]);
  const bool driven = is_driven(physics);
  if (driven && setup.domain != Domain::damper)
    throw InputError({{{},
                       "domain.kind",
                       "effects that drive box or grains, friction and attraction need a damper (other "
                       "domains are for checks of the plain engine)",
                       "take domain.kind = \"damper\" or leave the effects out"}});
  if (setup.domain == Domain::periodic) {
    if (fraction < crossings_below && CellCrossings::can_hold(state, cell))
      return Loop(std::in_place_index<5>, state, physics, setup, CellCrossings(state, cell));
    const CellListsPlan plan{cell, true, {never, never}, fraction, 0};
    return Loop(std::in_place_index<2>, state, physics, setup, CellLists<true>(state, plan));
  }
  const bool wells = physics.contact.has_attraction();
  if (wells && state.size() > wells_up_to)
    throw InputError({{{},
                       "grain_cohesion",
                       "is modelled by the hard engine up to " + std::to_string(wells_up_to) +
                           " grains only (it keeps a table of pairs)",
                       "take fewer grains or --engine soft"}});
  if (state.size() <= all_pairs_up_to || wells) {
    const AllPairs grains(state, half_width, wells ? physics.contact.attraction_range : 0);
    return driven ? Loop(std::in_place_index<3>, state, physics, setup, grains)
                  : Loop(std::in_place_index<0>, state, physics, setup, grains);
  }
  // The grains of a damper lie in layers most of the time, whatever the box's mean filling.
  const CellListsPlan plan{cell, false, half_width,
                           setup.domain == Domain::damper ? std::max(0.5, fraction) : fraction, 0};
  CellLists<false> grains(state, plan);
  return driven ? Loop(std::in_place_index<4>, state, physics, setup, std::move(grains))
                : Loop(std::in_place_index<1>, state, physics, setup, std::move(grains));
}

}  // namespace

HardSphereSystem::HardSphereSystem(const Setup& setup, int run)
    : HardSphereSystem(setup, initial_state(setup, run)) {}

HardSphereSystem::HardSphereSystem(const Setup& setup, const State& state) {
  if (setup.domain == Domain::periodic) check_cell(setup, state);
  check_overlap(setup, state);
  inside_.reset(new Inside{loop_for(setup, physics_of(setup), state), {}});
}

HardSphereSystem::~HardSphereSystem() = default;
HardSphereSystem::HardSphereSystem(HardSphereSystem&&) noexcept = default;

// Which loop it is was decided once; every call goes to it.
#define SHAKEDOWN_IN_LOOP(expression) \
  std::visit([&](auto& loop) -> decltype(auto) { return expression; }, inside_->loop)

bool HardSphereSystem::advance_to(double t, const std::atomic<bool>* stop) {
  return SHAKEDOWN_IN_LOOP(loop.advance_to(t, stop));
}
void HardSphereSystem::advance_impacts(std::int64_t n) { SHAKEDOWN_IN_LOOP(loop.advance_impacts(n)); }
double HardSphereSystem::time() const { return SHAKEDOWN_IN_LOOP(loop.time()); }
void HardSphereSystem::log_collisions(State initial) {
  EXPECT(time() == 0 && events() == 0);
  const bool periodic = std::holds_alternative<EventLoop<CellLists<true>, BoxMotion>>(inside_->loop) ||
                        std::holds_alternative<EventLoop<CellCrossings, BoxMotion>>(inside_->loop);
  EXPECT(!periodic);
  inside_->writer = std::make_unique<EventWriter>(std::move(initial));
  SHAKEDOWN_IN_LOOP(loop.write_events_to(inside_->writer.get()));
}
CollisionLog HardSphereSystem::collision_log() const {
  EXPECT(inside_->writer != nullptr);
  return inside_->writer->finished(time(), SHAKEDOWN_IN_LOOP(loop.digest()));
}
Observation HardSphereSystem::observe() { return SHAKEDOWN_IN_LOOP(loop.observe()); }
State HardSphereSystem::state() const { return SHAKEDOWN_IN_LOOP(loop.state(loop.time())); }
Ledger HardSphereSystem::ledger() const { return SHAKEDOWN_IN_LOOP(loop.ledger()); }
Health HardSphereSystem::health() const { return SHAKEDOWN_IN_LOOP(loop.health()); }
const std::array<std::int64_t, contact_classes>& HardSphereSystem::collisions() const {
  return SHAKEDOWN_IN_LOOP(loop.collisions());
}
std::int64_t HardSphereSystem::events() const { return SHAKEDOWN_IN_LOOP(loop.events()); }
double HardSphereSystem::initial_energy() const { return SHAKEDOWN_IN_LOOP(loop.initial_energy()); }
double HardSphereSystem::virial() const { return SHAKEDOWN_IN_LOOP(loop.virial()); }
double HardSphereSystem::bytes_per_grain() const { return SHAKEDOWN_IN_LOOP(loop.bytes_per_grain()); }

}  // namespace shakedown
