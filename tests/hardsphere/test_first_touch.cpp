// SPDX-License-Identifier: MIT
// Who is touched first, found in vector lanes by estimates, against every pair on its own; and the cells that
// say who is near.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "all_pairs.hpp"
#include "centre_cells.hpp"
#include "grain_lines.hpp"
#include "random.hpp"

using namespace shakedown;

namespace {

constexpr double extent = 10;

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }

/// Grains anywhere, some overlapping; of every four two are images of the others beyond a mirror or nearly
/// so, so that touches of one grain at rest in the mirror come at the same instant or hardly apart.
State mirrored_grains(Random& random, int count, bool equal) {
  State state;
  const double hardly = random.uniform() < 0.5 ? 0 : std::pow(10, between(random, -16, -2));
  for (int i = 0; i < count; ++i) {
    const bool image = i % 4 > 1;
    const std::size_t of = static_cast<std::size_t>(i) - 2;
    state.radius.push_back(equal ? 0.5 : image ? state.radius[of] : between(random, 0.2, 0.5));
    state.mass.push_back(1);
    const Vec3 place(between(random, -5, 5), between(random, -5, 5), between(random, -5, 5)),
        velocity(random.normal(), random.normal(), random.normal());
    const Vec3 mirror(-1 - hardly, 1, 1);
    state.position.push_back(image ? Vec3(state.position[of].cwiseProduct(mirror)) : place);
    state.velocity.push_back(image ? Vec3(state.velocity[of].cwiseProduct(Vec3(-1, 1, 1))) : velocity);
  }
  state.position[0] = state.velocity[0] = Vec3::Zero();
  return state;
}

/// Pair by pair; `near` makes of a difference of coordinates the nearest image's.
template <class Near>
double touch_of(const State& state, std::size_t i, std::size_t j, const Near& near) {
  std::array<double, 3> r, w;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    r[k] = near(state.position[j][axis] - state.position[i][axis], k);
    w[k] = state.velocity[j][axis] - state.velocity[i][axis];
  }
  const double reach = state.radius[j] + state.radius[i];
  const double a = w[0] * w[0] + w[1] * w[1] + w[2] * w[2], b = r[0] * w[0] + r[1] * w[1] + r[2] * w[2];
  return time_to_touch(a, b, r[0] * r[0] + r[1] * r[1] + r[2] * r[2] - reach * reach);
}

template <class Near>
double first_of(const State& state, std::size_t i, const std::vector<std::int32_t>& others,
                const Near& near) {
  double first = never;
  for (const std::int32_t j : others)
    first = std::min(first, touch_of(state, i, static_cast<std::size_t>(j), near));
  return first;
}

TEST(FirstTouch, OfLinesIsThatOfAllPairsOneByOne) {
  Random random(3, 0, Stream::other);
  int touches = 0;
  for (int round = 0; round < 5000; ++round) {
    const State state = mirrored_grains(random, 60, round % 2 == 0);
    GrainLines lines(state, {extent, extent, extent});
    const Period period({extent, extent, extent});
    const auto near = [&](double r, std::size_t axis) { return period.nearest(r, axis); };
    const std::size_t i = random.uniform() < 0.5 ? 0 : static_cast<std::size_t>(60 * random.uniform());
    std::vector<std::int32_t> others;
    for (std::int32_t j = 0; j < 60; ++j)
      if (static_cast<std::size_t>(j) != i && random.uniform() < round % 10 / 10.0) others.push_back(j);
    const double expected = first_of(state, i, others, near),
                 limit = random.uniform() < 0.5 ? never : random.uniform();
    const std::size_t size = others.size();
    others.resize(size + lane_count, static_cast<std::int32_t>(i));
    const GrainLines::Touch touch = lines.first_touch<true>(i, lines.flight(i), others.data(), size, limit);
    ASSERT_DOUBLE_EQ(touch.wait, std::min(expected, limit)) << "round " << round;
    ASSERT_EQ(touch.partner >= 0, expected < limit);
    if (touch.partner < 0) continue;
    ++touches;
    ASSERT_DOUBLE_EQ(touch_of(state, i, static_cast<std::size_t>(touch.partner), near), expected);
  }
  EXPECT_GT(touches, 800);
}

TEST(FirstTouch, OfAFewGrainsIsThatOfAllPairsOneByOne) {
  Random random(4, 0, Stream::other);
  const auto open = [](double r, std::size_t) { return r; };
  for (int round = 0; round < 500; ++round) {
    const State state = mirrored_grains(random, 37, round % 2 == 0);
    AllPairs all(state, {never, never});
    std::vector<std::int32_t> everyone(37);
    for (int j = 0; j < 37; ++j) everyone[static_cast<std::size_t>(j)] = j;
    const int j = 1 + static_cast<int>(36 * random.uniform());
    all.predict(0, j);
    for (const int i : {0, j}) {
      const double expected = first_of(state, static_cast<std::size_t>(i), everyone, open);
      ASSERT_DOUBLE_EQ(all.event(i).time, expected) << "round " << round;
      if (all.event(i).partner < 0) continue;
      ASSERT_DOUBLE_EQ(
          touch_of(state, static_cast<std::size_t>(i), static_cast<std::size_t>(all.event(i).partner), open),
          expected);
    }
  }
}

/// Centres move about, out of an open domain as well; of a place all within reach are found, once each, and
/// none much further away.
void look_around(bool periodic, double reach) {
  Random random(5, periodic, Stream::other);
  const std::int32_t grains = 300;
  CentreCells cells(static_cast<std::size_t>(grains), {extent, extent, extent}, reach, periodic);
  std::vector<std::array<double, 3>> centres(static_cast<std::size_t>(grains));
  const auto anywhere = [&] {
    // more than a block holds in some cells
    const double wide = periodic ? 0.5 : 0.9, crowd = random.uniform() < 0.3 ? 0.1 : 1;
    std::array<double, 3> centre;
    for (double& x : centre) x = extent * wide * crowd * between(random, -1, 1);
    return centre;
  };
  for (std::int32_t i = 0; i < grains; ++i)
    cells.put(i, cells.place(centres[static_cast<std::size_t>(i)] = anywhere()));
  std::vector<std::int32_t> near;
  for (int move = 0; move < 3000; ++move) {
    const auto i = static_cast<std::int32_t>(grains * random.uniform());
    cells.take(i);
    const std::array<double, 3> here = centres[static_cast<std::size_t>(i)] = anywhere();
    near.resize(cells.find(cells.place(here), near) + 8);
    const std::size_t size = cells.find(cells.place(here), near);
    const std::set<std::int32_t> found(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_EQ(found.size(), size);
    ASSERT_FALSE(found.contains(i));
    for (std::int32_t j = 0; j < grains; ++j) {
      double squared = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double r = centres[static_cast<std::size_t>(j)][axis] - here[axis];
        squared += std::pow(periodic ? std::remainder(r, extent) : r, 2);
      }
      const bool within = j != i && squared < reach * reach;
      // Beyond an open domain cells wrap around: who is found there too many is far away, and never met.
      const bool beyond = periodic && squared > reach * reach * (1 + 2e-5);
      ASSERT_TRUE(!within || found.contains(j)) << "move " << move << ", " << std::sqrt(squared);
      ASSERT_TRUE(!beyond || !found.contains(j)) << "move " << move << ", " << std::sqrt(squared);
    }
    cells.put(i, cells.place(here));
  }
}

TEST(CentreCells, FindWhoIsWithinReach) {
  for (const double reach : {1.0, 1.9, 10.0 / 3}) {
    look_around(true, reach);
    look_around(false, reach);
  }
}

}  // namespace
