// SPDX-License-Identifier: MIT
#include "bullet_world.hpp"

#include <btBulletDynamicsCommon.h>

#include <cmath>

namespace shakedown {

static_assert(sizeof(btScalar) == 8,
              "Bullet's headers are in single precision: take the flags of pkg-config bullet-float64");

namespace {

btVector3 to_bullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

btTransform at(const Vec3& place) {
  btTransform transform = btTransform::getIdentity();
  transform.setOrigin(to_bullet(place));
  return transform;
}

/// Bullet enlarges every bounding box by gContactBreakingThreshold (20 mm) and every leaf of its tree by
/// gDbvtMargin (50 mm), so that among grains of 10 mm all pairs would be neighbours. Both are process-wide;
/// this undoes them for one world.
class TightBroadphase : public btDbvtBroadphase {
 public:
  void setAabb(btBroadphaseProxy* proxy, const btVector3& low, const btVector3& high,
               btDispatcher* dispatcher) override {
    const btScalar excess = gContactBreakingThreshold - margin;
    const btVector3 shrink(excess, excess, excess);
    setAabbForceUpdate(proxy, low + shrink, high - shrink, dispatcher);
  }

 private:
  static constexpr btScalar margin = 1e-5;  // metre
};

/// Bullet's sequential impulses, with restitution by class of contact (Bullet itself multiplies one number of
/// each body) and the work of every impulse entered: the velocity of A changes by J n / m, so its kinetic
/// energy by J n . (v + v') / 2, exactly.
class AccountingSolver : public btSequentialImpulseConstraintSolver {
 public:
  AccountingSolver(const ContactLaw& law, int box, bool own_law) : law_(law), box_(box), own_law_(own_law) {}
  void enter_into(Accounts& accounts) { accounts_ = &accounts; }

  btScalar solveGroup(btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
                      int manifold_count, btTypedConstraint** constraints, int constraint_count,
                      const btContactSolverInfo& info, btIDebugDraw* drawer,
                      btDispatcher* dispatcher) override {
    impacts_.clear();
    for (int k = 0; k < manifold_count; ++k) look_at(*manifolds[k]);
    const btScalar residual = btSequentialImpulseConstraintSolver::solveGroup(
        bodies, body_count, manifolds, manifold_count, constraints, constraint_count, info, drawer,
        dispatcher);
    for (const Impact& impact : impacts_) enter(impact);
    return residual;
  }

 protected:
  /// Bullet writes the impulses into the contacts only when they are to start the next step.
  btScalar solveGroupCacheFriendlyFinish(btCollisionObject** bodies, int body_count,
                                         const btContactSolverInfo& info) override {
    writeBackContacts(0, m_tmpSolverContactConstraintPool.size(), info);
    return btSequentialImpulseConstraintSolver::solveGroupCacheFriendlyFinish(bodies, body_count, info);
  }

 private:
  struct Impact {
    const btRigidBody *a, *b;
    const btManifoldPoint* point;
    ContactClass kind;
    btVector3 relative_velocity;  // of A's point of contact, before
  };

  ContactClass kind_of(const btRigidBody& a, const btRigidBody& b, const btManifoldPoint& point) const {
    if (a.getUserIndex() != box_ && b.getUserIndex() != box_) return ContactClass::grain_grain;
    return std::abs(point.m_normalWorldOnB.x()) > 0.7 ? ContactClass::end_wall : ContactClass::side_wall;
  }

  static btVector3 relative_velocity(const btRigidBody& a, const btRigidBody& b,
                                     const btManifoldPoint& point) {
    return a.getVelocityInLocalPoint(point.getPositionWorldOnA() - a.getCenterOfMassPosition()) -
           b.getVelocityInLocalPoint(point.getPositionWorldOnB() - b.getCenterOfMassPosition());
  }

  void look_at(btPersistentManifold& manifold) {
    const auto* a = static_cast<const btRigidBody*>(manifold.getBody0());
    const auto* b = static_cast<const btRigidBody*>(manifold.getBody1());
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      btManifoldPoint& point = manifold.getContactPoint(k);
      // The solver skips these, and they keep the impulse of a step long ago.
      if (point.getDistance() > manifold.getContactProcessingThreshold()) continue;
      const Impact impact{a, b, &point, kind_of(*a, *b, point), relative_velocity(*a, *b, point)};
      if (own_law_) set_law(impact, point);
      impacts_.push_back(impact);
    }
  }

