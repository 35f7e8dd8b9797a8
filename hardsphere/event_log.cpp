// SPDX-License-Identifier: MIT
#include "event_log.hpp"

#include <algorithm>
#include <bit>

#include "errors.hpp"

namespace shakedown {

namespace {

// Partners after the N grains, in this order.
constexpr int other_kinds = 3;                  // new_anchor, grain_kick, next_piece
constexpr int faces = 6;                        // axis and side
constexpr int walls_at = other_kinds;           // touch, capture, escape: `faces` each
constexpr int wells_at = walls_at + 3 * faces;  // pairs captured (N), pairs escaped (N)

std::uint64_t code_of(const LoggedEvent& event, std::uint64_t n) {
  const auto meeting = static_cast<std::uint64_t>(event.meeting) - 1,
             partner = static_cast<std::uint64_t>(event.partner);
  std::uint64_t with = 0;
  if (event.kind == EventKind::pair)
    with = event.meeting == Meeting::touch ? partner : n + wells_at + (meeting - 1) * n + partner;
  else if (event.kind == EventKind::wall)
    with = n + walls_at + meeting * faces + 2 * partner + (event.side > 0 ? 1 : 0);
  else
    with = n + static_cast<std::uint64_t>(event.kind) - static_cast<std::uint64_t>(EventKind::new_anchor);
  return static_cast<std::uint64_t>(event.grain) + std::max<std::uint64_t>(n, 1) * with;
}

LoggedEvent event_of(std::uint64_t code, std::uint64_t grains) {
  const std::uint64_t n = std::max<std::uint64_t>(grains, 1);
  LoggedEvent event;
  event.grain = static_cast<int>(code % n);
  std::uint64_t with = code / n;
  if (with < grains) {
    event.partner = static_cast<int>(with);
  } else if ((with -= grains) < other_kinds) {
    event.kind = static_cast<EventKind>(static_cast<std::uint64_t>(EventKind::new_anchor) + with);
  } else if (with < wells_at) {
    const auto face = static_cast<int>(with) - walls_at;
    event.kind = EventKind::wall;
    event.meeting = static_cast<Meeting>(1 + face / faces);
    event.partner = face % faces / 2;
    event.side = face % 2 == 1 ? 1 : -1;
  } else if ((with -= wells_at) < 2 * grains) {
    event.meeting = with < grains ? Meeting::capture : Meeting::escape;
    event.partner = static_cast<int>(with % grains);
  } else {
    throw FileError("the collision log names an event that does not exist (it is damaged)");
  }
  return event;
}

void append(std::vector<std::uint8_t>& bytes, std::uint64_t number) {
  for (; number >= 0x80; number >>= 7) bytes.push_back(static_cast<std::uint8_t>(number | 0x80));
  bytes.push_back(static_cast<std::uint8_t>(number));
}

/// Codes a signed step so that small steps of either sign make small numbers; unzigzag() takes it back.
std::uint64_t zigzag(std::uint64_t step) { return (step << 1) ^ (0 - (step >> 63)); }
std::uint64_t unzigzag(std::uint64_t number) { return (number >> 1) ^ (0 - (number & 1)); }

}  // namespace

std::int64_t digest_interval(std::size_t grains) {
  return std::max<std::int64_t>(4096, 16 * static_cast<std::int64_t>(grains));
}

EventWriter::EventWriter(State initial) : interval_(digest_interval(initial.size())), due_(interval_) {
  log_.initial = std::move(initial);
}

bool EventWriter::add(const LoggedEvent& event) {
  const auto bits = std::bit_cast<std::uint64_t>(event.time);
  append(log_.events, zigzag(bits - last_bits_));
  append(log_.events, code_of(event, log_.initial.size()));
  last_bits_ = bits;
  ++log_.entries;
  if ((event.kind == EventKind::pair || event.kind == EventKind::wall) && event.meeting == Meeting::touch)
    ++log_.impacts;
  if (--due_ > 0) return false;
  due_ = interval_;
  return true;
}

CollisionLog EventWriter::finished(double t, std::uint64_t digest) const {
  CollisionLog log = log_;
  log.end_time = t;
  log.digests.push_back(digest);
  log.events.shrink_to_fit();
  return log;
}

std::uint64_t EventReader::number() {
  std::uint64_t number = 0;
  for (int shift = 0; shift < 64; shift += 7) {
    if (at_ >= log_->events.size()) break;
    const std::uint8_t byte = log_->events[at_++];
    number |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return number;
  }
  throw FileError("the collision log is cut short");
}

LoggedEvent EventReader::next() {
  last_bits_ += unzigzag(number());
  LoggedEvent event = event_of(number(), log_->initial.size());
  event.time = std::bit_cast<double>(last_bits_);
  ++entry_;
  return event;
}

}  // namespace shakedown
