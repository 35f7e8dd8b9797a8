// SPDX-License-Identifier: MIT
// What happens when grains touch each other or a wall: restitution along the normal, friction across, rolling
// resistance.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "elastic_limits.hpp"
#include "rolling_impact.hpp"
#include "wells.hpp"

namespace shakedown {

/// A rebound goes at least this far, m: a tenth of the overlap that is promised, some thousand units in the
/// last place of a position.
constexpr double lowest_bounce = 1e-13;

/// Returns the restitution at a wall, raised where the rebound would not go `lowest_bounce` far: a bounce
/// that positions do not resolve would never end on an accelerated wall. `closing`: m/s; `wall_acceleration`:
/// m/s^2. The energy that this adds is booked (a loss below zero, 1e-14 of E0).
inline double resolved(double restitution, double closing, double wall_acceleration) {
  return std::max(restitution, std::sqrt(2 * wall_acceleration * lowest_bounce) / closing);
}

/// Returns four epsilon times the sum of all components' sizes, m/s: some times what rounding does to them.
inline double rounding_of(const MeetingPair& pair) {
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += std::abs(pair.a.v[axis]) + std::abs(pair.b.v[axis]);
  return 4 * std::numeric_limits<double>::epsilon() * sum;
}

/// Returns the restitution of a pair, raised where its impact would be lost when velocities are rounded, so
/// that the two part: else they meet again at the same instant, without end. Two grains that drift side by
/// side closed at 1e-19 m/s (one plain run in 20 000). A wall that moves without being accelerated would need
/// this too; there is none.
inline double resolved(double restitution, double closing, const MeetingPair& pair) {
  const double least = rounding_of(pair);
  if (closing >= least) [[likely]]
    return restitution;
  constexpr double most = 1e100;  // its square is a number
  return std::max(restitution, std::min(most, least / closing));
}

template <class Scene>
class Impacts {
 public:
  Impacts(Scene& scene, LoopWalls<Scene>& walls, LoopAccounts<Scene>& accounts, Partings<Scene>& partings,
          Wells<Scene>& wells)
      : scene_(scene), walls_(walls), accounts_(accounts), partings_(partings), wells_(wells) {}
  /// Sets the laws and limits of a setup, and the spins at release.
  void start(const State& state, const Physics& physics, const Setup& setup);

  /// Executes the impact of grains i and j: the normal impulse is mu (1 + eps) times the closing speed along
  /// the line of centres.
  void pair(int i, int j);
  /// Executes the impact of grain i on the end wall of this side, +1 or -1; the box takes the opposite
  /// impulse (paper, Sec. II B, with v_Box' = v_Box + dp / M).
  void end_wall(int i, int side);
  /// Executes the impact of grain i on a side wall across `axis` 1 or 2. The wall may move across (falling
  /// frame, arc), and along the axis with the box, on which friction pulls.
  void side_wall(int i, int axis, int side);

  const std::vector<Vec3>& spin() const { return spin_; }  ///< rad/s; empty without friction
  /// Returns the sum over pair impacts of impulse times distance, N s m.
  double virial() const { return virial_; }
  /// Return the number of impacts on walls, and between grains, that the elastic limits made elastic.
  std::int64_t elastic_walls() const { return elastic_walls_; }
  std::int64_t elastic_pairs() const { return elastic_pairs_; }

