// SPDX-License-Identifier: MIT
#include "hard_engine.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

#include "hard_sphere_system.hpp"
#include "initial_state.hpp"
#include "promise.hpp"

namespace shakedown {

namespace {

class HardEngine final : public Engine {
 public:
  std::string_view name() const override { return "hard"; }
  Capability can_model(const EffectRecord& effect) const override { return effect.capability(name()); }

  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    refuse_what_is_not_modelled(*this, setup);
    const auto start = std::chrono::steady_clock::now();
    State initial = initial_state(setup, options.run);
    HardSphereSystem system(setup, initial);
    const bool logging = options.log_collisions && setup.domain != Domain::periodic;
    if (logging) system.log_collisions(std::move(initial));
    Trajectory trajectory;
    trajectory.engine = "hard";
    trajectory.initial_energy = system.initial_energy();
    Promise promise{system};
    const auto samples =
        static_cast<std::int64_t>(std::floor(setup.run.duration * setup.run.sample_rate * (1 + 1e-12)));
    reserve(static_cast<std::size_t>(samples + 1), trajectory);
    const std::int64_t report_every = std::max<std::int64_t>(1, samples / 200);
    for (std::int64_t k = 0; k <= samples; ++k) {
      const double time = static_cast<double>(k) / setup.run.sample_rate;
      // Small dampers have few events a sample, too few for the loop itself to look at the flag.
      const bool stopped = k > 0 && options.stop != nullptr && options.stop->load(std::memory_order_relaxed);
      if (stopped || !advance(system, time, setup.run.duration, options)) {
        trajectory.interrupted = true;
        break;
      }
      promise.see(append(system.observe(), system.ledger(), trajectory));
      if (k % report_every == 0) promise.check_on_the_way();
      if (options.progress && k % report_every == 0) options.progress(time);
    }
    trajectory.end_time = trajectory.time.empty() ? 0 : trajectory.time.back();
    // a rest shorter than the interval of samples
    if (!trajectory.interrupted && setup.run.duration > trajectory.end_time) {
      trajectory.interrupted = !advance(system, setup.run.duration, setup.run.duration, options);
      promise.see(system.observe().total_energy);
      if (!trajectory.interrupted) trajectory.end_time = setup.run.duration;
    }
    promise.check();
    trajectory.ledger = system.ledger();
    trajectory.end_state = system.state();
    trajectory.collisions = system.collisions();
    trajectory.events = system.events();
    trajectory.health = system.health();
    if (logging) trajectory.collision_log = std::make_shared<const CollisionLog>(system.collision_log());
    trajectory.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return trajectory;
  }

 private:
  /// Checks what is promised while the run goes on, so that a run that is lost ends early.
  struct Promise {
    const HardSphereSystem& system;
    double most_energy = 0;  ///< J, so far

    void see(double energy) { most_energy = std::isfinite(energy) ? std::max(most_energy, energy) : energy; }
    /// Checks overlaps and finite numbers alone: while forces have put in little energy yet, rounding is a
    /// large part of it, so the balance counts at the end.
    void check_on_the_way() const {
      if (system.health().deepest_overlap > most_overlap || !std::isfinite(most_energy)) check();
    }
    void check() const { expect_kept(system.health(), system.time(), most_energy); }
  };

  /// Moves the system on to `until`, s, and tells progress in between where samples are far apart; false when
  /// stopped.
  static bool advance(HardSphereSystem& system, double until, double duration, const RunOptions& options) {
    const double piece = duration / 100;
    while (until - system.time() > 2 * piece) {
      if (!system.advance_to(system.time() + piece, options.stop)) return false;
      if (options.progress) options.progress(system.time());
    }
    return system.advance_to(until, options.stop);
  }

  static void reserve(std::size_t samples, Trajectory& trajectory) {
    for (auto* series : {&trajectory.time, &trajectory.x_box, &trajectory.v_box, &trajectory.x_com,
                         &trajectory.total_energy})
      series->reserve(samples);
    for (auto& series : trajectory.loss) series.reserve(samples);
  }
  /// Appends one sample to the trajectory; returns its energy, J.
  static double append(const Observation& seen, const Ledger& ledger, Trajectory& trajectory) {
    trajectory.time.push_back(seen.time);
    trajectory.x_box.push_back(seen.x_box);
    trajectory.v_box.push_back(seen.v_box);
    trajectory.x_com.push_back(seen.x_com);
    trajectory.total_energy.push_back(seen.total_energy);
    for (std::size_t c = 0; c < contact_classes; ++c) trajectory.loss[c].push_back(ledger.contact_loss[c]);
    return seen.total_energy;
  }
};

}  // namespace

std::unique_ptr<Engine> make_hard_engine() { return std::make_unique<HardEngine>(); }

}  // namespace shakedown
