// SPDX-License-Identifier: MIT
// Vectors of doubles as wide as the machine, and arrays that they can be loaded from. The width never changes
// a result: every lane does the same operations in the same order, and ties go to the lowest index.
#pragma once
#include <array>
#include <cstdint>
#include <experimental/simd>
#include <limits>
#include <new>
#include <vector>
#ifdef __AVX512F__
#include <immintrin.h>
#ifdef __clang__
#error \
    "where(mask, x) = y of libstdc++ 12 does nothing here: impacts would be missed; compile with -mno-avx512f"
#endif
#endif

namespace shakedown {

namespace simd = std::experimental;
using Lanes = simd::native_simd<double>;
constexpr std::size_t lane_count = Lanes::size();

/// Allocates memory aligned to 64 bytes, large arrays on large pages, so that addresses reached at random
/// stay in the processor's tables; free_cache_lines() takes the same number of bytes.
void* allocate_cache_lines(std::size_t bytes);
void free_cache_lines(void* memory, std::size_t bytes);

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(allocate_cache_lines(n * sizeof(T))); }
  void deallocate(T* p, std::size_t n) { free_cache_lines(p, n * sizeof(T)); }
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
template <class L = Lanes>
L lane_index() {
  return L([](auto lane) { return static_cast<double>(lane); });
}

/// Half as many lanes, where the machine has that many: roots and divisions take half the time.
constexpr std::size_t few_count = lane_count > 4 ? lane_count / 2 : lane_count;
using FewLanes = simd::simd<double, simd::simd_abi::deduce_t<double, few_count>>;

/// Returns square roots from below, good to 2^-21, of numbers up to 1e30: in single precision they take a
/// third of the time, on every machine alike.
inline Lanes roots_below(const Lanes& x) {
  using Single = simd::simd<float, simd::simd_abi::deduce_t<float, lane_count>>;
  const Single root = simd::sqrt(simd::static_simd_cast<Single>(simd::min(x, Lanes(1e30))));
  return simd::static_simd_cast<Lanes>(root) * Lanes(1 - 0x1p-22);
}

/// Tells whether the machine has the two estimates below, within 2^-14 of the true value and many times
/// cheaper than a root or a division.
#ifdef __AVX512VL__
constexpr bool has_estimates = true;
template <class L>
L inverse_estimate(const L& x) {
  if constexpr (L::size() == 8)
    return L(_mm512_rcp14_pd(static_cast<__m512d>(x)));
  else
    return L(_mm256_rcp14_pd(static_cast<__m256d>(x)));
}
template <class L>
L inverse_root_estimate(const L& x) {
  if constexpr (L::size() == 8)
    return L(_mm512_rsqrt14_pd(static_cast<__m512d>(x)));
  else
    return L(_mm256_rsqrt14_pd(static_cast<__m256d>(x)));
}
#else
constexpr bool has_estimates = false;
template <class L>
L inverse_estimate(const L& x) {
  return L(1.0) / x;
}
template <class L>
L inverse_root_estimate(const L& x) {
  return L(1.0) / simd::sqrt(x);
}
#endif

/// first[stride * index[0]], first[stride * index[1]], ... for all lanes.
template <std::size_t stride, class L = Lanes>
L gather(const double* first, const std::int32_t* index) {
#ifdef __AVX512VL__  // GCC 12 makes fifteen instructions of the general form
  if constexpr (L::size() == 8) {
    const __m256i at = _mm256_mullo_epi32(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(index)),
                                          _mm256_set1_epi32(stride));
    return L(_mm512_mask_i32gather_pd(_mm512_setzero_pd(), 0xff, at, first, 8));
  } else if constexpr (L::size() == 4) {
    const __m128i at =
        _mm_mullo_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(index)), _mm_set1_epi32(stride));
    return L(_mm256_mmask_i32gather_pd(_mm256_setzero_pd(), 0xf, at, first, 8));
  }
#endif
  return L([&](auto lane) { return first[stride * static_cast<std::size_t>(index[lane])]; });
}