 private:
  /// Returns the law's restitution at this closing speed, m/s, or 1 below `elastic_below`, m/s; the latter
  /// counts in `rescues`.
  double restitution(ContactClass contact, double closing, double elastic_below, std::int64_t& rescues) const;
  /// Returns the time since grain i (or j) last touched anything, s, and notes this touch. Where touches are
  /// not noted it returns HeldBonds::quick.
  double since_touch(int i, int j = -1);
  /// Returns the closing speed below which an impact is elastic, m/s: `limit`, or more where the free path
  /// since the last touch, `since` seconds ago, was shorter than ElasticLimits::free_path.
  double elastic_below(double limit, double since) const {
    const bool is_rest = since < HeldBonds::quick && limits_.free_path > limit * since;
    return is_rest ? limits_.free_path / since : limit;
  }
  /// Tells whether friction acts in an impact with this closing speed, m/s, where impacts below
  /// `elastic_below`, m/s, are elastic; the last touch was `since` seconds ago.
  static bool rubs(double closing, double elastic_below, double since);
  /// Tells whether contacts of this kind (a ContactClass) rub or resist rolling.
  bool touches_roughly(std::size_t kind) const {
    return law_.rubs(static_cast<ContactClass>(kind)) ||
           (law_.rolling_resistance[kind] > 0 && !spin_.empty());
  }
  /// Apply friction, and in roll_pair() rolling resistance too, to the velocities in `pair` and to the spins;
  /// return the energy that it takes, J. `contact`: its slip, normal and mass.
  double rub_pair(int i, int j, MeetingPair& pair, const NormalImpact& normal_impact);
  double roll_pair(int i, int j, MeetingPair& pair, const RollingContact& contact,
                   const NormalImpact& normal_impact);
  /// Returns the velocity, m/s, that the spin of grain i gives to its surface in direction `normal` from the
  /// centre.
  Vec3 surface_velocity(int i, const Vec3& normal) const {
    return spin_[static_cast<std::size_t>(i)].cross(normal) * scene_.grains.radius(i);
  }
  /// Change the spin of grain i by the friction (in roll_on_wall() the rolling resistance too) of a wall, and
  /// return the impulse on the grain and the energy taken. `slip`: m/s, of the grain's surface past the wall;
  /// `mass`: kg along each axis, which the slip feels.
  Friction rub_wall(int i, const Vec3& normal, const Vec3& slip, const Vec3& mass,
                    const NormalImpact& normal_impact);
  Friction roll_on_wall(int i, const RollingContact& contact, const NormalImpact& normal_impact);
  /// Do what side_wall() says, for a box on its spring alone and for a driven one.
  void fixed_side_wall(int i, int axis, int side);
  void moving_side_wall(int i, int axis, int side);
  /// Lengthens the free path below which impacts are elastic while the box swings wider than at release.
  void press_by_the_swing();

