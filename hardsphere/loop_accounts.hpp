// SPDX-License-Identifier: MIT
// What an event loop keeps book of: the energy that contacts and effects took, the impulses from outside, and
// how far energy and momentum fail to balance.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "observation.hpp"
#include "open_book.hpp"
#include "scene.hpp"

namespace shakedown {

template <class Scene>
class LoopAccounts {
 public:
  LoopAccounts(Scene& scene, const Physics& physics, const Setup& setup);

  /// Energy that is neither motion along straight lines nor the spring's.
  struct Held {
    std::span<const Vec3> spin;  ///< rad/s, of each grain; empty: none turns
    double in_wells = 0;         ///< J
  };
  /// The balances count from here on.
  void open(const Held& held);
  /// The motion now; enters how far the balances are off.
  Observation observe(const Held& held);

  /// An impact of this class has taken energy (J).
  void impact(ContactClass contact, double loss) {
    lose(static_cast<std::size_t>(contact), loss);
    ++collisions_[static_cast<std::size_t>(contact)];
  }
  /// J, taken so far by an effect between impacts.
  double& loss_of(int effect) { return ledger_.effect_loss[static_cast<std::size_t>(effect)]; }
  /// Adds up what the outer forces did to the grains and the box since the last call: the grains' momentum in
  /// the falling frame was constant.
  void catch_up();
  /// The walls give a grain an impulse (N s); with them moves whatever holds the box on its arc.
  void wall_pushes_grain(const Vec3& impulse) {
    if (arc_effect_ >= 0) loss_of(arc_effect_) -= impulse.z() * scene_.speed_across();
    catch_up_with_grains();
    grain_momentum_ += impulse;
  }
  /// Anything else gives a grain an impulse, at the time of the last catch_up().
  void grain_pushed(const Vec3& impulse) { grain_momentum_ += impulse; }
  /// Enters an impulse from outside on box and grains along the axis, N s.
  void pushed_from_outside(double impulse) { outer_impulse_ += impulse; }
  /// To be called before the box is kicked.
  void before_kick() {
    if constexpr (Scene::driven)
      catch_up();
    else
      outer_impulse_ += scene_.spring_impulse();
  }

  /// Returns what contacts and effects have taken since open(), J.
  Ledger ledger() const;
  /// Returns the number of impacts by ContactClass.
  const std::array<std::int64_t, contact_classes>& collisions() const { return collisions_; }
  double initial_energy() const { return initial_energy_; }  ///< J
  /// Return how far energy and momentum were off balance at most when observe() was called (Health).
  double ledger_error() const { return energy_book_.error(initial_energy_); }
  double momentum_error() const { return momentum_book_.error(momentum_scale_); }

 private:
  /// With Neumaier's compensation: millions of small losses must not cost the balance its digits.
  void lose(std::size_t contact_class, double energy) {
    double& sum = ledger_.contact_loss[contact_class];
    const double next = sum + energy;
    ledger_rest_[contact_class] +=
        std::abs(sum) >= std::abs(energy) ? (sum - next) + energy : (energy - next) + sum;
    sum = next;
  }
  void catch_up_with_grains();
  double total_loss() const;
  double spin_energy_added_to(double energy, std::span<const Vec3> spin) const;

