// SPDX-License-Identifier: MIT
#include "soft_engine.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>

#include "box_flow.hpp"
#include "contacts.hpp"
#include "grain_flow.hpp"
#include "initial_state.hpp"
#include "kick.hpp"
#include "printed_text.hpp"
#include "run_record.hpp"

namespace shakedown {

namespace {

/// Wide enough that Bullet is asked seldom, narrow enough that few pairs are looked at now and then.
constexpr double skin_in_diameters = 0.3;
constexpr int implicit_passes = 3;
/// With fewer steps the contact oscillator is not resolved (Verlet is unstable below pi / 2).
constexpr double fewest_steps_per_contact = 5;
/// An error of the restitution above this is told, as the bounce is then visibly not what the setup says.
constexpr double largest_quiet_restitution_error = 5e-3;

void expect_soft(const Setup& setup) {
  std::vector<Violation> found;
  if (setup.domain == Domain::periodic)
    found.push_back({place_of(setup, "domain.kind"), "domain.kind",
                     "periodic is not modelled by engine 'soft' (its walls are real ones)",
                     "use engine 'hard' for periodic cells, or domain.kind = \"closed\""});
  if (!(setup.soft.contact_time > 0))
    found.push_back({place_of(setup, "soft.contact_time"), "soft.contact_time",
                     "must be above zero (it sets the stiffness)", "0.3 ms suits the paper's damper"});
  if (!(setup.soft.steps_per_contact >= fewest_steps_per_contact))
    found.push_back({place_of(setup, "soft.steps_per_contact"), "soft.steps_per_contact",
                     text_of("%g is too few (below %g the contact is not resolved)",
                             setup.soft.steps_per_contact, fewest_steps_per_contact),
                     "use 20, or 50 for a restitution right to 6e-4"});
  if (!found.empty()) throw InputError(std::move(found));
}

/// One run from a state to the end.
class SoftRun {
 public:
  SoftRun(const State& state, const Setup& setup, const RunOptions& options, PairSearch search)
      : setup_(setup),
        options_(options),
        physics_(physics_of(setup)),
        held_(setup.domain != Domain::damper),
        model_{physics_.contact, setup.soft.contact_time, held_ ? 0.0 : physics_.box_mass, setup.box.length,
               setup.box.width},
        bodies_(bodies_of(state, model_.box_mass)),
        box_(physics_),
        neighbours_(bodies_, model_.law.reach(ContactClass::grain_grain),
                    search == PairSearch::every_step ? 0.0 : skin_in_diameters * setup.grains.diameter),
        record_(setup, "soft", model_.box_mass, [this](double x) { return box_.spring_energy(x); }) {
    accounts_.effect_work.resize(setup.effects.size());
    find_contacts_after(longest_step());
    settle_contacts(contacts_);
    record_.begin(setup, bodies_, stored());
  }
  SoftRun(const SoftRun&) = delete;
  SoftRun& operator=(const SoftRun&) = delete;

  Trajectory run() {
    const auto started = std::chrono::steady_clock::now();
    through_samples(
        setup_, options_, [this](double interval, double until) { return march(interval, until); },
        [this](double time) {
          check_promises();
          record_.sample(time, bodies_, accounts_, stored());
        });
    check_promises();
    add_notes();
    Trajectory trajectory = record_.finish(bodies_, accounts_, stored(), time_);
    expect_balanced(trajectory.health.ledger_error);
    trajectory.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    return trajectory;
  }

 private:
  double longest_step() const { return setup_.soft.contact_time / setup_.soft.steps_per_contact; }