/// Loads the first seven numbers of as many lines of eight numbers as there are lanes; returns number k of
/// all lines in vector k.
template <class L>
std::array<L, 7> columns(const double* first, const std::int32_t* index) {
#ifdef __AVX512F__
  if constexpr (L::size() == 8) {  // whole lines, transposed: 1 to 5 % of a fluid less than seven gathers
    const auto line = [&](int lane) {
      return _mm512_load_pd(first + 8 * static_cast<std::size_t>(index[lane]));
    };
    __m512d even[4], odd[4];  // numbers 0, 2, 4, 6 and 1, 3, 5, 7 of two lines each
    for (int two = 0; two < 4; ++two) {
      const __m512d a = line(2 * two), b = line(2 * two + 1);
      even[two] = _mm512_shuffle_pd(a, b, 0x00);
      odd[two] = _mm512_shuffle_pd(a, b, 0xff);
    }
    const auto quarters = [](const __m512d* of, auto first_level, auto second_level) {
      constexpr int one = decltype(first_level)::value, two = decltype(second_level)::value;
      const __m512d a = _mm512_maskz_shuffle_f64x2(0xff, of[0], of[1], one),
                    b = _mm512_maskz_shuffle_f64x2(0xff, of[2], of[3], one);
      return L(_mm512_maskz_shuffle_f64x2(0xff, a, b, two));
    };
    constexpr std::integral_constant<int, 0x88> low{};
    constexpr std::integral_constant<int, 0xdd> high{};
    return {quarters(even, low, low),  quarters(odd, low, low),   quarters(even, high, low),
            quarters(odd, high, low),  quarters(even, low, high), quarters(odd, low, high),
            quarters(even, high, high)};
  }
#endif
  return {gather<8, L>(first, index),     gather<8, L>(first + 1, index), gather<8, L>(first + 2, index),
          gather<8, L>(first + 3, index), gather<8, L>(first + 4, index), gather<8, L>(first + 5, index),
          gather<8, L>(first + 6, index)};
}

/// Writes those of eight `what` whose `size` is less than `limit` to `to`, which has room for eight; returns
/// how many.
inline std::size_t append_where_less(std::int32_t* to, const std::array<std::int32_t, 8>& what,
                                     const std::array<float, 8>& size, float limit) {
#ifdef __AVX512VL__
  const __mmask8 less = _mm256_cmp_ps_mask(_mm256_loadu_ps(size.data()), _mm256_set1_ps(limit), _CMP_LT_OQ);
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(what.data()));
  _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_maskz_compress_epi32(less, all));
  return static_cast<std::size_t>(__builtin_popcount(less));
#else
  std::size_t count = 0;
  for (std::size_t lane = 0; lane < 8; ++lane) {
    to[count] = what[lane];
    count += size[lane] < limit;
  }
  return count;
#endif
}

/// Smallest element of an array padded with infinities, and its (lowest) index.
struct Smallest {
  double value;
  int index;
};
inline Smallest smallest(const AlignedVector<double>& array, std::size_t size) {
  Lanes best = load(array, 0);
  for (std::size_t first = lane_count; first < size; first += lane_count)
    best = simd::min(best, load(array, first));
  const double value = simd::hmin(best);
#ifdef __AVX512F__
  if (size <= 64) {  // where it stands is as good as random: no branch on it
    std::uint64_t here = 0;
    for (std::size_t first = 0; first < size; first += lane_count)
      here |= std::uint64_t{_mm512_cmp_pd_mask(_mm512_load_pd(array.data() + first), _mm512_set1_pd(value),
                                               _CMP_EQ_OQ)}
              << first;
    return {value, here == 0 ? 0 : __builtin_ctzll(here)};
  }
#endif
  for (std::size_t first = 0; first < size; first += lane_count) {
    const auto here = load(array, first) == Lanes(value);
    if (simd::any_of(here)) return {value, static_cast<int>(first) + simd::find_first_set(here)};
  }
  return {value, 0};  // not a number in the array
}

}  // namespace shakedown
