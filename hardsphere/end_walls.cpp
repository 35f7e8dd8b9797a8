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
  drift_ = 0;
  if (watch_all_) return;
  // The sweep over all grains at a window's start and the sweeps over the watched ones after each kick should cost about the same.
  const double swept = static_cast<double>(kicks_) * static_cast<double>(count_) / 4;
  const double all = static_cast<double>(room_.size());
  if (reach_ == 0) reach_ = 1e-3 * (room_.empty() ? 1.0 : room_[0]);
  else reach_ *= swept > all ? 0.8 : 1.25;
  reach_ = std::min(reach_, room_.empty() ? 1.0 : room_[0]);
  kicks_ = 0;
  slack_ = reach_;
  const double speed = std::max(box.top_speed(), 1e-6);
  window_end_ = now + reach_ / speed;
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

bool EndWalls::can_sleep(const Flight& flight, double room, double now, BoxMotion::Point point,
                         double top_acceleration) const {
  const double h = window_end_ - now;
  const double apart = point.x - (flight.x + flight.v * (now - flight.time)), rate = point.v - flight.v;
  const double curved = top_acceleration * h * h / 2;
  // The bound is concave in time: it is lowest at one of the window's ends.
  const double upper = room + apart, lower = room - apart;
  return std::min(upper, upper + rate * h - curved) > slack_ && std::min(lower, lower - rate * h - curved) > slack_;
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
    return;
  }
  const Lanes twice_top(2 * top), inverse_top(1 / top), zero(0.0);
  Lanes smallest_gap(smallest_gap_);
  const auto first_touch = [&](const Lanes& gap, const Lanes& rate) {
    const Lanes root = simd::sqrt(rate * rate + twice_top * simd::max(gap, zero));
    // With a closing rate the sum cancels; what is lost only makes the bound a little early, so clamp it at zero.
    return simd::max(rate + root, zero) * inverse_top;
  };
  for (std::size_t k = 0; k < count_; k += lane_count) {
    const Lanes room = load(room_of_slot_, k), v = load(v_, k);
    const Lanes apart = Lanes(point.x) - (load(x_, k) + v * (Lanes(now) - load(time_, k))), rate = Lanes(point.v) - v;
    const Lanes upper = room + apart, lower = room - apart;
    const Lanes touch = simd::min(first_touch(upper, rate), first_touch(lower, -rate));
    store(bound_, k, Lanes(now) + touch);
    if (k + lane_count <= count_) smallest_gap = simd::min(smallest_gap, simd::min(upper, lower));
  }
  smallest_gap_ = simd::hmin(smallest_gap);
  for (std::size_t k = count_; k < padded(count_); ++k) bound_[k] = never;
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

void EndWalls::grain_changed(int i, const Flight& flight, double now, const BoxMotion& box) {
  std::int32_t& slot = slot_[static_cast<std::size_t>(i)];
  const BoxMotion::Point point = box.at(now);
  const double top = box.top_acceleration(), room = room_[static_cast<std::size_t>(i)];
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
  if (!watch_all_) drift_ += std::abs(jump) * std::max(0.0, window_end_ - now);
  bound_all(now, box);
  find_next();
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
