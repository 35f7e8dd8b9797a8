// SPDX-License-Identifier: MIT
#include "cell_lists.hpp"

#include <algorithm>

#include "errors.hpp"

namespace shakedown {

namespace {

/// Returns the width of the shell in diameters: wide shells save renewals where grains fly far between
/// impacts, narrow ones save pair tests where they do not.
double shell_for(double packing_fraction) { return std::clamp(2.45 - 1.75 * packing_fraction, 1.45, 2.6); }

double shell_of(const CellListsPlan& plan, double largest_reach) {
  double shell = largest_reach * (plan.shell > 0 ? plan.shell : shell_for(plan.packing_fraction));
  if (plan.periodic)
    for (const double extent : plan.cell) shell = std::min(shell, extent / 3);
  return shell;
}

}  // namespace

template <bool Periodic>
CellLists<Periodic>::CellLists(const State& state, const CellListsPlan& plan)
    : ScheduledGrains(state, plan.cell),
      own_(state.size()),
      centres_(state.size(), plan.cell, shell_of(plan, lines_.largest_reach()), Periodic),
      half_width_(plan.half_width),
      leeway_((shell_of(plan, lines_.largest_reach()) - lines_.largest_reach()) / 2) {
  EXPECT(leeway_ > 0);
  const std::size_t n = state.size();
  list_.resize(n * list_room_);
  for (std::size_t i = 0; i < n; ++i) {
    own_[i].centre = lines_.flight(i).x;
    std::fill_n(list(i), list_room_, static_cast<std::int32_t>(i));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const CentreCells::Place place = centres_.place(own_[i].centre);
    const std::size_t near = centres_.find(place, near_);
    for (std::size_t m = 0; m < near; ++m) {
      add_neighbour(i, near_[m]);
      add_neighbour(static_cast<std::size_t>(near_[m]), static_cast<std::int32_t>(i));
    }
    centres_.put(static_cast<std::int32_t>(i), place);
  }
}

template <bool Periodic>
GrainEvent CellLists<Periodic>::event(int i) const {
  const std::size_t k = static_cast<std::size_t>(i);
  return {queue_.time(i), own_[k].partner, own_[k].partner_count, Meeting::touch};
}

template <bool Periodic>
std::array<double, 3> CellLists<Periodic>::separation(const Flight3& a, const Flight3& b) const {
  return {nearest(b.x[0] - a.x[0], 0), nearest(b.x[1] - a.x[1], 1), nearest(b.x[2] - a.x[2], 2)};
}

/// Returns when a grain is `leeway` away from the centre of its list, s from the time of its flight, or
/// `wait` if that is earlier. Mostly it is, and a look at the place where the grain would be then spares the
/// root (9 % of the time at packing fraction 0.5). Coordinates change by a period only together with the
/// centre.
template <bool Periodic>
double CellLists<Periodic>::time_to_leave(std::size_t i, const Flight3& flight, double wait) const {
  double a = 0, b = 0, c = -leeway_ * leeway_, later = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double off = flight.x[axis] - own_[i].centre[axis], v = flight.v[axis], then = off + v * wait;
    a += v * v;
    b += off * v;
    c += off * off;
    later += then * then;
  }
  if (later < leeway_ * leeway_ || a == 0) return wait;
  if (c >= 0) return b >= 0 ? 0 : std::min(wait, -2 * b / a);  // at the edge by rounding
  return std::min(wait, (std::sqrt(b * b - a * c) - b) / a);
}

template <bool Periodic>
GrainEvent CellLists<Periodic>::next_of(int i) {
  const std::size_t k = static_cast<std::size_t>(i);
  const Flight3 self = flight(i);
  const GrainLines::Touch touch = lines_.first_touch<Periodic>(k, self, list(k), own_[k].list_size, never);
  const double wait = time_to_leave(k, self, touch.wait);
  GrainEvent next{self.time + wait, leaves_neighbourhood, 0, Meeting::touch};
  if (touch.wait <= wait && touch.partner >= 0)
    next.partner = touch.partner, next.partner_count = lines_[static_cast<std::size_t>(touch.partner)].count;
  if (half_width_[0] < never) {
    const GrainEvent wall = next_side_wall(self, {half_width_[0] - radius(i), half_width_[1] - radius(i)});
    if (wall.time < next.time) next = wall;
  }
  return next;
}

template <bool Periodic>
void CellLists<Periodic>::remember(int i, const GrainEvent& next) {
  own_[static_cast<std::size_t>(i)].partner = next.partner;
  own_[static_cast<std::size_t>(i)].partner_count = next.partner_count;
  queue_.schedule(i, next.time);
}

