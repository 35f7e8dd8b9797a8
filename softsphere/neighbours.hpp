// SPDX-License-Identifier: MIT
// Pairs of grains that may touch, from Bullet's dynamic bounding-volume tree (btDbvtBroadphase).
#pragma once
#include <memory>
#include <vector>

#include "bodies.hpp"

namespace shakedown {

struct Pair {
  int i = 0, j = 0;          ///< i < j
  double reach_squared = 0;  ///< m^2, centres closer than this interact
};

/// The tree holds every grain enlarged by half a skin and is asked again only when some two grains may have
/// moved by a skin relative to each other along an axis; a skin of zero asks at every call. Of the pairs that
/// it gave those that may touch within a tenth of the skin are looked at until some two grains may have moved
/// by that much.
class Neighbours {
 public:
  /// `range`: gap in m up to which grains interact.
  Neighbours(const Bodies& bodies, double range, double skin);
  ~Neighbours();

  /// Returns every pair with centres within reach, and some more, sorted by (i, j); valid until asked again.
  const std::vector<Pair>& pairs(const Bodies& bodies);
  std::int64_t searches() const { return searches_; }  ///< how often the tree was asked

 private:
  /// Returns by how much, m, the displacements of two grains since then differ at most along an axis.
  static double moved_apart(const Bodies& bodies, const Bodies::Rows& since);
  /// Takes from the tree's pairs those that may come within reach before two grains have moved by near_skin_.
  void look_nearby(const Bodies& bodies);
  /// Asks the tree for the pairs anew.
  void search(const Bodies& bodies);

  struct Tree;
  std::unique_ptr<Tree> tree_;
  double range_, skin_, near_skin_;
  Bodies::Rows searched_at_, looked_at_;
  std::vector<Pair> pairs_, near_;
  std::int64_t searches_ = 0;
};

}  // namespace shakedown
