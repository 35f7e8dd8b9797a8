// SPDX-License-Identifier: MIT
#include "soft_engine.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "box_flow.hpp"
#include "grain_flow.hpp"
#include "kick.hpp"

namespace shakedown {

namespace {

/// Wide enough that Bullet is asked seldom, narrow enough that few pairs are looked at: in the dense layer of the paper's damper
/// 0.1 to 0.2 diameters cost the same, 0.05 and 0.4 a third more.
constexpr double skin_in_diameters = 0.15;
constexpr int implicit_passes = 3;
/// Fewer and the contact oscillator is no longer resolved at all (Verlet is unstable below pi / 2).
constexpr double fewest_steps_per_contact = 5;
/// Above this the bounce is visibly not what the setup says.
constexpr double largest_quiet_restitution_error = 5e-3;

std::string text_of(const char* format, auto... values) {
  std::array<char, 400> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

SourcePlace place_of(const Setup& setup, const std::string& key) {
  const auto found = setup.places.find(key);
  return found == setup.places.end() ? SourcePlace{} : found->second;
}

void check(const Setup& setup) {
  std::vector<Violation> found;
  if (setup.domain == Domain::periodic)
    found.push_back({place_of(setup, "domain"), "domain", "periodic is not modelled by engine 'soft' (its walls are real ones)",
                     "use engine 'hard' for periodic cells, or domain = \"closed\""});
  if (!(setup.soft.contact_time > 0))
    found.push_back({place_of(setup, "soft.contact_time"), "soft.contact_time", "must be above zero (it sets the stiffness)",
                     "0.3 ms suits the paper's damper"});
  if (!(setup.soft.steps_per_contact >= fewest_steps_per_contact))
    found.push_back({place_of(setup, "soft.steps_per_contact"), "soft.steps_per_contact",
                     text_of("%g is too few (below %g the contact is not resolved)", setup.soft.steps_per_contact,
                             fewest_steps_per_contact),
                     "use 20, or 50 for a restitution right to 6e-4"});
  if (!found.empty()) throw InputError(std::move(found));
}

/// One run from release to the end.
class SoftRun {
 public:
  SoftRun(const Setup& setup, const RunOptions& options, PairSearch search)
      : setup_(setup), options_(options), physics_(physics_of(setup)), held_(setup.domain != Domain::damper),
        state_(initial_state(setup, options.run)),
        model_{physics_.contact, setup.soft.contact_time, held_ ? 0.0 : physics_.box_mass, setup.box.length, setup.box.width},
        bodies_(bodies_of(state_, model_.box_mass)), box_(physics_),
        neighbours_(bodies_, model_.law.has_attraction() ? model_.law.attraction_range : 0.0,
                    search == PairSearch::every_step ? 0.0 : skin_in_diameters * setup.grains.diameter) {
    accounts_.effect_work.resize(setup.effects.size());
    find_contacts(model_, bodies_, neighbours_.pairs(bodies_), longest_step(), {}, contacts_, accounts_);
    settle_contacts(contacts_);
    stored_at_start_ = stored();
    initial_energy_ = energy();
    momentum_at_start_ = momentum();
  }

  Trajectory run() {
    const auto started = std::chrono::steady_clock::now();
    const double interval = 1 / setup_.run.sample_rate;
    // Samples at 0, interval, ... up to the duration; the last piece may be shorter and carries no sample.
    const auto samples = static_cast<std::int64_t>(std::floor(setup_.run.duration * setup_.run.sample_rate * (1 + 1e-12)));
    record(0);
    for (std::int64_t k = 1; k <= samples; ++k) {
      const double until = static_cast<double>(k) / setup_.run.sample_rate;
      if (!march(interval, until)) break;
      record(until);
      if (options_.progress && k % 50 == 0) options_.progress(until);
    }
    const double rest = setup_.run.duration - static_cast<double>(samples) / setup_.run.sample_rate;
    if (!trajectory_.interrupted && rest > 1e-9 * interval && march(rest, setup_.run.duration)) check_promises();
    finish();
    trajectory_.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return std::move(trajectory_);
  }

 private:
  double longest_step() const { return setup_.soft.contact_time / setup_.soft.steps_per_contact; }
  std::int64_t steps_in(double interval) const {
    return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(interval / longest_step() * (1 - 1e-12))));
  }

