// SPDX-License-Identifier: MIT
#include "contacts.hpp"

#include <algorithm>
#include <cmath>

#include "friction.hpp"

namespace shakedown {

namespace {

constexpr std::uint64_t wall_bit = std::uint64_t{1} << 63;

std::uint64_t pair_key(int i, int j) {
  return (static_cast<std::uint64_t>(i) << 32) | static_cast<std::uint64_t>(j);
}
std::uint64_t wall_key(int i, int wall) { return wall_bit | pair_key(i, wall); }

struct Geometry {
  Vec3 normal;
  double overlap;
};

Geometry pair_geometry(const Bodies& bodies, int i, int j) {
  const Vec3 apart = bodies.position_of(i) - bodies.position_of(j);
  const double distance = apart.norm();
  return {apart / distance, bodies.radius(i) + bodies.radius(j) - distance};
}

/// Walls 0 .. 5 are -x, +x, -y, +y, -z, +z.
Geometry wall_geometry(const ContactModel& model, const Bodies& bodies, int i, int wall) {
  const int axis = wall / 2;
  const double side = wall % 2 == 0 ? -1 : 1;
  const double half = (axis == 0 ? model.length : model.width[static_cast<std::size_t>(axis - 1)]) / 2;
  const double offset = bodies.position(i, axis) - (axis == 0 ? bodies.x_box() : 0.0);
  Vec3 normal = Vec3::Zero();
  normal(axis) = -side;
  return {normal, side * offset + bodies.radius(i) - half};
}

double closing_speed(const Bodies& bodies, const Contact& contact) {
  return (bodies.velocity_of(contact.j) - bodies.velocity_of(contact.i)).dot(contact.normal);
}

/// Returns the part of a step spent inside a range, from how far inside it is now (m, > 0) and how fast it
/// deepened (m/s).
double part_of_step_inside(double depth, double rate, double step) {
  const double advance = rate * step;
  return advance > depth ? depth / advance : 1.0;
}

/// Returns the part of a step spent inside a range that was left: depth before and (negative) depth now, m.
double part_of_step_before_leaving(double before, double now) {
  return before > 0 ? before / (before - now) : 0.0;
}

double reduced_mass_of(const ContactModel& model, const Bodies& bodies, const Contact& contact) {
  const double m = bodies.mass(contact.i);
  switch (contact.kind) {
    case ContactClass::grain_grain: return m * bodies.mass(contact.j) / (m + bodies.mass(contact.j));
    case ContactClass::end_wall: return model.box_mass > 0 ? m * model.box_mass / (m + model.box_mass) : m;
    case ContactClass::side_wall: return m;
  }
  return m;
}

void set_attraction(const ContactLaw& law, bool fresh, double overlap_before, double rate, double step,
                    Contact& contact) {
  const double depth = contact.overlap + law.attraction_range,
               depth_before = overlap_before + law.attraction_range;
  if (depth <= 0)
    contact.attraction = 2 * part_of_step_before_leaving(depth_before, depth) - 1;
  else
    contact.attraction = fresh ? 2 * part_of_step_inside(depth, rate, step) : 1;
}

/// Merges the candidates, which come in order of their keys, with the contacts of the step before.
class Merge {
 public:
  Merge(const ContactModel& model, const Bodies& bodies, double step, const std::vector<Contact>& before,
        FoundContacts& found)
      : model_(model),
        bodies_(bodies),
        step_(step),
        old_(before.begin()),
        end_(before.end()),
        found_(found),
        now_(found.contacts) {}

  /// Few pairs and grains are candidates: within the loops that look for them this would take their
  /// registers.
  [[gnu::noinline]] void candidate(std::uint64_t key, int i, int j, ContactClass kind,
                                   const Geometry& geometry) {
    pass_by_until(key);
    if (old_ != end_ && old_->key == key) {
      now_.push_back(*old_++);
      update(geometry, false, now_.back());
      return;
    }
    Contact& contact = now_.emplace_back();
    contact.key = key;
    contact.i = i;
    contact.j = j;
    contact.kind = kind;
    contact.reduced_mass = reduced_mass_of(model_, bodies_, contact);
    update(geometry, true, contact);
  }

  void finish() { pass_by_until(~std::uint64_t{0}); }

 private:
  /// Takes over the contacts of the step before up to this key, which are no candidates any more; those that
  /// have separated are marked `over`.
  void pass_by_until(std::uint64_t key) {
    for (; old_ != end_ && old_->key < key; ++old_) {
      now_.push_back(*old_);
      Contact& contact = now_.back();
      const bool wall = (contact.key & wall_bit) != 0;
      const auto number = static_cast<int>(contact.key & 0xffffffffu);
      const Geometry geometry = wall ? wall_geometry(model_, bodies_, contact.i, number)
                                     : pair_geometry(bodies_, contact.i, contact.j);
      update(geometry, false, contact);
    }
  }

