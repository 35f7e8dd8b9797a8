// SPDX-License-Identifier: MIT
#include "apart_engine.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "initial_state.hpp"
#include "motion.hpp"

namespace shakedown {

namespace {

using apart::Model;
using apart::Motion;

void check(const Setup& setup) {
  std::vector<Violation> found;
  if (setup.domain == Domain::periodic)
    found.push_back({place_of(setup, "domain.kind"), "domain.kind",
                     "periodic is not modelled by engine 'apart' (its walls are real ones)",
                     "use engine 'hard' for periodic cells, or domain.kind = \"closed\""});
  if (!(setup.soft.contact_time > 0))
    found.push_back({place_of(setup, "soft.contact_time"), "soft.contact_time",
                     "must be above zero (it sets the stiffness)", "0.3 ms suits the paper's damper"});
  constexpr double fewest = 5;
  if (!(setup.soft.steps_per_contact >= fewest))
    found.push_back({place_of(setup, "soft.steps_per_contact"), "soft.steps_per_contact",
                     "is too few steps (below 5 the contact is not resolved)", "use 20 or more"});
  for (const auto& [key, value] : {std::pair{"restitution.grain_grain", setup.restitution.grain_grain},
                                   std::pair{"restitution.grain_wall", setup.restitution.grain_wall}})
    if (value < apart::least_restitution)
      found.push_back({place_of(setup, key), key,
                       "is too small for engine 'apart', whose contacts unload stiffer by its square",
                       "use 0.1 or more, or engine 'hard' or 'soft'"});
  for (const EffectChoice& choice : setup.effects)
    if (const std::string_view name = apart::unknown_parameter(choice); !name.empty())
      found.push_back({choice.place, std::string(choice.record->name) + "." + std::string(name),
                       "is not modelled by engine 'apart' but at its default",
                       "use engine 'hard' or 'soft'"});
  if (!found.empty()) throw InputError(std::move(found));
}

/// Returns the longest step, s: the unloading of a contact takes e / (1 + e) of its time, and is to have its
/// share of the steps.
double longest_step(const Setup& setup) {
  const double e = std::min(setup.restitution.grain_grain, setup.restitution.grain_wall),
               stiffer = std::min(1.0, 2 * e / (1 + e));
  constexpr double steps_of_a_swing = 1e4;
  if (setup.grains.count == 0 && setup.spring.frequency > 0)
    return 1 / (steps_of_a_swing * setup.spring.frequency);
  return stiffer * setup.soft.contact_time / setup.soft.steps_per_contact;
}

class ApartRun {
 public:
  ApartRun(const Setup& setup, const RunOptions& options)
      : setup_(setup),
        options_(options),
        model_(apart::model_of(setup, options.run)),
        interval_(1 / setup.run.sample_rate),
        steps_(std::max<std::int64_t>(
            1, static_cast<std::int64_t>(std::ceil(interval_ / longest_step(setup) * (1 - 1e-12))))),
        step_(interval_ / static_cast<double>(steps_)),
        motion_(model_, initial_state(setup, options.run), step_, setup.effects.size()) {}
  ApartRun(const ApartRun&) = delete;
  ApartRun& operator=(const ApartRun&) = delete;

  Trajectory run() {
    const auto started = std::chrono::steady_clock::now();
    trajectory_.engine = "apart";
    const auto samples =
        static_cast<std::int64_t>(std::floor(setup_.run.duration * setup_.run.sample_rate * (1 + 1e-12)));
    sample(0);
    for (std::int64_t k = 1; k <= samples && !trajectory_.interrupted; ++k) {
      const double from = static_cast<double>(k - 1) * interval_;
      for (std::int64_t n = 0; n < steps_; ++n) motion_.advance(from + static_cast<double>(n) * step_);
      trajectory_.events += steps_;
      sample(k);
      if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed))
        trajectory_.interrupted = true;
      if (options_.progress && k % 50 == 0) options_.progress(trajectory_.time.back());
    }
    finish();
    trajectory_.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return std::move(trajectory_);
  }

 private:
  void sample(std::int64_t k) {
    const State& state = motion_.state();
    const double energy = motion_.energy();
    const auto lost = motion_.contact_loss();
    trajectory_.time.push_back(static_cast<double>(k) * interval_);
    trajectory_.x_box.push_back(state.x_box);
    trajectory_.v_box.push_back(state.v_box);
    trajectory_.x_com.push_back(centre_of_mass_x(state));
    trajectory_.total_energy.push_back(energy);
    double open = energy - trajectory_.total_energy.front();
    for (std::size_t kind = 0; kind < lost.size(); ++kind) {
      trajectory_.loss[kind].push_back(lost[kind]);
      open += lost[kind];
    }
    for (const double loss : motion_.effect_loss()) open += loss;
    most_ = std::max(most_, std::abs(energy));
    worst_ = std::max(worst_, std::abs(open));
    expect_inside(state, energy);
  }

  void expect_inside(const State& state, double energy) const {
    bool inside = std::isfinite(energy);
    for (const Vec3& place : state.position)
      inside = inside && std::abs(place.x() - state.x_box) < model_.half.x() &&
               std::abs(place.y()) < model_.half.y() && std::abs(place.z()) < model_.half.z();
    if (!inside)
      throw PhysicsError("engine 'apart': a grain has gone through a wall at t = " +
                         std::to_string(trajectory_.time.back()) +
                         " s. Use a shorter soft.contact_time or more soft.steps_per_contact.");
  }

  void finish() {
    trajectory_.initial_energy = trajectory_.total_energy.front();
    trajectory_.ledger.contact_loss = motion_.contact_loss();
    trajectory_.ledger.effect_loss = motion_.effect_loss();
    trajectory_.collisions = motion_.encounters().touches();
    trajectory_.end_time = trajectory_.time.back();
    trajectory_.end_state = motion_.state();
    trajectory_.health.deepest_overlap = motion_.encounters().deepest();
    trajectory_.health.ledger_error = most_ > 0 ? worst_ / most_ : 0;
    trajectory_.health.momentum_error = std::numeric_limits<double>::quiet_NaN();
    trajectory_.health.notes = {"a second coding for laboratories: springs that latch, the midpoint rule"};
  }

  const Setup& setup_;
  const RunOptions& options_;
  Model model_;
  double interval_;
  std::int64_t steps_;
  double step_;
  Motion motion_;
  Trajectory trajectory_;
  double most_ = 0, worst_ = 0;
};

class ApartEngine final : public Engine {
 public:
  std::string_view name() const override { return "apart"; }
  /// Answers by its own list: the records say what the other engines model.
  Capability can_model(const EffectRecord& effect) const override {
    if (const std::string_view how = apart::known_effect(effect.name); !how.empty())
      return {Fidelity::to_stated_error, how};
    return effect.capability(every_engine);
  }
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    refuse_what_is_not_modelled(*this, setup);
    check(setup);
    return ApartRun(setup, options).run();
  }
};

}  // namespace

std::unique_ptr<Engine> make_apart_engine() { return std::make_unique<ApartEngine>(); }

}  // namespace shakedown
