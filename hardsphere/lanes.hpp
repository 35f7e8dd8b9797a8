// SPDX-License-Identifier: MIT
// Vectors of doubles as wide as the machine, and arrays that they can be loaded from. The width never changes a result: every lane does
// the same operations in the same order, and ties go to the lowest index.
#pragma once
#include <experimental/simd>
#include <new>
#include <vector>

namespace shakedown {

namespace simd = std::experimental;
using Lanes = simd::native_simd<double>;
constexpr std::size_t lane_count = Lanes::size();

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), std::align_val_t{64})); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, std::align_val_t{64}); }
  bool operator==(const CacheLineAllocator&) const { return true; }
};

/// An array whose start is aligned to 64 bytes.
template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

constexpr std::size_t padded(std::size_t n) { return (n + lane_count - 1) / lane_count * lane_count; }

inline Lanes load(const AlignedVector<double>& array, std::size_t first) {
  return Lanes(array.data() + first, simd::vector_aligned);
}
inline void store(AlignedVector<double>& array, std::size_t first, const Lanes& values) {
  values.copy_to(array.data() + first, simd::vector_aligned);
}
/// 0, 1, 2, ... of the lanes.
inline Lanes lane_index() {
  return Lanes([](auto lane) { return static_cast<double>(lane); });
}

/// Smallest element of an array padded with infinities, and its (lowest) index.
struct Smallest {
  double value;
  int index;
};
inline Smallest smallest(const AlignedVector<double>& array, std::size_t size) {
  Lanes best = load(array, 0);
  for (std::size_t first = lane_count; first < size; first += lane_count) best = simd::min(best, load(array, first));
  const double value = simd::hmin(best);
  for (std::size_t first = 0; first < size; first += lane_count) {
    const auto here = load(array, first) == Lanes(value);
    if (simd::any_of(here)) return {value, static_cast<int>(first) + simd::find_first_set(here)};
  }
  return {value, 0};  // not a number in the array
}

}  // namespace shakedown
