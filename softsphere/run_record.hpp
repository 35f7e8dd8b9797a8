// SPDX-License-Identifier: MIT
// Every engine on Bullet writes down samples, ledger, and how well energy and momentum balance.
#pragma once
#include <cmath>
#include <functional>

#include "accounts.hpp"
#include "bodies.hpp"
#include "engine.hpp"
#include "open_book.hpp"

namespace shakedown {

/// J, elastic energy held by contacts of each class.
using StoredEnergy = std::array<double, contact_classes>;

class RunRecord {
 public:
  /// `spring_energy` of the box as a function of its place, J; a held box has mass 0.
  RunRecord(const Setup& setup, std::string engine, double box_mass,
            std::function<double(double)> spring_energy);

  /// Takes the state at release, from which the balances count.
  void begin(const Setup& setup, const Bodies& bodies, const StoredEnergy& stored);
  /// Appends a sample at `time`, s, to the trajectory.
  void sample(double time, const Bodies& bodies, const Accounts& accounts, const StoredEnergy& stored);
  /// Enters the balances into the health; false when they are not numbers.
  bool check(const Bodies& bodies, const Accounts& accounts, const StoredEnergy& stored);
  /// Completes the trajectory with ledger, counts and the state at `end_time`, s, and returns it.
  Trajectory finish(const Bodies& bodies, const Accounts& accounts, const StoredEnergy& stored,
                    double end_time);

  Trajectory trajectory;

 private:
  /// Returns the energy of box, spring and grains, and what contacts hold, J.
  double energy(const Bodies& bodies, const StoredEnergy& stored) const;
  Ledger ledger(const Accounts& accounts, const StoredEnergy& stored) const;
  /// Returns the momentum of box and grains along the axis, kg m/s.
  double momentum(const Bodies& bodies) const;

  double box_mass_;
  std::function<double(double)> spring_energy_;
  double momentum_scale_ = 0, momentum_at_start_ = 0;
  OpenBook energy_book_, momentum_book_;
  StoredEnergy stored_at_start_{};
};

/// Walks through a run sample by sample. march(interval, until) goes on by `interval` seconds to the time
/// `until` and returns false when stopped; sample(time) is called at 0, 1/rate, 2/rate ... A rest of the
/// duration below one interval is marched without a sample.
template <class March, class Sample>
void through_samples(const Setup& setup, const RunOptions& options, March march, Sample sample) {
  const double rate = setup.run.sample_rate;
  const auto samples = static_cast<std::int64_t>(std::floor(setup.run.duration * rate * (1 + 1e-12)));
  sample(0.0);
  for (std::int64_t k = 1; k <= samples; ++k) {
    const double until = static_cast<double>(k) / rate;
    if (!march(1 / rate, until)) return;
    sample(until);
    if (options.progress && k % 50 == 0) options.progress(until);
  }
  const double rest = setup.run.duration - static_cast<double>(samples) / rate;
  if (rest * rate > 1e-9) march(rest, setup.run.duration);
}

/// Returns the number of equal steps, none longer than `longest`, that fill an interval.
inline std::int64_t steps_that_fill(double interval, double longest) {
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(interval / longest * (1 - 1e-12))));
}

/// Tells, at every so many steps, the time (s) as progress, and returns whether the run goes on.
inline bool goes_on(const RunOptions& options, std::int64_t step, std::int64_t every, double time) {
  if (step % every != 0) return true;
  if (step > 0 && options.progress) options.progress(time);
  return options.stop == nullptr || !options.stop->load(std::memory_order_relaxed);
}

}  // namespace shakedown