  Scene& scene_;
  int arc_effect_;
  Ledger ledger_;
  std::array<double, contact_classes> ledger_rest_{};
  std::array<std::int64_t, contact_classes> collisions_{};
  double initial_energy_ = 0, initial_momentum_ = 0, outer_impulse_ = 0;
  double momentum_scale_;  // M Omega Delta0, or the sum of m |v| at release
  OpenBook energy_book_, momentum_book_;
  double grain_mass_ = 0, accounted_ = 0;
  Vec3 grain_momentum_ = Vec3::Zero();  // in the falling frame
};

template <class Scene>
LoopAccounts<Scene>::LoopAccounts(Scene& scene, const Physics& physics, const Setup& setup)
    : scene_(scene),
      arc_effect_(physics.grains.arc_effect),
      momentum_scale_(setup.box.mass * 2 * std::numbers::pi * setup.spring.frequency *
                      std::abs(setup.release.displacement)) {
  ledger_.effect_loss.assign(setup.effects.size(), 0.0);
  for (int i = 0; i < scene.grains.size(); ++i) {
    const Flight3 flight = scene.grains.flight(i);
    const Vec3 velocity(flight.v[0], flight.v[1], flight.v[2]);
    grain_momentum_ += scene.grains.mass(i) * velocity;
    grain_mass_ += scene.grains.mass(i);
    if (setup.release.displacement == 0) momentum_scale_ += scene.grains.mass(i) * velocity.norm();
  }
}

template <class Scene>
void LoopAccounts<Scene>::open(const Held& held) {
  initial_momentum_ = grain_momentum_.x() + (scene_.has_spring ? scene_.box.mass() * scene_.box.v() : 0);
  initial_energy_ = observe(held).total_energy;
  energy_book_ = {};  // it was opened without knowing that
}

template <class Scene>
Observation LoopAccounts<Scene>::observe(const Held& held) {
  const double t = scene_.now;
  GrainSums grains = scene_.grains.sums(t);
  const BoxMotion::Point box = scene_.box_now();
  double energy = held.in_wells, outer_impulse = outer_impulse_;
  if constexpr (Scene::driven) {
    catch_up();
    const Vec3 s = scene_.frame.displacement(t), v = scene_.frame.velocity(t);
    grains.kinetic += Vec3(grains.momentum[0], grains.momentum[1], grains.momentum[2]).dot(v) +
                      grains.mass * v.squaredNorm() / 2;
    grains.moment += grains.mass * s.x();
    grains.momentum[0] += grains.mass * v.x();
    outer_impulse += scene_.box.outer_impulse() + grains.mass * v.x();
  } else if (scene_.has_spring) {
    outer_impulse += scene_.spring_impulse();
  }
  energy = spin_energy_added_to(energy, held.spin) + grains.kinetic;
  if (scene_.has_spring) energy += scene_.box.spring_energy(box.x) + scene_.box.mass() * box.v * box.v / 2;
  if constexpr (Scene::driven) {
    const Ledger lines = ledger();
    energy_book_.see(energy + lines.total_loss() - initial_energy_, energy, lines);
  } else {
    energy_book_.see(energy + total_loss() - initial_energy_, energy);
  }
  if (scene_.has_spring) {
    const double momentum = grains.momentum[0] + scene_.box.mass() * box.v;
    momentum_book_.see(momentum - initial_momentum_ - outer_impulse, momentum);
  }
  return {t, box.x, box.v, scene_.grains.size() > 0 ? grains.moment / grains.mass : std::nan(""), energy};
}

template <class Scene>
double LoopAccounts<Scene>::spin_energy_added_to(double energy, std::span<const Vec3> spin) const {
  for (std::size_t i = 0; i < spin.size(); ++i) {
    const double m = scene_.grains.mass(static_cast<int>(i)), r = scene_.grains.radius(static_cast<int>(i));
    energy += 0.2 * m * r * r * spin[i].squaredNorm();
  }
  return energy;
}

template <class Scene>
double LoopAccounts<Scene>::total_loss() const {
  if constexpr (Scene::driven) return ledger().total_loss();
  double loss = 0;
  for (std::size_t c = 0; c < contact_classes; ++c) loss += ledger_.contact_loss[c] + ledger_rest_[c];
  return loss;
}

template <class Scene>
Ledger LoopAccounts<Scene>::ledger() const {
  Ledger ledger = ledger_;
  for (std::size_t c = 0; c < contact_classes; ++c) ledger.contact_loss[c] += ledger_rest_[c];
  if constexpr (Scene::driven)
    for (std::size_t e = 0; e < scene_.box.effect_work().size(); ++e)
      ledger.effect_loss[e] -= scene_.box.effect_work()[e];
  return ledger;
}

template <class Scene>
void LoopAccounts<Scene>::catch_up() {
  if constexpr (Scene::driven) scene_.box.account(scene_.now);
  catch_up_with_grains();
}

/// What the accelerations of the falling frame did to the grains.
template <class Scene>
void LoopAccounts<Scene>::catch_up_with_grains() {
  if constexpr (Scene::driven) {
    const double t = scene_.now;
    if (!scene_.falling || t <= accounted_) return;
    constexpr std::array<double, 4> node{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                         0.8611363115940526};
    constexpr std::array<double, 4> weight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                           0.3478548451374538};
    const double longest = std::min(1.0, 0.2 / std::max(scene_.frame.top_frequency(), 1e-3));
    while (accounted_ < t) {
      const double h = std::min(longest, t - accounted_);
      for (std::size_t k = 0; k < node.size(); ++k) {
        const double time = accounted_ + h / 2 * (1 + node[k]);
        const Vec3 momentum = grain_momentum_ + grain_mass_ * scene_.frame.velocity(time);
        scene_.frame.each(time, [&](int effect, const Vec3& acceleration) {
          loss_of(effect) -= h / 2 * weight[k] * acceleration.dot(momentum);
        });
      }
      accounted_ = h < t - accounted_ ? accounted_ + h : t;
    }
  }
}

}  // namespace shakedown
