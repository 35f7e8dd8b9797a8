// SPDX-License-Identifier: MIT
#include "run_record.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "sum_in_order.hpp"

namespace shakedown {

namespace {

double centre_of_mass(const Bodies& bodies) {
  if (bodies.grains == 0) return std::numeric_limits<double>::quiet_NaN();
  return sum_in_order(bodies.mass * bodies.position.col(0).head(bodies.grains)) / sum_in_order(bodies.mass);
}

/// Returns M Omega Delta0, kg m/s; without a spring or its displacement the sum of m |v|.
double scale_of_momentum(const Setup& setup, const Bodies& bodies, double box_mass) {
  const double rate = 2 * std::numbers::pi * setup.spring.frequency;
  if (box_mass > 0 && setup.release.displacement != 0)
    return setup.box.mass * rate * std::abs(setup.release.displacement);
  double sum = 0;
  for (Eigen::Index i = 0; i < bodies.grains; ++i) sum += bodies.mass(i) * bodies.velocity_of(i).norm();
  return sum;
}

}  // namespace

RunRecord::RunRecord(const Setup& setup, std::string engine, double box_mass,
                     std::function<double(double)> spring_energy)
    : box_mass_(box_mass), spring_energy_(std::move(spring_energy)) {
  trajectory.engine = std::move(engine);
  const auto samples =
      static_cast<std::size_t>(std::max(0.0, setup.run.duration * setup.run.sample_rate)) + 2;
  for (auto* column :
       {&trajectory.time, &trajectory.x_box, &trajectory.v_box, &trajectory.x_com, &trajectory.total_energy})
    column->reserve(samples);
}

double RunRecord::energy(const Bodies& bodies, const StoredEnergy& stored) const {
  double energy =
      box_mass_ > 0 ? box_mass_ * bodies.v_box() * bodies.v_box() / 2 + spring_energy_(bodies.x_box()) : 0.0;
  for (Eigen::Index i = 0; i < bodies.grains; ++i) {
    energy += bodies.mass(i) * bodies.velocity_of(i).squaredNorm() / 2;
    energy += 0.2 * bodies.mass(i) * bodies.radius(i) * bodies.radius(i) * bodies.spin_of(i).squaredNorm();
  }
  for (const double part : stored) energy += part;
  return energy;
}

double RunRecord::momentum(const Bodies& bodies) const {
  return sum_in_order(bodies.mass * bodies.velocity.col(0).head(bodies.grains)) + box_mass_ * bodies.v_box();
}

/// Returns as dissipated what contacts took, less what their springs have gained since the start.
Ledger RunRecord::ledger(const Accounts& accounts, const StoredEnergy& stored) const {
  Ledger ledger;
  for (std::size_t kind = 0; kind < contact_classes; ++kind)
    ledger.contact_loss[kind] =
        -accounts.contact_work[kind].value() - (stored[kind] - stored_at_start_[kind]);
  for (const CompensatedSum& work : accounts.effect_work) ledger.effect_loss.push_back(-work.value());
  return ledger;
}

void RunRecord::begin(const Setup& setup, const Bodies& bodies, const StoredEnergy& stored) {
  stored_at_start_ = stored;
  trajectory.initial_energy = energy(bodies, stored);
  momentum_at_start_ = momentum(bodies);
  momentum_scale_ = scale_of_momentum(setup, bodies, box_mass_);
}

bool RunRecord::check(const Bodies& bodies, const Accounts& accounts, const StoredEnergy& stored) {
  const double start = trajectory.initial_energy, held = energy(bodies, stored), moved = momentum(bodies);
  const Ledger lines = ledger(accounts, stored);
  const double open = held + lines.total_loss() - start;
  const double drift = moved - momentum_at_start_ - accounts.outer_impulse.value();
  energy_book_.see(open, held, lines);
  momentum_book_.see(drift, moved);
  Health& health = trajectory.health;
  health.ledger_error = energy_book_.error(start);
  health.momentum_error = momentum_book_.error(momentum_scale_);
  health.deepest_overlap = std::max(health.deepest_overlap, accounts.deepest_overlap);
  return std::isfinite(open) && std::isfinite(drift);
}

void RunRecord::sample(double time, const Bodies& bodies, const Accounts& accounts,
                       const StoredEnergy& stored) {
  trajectory.time.push_back(time);
  trajectory.x_box.push_back(bodies.x_box());
  trajectory.v_box.push_back(bodies.v_box());
  trajectory.x_com.push_back(centre_of_mass(bodies));
  trajectory.total_energy.push_back(energy(bodies, stored));
  const Ledger now = ledger(accounts, stored);
  for (std::size_t kind = 0; kind < contact_classes; ++kind)
    trajectory.loss[kind].push_back(now.contact_loss[kind]);
}

Trajectory RunRecord::finish(const Bodies& bodies, const Accounts& accounts, const StoredEnergy& stored,
                             double end_time) {
  check(bodies, accounts, stored);
  trajectory.ledger = ledger(accounts, stored);
  trajectory.collisions = accounts.collisions;
  trajectory.end_time = end_time;
  trajectory.end_state = state_of(bodies);
  return std::move(trajectory);
}

}  // namespace shakedown
