// SPDX-License-Identifier: MIT
#include "packed_replay.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "packed_numbers.hpp"

namespace shakedown {

namespace {

void append(std::string& bytes, std::uint64_t number) {
  for (; number >= 0x80; number >>= 7) bytes += static_cast<char>(number | 0x80);
  bytes += static_cast<char>(number);
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

PackedReplay packed(const ReportReplay& replay) {
  PackedReplay result;
  for (const ReportReplay::Track& track : replay.grains) append_track(result.bytes, track, result);
  append_track(result.bytes, replay.box, result);
  return result;
}

}  // namespace shakedown
