// SPDX-License-Identifier: MIT
// The smallest of many numbers that change one at a time: a tree whose nodes hold the smallest of one vector
// of children. Its top is scanned, so that up to a few hundred numbers are a plain array.
#pragma once
#include "lanes.hpp"

namespace shakedown {

class SmallestTree {
 public:
  explicit SmallestTree(std::size_t capacity) { widen(capacity); }

  /// Makes room for so many numbers, no fewer than before; those that are there stay.
  void widen(std::size_t capacity) {
    numbers_.resize(std::max(padded(capacity), lane_count), infinite);
    node_.clear();
    for (std::size_t size = numbers_.size() / lane_count; size * lane_count > top_size;
         size = node_.back().size() / lane_count)
      node_.emplace_back(std::max(padded(size), lane_count), infinite);
    rebuild(used_);
  }

  double operator[](std::size_t k) const { return numbers_[k]; }
  /// Changes number k, below the capacity.
  void set(std::size_t k, double value) {
    numbers_[k] = value;
    used_ = std::max(used_, k + 1);
    for (std::size_t l = 0; l < node_.size(); ++l) {
      const double smallest = of_children(l, k /= lane_count);
      if (node_[l][k] == smallest) return;
      node_[l][k] = smallest;
    }
  }
  /// The numbers from `first` on, a vector of them; to be followed by rebuild().
  void set_lanes(std::size_t first, const Lanes& values) { store(numbers_, first, values); }
  /// Only the first `size` numbers count from now on.
  void rebuild(std::size_t size) {
    std::size_t changed = std::max(used_, padded(size));
    for (std::size_t k = size; k < changed; ++k) numbers_[k] = infinite;
    for (std::size_t l = 0; l < node_.size(); ++l) {
      changed = (changed + lane_count - 1) / lane_count;
      for (std::size_t k = 0; k < changed; ++k) node_[l][k] = of_children(l, k);
    }
    used_ = size;
  }
  /// The smallest number; of equal ones the first.
  Smallest smallest() const {
    if (node_.empty()) return shakedown::smallest(numbers_, numbers_.size());
    Smallest found = shakedown::smallest(node_.back(), node_.back().size());
    for (std::size_t l = node_.size(); l > 0; --l) {
      const std::size_t first = static_cast<std::size_t>(found.index) * lane_count;
      const auto here = load(children(l - 1), first) == Lanes(found.value);
      if (simd::any_of(here)) found.index = static_cast<int>(first) + simd::find_first_set(here);
    }
    return found;
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr std::size_t top_size = 256;
  /// Return the numbers below level l, and the smallest of those below its node k.
  const AlignedVector<double>& children(std::size_t l) const { return l == 0 ? numbers_ : node_[l - 1]; }
  double of_children(std::size_t l, std::size_t k) const {
    return simd::hmin(load(children(l), k * lane_count));
  }

  AlignedVector<double> numbers_;
  std::vector<AlignedVector<double>> node_;  // level by level
  std::size_t used_ = 0;                     // numbers beyond are infinite
};

}  // namespace shakedown
