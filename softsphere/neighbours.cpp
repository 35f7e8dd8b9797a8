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

/// Share of the skin of the tree's pairs within which pairs are looked at in every step.
constexpr double near_share = 0.1;

/// Returns the distance of centres within which a pair is kept, m: a skin along each axis is at most sqrt(3)
/// skins along the line of centres.
double kept_within(double reach, double skin) { return reach * (1 + 1e-9) + std::numbers::sqrt3 * skin; }

btVector3 corner(const Bodies& bodies, Eigen::Index i, double half_edge) {
  return {bodies.position(i, 0) + half_edge, bodies.position(i, 1) + half_edge,
          bodies.position(i, 2) + half_edge};
}
}  // namespace

Neighbours::Neighbours(const Bodies& bodies, double range, double skin)
    : tree_(std::make_unique<Tree>()), range_(range), skin_(skin), near_skin_(near_share * skin) {
  for (Eigen::Index i = 0; i < bodies.grains; ++i) {
    void* number = reinterpret_cast<void*>(i);  // Bullet keeps it as an opaque pointer
    tree_->proxies.push_back(tree_->broadphase.createProxy(
        corner(bodies, i, -bodies.radius(i)), corner(bodies, i, bodies.radius(i)), 0, number,
        btBroadphaseProxy::DefaultFilter, btBroadphaseProxy::AllFilter, nullptr));
  }
  search(bodies);
  look_nearby(bodies);
}

Neighbours::~Neighbours() = default;

const std::vector<Pair>& Neighbours::pairs(const Bodies& bodies) {
  if (skin_ == 0 || moved_apart(bodies, looked_at_) >= near_skin_) look_nearby(bodies);
  return near_;
}

// Boxes that did not overlap were apart by more than the skin along some axis; what matters along it is the
// largest difference of two displacements. Grains that travel together with the box therefore do not wear the
// list out.
double Neighbours::moved_apart(const Bodies& bodies, const Bodies::Rows& since) {
  double most = 0;
  if (bodies.grains > 1)
    for (int axis = 0; axis < 3; ++axis) {
      const auto moved = bodies.position.col(axis).head(bodies.grains) - since.col(axis);
      most = std::max(most, moved.maxCoeff() - moved.minCoeff());
    }
  return most;
}

void Neighbours::look_nearby(const Bodies& bodies) {
  // The tree's pairs are to last until the next look.
  if (skin_ == 0 || moved_apart(bodies, searched_at_) + near_skin_ >= skin_) search(bodies);
  looked_at_ = bodies.position.topRows(bodies.grains);
  near_.clear();
  for (const Pair& pair : pairs_) {
    const double keep = kept_within(std::sqrt(pair.reach_squared), near_skin_);
    if ((bodies.position_of(pair.i) - bodies.position_of(pair.j)).squaredNorm() <= keep * keep)
      near_.push_back(pair);
  }
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
    const double keep = kept_within(reach, skin_);
    if ((bodies.position_of(i) - bodies.position_of(j)).squaredNorm() <= keep * keep)
      pairs_.push_back({i, j, reach * reach});
  }
  std::sort(pairs_.begin(), pairs_.end(),
            [](const Pair& a, const Pair& b) { return std::tie(a.i, a.j) < std::tie(b.i, b.j); });
}

}  // namespace shakedown
