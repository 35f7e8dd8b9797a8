// SPDX-License-Identifier: MIT
#include "cell_lists.hpp"

#include <algorithm>

#include "errors.hpp"

namespace shakedown {

namespace {

/// Diameters: wide shells save renewals where grains fly far between impacts, narrow ones save pair tests where they do not.
double shell_for(double packing_fraction) {
  return std::clamp(2.35 - 1.75 * packing_fraction, 1.4, 2.6);
}

}  // namespace

template <bool Periodic>
CellLists<Periodic>::CellLists(const State& state, const CellListsPlan& plan)
    : ScheduledGrains(state, plan.cell), own_(state.size()), half_width_(plan.half_width) {
  shell_ = lines_.largest_reach() * (plan.shell > 0 ? plan.shell : shell_for(plan.packing_fraction));
  if (Periodic)
    for (const double extent : plan.cell) shell_ = std::min(shell_, extent / 3);
  leeway_ = (shell_ - lines_.largest_reach()) / 2;
  EXPECT(leeway_ > 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double across = plan.cell[axis] / shell_;
    // Open axes get two spare cells, so that the two ends of the grains' room never share one through the wrap.
    cells_[axis] = Periodic ? std::max(3, static_cast<int>(across)) : std::max(3, static_cast<int>(std::ceil(across)) + 2);
    per_cell_[axis] = Periodic ? cells_[axis] / plan.cell[axis] : 1 / shell_;
  }
  const std::size_t n = state.size();
  list_.resize(n * list_room_);
  for (std::size_t i = 0; i < n; ++i) {
    own_[i].centre = lines_.flight(i).x;
    std::fill_n(list(i), list_room_, static_cast<std::int32_t>(i));
  }
  cell_first_.assign(static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(cells_[2]), -1);
  for (std::size_t i = 0; i < n; ++i) {
    find_neighbours(i);
    for (const std::int32_t j : near_) {
      add_neighbour(i, j);
      add_neighbour(static_cast<std::size_t>(j), static_cast<std::int32_t>(i));
    }
    put_in_cell(i);
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

/// When a grain is `leeway` away from the centre of its list, if that is within `wait`; or `wait`. Mostly it is not, and a look at the
/// place where it would be then spares the root (9 % at packing fraction 0.5). Coordinates change by a period only together with the
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
void CellLists<Periodic>::predict(int i) {
  const std::size_t k = static_cast<std::size_t>(i);
  const Flight3 self = flight(i);
  const GrainLines::Touch touch = lines_.first_touch<Periodic>(k, self, list(k), own_[k].list_size, never);
  const double wait = time_to_leave(k, self, touch.wait);
  GrainEvent next{self.time + wait, leaves_neighbourhood, 0, Meeting::touch};
  if (touch.wait <= wait && touch.partner >= 0) next.partner = touch.partner, next.partner_count = lines_[static_cast<std::size_t>(touch.partner)].count;
  if (half_width_[0] < never) {
    const GrainEvent wall = next_side_wall(self, {half_width_[0] - radius(i), half_width_[1] - radius(i)});
    if (wall.time < next.time) next = wall;
  }
  own_[k].partner = next.partner;
  own_[k].partner_count = next.partner_count;
  queue_.schedule(i, next.time);
}

template <bool Periodic>
std::size_t CellLists<Periodic>::cell_of(const std::array<double, 3>& centre) const {
  std::size_t index = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<long long>(cells_[axis]);
    long long cell = static_cast<long long>(std::floor(centre[axis] * per_cell_[axis])) % n;
    if (cell < 0) cell += n;
    index = index * static_cast<std::size_t>(n) + static_cast<std::size_t>(cell);
  }
  return index;
}

template <bool Periodic>
void CellLists<Periodic>::put_in_cell(std::size_t i) {
  const std::size_t cell = cell_of(own_[i].centre);
  own_[i].cell = static_cast<std::int32_t>(cell);
  own_[i].previous_in_cell = -1;
  own_[i].next_in_cell = cell_first_[cell];
  if (cell_first_[cell] >= 0) own_[static_cast<std::size_t>(cell_first_[cell])].previous_in_cell = static_cast<std::int32_t>(i);
  cell_first_[cell] = static_cast<std::int32_t>(i);
}

template <bool Periodic>
void CellLists<Periodic>::take_from_cell(std::size_t i) {
  const Own& own = own_[i];
  if (own.previous_in_cell >= 0) own_[static_cast<std::size_t>(own.previous_in_cell)].next_in_cell = own.next_in_cell;
  else cell_first_[static_cast<std::size_t>(own.cell)] = own.next_in_cell;
  if (own.next_in_cell >= 0) own_[static_cast<std::size_t>(own.next_in_cell)].previous_in_cell = own.previous_in_cell;
}

/// Far ahead the grain's own lines, which say where to look later: at its partner and its neighbours.
template <bool Periodic>
void CellLists<Periodic>::prefetch(int i, int days) const {
  const std::size_t k = static_cast<std::size_t>(i);
  if (days == CalendarQueue::far_ahead) {
    queue_.prefetch(i);
    lines_.prefetch(k);
    __builtin_prefetch(&own_[k]);
    for (std::size_t n = 0; n < list_room_; n += 16) __builtin_prefetch(&list_[k * list_room_ + n]);
    return;
  }
  if (const std::int32_t partner = own_[k].partner; partner >= 0) {
    const auto j = static_cast<std::size_t>(partner);
    queue_.prefetch(partner);
    __builtin_prefetch(&own_[j]);
    for (std::size_t n = 0; n < list_room_; n += 16) __builtin_prefetch(&list_[j * list_room_ + n]);
  }
  for (std::size_t n = 0; n < own_[k].list_size; ++n) lines_.prefetch(static_cast<std::size_t>(list_[k * list_room_ + n]));
}

/// Into near_: the grains whose list centres lie within the shell of grain i's.
template <bool Periodic>
void CellLists<Periodic>::find_neighbours(std::size_t i) {
  const std::array<double, 3> centre = own_[i].centre;
  const double shell_squared = shell_ * shell_;
  std::array<std::array<std::size_t, 3>, 3> around;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<long long>(cells_[axis]);
    const auto home = static_cast<long long>(std::floor(centre[axis] * per_cell_[axis]));
    for (long long step = -1; step <= 1; ++step)
      around[axis][static_cast<std::size_t>(step + 1)] = static_cast<std::size_t>((((home + step) % n) + n) % n);
  }
  const auto ny = static_cast<std::size_t>(cells_[1]), nz = static_cast<std::size_t>(cells_[2]);
  near_.clear();
  for (const std::size_t x : around[0])
    for (const std::size_t y : around[1])
      for (const std::size_t z : around[2])
        for (std::int32_t j = cell_first_[(x * ny + y) * nz + z]; j >= 0; j = own_[static_cast<std::size_t>(j)].next_in_cell) {
          const std::array<double, 3>& other = own_[static_cast<std::size_t>(j)].centre;
          const double rx = nearest(other[0] - centre[0], 0), ry = nearest(other[1] - centre[1], 1), rz = nearest(other[2] - centre[2], 2);
          if (rx * rx + ry * ry + rz * rz < shell_squared && static_cast<std::size_t>(j) != i) near_.push_back(j);
        }
}

template <bool Periodic>
void CellLists<Periodic>::add_neighbour(std::size_t i, std::int32_t neighbour) {
  if (own_[i].list_size == list_room_) widen_lists();
  list(i)[own_[i].list_size++] = neighbour;
}

template <bool Periodic>
void CellLists<Periodic>::remove_neighbour(std::size_t i, std::int32_t neighbour) {
  std::int32_t *first = list(i), *last = first + own_[i].list_size;
  std::int32_t* found = std::find(first, last, neighbour);
  EXPECT(found != last);
  *found = *--last;
  *last = static_cast<std::int32_t>(i);
  --own_[i].list_size;
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

/// Whether j is among them; without a branch, so that the compiler compares in vector lanes.
inline bool contains(const std::int32_t* list, std::size_t size, std::int32_t j) {
  int found = 0;
  for (std::size_t n = 0; n < size; ++n) found |= list[n] == j;
  return found != 0;
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
  take_from_cell(k);
  own_[k].centre = {line.x, line.y, line.z};
  find_neighbours(k);
  put_in_cell(k);
  // Most neighbours stay: only the lists of those that come or go are touched.
  old_list_.assign(list(k), list(k) + own_[k].list_size);
  for (const std::int32_t j : old_list_)
    if (!contains(near_.data(), near_.size(), j)) remove_neighbour(static_cast<std::size_t>(j), i);
  for (const std::int32_t j : near_)
    if (!contains(old_list_.data(), old_list_.size(), j)) add_neighbour(static_cast<std::size_t>(j), i);
  std::fill_n(list(k), own_[k].list_size, i);
  own_[k].list_size = 0;
  for (const std::int32_t j : near_) add_neighbour(k, j);
  predict(i);
}

template <bool Periodic>
double CellLists<Periodic>::bytes_per_grain() const {
  if (lines_.size() == 0) return 0;
  const double n = static_cast<double>(lines_.size());
  const double arrays = GrainLines::bytes_per_grain() + sizeof(Own);
  return arrays + static_cast<double>(list_room_) * sizeof(std::int32_t) +
         static_cast<double>(cell_first_.size() * sizeof(std::int32_t) + queue_.bytes()) / n;
}

template class CellLists<true>;
template class CellLists<false>;

}  // namespace shakedown
