// SPDX-License-Identifier: MIT
// The tree of smallest numbers against looking through them all, at sizes around those at which it gains a
// level.
#include <gtest/gtest.h>

#include <algorithm>

#include "random.hpp"
#include "smallest_tree.hpp"

using namespace shakedown;

namespace {

TEST(SmallestTree, FindsTheFirstOfTheSmallest) {
  Random random(7, 0, Stream::other);
  for (const std::size_t capacity : {1u, 5u, 37u, 256u, 257u, 300u, 2048u, 2049u, 5000u, 20'000u}) {
    SmallestTree tree(capacity);
    std::vector<double> plain;
    for (int step = 0; step < 3000; ++step) {
      if (random.uniform() < 0.02) {  // only so many from now on
        plain.resize(static_cast<std::size_t>(random.uniform() * static_cast<double>(plain.size())));
        tree.rebuild(plain.size());
      }
      const bool grows = plain.size() < capacity && random.uniform() < 0.5;
      if (grows) plain.push_back(0);
      if (plain.empty()) continue;
      const std::size_t k =
          grows ? plain.size() - 1
                : static_cast<std::size_t>(random.uniform() * static_cast<double>(plain.size()));
      plain[k] = std::floor(50 * random.uniform());
      tree.set(k, plain[k]);
      const auto first = std::min_element(plain.begin(), plain.end());
      ASSERT_EQ(tree.smallest().value, *first) << capacity << ' ' << step;
      ASSERT_EQ(tree.smallest().index, first - plain.begin()) << capacity << ' ' << step;
    }
  }
}

TEST(SmallestTree, KeepsWhatIsThereWhereItIsMadeWider) {
  Random random(8, 0, Stream::other);
  SmallestTree tree(1);
  std::vector<double> plain;
  for (const std::size_t capacity : {1u, 9u, 200u, 257u, 3000u}) {
    tree.widen(capacity);
    while (plain.size() < capacity) {
      plain.push_back(100 * random.uniform());
      tree.set(plain.size() - 1, plain.back());
      if (plain.size() == capacity / 2) tree.widen(capacity);  // as wide as it is
      const auto first = std::min_element(plain.begin(), plain.end());
      ASSERT_EQ(tree.smallest().value, *first) << plain.size();
      ASSERT_EQ(tree.smallest().index, first - plain.begin()) << plain.size();
    }
  }
}

}  // namespace