  bool stopped() {
    if (options_.stop == nullptr || !options_.stop->load(std::memory_order_relaxed)) return false;
    trajectory_.interrupted = true;
    return true;
  }

  /// Returns false when stopped on the way.
  bool march(double interval, double until) {
    const std::int64_t steps = steps_in(interval);
    const double step = interval / static_cast<double>(steps), from = until - interval;
    for (std::int64_t k = 0; k < steps; ++k) {
      time_ = from + static_cast<double>(k) * step;
      if ((k & 0xfff) == 0 && stopped()) return false;
      advance(time_, step);
      ++trajectory_.events;
    }
    time_ = until;
    return true;
  }

  void advance(double time, double step) {
    kick(time, step / 2, 1);
    with_arc([&] {
      advance_grains(physics_.grains, time, step, bodies_, accounts_);
      if (!held_) box_.advance(time, step, bodies_.x_box(), bodies_.v_box(), accounts_);
    });
    find_contacts(model_, bodies_, neighbours_.pairs(bodies_), step, contacts_, found_, accounts_);
    std::swap(contacts_, found_);
    kick(time + step, step / 2, implicit_passes);
    settle_contacts(contacts_);
  }

  void kick(double time, double half_step, int passes) {
    with_arc([&] {
      half_kick(model_, physics_.grains, time, half_step, passes, bodies_, contacts_, space_, accounts_);
    });
  }

  template <class Action>
  void with_arc(Action action) {
    const double before = bodies_.x_box() * bodies_.v_box();
    action();
    if (physics_.grains.arc_length > 0) follow_arc(physics_.grains, before, bodies_, accounts_);
  }

  double stored() const {
    double energy = 0;
    for (const Contact& contact : contacts_) energy += stored_energy(model_, contact);
    return energy;
  }

  double kinetic() const {
    const Eigen::Index n = bodies_.grains;
    double energy = held_ ? 0.0 : model_.box_mass * bodies_.v_box() * bodies_.v_box() / 2;
    for (Eigen::Index i = 0; i < n; ++i) {
      energy += bodies_.mass(i) * bodies_.velocity_of(i).squaredNorm() / 2;
      energy += 0.2 * bodies_.mass(i) * bodies_.radius(i) * bodies_.radius(i) * bodies_.spin_of(i).squaredNorm();
    }
    return energy;
  }

  double energy() const { return kinetic() + stored() + (held_ ? 0.0 : box_.spring_energy(bodies_.x_box())); }

  double momentum() const {
    return (bodies_.mass * bodies_.velocity.col(0).head(bodies_.grains)).sum() + model_.box_mass * bodies_.v_box();
  }

  double momentum_scale() const {
    const double spring =
        held_ ? 0.0 : setup_.box.mass * 2 * std::numbers::pi * setup_.spring.frequency * std::abs(setup_.release.displacement);
    if (spring > 0) return spring;
    double sum = 0;
    for (std::size_t i = 0; i < state_.size(); ++i) sum += state_.mass[i] * state_.velocity[i].norm();
    return sum > 0 ? sum : 1;
  }

  /// Dissipated in contacts of each class: what they took, less what their springs still hold.
  std::array<double, contact_classes> losses() const {
    std::array<double, contact_classes> loss{};
    for (std::size_t kind = 0; kind < contact_classes; ++kind) loss[kind] = -accounts_.contact_work[kind].value();
    for (const Contact& contact : contacts_) loss[static_cast<std::size_t>(contact.kind)] -= stored_energy(model_, contact);
    // Springs that are loaded at release (attraction) belong to pairs of grains and walls alike; only their sum is needed.
    loss[0] += stored_at_start_;
    return loss;
  }

  Ledger ledger() const {
    Ledger ledger{losses(), {}};
    for (const CompensatedSum& work : accounts_.effect_work) ledger.effect_loss.push_back(-work.value());
    return ledger;
  }

  double centre_of_mass() const {
    return bodies_.grains == 0 ? std::numeric_limits<double>::quiet_NaN()
                               : (bodies_.mass * bodies_.position.col(0).head(bodies_.grains)).sum() / bodies_.mass.sum();
  }

  void record(double time) {
    trajectory_.time.push_back(time);
    trajectory_.x_box.push_back(bodies_.x_box());
    trajectory_.v_box.push_back(bodies_.v_box());
    trajectory_.x_com.push_back(centre_of_mass());
    trajectory_.total_energy.push_back(energy());
    const auto loss = losses();
    for (std::size_t kind = 0; kind < contact_classes; ++kind) trajectory_.loss[kind].push_back(loss[kind]);
    check_promises();
  }

