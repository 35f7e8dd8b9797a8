// SPDX-License-Identifier: MIT
// Properties of Bullet itself that softsphere/ relies on or works around. If a new Bullet fails one of these,
// read bullet_world.cpp again before anything else.
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <memory>

#include "within.hpp"

namespace {

/// A world with one sphere of 5 mm radius, flying in +x from the origin, and perhaps a wall whose surface is
/// at x = 6 mm.
class OneSphere : public ::testing::Test {
 protected:
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSphereShape ball{0.005};
  btStaticPlaneShape plane{{-1, 0, 0}, -0.006};
  btBoxShape slab{{0.01, 0.05, 0.05}};
  std::unique_ptr<btRigidBody> sphere, wall;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};

  OneSphere() { world.setGravity({0, 0, 0}); }
  ~OneSphere() override {
    for (const auto& body : {sphere.get(), wall.get()})
      if (body) world.removeRigidBody(body);
  }

  std::unique_ptr<btRigidBody> add(double mass, btCollisionShape& shape, double x) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
    info.m_startWorldTransform.setOrigin({x, 0, 0});
    auto body = std::make_unique<btRigidBody>(info);
    body->setFriction(0);
    world.addRigidBody(body.get());
    return body;
  }

  double speed_after(double speed, double step) {
    sphere->setLinearVelocity({speed, 0, 0});
    for (int k = 0; k < 2.5e-3 / speed / step; ++k) world.stepSimulation(step, 0);
    return sphere->getLinearVelocity().x();
  }

  /// The settings of engine "bullet" that matter for one impact.
  void correct_settings() {
    world.getSolverInfo().m_restitutionVelocityThreshold = 0;
    world.getSolverInfo().m_splitImpulsePenetrationThreshold = 1e30;
    world.getSolverInfo().m_solverMode = 0;
    for (btRigidBody* body : {sphere.get(), wall.get()}) body->setContactProcessingThreshold(0);
  }
};

}  // namespace

TEST(BulletTraps, LibraryIsInDoublePrecision) {
  EXPECT_EQ(sizeof(btScalar), 8u);
  EXPECT_EQ(btGetVersion() / 100, 3);
}

TEST_F(OneSphere, DoesNotBounceFromAPlaneByDefault) {
  sphere = add(4.04e-3, ball, 0);
  wall = add(0, plane, 0);
  sphere->setRestitution(0.76);
  wall->setRestitution(1);
  EXPECT_EQ(speed_after(1, 1.3e-5), 0);
}

TEST_F(OneSphere, BouncesFromAPlaneWithCorrectSettings) {
  sphere = add(4.04e-3, ball, 0);
  wall = add(0, plane, 0);
  sphere->setRestitution(0.76);  // Bullet multiplies the two
  wall->setRestitution(1);
  correct_settings();
  WITHIN(speed_after(1, 1.3e-5), -0.76, 3e-15, 1.7e-16);
}

TEST_F(OneSphere, DoesNotBounceFromASlabByDefault) {
  sphere = add(4.04e-3, ball, 0);
  wall = add(0, slab, 0.016);
  sphere->setRestitution(0.76);
  wall->setRestitution(1);
  EXPECT_EQ(speed_after(1, 1.3e-5), 0);
}

TEST_F(OneSphere, FallsAsleepInFlightByDefault) {
  sphere = add(4.04e-3, ball, 0);
  sphere->setLinearVelocity({0.05, 0, 0});
  for (int k = 0; k < 300; ++k) world.stepSimulation(0.01, 0);
  EXPECT_FALSE(sphere->isActive());
  const double x = sphere->getWorldTransform().getOrigin().x();
  WITHIN(x, 0.1, 1e-15, 7e-17);  // two seconds, and no further
}

TEST_F(OneSphere, SeparatedSpheresKeepNoContact) {
  sphere = add(4.04e-3, ball, 0);
  wall = add(4.04e-3, ball, 0.01 + 1e-6);
  world.performDiscreteCollisionDetection();
  // neighbours, but the soft engine needs the gap, so it takes geometry from places
  ASSERT_EQ(dispatcher.getNumManifolds(), 1);
  EXPECT_EQ(dispatcher.getManifoldByIndexInternal(0)->getNumContacts(), 0);
}

TEST_F(OneSphere, ImpulsesStayInTheSolverWithoutWarmStart) {
  sphere = add(4.04e-3, ball, 0);
  wall = add(0, plane, 0);
  correct_settings();
  sphere->setRestitution(1);
  wall->setRestitution(1);
  EXPECT_LT(speed_after(1, 1.3e-5), -0.99);
  ASSERT_GT(dispatcher.getNumManifolds(), 0);
  const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(0);
  for (int k = 0; k < manifold.getNumContacts(); ++k)
    EXPECT_EQ(manifold.getContactPoint(k).m_appliedImpulse, 0);
}
