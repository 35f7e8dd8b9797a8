// SPDX-License-Identifier: MIT
#include "packed_numbers.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "errors.hpp"

namespace shakedown {

std::int64_t whole_steps(double value, double unit) {
  constexpr double most = 0x1p61;
  const double steps = value / unit;
  return std::isnan(steps) ? 0 : std::llround(std::clamp(steps, -most, most));
}

PackedNumbers packed(const std::vector<double>& values, double parts) {
  double largest = 0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  PackedNumbers result;
  if (largest > 0) result.quantum = std::pow(10, std::floor(std::log10(largest / parts)));
  std::int64_t last = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) {
      result.steps.emplace_back();
      continue;
    }
    const std::int64_t here = whole_steps(value, result.quantum);
    result.steps.emplace_back(here - last);
    last = here;
  }
  return result;
}

std::string gzip(std::string_view bytes) {
  z_stream stream{};
  EXPECT(deflateInit2(&stream, 9, Z_DEFLATED, 15 + 16, 9, Z_DEFAULT_STRATEGY) == Z_OK);
  std::string result(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(result.data());
  stream.avail_out = static_cast<uInt>(result.size());
  EXPECT(deflate(&stream, Z_FINISH) == Z_STREAM_END);
  result.resize(stream.total_out);
  deflateEnd(&stream);
  return result;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(bytes.size() * 4 / 3 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u;
    };
    const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
    text += letters[three >> 18];
    text += letters[three >> 12 & 63];
    text += i + 1 < bytes.size() ? letters[three >> 6 & 63] : '=';
    text += i + 2 < bytes.size() ? letters[three & 63] : '=';
  }
  return text;
}

}  // namespace shakedown