  bool march(double interval, double until) {
    const std::int64_t steps = steps_that_fill(interval, longest_step());
    const double step = interval / static_cast<double>(steps), from = until - interval;
    for (std::int64_t k = 0; k < steps; ++k) {
      time_ = from + static_cast<double>(k) * step;
      if (!goes_on(options_, k, 0x1000, time_)) {
        record_.trajectory.interrupted = true;
        return false;
      }
      advance(time_, step);
      ++record_.trajectory.events;
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
    find_contacts_after(step);
    kick(time + step, step / 2, implicit_passes);
    settle_contacts(contacts_);
  }

  void find_contacts_after(double step) {
    found_ = find_contacts(model_, bodies_, neighbours_.pairs(bodies_), step, contacts_, std::move(found_));
    std::swap(contacts_, found_.contacts);
    for (std::size_t kind = 0; kind < contact_classes; ++kind)
      accounts_.collisions[kind] += found_.touches[kind];
    accounts_.deepest_overlap = std::max(accounts_.deepest_overlap, found_.deepest_overlap);
  }

  void kick(double time, double half_step, int passes) {
    with_arc([&] {
      half_kick({model_, physics_.grains, bodies_, contacts_, space_, accounts_}, time, half_step, passes);
    });
  }

  template <class Action>
  void with_arc(Action action) {
    const double before = bodies_.x_box() * bodies_.v_box();
    action();
    if (physics_.grains.arc_length > 0) follow_arc(physics_.grains, before, bodies_, accounts_);
  }

  StoredEnergy stored() const {
    StoredEnergy energy{};
    for (const Contact& contact : contacts_)
      energy[static_cast<std::size_t>(contact.kind)] += stored_energy(model_, contact);
    return energy;
  }

  void check_promises() {
    const bool finite = record_.check(bodies_, accounts_, stored());
    if (!finite || accounts_.deepest_overlap > setup_.grains.diameter / 4) fail();
  }

  /// Throws PhysicsError where the balance is off: as the work of every force is entered, what is open then
  /// is a motion that the steps do not follow.
  void expect_balanced(double ledger_error) const {
    constexpr double most = 1e-6;  // of the energy
    if (ledger_error <= most) return;
    throw PhysicsError(
        text_of("engine 'soft': energy and losses do not balance: at t = %.6g s they are off by %.3g of the "
                "energy (%g "
                "is the most that is let pass). Use a shorter soft.contact_time than %.3g ms, or check "
                "spring.frequency "
                "and the masses.",
                time_, ledger_error, most, setup_.soft.contact_time * 1e3));
  }

  /// Throws PhysicsError for contacts deeper than half a radius, or numbers that are none: the setup asks for
  /// more than soft contacts can do.
  [[noreturn]] void fail() const {
    std::string text = text_of(
        "engine 'soft': contacts are too soft at t = %.6g s: deepest overlap %.3g mm of a diameter of %.3g "
        "mm "
        "(grains pass through walls and each other). Use a shorter soft.contact_time than %.3g ms.",
        time_, accounts_.deepest_overlap * 1e3, setup_.grains.diameter * 1e3, setup_.soft.contact_time * 1e3);
    text += text_of("\nbox: x %.9g m, v %.9g m/s", bodies_.x_box(), bodies_.v_box());
    constexpr std::size_t most_shown = 10;
    for (const Contact& contact : std::span(contacts_).first(std::min(most_shown, contacts_.size())))
      text += text_of("\n%s contact of grain %d and %d: overlap %.3g mm, touched at %.3g m/s",
                      contact_class_names[static_cast<std::size_t>(contact.kind)], contact.i + 1,
                      contact.j + 1, contact.overlap * 1e3, contact.closing_speed);
    if (contacts_.size() > most_shown) text += text_of("\nand %zu more", contacts_.size() - most_shown);
    throw PhysicsError(text);
  }

  void add_notes() {
    std::vector<std::string>& notes = record_.trajectory.health.notes;
    const double interval = 1 / setup_.run.sample_rate;
    const double steps =
        setup_.soft.contact_time / interval * static_cast<double>(steps_that_fill(interval, longest_step()));
    const double error = predicted_restitution_error(steps);
    if (error > largest_quiet_restitution_error)
      notes.push_back(text_of(
          "%.3g steps per contact are coarse: the restitution is off by up to %.2g (predicted); use 20 for "
          "3.1e-3, 50 for 5e-4",
          steps, error));
    if (steps > 2 * setup_.soft.steps_per_contact)
      notes.push_back(text_of("samples %.3g ms apart force %.3g steps per contact instead of %.3g",
                              interval * 1e3, steps, setup_.soft.steps_per_contact));
    if (accounts_.deepest_overlap > 0.03 * setup_.grains.diameter)
      notes.push_back(text_of(
          "grains overlap by up to %.2g %% of their diameter: contacts this soft change the packing; use a "
          "shorter soft.contact_time",
          100 * accounts_.deepest_overlap / setup_.grains.diameter));
  }

  const Setup& setup_;
  const RunOptions& options_;
  Physics physics_;
  bool held_;
  ContactModel model_;
  Bodies bodies_;
  BoxFlow box_;
  Neighbours neighbours_;
  RunRecord record_;
  Accounts accounts_;
  std::vector<Contact> contacts_;
  FoundContacts found_;
  KickSpace space_;
  double time_ = 0;
};

class SoftEngine final : public Engine {
 public:
  explicit SoftEngine(PairSearch search) : search_(search) {}
  std::string_view name() const override { return "soft"; }
  Capability can_model(const EffectRecord& effect) const override { return effect.capability(name()); }
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    refuse_what_is_not_modelled(*this, setup);
    expect_soft(setup);
    return SoftRun(initial_state(setup, options.run), setup, options, search_).run();
  }

 private:
  PairSearch search_;
};

}  // namespace

std::unique_ptr<Engine> make_soft_engine(PairSearch search) { return std::make_unique<SoftEngine>(search); }

Trajectory run_soft_from(const State& state, const Setup& setup, const RunOptions& options) {
  expect_soft(setup);
  return SoftRun(state, setup, options, PairSearch::neighbour_list).run();
}

}  // namespace shakedown