  Scene& scene_;
  LoopWalls<Scene>& walls_;
  LoopAccounts<Scene>& accounts_;
  Partings<Scene>& partings_;
  Wells<Scene>& wells_;
  ContactLaw law_;
  ElasticLimits limits_, limits_at_release_;
  double speed_at_release_ = 0;  // box's top speed then, m/s
  std::vector<Vec3> spin_;       // empty without friction
  std::vector<double> touched_;  // latest impact of each grain, s; empty where nothing asks for it
  std::int64_t elastic_walls_ = 0, elastic_pairs_ = 0;
  double virial_ = 0;
};

template <class Scene>
void Impacts<Scene>::start(const State& state, const Physics& physics, const Setup& setup) {
  law_ = physics.contact;
  limits_ = limits_at_release_ = elastic_limits(setup, physics);
  speed_at_release_ = scene_.box.top_speed();
  if (law_.has_friction() || limits_.pull >= 0) touched_.assign(state.size(), -1.0);
  if (law_.has_friction())
    spin_ = state.spin.empty() ? std::vector<Vec3>(state.size(), Vec3::Zero()) : state.spin;
}

template <class Scene>
double Impacts<Scene>::restitution(ContactClass contact, double closing, double elastic_below,
                                   std::int64_t& rescues) const {
  const double law = law_.restitution_of(contact, closing);
  if (closing >= elastic_below || law >= 1) return law;
  ++rescues;
  return 1;
}

/// Impacts below `elastic_below` are elastic, and rub down to a tenth of it. A layer pressed on a wall
/// consists of such impacts, and without friction in them it slips as none of soft contacts does: with
/// coefficients of 0.41 (restitution 0.66, 128 runs) the peaks at 40 mm fall by 9.00 mm/s, with soft contacts
/// of 0.1 ms by 8.78. Friction down to 0.3, 0.1 and 0.03 of the limit gives 8.85, 8.83 and 8.83, and first
/// peaks within 0.15, 0.02 mm and less of each other; friction without a lower limit makes the layer
/// collapse. And where grains touch again at once, as in a row that just fits between the side walls,
/// friction takes what pushes the row apart: one run in 4000 made 22 million impacts of it. To leave friction
/// out for 1 us to 10 us after a touch forbids that and gives the same peaks within 0.1 mm.
template <class Scene>
bool Impacts<Scene>::rubs(double closing, double elastic_below, double since) {
  constexpr double slow = 0.1, at_once = 1e-5;  // of the limit; s
  return closing >= elastic_below || (closing >= slow * elastic_below && since > at_once);
}

template <class Scene>
double Impacts<Scene>::since_touch(int i, int j) {
  if (touched_.empty()) return HeldBonds::quick;
  double& touched = touched_[static_cast<std::size_t>(i)];
  double before = std::exchange(touched, scene_.now);
  if (j >= 0) before = std::max(before, std::exchange(touched_[static_cast<std::size_t>(j)], scene_.now));
  return scene_.now - before;
}

/// Friction between two grains.
template <class Scene>
double Impacts<Scene>::rub_pair(int i, int j, MeetingPair& pair, const NormalImpact& normal_impact) {
  const Vec3 normal = vec(pair.r) / pair.distance, apart = vec(pair.b.v) - vec(pair.a.v);
  const double ma = scene_.grains.mass(i), mb = scene_.grains.mass(j);
  const double ra = scene_.grains.radius(i), rb = scene_.grains.radius(j);
  Vec3 &spin_a = spin_[static_cast<std::size_t>(i)], &spin_b = spin_[static_cast<std::size_t>(j)];
  Vec3 slip = apart - (rb * spin_b + ra * spin_a).cross(normal);
  slip -= slip.dot(normal) * normal;
  const Vec3 felt = Vec3::Constant(normal_impact.reduced_mass / 3.5);
  if (law_.rolling_resistance[0] > 0)
    return roll_pair(i, j, pair, {.slip = -slip, .normal = normal, .mass = felt}, normal_impact);
  const Friction friction =
      friction_impulse(slip, felt, law_.friction_of(ContactClass::grain_grain, slip), law_, normal_impact);
  add(pair.a.v, -friction.impulse / ma);
  add(pair.b.v, friction.impulse / mb);
  spin_a += spin_change(normal, ra, ma, -friction.impulse);
  spin_b += spin_change(-normal, rb, mb, friction.impulse);
  return friction.loss;
}

/// Friction and rolling resistance of two grains.
template <class Scene>
double Impacts<Scene>::roll_pair(int i, int j, MeetingPair& pair, const RollingContact& contact,
                                 const NormalImpact& normal_impact) {
  const double ma = scene_.grains.mass(i), mb = scene_.grains.mass(j);
  const double ra = scene_.grains.radius(i), rb = scene_.grains.radius(j);
  const double a = inertia_of(ma, ra), b = inertia_of(mb, rb);
  Vec3 &spin_a = spin_[static_cast<std::size_t>(i)], &spin_b = spin_[static_cast<std::size_t>(j)];
  RollingContact rolling = contact;
  rolling.turning = spin_a - spin_b;
  rolling.turning -= rolling.turning.dot(contact.normal) * contact.normal;
  rolling.inertia = a * b / (a + b);
  rolling.coupling = ra / a - rb / b;
  rolling.friction = law_.friction_of(ContactClass::grain_grain, contact.slip);
  rolling.rolling = law_.rolling_resistance[0] * ra * rb / (ra + rb);
  const RollingImpact impact = rolling_impact(rolling, law_, normal_impact);
  add(pair.a.v, impact.impulse / ma);
  add(pair.b.v, -impact.impulse / mb);
  spin_a += spin_change(contact.normal, ra, ma, impact.impulse) + impact.turning / a;
  spin_b += spin_change(-contact.normal, rb, mb, -impact.impulse) - impact.turning / b;
  return impact.loss;
}

template <class Scene>
void Impacts<Scene>::pair(int i, int j) {
  MeetingPair pair = partings_.pair_now(i, j);
  const double closing = -pair.opening;
  if (closing <= 0) return partings_.refuse(i, pair.a, nullptr);
  const double since = since_touch(i, j),
               limit = wells_.elastic_below(elastic_below(limits_.pair_speed, since), i, j),
               e = resolved(restitution(ContactClass::grain_grain, closing, limit, elastic_pairs_), closing,
                            pair);
  const double ma = scene_.grains.mass(i), mb = scene_.grains.mass(j), reduced = ma * mb / (ma + mb);
  const double impulse = reduced * (1 + e) * closing;
  double loss = reduced / 2 * (1 - e * e) * closing * closing;
  if constexpr (Scene::driven) {
    if (touches_roughly(0) && rubs(closing, limit, since))
      loss += rub_pair(i, j, pair, {reduced, closing, e, impulse});
    if (wells_.act()) wells_.note_touch(HeldBonds::of_pair(i, j), reduced * e * closing, i, j);
  }
  accounts_.impact(ContactClass::grain_grain, loss);
  virial_ += impulse * pair.distance;
  // impulse / distance, without waiting for the root
  partings_.part(i, j, pair, -reduced * (1 + e) * pair.opening_rate);
}

/// Forced to swing wider than it was released, the box presses its layers with more than the setup's
/// accelerations. At resonance (1 m/s^2 at 1.05 Hz, L = 65 mm) pressed rows rattled 1.3 million times a
/// second by the time the box swung eight times as wide. An eighth of the swing's excess acceleration
/// lengthens the free path so that this stops (a fourth of the events in 22 s) and leaves the amplitude as it
/// is (967.06 for 967.05 +- 0.18 mm, 16 runs); all of it would move it by 1.0 mm.
template <class Scene>
void Impacts<Scene>::press_by_the_swing() {
  if (limits_.pull < 0) return;
  const double excess = scene_.box.angular_frequency() * (scene_.box.top_speed() - speed_at_release_);
  const double pull = std::max(limits_at_release_.pull, excess / 8);
  if (pull != limits_.pull) limits_ = pressed_by(pull, limits_at_release_, 2 * scene_.grains.radius(0));
}

/// Friction on a wall; the grain's spin changes.
template <class Scene>
Friction Impacts<Scene>::rub_wall(int i, const Vec3& normal, const Vec3& slip, const Vec3& mass,
                                  const NormalImpact& normal_impact) {
  const std::size_t kind = normal.x() != 0 ? 1 : 2;
  if (law_.rolling_resistance[kind] > 0)
    return roll_on_wall(i, {.slip = slip, .normal = normal, .mass = mass}, normal_impact);
  const Friction friction = friction_impulse(
      slip, mass, law_.friction_of(static_cast<ContactClass>(kind), slip), law_, normal_impact);
  spin_[static_cast<std::size_t>(i)] +=
      spin_change(normal, scene_.grains.radius(i), scene_.grains.mass(i), friction.impulse);
  return friction;
}

/// Friction and rolling resistance of a wall; the grain's spin changes.
template <class Scene>
Friction Impacts<Scene>::roll_on_wall(int i, const RollingContact& contact,
                                      const NormalImpact& normal_impact) {
  const std::size_t kind = contact.normal.x() != 0 ? 1 : 2;
  const double radius = scene_.grains.radius(i), mass = scene_.grains.mass(i);
  Vec3& spin = spin_[static_cast<std::size_t>(i)];
  RollingContact rolling = contact;
  rolling.turning = spin - spin.dot(contact.normal) * contact.normal;
  rolling.inertia = inertia_of(mass, radius);
  rolling.coupling = radius / rolling.inertia;
  rolling.friction = law_.friction_of(static_cast<ContactClass>(kind), contact.slip);
  rolling.rolling = law_.rolling_resistance[kind] * radius;
  const RollingImpact impact = rolling_impact(rolling, law_, normal_impact);
  spin += spin_change(contact.normal, radius, mass, impact.impulse) + impact.turning / rolling.inertia;
  return {impact.impulse, impact.loss};
}

template <class Scene>
void Impacts<Scene>::end_wall(int i, int side) {
  constexpr bool driven = Scene::driven;
  Flight3 flight = partings_.flight_now(i);
  const double wall = driven ? walls_.now(0).point.v : scene_.box_now().v;
  const double closing = side * (flight.v[0] - wall);
  if (closing <= 0) return partings_.refuse(i, flight, &walls_.across(0));
  if constexpr (driven) press_by_the_swing();
  const double since = since_touch(i);
  const double slow = std::max(limits_.wall_fraction * scene_.box.top_speed(), limits_.wall_speed),
               limit = wells_.elastic_below(elastic_below(slow, since), i);
  const double top = driven ? walls_.now(0).top_acceleration : scene_.box.top_acceleration();
  const double e =
      resolved(restitution(ContactClass::end_wall, closing, limit, elastic_walls_), closing, top);
  const double m = scene_.grains.mass(i), M = scene_.box.mass();
  const double reduced = scene_.has_spring ? m * M / (m + M) : m;
  const double impulse = reduced * (1 + e) * closing;
  double loss = reduced / 2 * (1 - e * e) * closing * closing;
  if constexpr (driven) {
    Vec3 on_grain(-side * impulse, 0, 0);
    if (touches_roughly(1) && rubs(closing, limit, since)) {
      const Vec3 normal(side, 0, 0), moving = walls_.velocity();
      Vec3 slip = vec(flight.v) + surface_velocity(i, normal);
      slip -= Vec3(0, moving.y(), moving.z());
      slip.x() = 0;
      const Friction friction =
          rub_wall(i, normal, slip, Vec3::Constant(m / 3.5), {reduced, closing, e, impulse});
      add(flight.v, friction.impulse / m);
      loss += friction.loss;
      on_grain += friction.impulse;
    }
    accounts_.wall_pushes_grain(on_grain);
    if (wells_.act()) wells_.note_touch(HeldBonds::of_wall(i, 0, side), reduced * e * closing, i);
  }
  flight.v[0] -= side * impulse / m;
  accounts_.impact(ContactClass::end_wall, loss);
  partings_.part_from_wall(i, flight, scene_.has_spring ? side * impulse / M : 0);
}

template <class Scene>
void Impacts<Scene>::side_wall(int i, int axis, int side) {
  if constexpr (Scene::driven)
    moving_side_wall(i, axis, side);
  else
    fixed_side_wall(i, axis, side);
}

template <class Scene>
void Impacts<Scene>::fixed_side_wall(int i, int axis, int side) {
  Flight3 flight = partings_.flight_now(i);
  const auto k = static_cast<std::size_t>(axis);
  const double closing = side * flight.v[k];
  // A log of another build, or one that was edited, may name what is no impact: its digests tell.
  if constexpr (Scene::scripted) {
    if (!(closing > 0)) return;
  }
  EXPECT(closing > 0);
  const double e = restitution(ContactClass::side_wall, closing, limits_.wall_speed, elastic_walls_);
  flight.v[k] *= -e;
  accounts_.impact(ContactClass::side_wall, scene_.grains.mass(i) / 2 * (1 - e * e) * closing * closing);
  partings_.part_from_wall(i, flight, 0);
}

template <class Scene>
void Impacts<Scene>::moving_side_wall(int i, int axis, int side) {
  Flight3 flight = partings_.flight_now(i);
  const Vec3 wall = walls_.velocity();
  const double closing = side * (flight.v[static_cast<std::size_t>(axis)] - wall[axis]);
  if (closing <= 0) return partings_.refuse(i, flight, walls_.has_sides() ? &walls_.across(axis) : nullptr);
  const double since = since_touch(i),
               limit = wells_.elastic_below(elastic_below(limits_.wall_speed, since), i),
               e = resolved(restitution(ContactClass::side_wall, closing, limit, elastic_walls_), closing,
                            walls_.now(axis).top_acceleration);
  const double m = scene_.grains.mass(i), impulse = m * (1 + e) * closing;
  double loss = m / 2 * (1 - e * e) * closing * closing, jump = 0;
  Vec3 on_grain = Vec3::Zero();
  if (touches_roughly(2) && rubs(closing, limit, since)) {
    Vec3 normal = Vec3::Zero();
    normal[axis] = side;
    Vec3 slip = vec(flight.v) - wall + surface_velocity(i, normal);
    slip[axis] = 0;
    Vec3 mass = Vec3::Constant(m / 3.5);
    if (scene_.has_spring) mass.x() = 1 / (3.5 / m + 1 / scene_.box.mass());
    const Friction friction = rub_wall(i, normal, slip, mass, {m, closing, e, impulse});
    loss += friction.loss;
    on_grain = friction.impulse;
    if (scene_.has_spring) jump = -friction.impulse.x() / scene_.box.mass();
  }
  on_grain[axis] -= side * impulse;
  accounts_.wall_pushes_grain(on_grain);
  add(flight.v, on_grain / m);
  accounts_.impact(ContactClass::side_wall, loss);
  if (wells_.act()) wells_.note_touch(HeldBonds::of_wall(i, axis, side), m * e * closing, i);
  partings_.part_from_wall(i, flight, jump);
}

}  // namespace shakedown
