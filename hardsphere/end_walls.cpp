// SPDX-License-Identifier: MIT
#include "end_walls.hpp"

#include <cmath>

namespace shakedown {

EndWalls::EndWalls(std::vector<double> room, bool always_watch_all, double range)
    : watch_all_(always_watch_all),
      range_(range),
      room_(std::move(room)),
      slot_(room_.size(), -1),
      bound_(room_.size()) {
  const std::size_t size = std::max(padded(room_.size()), lane_count);
  for (AlignedVector<double>* array : {&x_, &v_, &time_, &room_of_slot_}) array->assign(size, 0.0);
  grain_.assign(size, -1);
  side_.assign(size, 0);
  meeting_.assign(size, Meeting::none);
  if (range_ > 0) inside_.assign(2 * room_.size(), 0);
}

void EndWalls::start_window(const Now& now) {
  if (watch_all_) return;
  // A grain costs about 8 times as much in the sweep over all as in the vectorised sweep over the watched.
  const double all = 8 * static_cast<double>(room_.size());
  if (planned_ == 0)
    planned_ = 1e-5;
  else
    planned_ = std::clamp(planned_ * (swept_ > all ? 0.8 : outgrown_ ? 1.0 : 1.25), 1e-9, 1.0);
  if (budget_ == 0 && range_ == 0) budget_ = 1e-4 * now.top_speed;
  if (now.time > window_start_) jump_rate_ = (jump_rate_ + jumps_ / (now.time - window_start_)) / 2;
  const double tiny = 1e-9 * now.top_speed;
  slack_ = 2 * (jump_rate_ + tiny / planned_) * planned_ * planned_;
  window_top_ = now.on_spring_alone ? 0 : now.top_acceleration * (1 + 0x1p-4);  // room for pieces to come
  outgrown_ = false;
  window_start_ = now.time;
  window_end_ = now.time + planned_;
  drift_ = jumps_ = swept_ = 0;
}

/// Renews all bounds, with a budget that follows what it costs.
void EndWalls::sweep(const Now& now) {
  if (!watch_all_) {
    // In units of a bound in the vectorised sweep a refinement costs a hundred.
    const double watched = static_cast<double>(count_),
                 extra = static_cast<double>(refined_ - 2 * kicks_) * 100;
    budget_ *= extra > watched ? 0.8 : 1.25;
    swept_ += watched;
    used_ = 0;
    kicks_ = refined_ = 0;
    due_.clear();
  }
  bound_all(now);
}

double EndWalls::bound_of(int grain, const Flight& flight, double room, const Now& now) const {
  const double apart = now.point.x - (flight.x + flight.v * (now.time - flight.time)),
               rate = now.point.v - flight.v;
  const double top = top_in_window(now);
  if (range_ == 0)
    return now.time + std::min(earliest_possible_root(room + apart, rate - budget_, top),
                               earliest_possible_root(room - apart, -rate - budget_, top));
  double wait = never;
  for (const int side : {1, -1}) {
    const double gap = room + side * apart, opening = side * rate;
    if (is_inside(grain, side))
      wait = std::min({wait, earliest_possible_root(gap, opening, top),
                       earliest_possible_root(range_ - gap, -opening, top)});
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
  const double top = top_in_window(now);
  if (top <= 0 || range_ > 0) {  // walls at rest, or wells at the walls: grain by grain
    for (std::size_t k = 0; k < count_; ++k) {
      const Flight flight{x_[k], v_[k], time_[k]};
      const double apart = now.point.x - (flight.x + flight.v * (now.time - flight.time));
      smallest_gap_ = std::min(smallest_gap_, room_of_slot_[k] - std::abs(apart));
      bound_.set(k, bound_of(grain_[k], flight, room_of_slot_[k], now));
    }
    bound_.rebuild(count_);
    return find_next();
  }
  const Lanes twice_top(2 * top), inverse_top(1 / top), budget(budget_), zero(0.0);
  Lanes smallest_gap(smallest_gap_), slot = lane_index();
  const auto first_touch = [&](const Lanes& gap, const Lanes& rate) {
    const Lanes root = roots_below(rate * rate + twice_top * simd::max(gap, zero));
    // With a closing rate the sum cancels; what is lost only makes the bound a little early, so clamp it at
    // zero.
    return simd::max(rate + root, zero) * inverse_top;
  };
  for (std::size_t k = 0; k < count_; k += lane_count, slot += static_cast<double>(lane_count)) {
    const Lanes room = load(room_of_slot_, k), v = load(v_, k);
    const Lanes apart = Lanes(now.point.x) - (load(x_, k) + v * (Lanes(now.time) - load(time_, k))),
                rate = Lanes(now.point.v) - v;
    const Lanes upper = room + apart, lower = room - apart;
    Lanes bound =
        Lanes(now.time) + simd::min(first_touch(upper, rate - budget), first_touch(lower, -rate - budget));
    const auto empty = slot >= Lanes(static_cast<double>(count_));
    simd::where(empty, bound) = never;
    bound_.set_lanes(k, bound);
    simd::where(!empty, smallest_gap) = simd::min(smallest_gap, simd::min(upper, lower));
  }
  smallest_gap_ = simd::hmin(smallest_gap);
  bound_.rebuild(count_);
  find_next();
}

void EndWalls::find_next() {
  next_ = {};
  if (count_ == 0) return;
  const Smallest earliest = bound_.smallest();
  const std::size_t slot = static_cast<std::size_t>(earliest.index);
  if (earliest.value < never) next_ = {earliest.value, grain_[slot], side_[slot], meeting_[slot]};
}

bool EndWalls::watch_changed(int i, const Flight& flight, const Now& now) {
  const std::int32_t slot = slot_[static_cast<std::size_t>(i)];
  if (slot < 0) {
    if (can_sleep(flight, room_[static_cast<std::size_t>(i)], now)) return false;
    watch(i, flight);
    return true;
  }
  const std::size_t k = static_cast<std::size_t>(slot);
  x_[k] = flight.x;
  v_[k] = flight.v;
  time_[k] = flight.time;
  meeting_[k] = Meeting::none;
  return true;
}

void EndWalls::grain_flies(int i, const Flight& flight, const Now& now) {
  if (watch_changed(i, flight, now) && !watch_all_) due_.push_back(slot_[static_cast<std::size_t>(i)]);
}

void EndWalls::grain_changed(int i, const Flight& flight, const Now& now) {
  if (!watch_changed(i, flight, now)) return;
  const std::size_t k = static_cast<std::size_t>(slot_[static_cast<std::size_t>(i)]);
  bound_.set(k, bound_of(i, flight, room_[static_cast<std::size_t>(i)], now));
  if (bound_[k] < next_.time)
    next_ = {bound_[k], i, 0, Meeting::none};
  else if (next_.grain == i)
    find_next();
}

void EndWalls::put_off(int i, double until) {
  const std::size_t k = static_cast<std::size_t>(slot_[static_cast<std::size_t>(i)]);
  meeting_[k] = Meeting::none;
  bound_.set(k, std::max(bound_[k], until));
  find_next();
}

void EndWalls::set_inside(int i, int side, bool inside) {
  inside_[static_cast<std::size_t>(2 * i + (side > 0))] = inside ? 1 : 0;
}

void EndWalls::kicked(const Now& now, double jump) {
  if (watch_all_) return bound_all(now);
  ++kicks_;
  jumps_ += std::abs(jump);
  used_ += std::abs(jump);
  drift_ += std::abs(jump) * std::max(0.0, window_end_ - now.time);
  outgrown_ = outgrown_ || (!now.on_spring_alone && now.top_acceleration > window_top_);
  if (drift_ > slack_ || outgrown_) window_end_ = now.time;  // the sleepers' guarantee ends here
  if (jump == 0 || used_ > budget_) return sweep(now);
  for (const std::int32_t slot : due_) {
    const std::size_t k = static_cast<std::size_t>(slot);
    meeting_[k] = Meeting::none;
    bound_.set(k, bound_of(grain_[k], {x_[k], v_[k], time_[k]}, room_of_slot_[k], now));
  }
  due_.clear();
  find_next();
}

EndWalls::Root EndWalls::exact_root(const BoxMotion& box, const Now& now, int grain, const Flight& flight,
                                    double room, double horizon) const {
  const double w = box.angular_frequency();
  if (w == 0) return exact_root<BoxMotion>(box, now, grain, flight, room, horizon);  // a box at rest
  const double x = flight.x + flight.v * (now.time - flight.time), apart = now.point.x - x,
               rate = now.point.v - flight.v;
  const auto bound = [&](int s) {
    return earliest_possible_root(room + s * apart, s * rate, now.top_acceleration);
  };
  const auto root = [&](int s) {
    return first_wall_root({s * now.point.x, s * now.point.v / w, w, room - s * x, s * flight.v});
  };
  // The nearer wall's root mostly comes before the other can be reached at all: 8 % of the time of the
  // paper's damper.
  const double upper_bound = bound(1), lower_bound = bound(-1);
  const int first = upper_bound <= lower_bound ? 1 : -1;
  const double nearer = root(first);
  if (nearer < std::max(upper_bound, lower_bound)) return {now.time + nearer, first, Meeting::touch};
  const double other = root(-first);
  return {now.time + std::min(nearer, other),
          nearer < other || (nearer == other && first > 0) ? first : -first, Meeting::touch};
}

}  // namespace shakedown
