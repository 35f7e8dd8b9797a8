// SPDX-License-Identifier: MIT
#include "kick.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "friction.hpp"
#include "rolling.hpp"
#include "sum_in_order.hpp"

namespace shakedown {

namespace {

bool acts_on_every_grain(const GrainForces& forces) {
  return !forces.drag.sum().none() || !forces.free.empty();
}

/// One half kick; the plain path touches only the bodies in contact.
class HalfKick {
 public:
  HalfKick(const KickedRun& run, double time, double half_step)
      : model_(run.model),
        grain_forces_(run.grain_forces),
        time_(time),
        half_step_(half_step),
        bodies_(run.bodies),
        contacts_(run.contacts),
        space_(run.space),
        friction_(model_.law.has_friction()),
        rolling_(model_.law.resists_rolling()),
        everywhere_(acts_on_every_grain(grain_forces_)),
        box_is_held_(model_.box_mass == 0) {}

  void run(int passes, Accounts& accounts) {
    if (contacts_.empty() && !everywhere_) return;
    if (!everywhere_) list_bodies();
    for_each_body([this](Eigen::Index body) { remember(body); });
    for (int pass = 0; pass < passes; ++pass) {
      for_each_body([this](Eigen::Index body) { clear(body); });
      if (everywhere_) add_field_forces();
      for (Contact& contact : contacts_) add_contact_force(contact);
      for_each_body([this](Eigen::Index body) { accelerate(body); });
    }
    for (Contact& contact : contacts_) enter_work(contact, accounts);
    if (everywhere_) enter_field_work(accounts);
  }

 private:
  /// Lists the bodies in contact, each once.
  void list_bodies() {
    space_.touched.clear();
    const auto list = [&](int body) {
      bool& listed = space_.listed[static_cast<std::size_t>(body)];
      if (!listed) space_.touched.push_back(body);
      listed = true;
    };
    for (const Contact& contact : contacts_) {
      list(contact.i);
      list(contact.j);
    }
    for (const int body : space_.touched) space_.listed[static_cast<std::size_t>(body)] = false;
  }

  /// Calls `action` for each body that takes part.
  template <class Action>
  void for_each_body(Action action) {
    if (everywhere_)
      for (Eigen::Index body = 0; body <= bodies_.box(); ++body) action(body);
    else
      for (const int body : space_.touched) action(body);
  }

  void remember(Eigen::Index body) {
    for (int axis = 0; axis < 3; ++axis) space_.velocity_before(body, axis) = bodies_.velocity(body, axis);
    if (friction_)
      for (int axis = 0; axis < 3; ++axis) space_.spin_before(body, axis) = bodies_.spin(body, axis);
  }

  void clear(Eigen::Index body) {
    for (int axis = 0; axis < 3; ++axis) space_.force(body, axis) = 0;
    if (friction_)
      for (int axis = 0; axis < 3; ++axis) space_.torque(body, axis) = 0;
  }

  void accelerate(Eigen::Index body) {
    const double along = half_step_ * bodies_.inverse_mass(body),
                 across = half_step_ * bodies_.inverse_mass_across(body);
    bodies_.velocity(body, 0) = space_.velocity_before(body, 0) + along * space_.force(body, 0);
    bodies_.velocity(body, 1) = space_.velocity_before(body, 1) + across * space_.force(body, 1);
    bodies_.velocity(body, 2) = space_.velocity_before(body, 2) + across * space_.force(body, 2);
    if (!friction_) return;
    const double turn = half_step_ * bodies_.inverse_inertia(body);
    for (int axis = 0; axis < 3; ++axis)
      bodies_.spin(body, axis) = space_.spin_before(body, axis) + turn * space_.torque(body, axis);
  }

  void set_normal_force(Contact& contact) const {
    const double rate = (bodies_.velocity_of(contact.j) - bodies_.velocity_of(contact.i)).dot(contact.normal);
    const double overlap = contact.touching ? contact.overlap : 0.0;
    double viscous;
    if (model_.law.pushes(contact.kind)) {
      const auto push = [&](double at_rate) {
        return model_.law.push(contact.kind, overlap, at_rate, contact.closing_speed, contact.reduced_mass);
      };
      contact.elastic_force = overlap > 0 ? push(0) : 0.0;
      viscous = contact.dashpot != 0 ? contact.dashpot * (push(rate) - push(0)) : 0.0;
    } else {
      contact.elastic_force = contact.spring.stiffness * overlap;
      viscous = contact.dashpot * contact.spring.damping * rate;
    }
    contact.normal_force =
        contact.elastic_force + viscous - contact.attraction * model_.law.attraction(contact.kind);
  }

  void add_contact_force(Contact& contact) {
    set_normal_force(contact);
    Vec3 force = contact.normal_force * contact.normal;
    if (friction_) {
      set_friction(model_, bodies_, contact);
      force += contact.tangential_force;
      const Vec3 twist = -contact.normal.cross(contact.tangential_force);
      add(space_.torque, contact.i, lever_of_first(bodies_, contact) * twist);
      add(space_.torque, contact.j, lever_of_second(bodies_, contact) * twist);
    }
    if (rolling_) {
      contact.rolling_torque = rolling_torque(model_, bodies_, contact, space_.spin_before, half_step_);
      add(space_.torque, contact.i, contact.rolling_torque);
      add(space_.torque, contact.j, -contact.rolling_torque);
    }
    add(space_.force, contact.i, force);
    add(space_.force, contact.j, -force);
  }

