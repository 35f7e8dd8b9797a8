// SPDX-License-Identifier: MIT
#include "end_walls.hpp"

#include <algorithm>

namespace shakedown {

EndWalls::EndWalls(std::vector<double> room, bool always_watch_all)
    : watch_all_(always_watch_all), room_(std::move(room)), slot_(room_.size(), -1) {
  const std::size_t size = std::max(padded(room_.size()), lane_count);
  for (AlignedVector<double>* array : {&x_, &v_, &time_}) array->assign(size, 0.0);
  room_of_slot_.assign(size, 0.0);
  bound_.assign(size, never);
  grain_.assign(size, -1);
  side_.assign(size, 0);
}

void EndWalls::start_window(double now, const BoxMotion& box) {
  if (watch_all_) return;
  // A grain costs about 8 times as much in the sweep over all as in the vectorised sweep over the watched.
  const double swept = static_cast<double>(kicks_) * static_cast<double>(count_), all = 8 * static_cast<double>(room_.size());
  if (planned_ == 0) planned_ = 1e-5;
  else planned_ = std::clamp(planned_ * (swept > all ? 0.8 : 1.25), 1e-9, 1.0);
  if (now > window_start_) jump_rate_ = (jump_rate_ + jumps_ / (now - window_start_)) / 2;
  const double tiny = 1e-9 * box.top_speed();
  slack_ = 2 * (jump_rate_ + tiny / planned_) * planned_ * planned_;
  window_start_ = now;
  window_end_ = now + planned_;
  drift_ = jumps_ = 0;
  kicks_ = 0;
}

double EndWalls::bound_of(const Flight& flight, double room, double now, BoxMotion::Point point,
                          double top_acceleration) const {
  const double apart = point.x - (flight.x + flight.v * (now - flight.time)), rate = point.v - flight.v;
  if (top_acceleration <= 0) {  // a box at rest for good: straight flight to a fixed wall
    const double u = -rate;
    if (u == 0) return never;
    return now + std::max(0.0, (room + (u > 0 ? apart : -apart)) / std::abs(u));
  }
  return now + std::min(earliest_possible_root(room + apart, rate, top_acceleration),
                        earliest_possible_root(room - apart, -rate, top_acceleration));
}

void EndWalls::watch(int i, const Flight& flight) {
  const std::size_t slot = count_++;
  slot_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(slot);
  x_[slot] = flight.x;
  v_[slot] = flight.v;
  time_[slot] = flight.time;
  room_of_slot_[slot] = room_[static_cast<std::size_t>(i)];
  grain_[slot] = i;
  side_[slot] = 0;
}

void EndWalls::bound_all(double now, const BoxMotion& box) {
  const BoxMotion::Point point = box.at(now);
  const double top = box.top_acceleration();
  std::fill(side_.begin(), side_.begin() + static_cast<std::ptrdiff_t>(count_), std::int8_t{0});
  if (top <= 0) {
    for (std::size_t k = 0; k < count_; ++k)
      bound_[k] = bound_of({x_[k], v_[k], time_[k]}, room_of_slot_[k], now, point, 0);
    for (std::size_t k = count_; k < padded(count_); ++k) bound_[k] = never;
    return find_next();
  }
  const Lanes twice_top(2 * top), inverse_top(1 / top), zero(0.0);
  Lanes smallest_gap(smallest_gap_), earliest(never), earliest_slot(0.0), slot = lane_index();
  const auto first_touch = [&](const Lanes& gap, const Lanes& rate) {
    const Lanes root = simd::sqrt(rate * rate + twice_top * simd::max(gap, zero));
    // With a closing rate the sum cancels; what is lost only makes the bound a little early, so clamp it at zero.
    return simd::max(rate + root, zero) * inverse_top;
  };
  for (std::size_t k = 0; k < count_; k += lane_count, slot += static_cast<double>(lane_count)) {
    const Lanes room = load(room_of_slot_, k), v = load(v_, k);
    const Lanes apart = Lanes(point.x) - (load(x_, k) + v * (Lanes(now) - load(time_, k))), rate = Lanes(point.v) - v;
    const Lanes upper = room + apart, lower = room - apart;
    Lanes bound = Lanes(now) + simd::min(first_touch(upper, rate), first_touch(lower, -rate));
    const auto empty = slot >= Lanes(static_cast<double>(count_));
    simd::where(empty, bound) = never;
    store(bound_, k, bound);
    simd::where(!empty, smallest_gap) = simd::min(smallest_gap, simd::min(upper, lower));
    const auto sooner = bound < earliest;
    simd::where(sooner, earliest) = bound;
    simd::where(sooner, earliest_slot) = slot;
  }
  smallest_gap_ = simd::hmin(smallest_gap);
  next_ = {};
  const double first = simd::hmin(earliest);
  if (first == never) return;
  Lanes slots_of_first(never);
  simd::where(earliest == Lanes(first), slots_of_first) = earliest_slot;
  next_ = {first, grain_[static_cast<std::size_t>(simd::hmin(slots_of_first))], 0, false};
}

void EndWalls::find_next() {
  if (count_ == 0) {
    next_ = {};
    return;
  }
  const Smallest earliest = smallest(bound_, padded(count_));
  const std::size_t slot = static_cast<std::size_t>(earliest.index);
  next_ = {earliest.value, grain_[slot], side_[slot], side_[slot] != 0};
}

void EndWalls::grain_changed(int i, const Flight& flight, double now, BoxMotion::Point point, double top) {
  std::int32_t& slot = slot_[static_cast<std::size_t>(i)];
  const double room = room_[static_cast<std::size_t>(i)];
  if (slot < 0) {
    if (can_sleep(flight, room, now, point, top)) return;
    watch(i, flight);
    const std::size_t last = static_cast<std::size_t>(slot);
    for (std::size_t k = last + 1; k < padded(count_); ++k) bound_[k] = never;
  }
  const std::size_t k = static_cast<std::size_t>(slot);
  x_[k] = flight.x;
  v_[k] = flight.v;
  time_[k] = flight.time;
  side_[k] = 0;
  bound_[k] = bound_of(flight, room, now, point, top);
  if (bound_[k] < next_.time) next_ = {bound_[k], i, 0, false};
  else if (next_.grain == i) find_next();
}

void EndWalls::box_kicked(double now, const BoxMotion& box, double jump) {
  ++kicks_;
  if (!watch_all_) {
    jumps_ += std::abs(jump);
    drift_ += std::abs(jump) * std::max(0.0, window_end_ - now);
    if (drift_ > slack_) window_end_ = now;  // the sleepers' guarantee ends here
  }
  bound_all(now, box);
}

void EndWalls::refine(const BoxMotion& box, double limit) {
  const std::size_t k = static_cast<std::size_t>(slot_[static_cast<std::size_t>(next_.grain)]);
  const Flight flight{x_[k], v_[k], time_[k]};
  const double now = bound_[k], room = room_of_slot_[k];
  const BoxMotion::Point point = box.at(now);
  // A new bound from here is cheap; the root is sought only when the bound stays before the next event.
  const double sharper = bound_of(flight, room, now, point, box.top_acceleration());
  if (sharper > limit || box.top_acceleration() <= 0) {
    bound_[k] = sharper;
    if (box.top_acceleration() <= 0 && sharper < never) side_[k] = point.v - flight.v < 0 ? std::int8_t{1} : std::int8_t{-1};
  } else {
    const double w = box.angular_frequency(), x = flight.x + flight.v * (now - flight.time);
    const auto root = [&](double s) {
      return first_wall_root({s * point.x, s * point.v / w, w, room - s * x, s * flight.v});
    };
    const double upper = root(1), lower = root(-1);
    bound_[k] = now + std::min(upper, lower);
    side_[k] = upper <= lower ? std::int8_t{1} : std::int8_t{-1};
  }
  find_next();
}

}  // namespace shakedown
