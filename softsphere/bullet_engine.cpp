// SPDX-License-Identifier: MIT
#include "bullet_engine.hpp"

#include <chrono>

#include "box_flow.hpp"
#include "bullet_world.hpp"
#include "initial_state.hpp"
#include "printed_text.hpp"
#include "run_record.hpp"

namespace shakedown {

namespace {

bool has_forces_beside_spring(const Physics& physics) {
  return physics.spring_cubic != 0 || !physics.box.none();
}

void expect_modelled(const Setup& setup, const Physics& physics) {
  std::vector<Violation> found;
  if (setup.domain == Domain::periodic)
    found.push_back({place_of(setup, "domain.kind"), "domain.kind",
                     "periodic is not modelled by engine 'bullet' (Bullet has no periodic space)",
                     "use engine 'hard' for periodic cells, or domain.kind = \"closed\""});
  if (!(setup.bullet.time_step > 0))
    found.push_back({place_of(setup, "bullet.time_step"), "bullet.time_step", "must be above zero",
                     "0.1 ms suits the paper's damper"});
  const ContactLaw& law = physics.contact;
  const bool special_contacts = law.restitution_at || law.side_wall_restitution_at || law.has_friction() ||
                                law.restitution[1] != law.restitution[2];
  if (setup.bullet.defaults && (special_contacts || has_forces_beside_spring(physics)))
    found.push_back({place_of(setup, "bullet.defaults"), "bullet.defaults",
                     "does not go with effects (it shows Bullet untouched)", "set it to false"});
  if (!found.empty()) throw InputError(std::move(found));
}

class BulletRun {
 public:
  BulletRun(const Setup& setup, const RunOptions& options, const Physics& physics)
      : setup_(setup),
        options_(options),
        physics_(physics),
        held_(setup.domain != Domain::damper),
        untouched_(setup.bullet.defaults),
        bodies_(bodies_of(initial_state(setup, options.run), box_mass())),
        box_(physics),
        world_(setup, physics, box_mass(), bodies_),
        record_(setup, "bullet", box_mass(), [this](double x) { return box_.spring_energy(x); }) {
    accounts_.effect_work.resize(setup.effects.size());
    record_.begin(setup, bodies_, {});
  }
  BulletRun(const BulletRun&) = delete;
  BulletRun& operator=(const BulletRun&) = delete;

  Trajectory run() {
    const auto started = std::chrono::steady_clock::now();
    through_samples(
        setup_, options_, [this](double interval, double until) { return march(interval, until); },
        [this](double time) {
          if (!record_.check(bodies_, accounts_, {})) fail();
          record_.sample(time, bodies_, accounts_, {});
        });
    add_notes();
    Trajectory trajectory = record_.finish(bodies_, accounts_, {}, time_);
    trajectory.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return trajectory;
  }

 private:
  double box_mass() const { return held_ ? 0.0 : physics_.box_mass; }

  bool march(double interval, double until) {
    const std::int64_t steps = steps_that_fill(interval, setup_.bullet.time_step);
    const double step = interval / static_cast<double>(steps), from = until - interval;
    for (std::int64_t k = 0; k < steps; ++k) {
      time_ = from + static_cast<double>(k) * step;
      if (!goes_on(options_, k, 0x100, time_)) {
        record_.trajectory.interrupted = true;
        return false;
      }
      untouched_ ? advance_untouched(step) : advance(step);
      ++record_.trajectory.events;
    }
    time_ = until;
    return true;
  }

  /// Takes a step with the spring as users of Bullet write it: a force at the beginning of each step.
  void advance_untouched(double step) {
    world_.step(step, held_ ? 0.0 : -physics_.stiffness * bodies_.x_box(), accounts_);
    world_.read(bodies_);
    if (asleep_since_ < 0 && !held_ && world_.box_sleeps()) asleep_since_ = time_ + step;
  }

  /// Takes a step in which Bullet resolves the contacts at the places of its beginning; the flight to its end
  /// is computed here, and exact for the box.
  void advance(double step) {
    const double x = bodies_.x_box();
    world_.step(step, 0, accounts_);
    world_.read(bodies_);
    if (held_) return;
    fly_box(x, step);
    world_.write_box(bodies_);
  }

  void fly_box(double from, double step) {
    // Bullet's overlap correction has moved the box by this much: it did no work on velocities, but the
    // spring feels it.
    const double pushed = bodies_.x_box() - (from + step * bodies_.v_box());
    double x = from;
    box_.advance(time_, step, x, bodies_.v_box(), accounts_);
    bodies_.x_box() = x + pushed;
    const double work = box_.spring_energy(x + pushed) - box_.spring_energy(x);
    accounts_.contact_work[static_cast<std::size_t>(ContactClass::end_wall)] += work;
    correction_work_ += std::abs(work);
  }

  [[noreturn]] void fail() const {
    throw PhysicsError(text_of(
        "engine 'bullet': velocities are not finite at t = %.6g s (box x %.9g m, v %.9g m/s). Use a shorter "
        "bullet.time_step than %.3g ms.",
        time_, bodies_.x_box(), bodies_.v_box(), setup_.bullet.time_step * 1e3));
  }

  void add_notes() {
    std::vector<std::string>& notes = record_.trajectory.health.notes;
    if (!untouched_) {
      notes.push_back(
          "simultaneous contacts are resolved one after another (restitution is right in binary impacts "
          "only)");
      if (correction_work_.value() > 1e-9 * record_.trajectory.initial_energy)
        notes.push_back(
            text_of("overlap corrections moved the box against its spring by %.2g of E0 in sum, entered as "
                    "end-wall work",
                    correction_work_.value() / record_.trajectory.initial_energy));
      return;
    }
    notes.push_back(
        "Bullet as shipped: impacts below 0.2 m/s do not bounce, faster ones by up to 0.2 too much (overlap "
        "correction), bodies fall asleep");
    notes.push_back(
        "ledger and momentum are not exact: spring by semi-implicit Euler, energy from overlap correction, "
        "sleep");
    if (asleep_since_ >= 0)
      notes.push_back(text_of("the box fell asleep at t = %.4g s and stays at %.4g mm", asleep_since_,
                              bodies_.x_box() * 1e3));
  }

  const Setup& setup_;
  const RunOptions& options_;
  const Physics& physics_;
  bool held_, untouched_;
  Bodies bodies_;
  BoxFlow box_;
  BulletWorld world_;
  RunRecord record_;
  Accounts accounts_;
  CompensatedSum correction_work_;
  double time_ = 0, asleep_since_ = -1;
};

class BulletEngine final : public Engine {
 public:
  std::string_view name() const override { return "bullet"; }
  Capability can_model(const EffectRecord& effect) const override { return effect.capability(name()); }
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    refuse_what_is_not_modelled(*this, setup);
    const Physics physics = physics_of(setup);
    expect_modelled(setup, physics);
    return BulletRun(setup, options, physics).run();
  }
};

}  // namespace

std::unique_ptr<Engine> make_bullet_engine() { return std::make_unique<BulletEngine>(); }

}  // namespace shakedown