  static void add(Bodies::Rows& rows, Eigen::Index body, const Vec3& value) {
    for (int axis = 0; axis < 3; ++axis) rows(body, axis) += value(axis);
  }

  /// Returns the mean of a body's row before and after.
  static Vec3 mean(const Bodies::Rows& before, const Bodies::Rows& after, Eigen::Index body) {
    return {(before(body, 0) + after(body, 0)) / 2, (before(body, 1) + after(body, 1)) / 2,
            (before(body, 2) + after(body, 2)) / 2};
  }
  Vec3 mean_velocity(Eigen::Index body) const { return mean(space_.velocity_before, bodies_.velocity, body); }
  Vec3 mean_spin(Eigen::Index body) const { return mean(space_.spin_before, bodies_.spin, body); }

  void enter_work(Contact& contact, Accounts& accounts) {
    const Vec3 relative = mean_velocity(contact.i) - mean_velocity(contact.j);
    double power = contact.normal_force * relative.dot(contact.normal);
    if (friction_) {
      const Vec3 rolling = lever_of_first(bodies_, contact) * mean_spin(contact.i) +
                           lever_of_second(bodies_, contact) * mean_spin(contact.j);
      power += contact.tangential_force.dot(relative - rolling.cross(contact.normal));
      let_slide(model_, bodies_, contact);
    }
    if (rolling_) power += contact.rolling_torque.dot(mean_spin(contact.i) - mean_spin(contact.j));
    accounts.contact_work[static_cast<std::size_t>(contact.kind)] += half_step_ * power;
    if (box_is_held_ && contact.j == bodies_.box())
      accounts.outer_impulse +=
          half_step_ * (contact.normal_force * contact.normal.x() + contact.tangential_force.x());
  }

  /// Adds the drag of air that moves with the box, and the user's formulas.
  void add_field_forces() {
    const Eigen::Index n = bodies_.grains, box = bodies_.box();
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vec3 wind = bodies_.velocity_of(i) - bodies_.velocity_of(box);
      space_.wind(i) = wind.norm();
      const Vec3 drag = -grain_forces_.drag.sum().over_speed(space_.wind(i)) * wind;
      for (int axis = 0; axis < 3; ++axis) space_.drag(i, axis) = drag(axis);
      add(space_.force, i, drag);
      add(space_.force, box, -drag);
      for (std::size_t k = 0; k < grain_forces_.free.size(); ++k) {
        const double newton =
            grain_forces_.free[k].newton(bodies_.position(i, 0), bodies_.velocity(i, 0), time_);
        space_.free[k](i) = newton;
        space_.force(i, 0) += newton;
      }
    }
  }

  void enter_field_work(Accounts& accounts) {
    if (box_is_held_)
      accounts.outer_impulse += half_step_ * sum_in_order(space_.drag.col(0).head(bodies_.grains));
    for (const auto& share : grain_forces_.drag.shares())
      accounts.add_work(share.effect, half_step_ * drag_power(share.strength));
    for (std::size_t k = 0; k < grain_forces_.free.size(); ++k) {
      double power = 0, force = 0;
      for (Eigen::Index i = 0; i < bodies_.grains; ++i) {
        power += space_.free[k](i) * mean_velocity(i).x();
        force += space_.free[k](i);
      }
      accounts.add_work(grain_forces_.free[k].effect, half_step_ * power);
      accounts.outer_impulse += half_step_ * force;
    }
  }

  /// Returns the power of one effect's drag on all grains, W.
  double drag_power(const AirDrag& drag) const {
    const double box_speed = mean_velocity(bodies_.box()).x();
    double power = 0;
    for (Eigen::Index i = 0; i < bodies_.grains; ++i) {
      const double all = grain_forces_.drag.sum().over_speed(space_.wind(i));
      if (all == 0) continue;
      const Vec3 speed = mean_velocity(i);
      power += drag.over_speed(space_.wind(i)) / all *
               (space_.drag(i, 0) * (speed.x() - box_speed) + space_.drag(i, 1) * speed.y() +
                space_.drag(i, 2) * speed.z());
    }
    return power;
  }

  const ContactModel& model_;
  const GrainForces& grain_forces_;
  double time_, half_step_;
  Bodies& bodies_;
  std::vector<Contact>& contacts_;
  KickSpace& space_;
  bool friction_, rolling_, everywhere_, box_is_held_;
};

void make_room(const Bodies& bodies, const GrainForces& forces, KickSpace& space) {
  const Eigen::Index rows = bodies.grains + 1;
  if (space.force.rows() == rows) return;
  for (Bodies::Rows* part :
       {&space.velocity_before, &space.spin_before, &space.force, &space.torque, &space.drag})
    part->setZero(rows, 3);
  space.listed = std::make_unique<bool[]>(static_cast<std::size_t>(rows));
  space.wind.setZero(rows);
  space.free.assign(forces.free.size(), Bodies::Column::Zero(rows));
}

}  // namespace

void half_kick(const KickedRun& run, double time, double half_step, int passes) {
  make_room(run.bodies, run.grain_forces, run.space);
  HalfKick(run, time, half_step).run(passes, run.accounts);
}

}  // namespace shakedown
