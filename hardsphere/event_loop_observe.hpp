// SPDX-License-Identifier: MIT
// Part of event_loop.hpp: what is seen of a loop.
#pragma once
#include "event_loop.hpp"

namespace shakedown {

template <class Grains, class Motion>
Observation EventLoop<Grains, Motion>::observe() {
  const double t = now_;
  GrainSums grains = grains_.sums(t);
  const BoxMotion::Point box = box_now();
  double energy = 0, outer_impulse = outer_impulse_;
  if constexpr (driven) {
    account(t);
    const Vec3 s = frame_.displacement(t), v = frame_.velocity(t);
    grains.kinetic += Vec3(grains.momentum[0], grains.momentum[1], grains.momentum[2]).dot(v) +
                      grains.mass * v.squaredNorm() / 2;
    grains.moment += grains.mass * s.x();
    grains.momentum[0] += grains.mass * v.x();
    outer_impulse += box_.outer_impulse() + grains.mass * v.x();
    energy -= static_cast<double>(wells_) * contact_.attraction_force * contact_.attraction_range;
  } else if (has_spring_) {
    outer_impulse += spring_impulse_;
  }
  for (std::size_t i = 0; i < spin_.size(); ++i) {
    const double m = grains_.mass(static_cast<int>(i)), r = grains_.radius(static_cast<int>(i));
    energy += 0.2 * m * r * r * spin_[i].squaredNorm();
  }
  energy += grains.kinetic;
  if (has_spring_) energy += box_.spring_energy(box.x) + box_.mass() * box.v * box.v / 2;
  const Observation seen{t, box.x, box.v, grains_.size() > 0 ? grains.moment / grains.mass : std::nan(""),
                         energy};
  energy_book_.see(energy + total_loss() - initial_energy_, energy);
  if (has_spring_) {
    const double momentum = grains.momentum[0] + box_.mass() * box.v;
    momentum_book_.see(momentum - initial_momentum_ - outer_impulse, momentum);
  }
  return seen;
}

template <class Grains, class Motion>
double EventLoop<Grains, Motion>::total_loss() const {
  if constexpr (driven) return ledger().total_loss();
  double loss = 0;
  for (std::size_t c = 0; c < contact_classes; ++c) loss += ledger_.contact_loss[c] + ledger_rest_[c];
  return loss;
}

template <class Grains, class Motion>
Ledger EventLoop<Grains, Motion>::ledger() const {
  Ledger ledger = ledger_;
  for (std::size_t c = 0; c < contact_classes; ++c) ledger.contact_loss[c] += ledger_rest_[c];
  if constexpr (driven)
    for (std::size_t e = 0; e < box_.effect_work().size(); ++e)
      ledger.effect_loss[e] -= box_.effect_work()[e];
  return ledger;
}

template <class Grains, class Motion>
State EventLoop<Grains, Motion>::state(double t) const {
  State state;
  const Vec3 frame_x = frame_.displacement(t), frame_v = frame_.velocity(t);
  for (int i = 0; i < grains_.size(); ++i) {
    Flight3 flight = grains_.flight(i);
    flight.advance(t);
    state.position.push_back(Vec3(flight.x[0], flight.x[1], flight.x[2]) + frame_x);
    state.velocity.push_back(Vec3(flight.v[0], flight.v[1], flight.v[2]) + frame_v);
    state.radius.push_back(grains_.radius(i));
    state.mass.push_back(grains_.mass(i));
  }
  state.spin = spin_;
  const BoxMotion::Point box = box_.at(t);
  state.x_box = box.x;
  state.v_box = box.v;
  for (std::size_t i = 0; arc_curvature_ != 0 && i < state.size(); ++i) {
    state.position[i].z() -= arc_curvature_ * (box.x * box.x - release_x_ * release_x_);
    state.velocity[i].z() -= 2 * arc_curvature_ * box.x * box.v;
  }
  return state;
}

template <class Grains, class Motion>
Health EventLoop<Grains, Motion>::health() const {
  Health health;
  health.deepest_overlap = std::max({0.0, grains_.deepest_overlap(), end_walls_.deepest_overlap()});
  for (const EndWalls& walls : side_walls_)
    health.deepest_overlap = std::max(health.deepest_overlap, walls.deepest_overlap());
  health.ledger_error = energy_book_.error(initial_energy_);
  health.momentum_error = momentum_book_.error(momentum_scale_);
  health.elastic_rescues = elastic_walls_ + elastic_pairs_;
  health.elastic_pair_rescues = elastic_pairs_;
  health.refused_events = refused_;
  if (let_go_ > 0)
    health.notes.push_back(
        "bonds of grain_cohesion hung at the edge of their well until they were pulled off with more than "
        "its force; the energy "
        "that this leaves unpaid is booked as its work");
  return health;
}

}  // namespace shakedown
