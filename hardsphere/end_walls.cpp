// SPDX-License-Identifier: MIT
#include "end_walls.hpp"

namespace shakedown {

EndWalls::EndWalls(std::vector<double> room, bool always_watch_all, double range)
    : watch_all_(always_watch_all), range_(range), room_(std::move(room)), slot_(room_.size(), -1) {
  const std::size_t size = std::max(padded(room_.size()), lane_count);
  for (AlignedVector<double>* array : {&x_, &v_, &time_, &room_of_slot_}) array->assign(size, 0.0);
  bound_.assign(size, never);
  grain_.assign(size, -1);
  side_.assign(size, 0);
  meeting_.assign(size, Meeting::none);
  if (range_ > 0) inside_.assign(2 * room_.size(), 0);
}

void EndWalls::start_window(const Now& now) {
  if (watch_all_) return;
  // A grain costs about 8 times as much in the sweep over all as in the vectorised sweep over the watched.
  const double swept = static_cast<double>(kicks_) * static_cast<double>(count_), all = 8 * static_cast<double>(room_.size());
  if (planned_ == 0) planned_ = 1e-5;
  else planned_ = std::clamp(planned_ * (swept > all ? 0.8 : 1.25), 1e-9, 1.0);
  if (now.time > window_start_) jump_rate_ = (jump_rate_ + jumps_ / (now.time - window_start_)) / 2;
  const double tiny = 1e-9 * now.top_speed;
  slack_ = 2 * (jump_rate_ + tiny / planned_) * planned_ * planned_;
  window_start_ = now.time;
  window_end_ = now.time + planned_;
  drift_ = jumps_ = 0;
  kicks_ = 0;
}

double EndWalls::bound_of(int grain, const Flight& flight, double room, const Now& now) const {
  const double apart = now.point.x - (flight.x + flight.v * (now.time - flight.time)), rate = now.point.v - flight.v;
  const double top = now.top_acceleration;
  if (range_ == 0)
    return now.time + std::min(earliest_possible_root(room + apart, rate, top), earliest_possible_root(room - apart, -rate, top));
  double wait = never;
  for (const int side : {1, -1}) {
    const double gap = room + side * apart, opening = side * rate;
    if (is_inside(grain, side))
      wait = std::min({wait, earliest_possible_root(gap, opening, top), earliest_possible_root(range_ - gap, -opening, top)});
    else
      wait = std::min(wait, earliest_possible_root(gap - range_, opening, top));
  }
  return now.time + wait;
}

void EndWalls::watch(int i, const Flight& flight) {
  const std::size_t slot = count_++;
  slot_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(slot);
  x_[slot] = flight.x;
  v_[slot] = flight.v;
  time_[slot] = flight.time;
  room_of_slot_[slot] = room_[static_cast<std::size_t>(i)];
  grain_[slot] = i;
  meeting_[slot] = Meeting::none;
}

void EndWalls::bound_all(const Now& now) {
  std::fill(meeting_.begin(), meeting_.begin() + static_cast<std::ptrdiff_t>(count_), Meeting::none);
  for (std::size_t k = count_; k < padded(count_); ++k) bound_[k] = never;
  if (now.top_acceleration <= 0 || range_ > 0) {  // walls at rest, or wells at the walls: grain by grain
    for (std::size_t k = 0; k < count_; ++k)
      bound_[k] = bound_of(grain_[k], {x_[k], v_[k], time_[k]}, room_of_slot_[k], now);
    return find_next();
  }
  const double top = now.top_acceleration;
  const Lanes twice_top(2 * top), inverse_top(1 / top), zero(0.0);
  Lanes smallest_gap(smallest_gap_), earliest(never), earliest_slot(0.0), slot = lane_index();
  const auto first_touch = [&](const Lanes& gap, const Lanes& rate) {
    const Lanes root = simd::sqrt(rate * rate + twice_top * simd::max(gap, zero));
    // With a closing rate the sum cancels; what is lost only makes the bound a little early, so clamp it at zero.
    return simd::max(rate + root, zero) * inverse_top;
  };
  for (std::size_t k = 0; k < count_; k += lane_count, slot += static_cast<double>(lane_count)) {
    const Lanes room = load(room_of_slot_, k), v = load(v_, k);
    const Lanes apart = Lanes(now.point.x) - (load(x_, k) + v * (Lanes(now.time) - load(time_, k))), rate = Lanes(now.point.v) - v;
    const Lanes upper = room + apart, lower = room - apart;
    Lanes bound = Lanes(now.time) + simd::min(first_touch(upper, rate), first_touch(lower, -rate));
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
  next_ = {first, grain_[static_cast<std::size_t>(simd::hmin(slots_of_first))], 0, Meeting::none};
}

void EndWalls::find_next() {
  next_ = {};
  if (count_ == 0) return;
  const Smallest earliest = smallest(bound_, padded(count_));
  const std::size_t slot = static_cast<std::size_t>(earliest.index);
  if (earliest.value < never) next_ = {earliest.value, grain_[slot], side_[slot], meeting_[slot]};
}

void EndWalls::grain_flies(int i, const Flight& flight, const Now& now) {
  const std::int32_t slot = slot_[static_cast<std::size_t>(i)];
  if (slot < 0) {
    if (can_sleep(flight, room_[static_cast<std::size_t>(i)], now)) return;
    watch(i, flight);
    for (std::size_t k = count_; k < padded(count_); ++k) bound_[k] = never;
    return;
  }
  const std::size_t k = static_cast<std::size_t>(slot);
  x_[k] = flight.x;
  v_[k] = flight.v;
  time_[k] = flight.time;
  meeting_[k] = Meeting::none;
}

void EndWalls::grain_changed(int i, const Flight& flight, const Now& now) {
  grain_flies(i, flight, now);
  if (slot_[static_cast<std::size_t>(i)] < 0) return;
  const std::size_t k = static_cast<std::size_t>(slot_[static_cast<std::size_t>(i)]);
  bound_[k] = bound_of(i, flight, room_[static_cast<std::size_t>(i)], now);
  if (bound_[k] < next_.time) next_ = {bound_[k], i, 0, Meeting::none};
  else if (next_.grain == i) find_next();
}

void EndWalls::put_off(int i, double until) {
  const std::size_t k = static_cast<std::size_t>(slot_[static_cast<std::size_t>(i)]);
  meeting_[k] = Meeting::none;
  bound_[k] = std::max(bound_[k], until);
  find_next();
}

void EndWalls::set_inside(int i, int side, bool inside) {
  inside_[static_cast<std::size_t>(2 * i + (side > 0))] = inside ? 1 : 0;
}

void EndWalls::kicked(const Now& now, double jump) {
  ++kicks_;
  if (!watch_all_) {
    jumps_ += std::abs(jump);
    drift_ += std::abs(jump) * std::max(0.0, window_end_ - now.time);
    if (drift_ > slack_) window_end_ = now.time;  // the sleepers' guarantee ends here
  }
  bound_all(now);
}

EndWalls::Root EndWalls::exact_root(const BoxMotion& box, const Now& now, int grain, const Flight& flight, double room,
                                    double horizon) const {
  const double w = box.angular_frequency();
  if (w == 0) return exact_root<BoxMotion>(box, now, grain, flight, room, horizon);  // a box at rest
  const double x = flight.x + flight.v * (now.time - flight.time), apart = now.point.x - x, rate = now.point.v - flight.v;
  const auto bound = [&](int s) { return earliest_possible_root(room + s * apart, s * rate, now.top_acceleration); };
  const auto root = [&](int s) {
    return first_wall_root({s * now.point.x, s * now.point.v / w, w, room - s * x, s * flight.v});
  };
  // The nearer wall's root mostly comes before the other can be reached at all: 8 % of the time of the paper's damper.
  const double upper_bound = bound(1), lower_bound = bound(-1);
  const int first = upper_bound <= lower_bound ? 1 : -1;
  const double nearer = root(first);
  if (nearer < std::max(upper_bound, lower_bound)) return {now.time + nearer, first, Meeting::touch};
  const double other = root(-first);
  return {now.time + std::min(nearer, other), nearer < other || (nearer == other && first > 0) ? first : -first, Meeting::touch};
}

}  // namespace shakedown
