// SPDX-License-Identifier: MIT
// FNV-1a, 64 bits (Fowler, Noll, Vo): tells changed data from unchanged. No protection against malice.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace shakedown {

constexpr std::uint64_t fnv_start = 0xcbf29ce484222325u;

/// Returns the hash with one unit more: a byte, or a word where speed matters.
constexpr std::uint64_t fnv_step(std::uint64_t hash, std::uint64_t unit) {
  return (hash ^ unit) * 0x100000001b3u;
}

/// Returns the hash with these bytes more; `hash`: that of the bytes before.
constexpr std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash = fnv_start) {
  for (const char c : bytes) hash = fnv_step(hash, static_cast<unsigned char>(c));
  return hash;
}

/// Returns 16 hexadecimal digits.
inline std::string hexadecimal(std::uint64_t value) {
  std::string digits(16, '0');
  for (std::size_t i = digits.size(); i-- > 0; value >>= 4) digits[i] = "0123456789abcdef"[value & 15];
  return digits;
}

}  // namespace shakedown