  void check_promises() {
    Health& health = trajectory_.health;
    const double scale = initial_energy_ > 0 ? initial_energy_ : 1;
    const double open = std::abs(energy() + ledger().total_loss() - initial_energy_) / scale;
    if (!std::isfinite(open) || accounts_.deepest_overlap > setup_.grains.diameter / 4) fail();
    health.ledger_error = std::max(health.ledger_error, open);
    const double drift = std::abs(momentum() - momentum_at_start_ - accounts_.outer_impulse.value());
    health.momentum_error = std::max(health.momentum_error, drift / momentum_scale());
  }

  /// Contacts deeper than half a radius, or numbers that are none: the setup asks for more than soft contacts can do.
  [[noreturn]] void fail() const {
    std::string text = text_of("engine 'soft': contacts are too soft at t = %.6g s: deepest overlap %.3g mm of a diameter of %.3g mm "
                               "(grains pass through walls and each other). Use a shorter soft.contact_time than %.3g ms.",
                               time_, accounts_.deepest_overlap * 1e3, setup_.grains.diameter * 1e3,
                               setup_.soft.contact_time * 1e3);
    text += text_of("\nbox: x %.9g m, v %.9g m/s", bodies_.x_box(), bodies_.v_box());
    for (const Contact& contact : contacts_)
      text += text_of("\n%s contact of grain %d and %d: overlap %.3g mm, touched at %.3g m/s",
                      contact_class_names[static_cast<std::size_t>(contact.kind)], contact.i + 1, contact.j + 1,
                      contact.overlap * 1e3, contact.closing_speed);
    throw PhysicsError(text);
  }

  void finish() {
    trajectory_.engine = "soft";
    trajectory_.initial_energy = initial_energy_;
    trajectory_.ledger = ledger();
    trajectory_.collisions = accounts_.collisions;
    trajectory_.end_time = time_;
    trajectory_.health.deepest_overlap = accounts_.deepest_overlap;
    add_notes();
  }

  void add_notes() {
    std::vector<std::string>& notes = trajectory_.health.notes;
    const double interval = 1 / setup_.run.sample_rate;
    const double steps = setup_.soft.contact_time / (interval / static_cast<double>(steps_in(interval)));
    const double error = predicted_restitution_error(steps);
    if (error > largest_quiet_restitution_error)
      notes.push_back(text_of("%.3g steps per contact are coarse: the restitution is off by up to %.2g (predicted); use 20 for "
                              "3.1e-3, 50 for 5e-4",
                              steps, error));
    if (steps > 2 * setup_.soft.steps_per_contact)
      notes.push_back(text_of("samples %.3g ms apart force %.3g steps per contact instead of %.3g", interval * 1e3, steps,
                              setup_.soft.steps_per_contact));
    if (accounts_.deepest_overlap > 0.03 * setup_.grains.diameter)
      notes.push_back(text_of("grains overlap by up to %.2g %% of their diameter: contacts this soft change the packing; use a "
                              "shorter soft.contact_time",
                              100 * accounts_.deepest_overlap / setup_.grains.diameter));
  }

  const Setup& setup_;
  const RunOptions& options_;
  Physics physics_;
  bool held_;
  State state_;
  ContactModel model_;
  Bodies bodies_;
  BoxFlow box_;
  Neighbours neighbours_;
  Accounts accounts_;
  std::vector<Contact> contacts_, found_;
  KickSpace space_;
  double time_ = 0, stored_at_start_ = 0, initial_energy_ = 0, momentum_at_start_ = 0;
  Trajectory trajectory_;
};

class SoftEngine final : public Engine {
 public:
  explicit SoftEngine(PairSearch search) : search_(search) {}
  std::string_view name() const override { return "soft"; }
  Capability can_model(const EffectRecord& effect) const override { return effect.soft; }
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    refuse_what_is_not_modelled(*this, setup);
    check(setup);
    return SoftRun(setup, options, search_).run();
  }

 private:
  PairSearch search_;
};

}  // namespace

std::unique_ptr<Engine> make_soft_engine(PairSearch search) { return std::make_unique<SoftEngine>(search); }

}  // namespace shakedown
