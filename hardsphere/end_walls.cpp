// SPDX-License-Identifier: MIT
#include "end_walls.hpp"

#include <cmath>

namespace shakedown {

EndWalls::EndWalls(std::vector<double> room, bool always_watch_all, double range)
    : watch_all_(always_watch_all),
      range_(range),
      room_(std::move(room)),
      slot_(room_.size(), -1),
      bound_(watch_all_ ? room_.size() : 0) {
  make_room(watch_all_ ? slot_.size() : 0);
  if (range_ > 0) inside_.assign(2 * slot_.size(), 0);
  equal_ = std::all_of(room_.begin(), room_.end(), [this](double one) { return one == room_[0]; });
  if (equal_ && room_.size() > 1) room_ = {room_[0]};
}

void EndWalls::make_room(std::size_t watched) {
  const std::size_t size = std::max(padded(watched), lane_count);
  for (AlignedVector<double>* array : {&x_, &v_, &time_, &room_of_slot_}) array->resize(size, 0.0);
  grain_.resize(size, -1);
  side_.resize(size, 0);
  meeting_.resize(size, Meeting::none);
  bound_.widen(size);
  if (range_ == 0) return;
  for (AlignedVector<double>& side : inside_of_slot_) side.resize(size, 0.0);
}

std::size_t EndWalls::bytes() const {
  const std::size_t of_watched = 5 * sizeof(double) + sizeof(std::int32_t) + 2;
  return room_.size() * sizeof(double) + slot_.size() * sizeof(std::int32_t) + grain_.size() * of_watched;
}

void EndWalls::start_window(const Now& now) {
  if (watch_all_) return;
  // A grain costs about 8 times as much in the sweep over all as in the vectorised sweep over the watched.
  const double all = 8 * static_cast<double>(slot_.size());
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

/// Bounds of the first root of gaps in vector lanes, each as earliest_possible_root() makes it.
template <class L>
static L earliest_possible_roots(const L& gap, const L& rate, double top) {
  const L zero(0.0), room = simd::max(gap, zero);
  const auto opens = rate >= zero;
  if (top <= 0) {
    L wait = room / -rate;
    simd::where(opens, wait) = never;
    return wait;
  }
  const L root = simd::sqrt(rate * rate + L(2 * top) * room);
  L over = L(2.0) * room, under = root - rate;
  simd::where(opens, over) = rate + root;
  simd::where(opens, under) = L(top);
  return over / under;
}

double EndWalls::bound_of(int grain, const Flight& flight, double room, const Now& now) const {
  const double apart = now.point.x - (flight.x + flight.v * (now.time - flight.time)),
               rate = now.point.v - flight.v;
  const double top = top_in_window(now);
  if (range_ > 0) return now.time + bound_at_wells(grain, room + apart, room - apart, rate, top);
  // Both walls at a time: a root and a division each.
  using Two = simd::simd<double, simd::simd_abi::deduce_t<double, 2>>;
  const Two side([](auto lane) { return lane == 0 ? 1.0 : -1.0; });
  return now.time + simd::hmin(earliest_possible_roots<Two>(Two(room) + side * Two(apart),
                                                            side * Two(rate) - Two(budget_), top));
}

/// Returns a lower bound of the time, s from now, to what lies ahead at the upper and the lower wall: the
/// wall or the edge of its well, and for a grain in the well the edge from within. All four are found at a
/// time, as which of them comes first is as good as random.
double EndWalls::bound_at_wells(int grain, double upper, double lower, double rate, double top) const {
  using Four = simd::simd<double, simd::simd_abi::deduce_t<double, 4>>;
  constexpr double far = 1e300;  // m, of what is not there, and opening
  const bool in_upper = is_inside(grain, 1), in_lower = is_inside(grain, -1);
  const std::array<double, 4> gaps{upper - (in_upper ? 0 : range_), lower - (in_lower ? 0 : range_),
                                   in_upper ? range_ - upper : far, in_lower ? range_ - lower : far};
  const std::array<double, 4> rates{rate, -rate, in_upper ? -rate : 1, in_lower ? rate : 1};
  return simd::hmin(earliest_possible_roots<Four>(Four(gaps.data(), simd::element_aligned),
                                                  Four(rates.data(), simd::element_aligned), top));
}

void EndWalls::watch(int i, const Flight& flight) {
  if (count_ == grain_.size()) make_room(std::min(count_ + count_ / 4 + lane_count, padded(slot_.size())));
  const std::size_t slot = count_++;
  slot_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(slot);
  x_[slot] = flight.x;
  v_[slot] = flight.v;
  time_[slot] = flight.time;
  room_of_slot_[slot] = room_of(static_cast<std::size_t>(i));
  grain_[slot] = i;
  meeting_[slot] = Meeting::none;
  note_inside(slot, i);
}

void EndWalls::note_inside(std::size_t slot, int i) {
  if (range_ == 0) return;
  inside_of_slot_[0][slot] = is_inside(i, 1) ? 1 : 0;
  inside_of_slot_[1][slot] = is_inside(i, -1) ? 1 : 0;
}

/// Bounds of the first root of gaps in vector lanes, as earliest_possible_root() makes of one, or a little
/// earlier.
class EndWalls::EarliestRoots {
 public:
  explicit EarliestRoots(double top)
      : at_rest_(top <= 0), twice_top_(2 * top), inverse_top_(at_rest_ ? 0 : 1 / top) {}
  Lanes operator()(const Lanes& gap, const Lanes& rate) const {
    const Lanes zero(0.0), room = simd::max(gap, zero);
    if (at_rest_) {
      Lanes wait(never);
      simd::where(rate < zero, wait) = room / -rate;
      return wait;
    }
    // With a closing rate the sum cancels; what is lost only makes the bound a little early, so clamp it at
    // zero.
    return simd::max(rate + roots_below(rate * rate + twice_top_ * room), zero) * inverse_top_;
  }

 private:
  bool at_rest_;
  Lanes twice_top_, inverse_top_;
};

void EndWalls::bound_all(const Now& now) {
  std::fill(meeting_.begin(), meeting_.begin() + static_cast<std::ptrdiff_t>(count_), Meeting::none);
  const EarliestRoots earliest(top_in_window(now));
  const Lanes budget(budget_), range(range_);
  Lanes smallest_gap(smallest_gap_), slot = lane_index();
  for (std::size_t k = 0; k < count_; k += lane_count, slot += static_cast<double>(lane_count)) {
    const Lanes room = load(room_of_slot_, k), v = load(v_, k);
    const Lanes apart = Lanes(now.point.x) - (load(x_, k) + v * (Lanes(now.time) - load(time_, k))),
                rate = Lanes(now.point.v) - v;
    const Lanes upper = room + apart, lower = room - apart;
    // the next edge of a well in attracting walls: its own, or from within the wall and the edge
    const auto at_wall = [&](int side, const Lanes& gap, const Lanes& opening) {
      if (range_ == 0) return earliest(gap, opening - budget);
      const auto inside = load(inside_of_slot_[side > 0 ? 0 : 1], k) > Lanes(0.5);
      Lanes to_touch = gap - range;
      simd::where(inside, to_touch) = gap;
      Lanes wait = earliest(to_touch, opening);
      simd::where(inside, wait) = simd::min(wait, earliest(range - gap, -opening));
      return wait;
    };
    Lanes bound = Lanes(now.time) + simd::min(at_wall(1, upper, rate), at_wall(-1, lower, -rate));
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
    if (can_sleep(flight, room_of(static_cast<std::size_t>(i)), now)) return false;
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

void EndWalls::grain_changed(int i, const Flight& flight, const Now& now, bool may_fly_on) {
  if (const std::int32_t slot = slot_[static_cast<std::size_t>(i)]; may_fly_on && slot >= 0) {
    const std::size_t watched = static_cast<std::size_t>(slot);
    if (v_[watched] == flight.v && bound_[watched] > now.time) return;
  }
  if (!watch_changed(i, flight, now)) return;
  const std::size_t k = static_cast<std::size_t>(slot_[static_cast<std::size_t>(i)]);
  bound_.set(k, bound_of(i, flight, room_of(static_cast<std::size_t>(i)), now));
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
  if (const std::int32_t slot = slot_[static_cast<std::size_t>(i)]; slot >= 0)
    note_inside(static_cast<std::size_t>(slot), i);
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

EndWalls::Edges EndWalls::edges_ahead(const Now& now, int grain, const Flight& flight, double room) const {
  const double apart = now.point.x - (flight.x + flight.v * (now.time - flight.time)),
               rate = now.point.v - flight.v;
  Edges ahead;
  const auto add = [&](int side, double level, int direction, Meeting meeting) {
    const double gap = direction * (room + side * apart - level), opening = direction * side * rate;
    const double bound = earliest_possible_root(gap, opening, now.top_acceleration);
    std::size_t place = ahead.count++;
    for (; place > 0 && bound < ahead.edge[place - 1].bound; --place)
      ahead.edge[place] = ahead.edge[place - 1];
    ahead.edge[place] = {side, level, direction, meeting, bound};
  };
  for (const int side : {1, -1}) {
    const bool inside = is_inside(grain, side);
    if (range_ > 0 && !inside)
      add(side, range_, 1, Meeting::capture);
    else
      add(side, 0, 1, Meeting::touch);
    if (inside) add(side, range_, -1, Meeting::escape);
  }
  return ahead;
}

/// Finds the nearer edge's root first, which mostly comes before the other edge can be reached at all: this
/// saves 8 % of the time of the paper's damper.
EndWalls::Root EndWalls::harmonic_root(double centre, double angular_frequency, const Now& now, int grain,
                                       const Flight& flight, double room) const {
  const double x = flight.x + flight.v * (now.time - flight.time), w = angular_frequency;
  if (range_ == 0) {
    const double apart = now.point.x - x, rate = now.point.v - flight.v, top = now.top_acceleration;
    const auto root = [&](int s) {
      return first_wall_root(
          {s * (now.point.x - centre), s * now.point.v / w, w, room + s * (centre - x), s * flight.v});
    };
    const double upper = earliest_possible_root(room + apart, rate, top),
                 lower = earliest_possible_root(room - apart, -rate, top);
    const int nearer = upper <= lower ? 1 : -1;
    const double first = root(nearer);
    if (first < std::max(upper, lower)) return {now.time + first, nearer, Meeting::touch};
    const double other = root(-nearer);
    return {now.time + std::min(first, other), first <= other ? nearer : -nearer, Meeting::touch};
  }
  const Edges ahead = edges_ahead(now, grain, flight, room);
  Root first;
  double wait = never;
  for (std::size_t k = 0; k < ahead.count; ++k) {
    const auto& [side, level, direction, meeting, bound] = ahead.edge[k];
    if (wait < bound) break;
    const int sign = direction * side;
    const double root = first_wall_root({sign * (now.point.x - centre), sign * now.point.v / w, w,
                                         direction * (room - level + side * (centre - x)), sign * flight.v});
    if (root < wait || k == 0) {
      wait = root;
      first = {now.time + root, side, meeting};
    }
  }
  return first;
}

EndWalls::Root EndWalls::exact_root(const BoxMotion& box, const Now& now, int grain, const Flight& flight,
                                    double room, double horizon) const {
  const double w = box.angular_frequency();
  if (w == 0) return exact_root<BoxMotion>(box, now, grain, flight, room, horizon);  // a box at rest
  return harmonic_root(0, w, now, grain, flight, room);
}

}  // namespace shakedown