  /// Brings a contact to the positions after the drift. `fresh`: it did not exist before.
  void update(const Geometry& geometry, bool fresh, Contact& contact) {
    const double overlap_before = contact.overlap;
    contact.normal = geometry.normal;
    contact.overlap = geometry.overlap;
    const double rate = closing_speed(bodies_, contact);
    double part_touching = 1;
    if (contact.overlap > 0) {
      if (!contact.touching) {
        begin_touch(rate, contact);
        part_touching = contact.dashpot / 2;
      }
      found_.deepest_overlap = std::max(found_.deepest_overlap, contact.overlap);
    } else if (contact.touching) {
      contact.touching = false;
      contact.dashpot = 2 * part_of_step_before_leaving(overlap_before, contact.overlap) - 1;
    } else {
      contact.dashpot = 0;
    }
    const bool attracts = model_.law.attraction(contact.kind) > 0;
    if (attracts) set_attraction(model_.law, fresh, overlap_before, rate, step_, contact);
    if (rubs(model_, contact)) stretch_tangentially(bodies_, step_ * part_touching, contact);
    contact.over = contact.overlap <= -model_.law.reach(contact.kind);
  }

  void begin_touch(double rate, Contact& contact) {
    contact.touching = true;
    contact.closing_speed = std::max(rate, 0.0);
    contact.spring = spring_dashpot(model_.law.restitution_of(contact.kind, contact.closing_speed),
                                    contact.reduced_mass, model_.contact_time);
    contact.dashpot = 2 * part_of_step_inside(contact.overlap, rate, step_);
    contact.stretch.setZero();
    if (rubs(model_, contact))
      contact.friction = model_.law.friction_of(contact.kind, slip_velocity(bodies_, contact));
    ++found_.touches[static_cast<std::size_t>(contact.kind)];
  }

  const ContactModel& model_;
  const Bodies& bodies_;
  double step_;
  std::vector<Contact>::const_iterator old_, end_;
  FoundContacts& found_;
  std::vector<Contact>& now_;
};

/// Tells whether any grain is within `range` (m) of a wall across `axis`, in one vector pass, as it mostly is
/// not.
bool any_at_wall(const Bodies& bodies, int axis, double centre, double half, double range) {
  return ((bodies.position.col(axis).head(bodies.grains) - centre).abs() + bodies.radius).maxCoeff() >
         half - range;
}

void wall_candidates(const ContactModel& model, const Bodies& bodies, Merge& merge) {
  const double range = model.law.reach(ContactClass::end_wall);
  const std::array<double, 3> half{model.length / 2, model.width[0] / 2, model.width[1] / 2};
  const std::array<double, 3> centre{bodies.x_box(), 0, 0};
  std::array<bool, 3> near{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    near[axis] = any_at_wall(bodies, static_cast<int>(axis), centre[axis], half[axis], range);
  if (!near[0] && !near[1] && !near[2]) return;
  const double* radius = bodies.radius.data();
  const auto reaches = [&](int i) {
    bool any = false;
    for (std::size_t a = 0; a < 3; ++a)
      any |= near[a] &&
             std::abs(bodies.position(i, static_cast<int>(a)) - centre[a]) + radius[i] > half[a] - range;
    return any;
  };
  for (int i = 0; i < bodies.grains; ++i) {
    if (!reaches(i)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      if (!near[a]) continue;
      const double offset = bodies.position(i, axis) - centre[a];
      // In a box as narrow as a grain both walls can be within reach.
      for (const int side : {0, 1})
        if ((side == 0 ? -offset : offset) + bodies.radius(i) > half[a] - range) {
          const int wall = 2 * axis + side;
          merge.candidate(wall_key(i, wall), i, static_cast<int>(bodies.box()),
                          axis == 0 ? ContactClass::end_wall : ContactClass::side_wall,
                          wall_geometry(model, bodies, i, wall));
        }
    }
  }
}

}  // namespace

FoundContacts find_contacts(const ContactModel& model, const Bodies& bodies, const std::vector<Pair>& pairs,
                            double step, const std::vector<Contact>& before, FoundContacts memory) {
  FoundContacts found;
  found.contacts = std::move(memory.contacts);
  found.contacts.clear();
  Merge merge(model, bodies, step, before, found);
  const double* x = bodies.position.data();
  const double* y = x + bodies.position.rows();
  const double* z = y + bodies.position.rows();
  for (const Pair& pair : pairs) {
    const double dx = x[pair.i] - x[pair.j], dy = y[pair.i] - y[pair.j], dz = z[pair.i] - z[pair.j];
    if (dx * dx + dy * dy + dz * dz < pair.reach_squared)
      merge.candidate(pair_key(pair.i, pair.j), pair.i, pair.j, ContactClass::grain_grain,
                      pair_geometry(bodies, pair.i, pair.j));
  }
  if (bodies.grains > 0) wall_candidates(model, bodies, merge);
  merge.finish();
  return found;
}

void settle_contacts(std::vector<Contact>& contacts) {
  std::erase_if(contacts, [](const Contact& contact) { return contact.over; });
  for (Contact& contact : contacts) {
    contact.dashpot = contact.touching ? 1 : 0;
    if (contact.attraction != 0) contact.attraction = 1;
  }
}

double stored_energy(const ContactModel& model, const Contact& contact) {
  double energy = 0;
  if (contact.touching) {
    energy += model.law.pushes(contact.kind)
                  ? model.law.stored_energy(contact.kind, contact.overlap, contact.closing_speed,
                                            contact.reduced_mass)
                  : contact.spring.stiffness * contact.overlap * contact.overlap / 2;
    if (rubs(model, contact)) energy += energy_of_stretch(model, contact);
  }
  if (const double reach = model.law.reach(contact.kind); reach > 0 && contact.overlap > -reach)
    energy -= model.law.attraction(contact.kind) * (contact.overlap + reach);
  return energy;
}

}  // namespace shakedown
