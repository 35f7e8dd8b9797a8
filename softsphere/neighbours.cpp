// SPDX-License-Identifier: MIT
#include "neighbours.hpp"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace shakedown {

static_assert(sizeof(btScalar) == 8,
              "Bullet's headers are in single precision: take the flags of pkg-config bullet-float64");

struct Neighbours::Tree {
  btDbvtBroadphase broadphase;
  std::vector<btBroadphaseProxy*> proxies;

  ~Tree() {
    // destroyProxy looks through all pairs for each grain: a square law, for pairs that nobody needs any
    // more.
    broadphase.getOverlappingPairCache()->getOverlappingPairArray().clear();
    for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
  }
};

namespace {
btVector3 corner(const Bodies& bodies, Eigen::Index i, double half_edge) {
  return {bodies.position(i, 0) + half_edge, bodies.position(i, 1) + half_edge,
          bodies.position(i, 2) + half_edge};
}
}  // namespace

Neighbours::Neighbours(const Bodies& bodies, double range, double skin)
    : tree_(std::make_unique<Tree>()), range_(range), skin_(skin) {
  for (Eigen::Index i = 0; i < bodies.grains; ++i) {
    void* number = reinterpret_cast<void*>(i);  // Bullet keeps it as an opaque pointer
    tree_->proxies.push_back(tree_->broadphase.createProxy(
        corner(bodies, i, -bodies.radius(i)), corner(bodies, i, bodies.radius(i)), 0, number,
        btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter, nullptr));
  }
  search(bodies);
}

Neighbours::~Neighbours() = default;

const std::vector<Pair>& Neighbours::pairs(const Bodies& bodies) {
  if (stale(bodies)) search(bodies);
  return pairs_;
}

bool Neighbours::stale(const Bodies& bodies) const {
  if (skin_ == 0) return true;
  // Boxes that did not overlap were apart by more than the skin along some axis; what matters along it is the
  // largest difference of two displacements. Grains that travel together with the box therefore do not wear
  // the list out.
  for (int axis = 0; axis < 3; ++axis) {
    const auto moved = bodies.position.col(axis).head(bodies.grains) - searched_at_.col(axis);
    if (bodies.grains > 1 && moved.maxCoeff() - moved.minCoeff() >= skin_) return true;
  }
  return false;
}

void Neighbours::search(const Bodies& bodies) {
  ++searches_;
  searched_at_ = bodies.position.topRows(bodies.grains);
  for (Eigen::Index i = 0; i < bodies.grains; ++i) {
    // Rounding of the last bit must not lose a pair, hence the tiny extra of 1e-9 R.
    const double half_edge = bodies.radius(i) * (1 + 1e-9) + (range_ + skin_) / 2;
    // Not setAabb: that enlarges by gDbvtMargin, a process-wide 50 mm.
    tree_->broadphase.setAabbForceUpdate(tree_->proxies[static_cast<std::size_t>(i)],
                                         corner(bodies, i, -half_edge), corner(bodies, i, half_edge),
                                         nullptr);
  }
  tree_->broadphase.calculateOverlappingPairs(nullptr);
  const btBroadphasePairArray& found = tree_->broadphase.getOverlappingPairCache()->getOverlappingPairArray();
  pairs_.clear();
  for (int k = 0; k < found.size(); ++k) {
    auto i = static_cast<int>(reinterpret_cast<std::intptr_t>(found[k].m_pProxy0->m_clientObject));
    auto j = static_cast<int>(reinterpret_cast<std::intptr_t>(found[k].m_pProxy1->m_clientObject));
    if (i > j) std::swap(i, j);
    const double reach = bodies.radius(i) + bodies.radius(j) + range_;
    // A skin along each axis is at most sqrt(3) skins along the line of centres.
    const double keep = reach * (1 + 1e-9) + std::numbers::sqrt3 * skin_;
    if ((bodies.position_of(i) - bodies.position_of(j)).squaredNorm() <= keep * keep)
      pairs_.push_back({i, j, reach * reach});
  }
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& a, const Pair& b) { return std::tie(a.i, a.j) < std::tie(b.i, b.j); });
}

}  // namespace shakedown
