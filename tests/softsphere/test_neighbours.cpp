// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "neighbours.hpp"
#include "random.hpp"

using namespace shakedown;

namespace {

State random_cloud(int count, double spread, Random& random) {
  State state;
  for (int i = 0; i < count; ++i) {
    Vec3 position;
    for (double& component : position) component = spread * random.uniform();
    state.position.push_back(position);
    state.velocity.push_back(Vec3::Zero());
    state.radius.push_back(0.004 + 0.002 * random.uniform());
    state.mass.push_back(1);
  }
  return state;
}

std::vector<std::pair<int, int>> within_reach(const Bodies& bodies, const std::vector<Pair>& pairs) {
  std::vector<std::pair<int, int>> found;
  for (const Pair& pair : pairs)
    if ((bodies.position_of(pair.i) - bodies.position_of(pair.j)).squaredNorm() < pair.reach_squared)
      found.emplace_back(pair.i, pair.j);
  return found;
}

std::vector<Pair> every_pair(const Bodies& bodies, double range) {
  std::vector<Pair> pairs;
  for (int i = 0; i < bodies.grains; ++i)
    for (int j = i + 1; j < bodies.grains; ++j) {
      const double reach = bodies.radius(i) + bodies.radius(j) + range;
      pairs.push_back({i, j, reach * reach});
    }
  return pairs;
}

}  // namespace

TEST(Neighbours, NeverMissAPairWhileGrainsWander) {
  Random random(5, 0, Stream::other);
  for (const double skin : {0.0, 0.002})
    for (const double range : {0.0, 0.001}) {
      Bodies bodies = bodies_of(random_cloud(120, 0.08, random), 1);
      Neighbours neighbours(bodies, range, skin);
      for (int step = 0; step < 600; ++step) {
        // Short steps, as a run's, wear out neither list for some time, long ones both.
        const double length = step < 300 ? 1e-5 : 2e-4;
        for (double& coordinate : bodies.position.topRows(bodies.grains).reshaped())
          coordinate += length * random.normal();
        bodies.position.col(0) += 3e-4;  // all together: must not wear the list out
        EXPECT_EQ(within_reach(bodies, neighbours.pairs(bodies)),
                  within_reach(bodies, every_pair(bodies, range)));
      }
      EXPECT_EQ(neighbours.searches() > 600, skin == 0);
    }
}

TEST(Neighbours, OfNoGrainsAreNone) {
  const Bodies bodies = bodies_of(State{}, 1);
  Neighbours neighbours(bodies, 0, 0.001);
  EXPECT_TRUE(neighbours.pairs(bodies).empty());
}
