// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <numbers>

#include "engine.hpp"
#include "random.hpp"

/// A viscously damped box whose rate depends on the run; with numbers for everything that a trajectory holds.
class ClosedFormEngine final : public shakedown::Engine {
 public:
  int failing_run = -1;                ///< throws PhysicsError there
  std::atomic<bool>* raise = nullptr;  ///< raised in the middle of
  int raising_run = -1;

  std::string_view name() const override { return "closed_form"; }
  shakedown::Capability can_model(const shakedown::EffectRecord&) const override { return {}; }

  shakedown::Trajectory run(const shakedown::Setup& setup,
                            const shakedown::RunOptions& options) const override {
    if (options.run == failing_run) throw shakedown::PhysicsError("run " + std::to_string(options.run));
    const double angular = 2 * std::numbers::pi * setup.spring.frequency;
    const double rate = rate_of(setup, options.run);
    shakedown::Trajectory trajectory;
    trajectory.engine = name();
    trajectory.initial_energy = 0.5;
    const int samples = static_cast<int>(setup.run.duration * setup.run.sample_rate + 0.5);
    for (int k = 0; k <= samples; ++k) {
      if (options.run == raising_run && k == samples / 2) *raise = true;
      if (options.stop != nullptr && *options.stop) {
        trajectory.interrupted = true;
        break;
      }
      add_sample(k / setup.run.sample_rate, setup.release.displacement, rate, angular, trajectory);
      if (options.progress) options.progress(trajectory.time.back());
    }
    trajectory.end_time = trajectory.time.empty() ? 0 : trajectory.time.back();
    trajectory.ledger.contact_loss = {0.1, 0.05, 0.02 * rate};
    trajectory.collisions = {1000 + options.run, 500, 250};
    trajectory.events = 4000;
    trajectory.wall_seconds = 0.5;
    trajectory.health.ledger_error = 1e-15 * (1 + options.run);
    return trajectory;
  }

  /// 1/s
  static double rate_of(const shakedown::Setup& setup, int run) {
    return 0.2 +
           0.1 * shakedown::Random(setup.run.seed, static_cast<std::uint64_t>(run), shakedown::Stream::other)
                     .uniform();
  }

 private:
  static void add_sample(double time, double release, double rate, double angular,
                         shakedown::Trajectory& trajectory) {
    const double envelope = release * std::exp(-rate * time), phase = angular * time;
    trajectory.time.push_back(time);
    trajectory.x_box.push_back(envelope * (std::cos(phase) + rate / angular * std::sin(phase)));
    trajectory.v_box.push_back(-envelope * (angular + rate * rate / angular) * std::sin(phase));
    trajectory.x_com.push_back(std::numeric_limits<double>::quiet_NaN());
    trajectory.total_energy.push_back(0.5 * std::exp(-2 * rate * time));
    for (auto& loss : trajectory.loss) loss.push_back(time);
  }
};