  void set_law(const Impact& impact, btManifoldPoint& point) const {
    const auto kind = static_cast<std::size_t>(impact.kind);
    const double closing = -impact.relative_velocity.dot(point.m_normalWorldOnB);
    point.m_combinedRestitution =
        closing > 0 ? law_.restitution_of(impact.kind, closing) : law_.restitution[kind];
    point.m_combinedFriction = law_.friction[kind];
  }

  void enter(const Impact& impact) {
    const btManifoldPoint& point = *impact.point;
    const auto kind = static_cast<std::size_t>(impact.kind);
    const btVector3 mean = (impact.relative_velocity + relative_velocity(*impact.a, *impact.b, point)) / 2;
    btVector3 impulse = point.m_appliedImpulse * point.m_normalWorldOnB;
    impulse += point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1;
    impulse += point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2;
    accounts_->contact_work[kind] += impulse.dot(mean);
    if (point.m_appliedImpulse > 0 && impact.relative_velocity.dot(point.m_normalWorldOnB) < 0)
      ++accounts_->collisions[kind];
    accounts_->deepest_overlap =
        std::max(accounts_->deepest_overlap, -static_cast<double>(point.getDistance()));
    if (impact.a->getInvMass() == 0) accounts_->outer_impulse += -impulse.x();
    if (impact.b->getInvMass() == 0) accounts_->outer_impulse += impulse.x();
  }

  const ContactLaw& law_;
  int box_;
  bool own_law_;
  Accounts* accounts_ = nullptr;
  std::vector<Impact> impacts_;
};

}  // namespace

struct BulletWorld::Inside {
  ContactLaw law;
  bool untouched;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;  // grains, then the box
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  std::unique_ptr<btBroadphaseInterface> broadphase;
  AccountingSolver solver;
  std::unique_ptr<btDiscreteDynamicsWorld> world;

  Inside(const Physics& physics, bool as_shipped, int grains)
      : law(physics.contact), untouched(as_shipped), solver(law, grains, !as_shipped) {
    if (untouched)
      broadphase = std::make_unique<btDbvtBroadphase>();
    else
      broadphase = std::make_unique<TightBroadphase>();
    world = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher, broadphase.get(), &solver, &configuration);
    world->setGravity({0, 0, 0});
    if (!untouched) set_solver(world->getSolverInfo());
  }

  static void set_solver(btContactSolverInfo& info) {
    info.m_restitutionVelocityThreshold = 0;  // default .2 m/s: no bounce below
    info.m_splitImpulse = true;               // overlap correction moves bodies and gives them no speed,
    info.m_splitImpulsePenetrationThreshold = 1e30;  // however small the overlap
    info.m_erp2 = 0.02;
    info.m_solverMode = 0;  // no warm start: last step's impulse is no guess for a bounce
    info.m_numIterations = 10;
  }

  btRigidBody& add(double mass, std::unique_ptr<btCollisionShape> shape, const Vec3& place) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape->calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape.get(), inertia);
    info.m_startWorldTransform = at(place);
    shapes.push_back(std::move(shape));
    bodies.push_back(std::make_unique<btRigidBody>(info));
    btRigidBody& body = *bodies.back();
    body.setUserIndex(static_cast<int>(bodies.size()) - 1);
    body.setFriction(0);  // the setup's, as mass and restitution are; Bullet's own default is .5
    if (!untouched) {
      // else a contact seen ahead stops a grain before the step in which it bounces
      body.setContactProcessingThreshold(0);
      body.setActivationState(DISABLE_DEACTIVATION);
      if (!law.has_friction()) body.setAngularFactor(0);
    }
    return body;
  }

  /// Six slabs. Those at the ends are wider than the opening, so that no inner edge is exposed.
  std::unique_ptr<btCollisionShape> box_shape(const Setup& setup, double thickness) {
    const double x = setup.box.length / 2, y = setup.box.width[0] / 2, z = setup.box.width[1] / 2,
                 t = thickness;
    auto compound = std::make_unique<btCompoundShape>();
    for (const double side : {-1.0, 1.0}) {
      add_slab(*compound, {t, y + 2 * t, z + 2 * t}, {side * (x + t), 0, 0});
      add_slab(*compound, {x, t, z + 2 * t}, {0, side * (y + t), 0});
      add_slab(*compound, {x, y, t}, {0, 0, side * (z + t)});
    }
    return compound;
  }

  void add_slab(btCompoundShape& compound, const Vec3& half, const Vec3& centre) {
    shapes.push_back(std::make_unique<btBoxShape>(to_bullet(half)));
    compound.addChildShape(at(centre), shapes.back().get());
  }

  btRigidBody& box() { return *bodies.back(); }
};

