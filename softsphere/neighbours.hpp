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
/// moved by a skin relative to each other along an axis; a skin of zero asks at every call.
class Neighbours {
 public:
  /// `range`: gap in m up to which grains interact.
  Neighbours(const Bodies& bodies, double range, double skin);
  ~Neighbours();

  /// Returns every pair with centres within reach, and some more, sorted by (i, j).
  const std::vector<Pair>& pairs(const Bodies& bodies);
  std::int64_t searches() const { return searches_; }  ///< how often the tree was asked

 private:
  /// Tells whether grains have moved so far that a pair within reach may be missing.
  bool stale(const Bodies& bodies) const;
  /// Asks the tree for the pairs anew.
  void search(const Bodies& bodies);

  struct Tree;
  std::unique_ptr<Tree> tree_;
  double range_, skin_;
  Bodies::Rows searched_at_;
  std::vector<Pair> pairs_;
  std::int64_t searches_ = 0;
};

}  // namespace shakedown