/// Fetches far ahead the grain's own lines, which say where to look later: at its neighbours and its partner,
/// and at last at the partner's neighbours.
template <bool Periodic>
void CellLists<Periodic>::prefetch(int i, int days) const {
  const std::size_t k = static_cast<std::size_t>(i);
  const std::int32_t partner = days == looks[0] ? no_partner : own_[k].partner;
  if (days == looks[2]) return partner >= 0 ? prefetch_neighbours(static_cast<std::size_t>(partner)) : void();
  if (days == looks[1]) prefetch_neighbours(k);
  if (days == looks[1] && partner < 0) return;
  const std::size_t whose = partner >= 0 ? static_cast<std::size_t>(partner) : k;
  queue_.prefetch(static_cast<int>(whose));
  lines_.prefetch(whose);
  __builtin_prefetch(&own_[whose]);
  for (std::size_t n = 0; n < list_room_; n += 16) __builtin_prefetch(&list_[whose * list_room_ + n]);
}

template <bool Periodic>
void CellLists<Periodic>::prefetch_neighbours(std::size_t i) const {
  for (std::size_t n = 0; n < own_[i].list_size; ++n)
    lines_.prefetch(static_cast<std::size_t>(list_[i * list_room_ + n]));
}

template <bool Periodic>
void CellLists<Periodic>::add_neighbour(std::size_t i, std::int32_t neighbour) {
  if (own_[i].list_size == list_room_) widen_lists();
  list(i)[own_[i].list_size++] = neighbour;
}

/// Lists are compared a chunk at a time, so that the compiler does it in vector lanes.
constexpr std::size_t chunk = 8;

/// Returns one more than the place of j in a list, which goes on with something else up to a whole number of
/// chunks; 0 when j is not in it. (The sum over all entries that are j of one more than their place.)
inline std::size_t one_beyond(const std::int32_t* list, std::size_t size, std::int32_t j) {
  std::int32_t found = 0;
  for (std::size_t first = 0; first < size; first += chunk)
    for (std::size_t n = first; n < first + chunk; ++n)
      found += list[n] == j ? static_cast<std::int32_t>(n) + 1 : 0;
  return static_cast<std::size_t>(found);
}

template <bool Periodic>
void CellLists<Periodic>::remove_neighbour(std::size_t i, std::int32_t neighbour) {
  const std::size_t found = one_beyond(list(i), own_[i].list_size, neighbour);
  EXPECT(found > 0);
  std::int32_t* const last = &list(i)[--own_[i].list_size];
  list(i)[found - 1] = *last;
  *last = static_cast<std::int32_t>(i);
}

template <bool Periodic>
void CellLists<Periodic>::widen_lists() {
  const std::size_t room = list_room_ + 8;
  AlignedVector<std::int32_t> wider(lines_.size() * room);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    std::fill_n(&wider[i * room], room, static_cast<std::int32_t>(i));
    std::copy_n(list(i), own_[i].list_size, &wider[i * room]);
  }
  list_ = std::move(wider);
  list_room_ = room;
}

template <bool Periodic>
void CellLists<Periodic>::leave_neighbourhood(int i, double now) {
  const std::size_t k = static_cast<std::size_t>(i);
  Flight3 here = flight(i);
  here.advance(now);
  move_to(i, here);
  GrainLine& line = lines_[k];
  if (Periodic) {  // keep coordinates small, so that rounding does not grow with time
    line.x = nearest(line.x, 0);
    line.y = nearest(line.y, 1);
    line.z = nearest(line.z, 2);
  }
  own_[k].centre = {line.x, line.y, line.z};
  centres_.take(i);
  const CentreCells::Place place = centres_.place(own_[k].centre);
  const std::size_t near = centres_.find(place, near_);
  centres_.put(i, place);
  near_.resize(std::max(near_.size(), near + chunk));
  std::fill_n(&near_[near], chunk, no_partner);
  // Most neighbours stay: only the lists of those that come or go are touched.
  for (std::size_t n = 0; n < own_[k].list_size; ++n)
    if (const std::int32_t j = list(k)[n]; one_beyond(near_.data(), near, j) == 0)
      remove_neighbour(static_cast<std::size_t>(j), i);
  for (std::size_t n = 0; n < near; ++n)
    if (one_beyond(list(k), own_[k].list_size, near_[n]) == 0)
      add_neighbour(static_cast<std::size_t>(near_[n]), i);
  while (list_room_ < near) widen_lists();
  std::fill_n(std::copy_n(near_.data(), near, list(k)), list_room_ - near, i);
  own_[k].list_size = static_cast<std::uint32_t>(near);
  predict(i);
}

template <bool Periodic>
double CellLists<Periodic>::bytes_per_grain() const {
  if (lines_.size() == 0) return 0;
  const double n = static_cast<double>(lines_.size());
  return sizeof(Own) + static_cast<double>(list_room_) * sizeof(std::int32_t) +
         static_cast<double>(lines_.bytes() + centres_.bytes() + queue_.bytes()) / n;
}

template class CellLists<true>;
template class CellLists<false>;

}  // namespace shakedown
