// SPDX-License-Identifier: MIT
#include "packed_numbers.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "errors.hpp"

namespace shakedown {

namespace {

void append(std::string& bytes, std::uint64_t number) {
  for (; number >= 0x80; number >>= 7) bytes += static_cast<char>(number | 0x80);
  bytes += static_cast<char>(number);
}

/// The difference of any two fits 64 bits, whatever a file of somebody else's says.
std::int64_t whole_steps(double value, double unit) {
  constexpr double most = 0x1p61;
  const double steps = value / unit;
  return std::isnan(steps) ? 0 : std::llround(std::clamp(steps, -most, most));
}

std::uint64_t zigzag(std::int64_t number) {
  return number < 0 ? 2 * static_cast<std::uint64_t>(-(number + 1)) + 1
                    : 2 * static_cast<std::uint64_t>(number);
}

void append_steps(std::string& bytes, const std::vector<double>& values, double unit) {
  std::int64_t last = 0;
  for (const double value : values) {
    const std::int64_t here = whole_steps(value, unit);
    append(bytes, zigzag(here - last));
    last = here;
  }
}

void append_track(std::string& bytes, const ReportReplay::Track& track, const PackedReplay& units) {
  std::int64_t last = 0;
  for (std::size_t i = 0; i < track.time.size(); ++i) {
    const std::int64_t here = std::max<std::int64_t>(last, whole_steps(track.time[i], units.time_unit));
    append(bytes,
           4 * static_cast<std::uint64_t>(here - last) + (track.contact.empty() ? 3u : track.contact[i]));
    last = here;
  }
  for (const auto* values : {&track.x, &track.y, &track.z}) append_steps(bytes, *values, units.length_unit);
}

}  // namespace

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

PackedReplay packed(const ReportReplay& replay) {
  PackedReplay result;
  for (const ReportReplay::Track& track : replay.grains) append_track(result.bytes, track, result);
  append_track(result.bytes, replay.box, result);
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