BulletWorld::BulletWorld(const Setup& setup, const Physics& physics, double box_mass, const Bodies& state)
    : inside_(std::make_unique<Inside>(physics, setup.bullet.defaults, static_cast<int>(state.grains))) {
  // Bullet multiplies the restitutions of the two bodies: these give the setup's for both kinds of contact.
  const double of_grain = std::sqrt(physics.contact.restitution[0]);
  const double of_box = of_grain > 0 ? physics.contact.restitution[1] / of_grain : 0;
  for (Eigen::Index i = 0; i < state.grains; ++i) {
    btRigidBody& grain =
        inside_->add(state.mass(i), std::make_unique<btSphereShape>(state.radius(i)), state.position_of(i));
    grain.setRestitution(of_grain);
  }
  btRigidBody& box =
      inside_->add(box_mass, inside_->box_shape(setup, setup.grains.diameter), {state.x_box(), 0, 0});
  box.setRestitution(of_box);
  box.setLinearFactor({1, 0, 0});
  box.setAngularFactor(0);
  for (const auto& body : inside_->bodies) inside_->world->addRigidBody(body.get());
  write_grains(state);
  if (box_mass > 0) write_box(state);
}

BulletWorld::~BulletWorld() = default;

void BulletWorld::step(double seconds, double force_on_box, Accounts& accounts) {
  inside_->solver.enter_into(accounts);
  btRigidBody& box = inside_->box();
  if (force_on_box != 0 && box.isActive()) {
    box.applyCentralForce({force_on_box, 0, 0});
    accounts.outer_impulse += force_on_box * seconds;
  }
  inside_->world->stepSimulation(seconds, 0);  // 0: this step, not sub-steps of 1/60 s
}

void BulletWorld::read(Bodies& bodies) const {
  for (std::size_t k = 0; k < inside_->bodies.size(); ++k) {
    const btRigidBody& body = *inside_->bodies[k];
    for (int axis = 0; axis < 3; ++axis) {
      bodies.position(static_cast<Eigen::Index>(k), axis) = body.getCenterOfMassPosition()[axis];
      bodies.velocity(static_cast<Eigen::Index>(k), axis) = body.getLinearVelocity()[axis];
      bodies.spin(static_cast<Eigen::Index>(k), axis) = body.getAngularVelocity()[axis];
    }
  }
}

void BulletWorld::write_box(const Bodies& bodies) {
  inside_->box().setCenterOfMassTransform(at({bodies.x_box(), 0, 0}));
  inside_->box().setLinearVelocity({bodies.v_box(), 0, 0});
}

void BulletWorld::write_grains(const Bodies& bodies) {
  for (Eigen::Index i = 0; i < bodies.grains; ++i) {
    btRigidBody& grain = *inside_->bodies[static_cast<std::size_t>(i)];
    btTransform place = grain.getCenterOfMassTransform();
    place.setOrigin(to_bullet(bodies.position_of(i)));
    grain.setCenterOfMassTransform(place);
    grain.setLinearVelocity(to_bullet(bodies.velocity_of(i)));
    grain.setAngularVelocity(to_bullet(bodies.spin_of(i)));
  }
}

bool BulletWorld::box_sleeps() const { return !inside_->box().isActive(); }

}  // namespace shakedown
