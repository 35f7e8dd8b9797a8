// SPDX-License-Identifier: MIT
#pragma once
#include <memory>

#include "engine.hpp"

namespace shakedown {

/// How pairs of grains near each other are found; the digits of a run do not depend on it.
enum class PairSearch {
  neighbour_list,  ///< Bullet's tree is asked with enlarged grains, and again only when grains have moved by
                   ///< the enlargement
  every_step,      ///< Bullet's tree is asked at every step: the test oracle, several times dearer
};

/// Engine "soft": linear spring-dashpot contacts found by Bullet, velocity Verlet made second order at touch
/// and separation, exact harmonic flight of the box. Samples fall on steps: the step is the sample interval
/// over a whole number, at most contact_time / steps_per_contact, so x_box is exact to the integrator.
/// Domains: damper and closed.
std::unique_ptr<Engine> make_soft_engine(PairSearch search = PairSearch::neighbour_list);

/// The same from any state in the setup's domain: grains that spin or are unequal, for checks against known
/// physics. Effects are not asked whether the engine models them.
Trajectory run_soft_from(const State& state, const Setup& setup, const RunOptions& options = {});

}  // namespace shakedown
