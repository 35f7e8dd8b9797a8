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
    : lines_(state.size()), radius_(state.radius), mass_(state.mass), centre_(state.size()), half_width_(plan.half_width), queue_(state.size()) {
  double largest = 0, smallest = never;
  for (const double r : radius_) largest = std::max(largest, r), smallest = std::min(smallest, r);
  equal_ = largest == smallest;
  largest_reach_ = 2 * largest;
  smallest_reach_ = 2 * smallest;
  shell_ = largest_reach_ * (plan.shell > 0 ? plan.shell : shell_for(plan.packing_fraction));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    extent_[axis] = plan.cell[axis];
    if (Periodic) shell_ = std::min(shell_, extent_[axis] / 3);
  }
  leeway_ = (shell_ - largest_reach_) / 2;
  EXPECT(leeway_ > 0);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double across = plan.cell[axis] / shell_;
    // Open axes get two spare cells, so that the two ends of the grains' room never share one through the wrap.
    cells_[axis] = Periodic ? std::max(3, static_cast<int>(across)) : std::max(3, static_cast<int>(std::ceil(across)) + 2);
    per_cell_[axis] = Periodic ? cells_[axis] / extent_[axis] : 1 / shell_;
    inverse_extent_[axis] = 1 / extent_[axis];
  }
  const std::size_t n = state.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &r = state.position[i], &v = state.velocity[i];
    lines_[i] = {r.x(), r.y(), r.z(), v.x(), v.y(), v.z(), 0.0, 0, 0};
    centre_[i] = {r.x(), r.y(), r.z()};
  }
  list_.assign(n * list_room_, 0);
  list_size_.assign(n, 0);
  cell_first_.assign(static_cast<std::size_t>(cells_[0]) * static_cast<std::size_t>(cells_[1]) * static_cast<std::size_t>(cells_[2]), -1);
  cell_next_.assign(n, -1);
  cell_previous_.assign(n, -1);
  cell_.assign(n, -1);
  event_.assign(n, {no_partner, 0});
  for (std::size_t i = 0; i < n; ++i) {
    find_neighbours(i, true);
    put_in_cell(i);
  }
}

template <bool Periodic>
void CellLists<Periodic>::set_flight(int i, const Flight3& flight) {
  move_to(i, flight);
  ++lines_[static_cast<std::size_t>(i)].count;
}

template <bool Periodic>
void CellLists<Periodic>::move_to(int i, const Flight3& flight) {
  Line& line = lines_[static_cast<std::size_t>(i)];
  line = {flight.x[0], flight.x[1], flight.x[2], flight.v[0], flight.v[1], flight.v[2], flight.time, line.count, 0};
}

template <bool Periodic>
GrainEvent CellLists<Periodic>::event(int i) const {
  const std::size_t k = static_cast<std::size_t>(i);
  return {queue_.time(i), event_[k].partner, event_[k].partner_count, Meeting::touch};
}

template <bool Periodic>
std::array<double, 3> CellLists<Periodic>::separation(const Flight3& a, const Flight3& b) const {
  return {nearest(b.x[0] - a.x[0], 0), nearest(b.x[1] - a.x[1], 1), nearest(b.x[2] - a.x[2], 2)};
}

template <bool Periodic>
double CellLists<Periodic>::time_to_leave(std::size_t i, const Flight3& flight) const {
  double a = 0, b = 0, c = -leeway_ * leeway_;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double off = nearest(flight.x[axis] - centre_[i][axis], axis), v = flight.v[axis];
    a += v * v;
    b += off * v;
    c += off * off;
  }
  if (a == 0) return never;
  if (c >= 0) return b >= 0 ? 0 : -2 * b / a;  // at the edge by rounding
  return (std::sqrt(b * b - a * c) - b) / a;
}

template <bool Periodic>
void CellLists<Periodic>::predict(int i) {
  const std::size_t k = static_cast<std::size_t>(i);
  const Flight3 self = flight(i);
  const double now = self.time;
  double earliest = time_to_leave(k, self);
  std::int32_t partner = leaves_neighbourhood;
  const double own_radius = radius_[k], equal_reach_squared = largest_reach_ * largest_reach_;
  const std::int32_t* list = &list_[k * list_room_];
  const std::size_t neighbours = list_size_[k];
  for (std::size_t n = 0; n < neighbours; ++n) __builtin_prefetch(&lines_[static_cast<std::size_t>(list[n])]);
  for (std::size_t n = 0; n < neighbours; ++n) {
    const std::size_t j = static_cast<std::size_t>(list[n]);
    const Line& other = lines_[j];
    const double flown = now - other.time;
    const double rx = nearest(other.x + other.vx * flown - self.x[0], 0), ry = nearest(other.y + other.vy * flown - self.x[1], 1),
                 rz = nearest(other.z + other.vz * flown - self.x[2], 2);
    const double wx = other.vx - self.v[0], wy = other.vy - self.v[1], wz = other.vz - self.v[2];
    const double b = rx * wx + ry * wy + rz * wz;
    if (b >= 0) continue;
    double reach_squared = equal_reach_squared;
    if (!equal_) reach_squared = (own_radius + radius_[j]) * (own_radius + radius_[j]);
    const double c = rx * rx + ry * ry + rz * rz - reach_squared;
    // t >= c / (-2 b): cannot beat the best so far, no need for the root.
    if (c > -2 * b * earliest) continue;
    const double touch = time_to_touch(wx * wx + wy * wy + wz * wz, b, c);
    smallest_room_ = std::min(smallest_room_, c);
    if (touch < earliest) {
      earliest = touch;
      partner = list[n];
    }
  }
  GrainEvent next{now + earliest, partner, partner >= 0 ? lines_[static_cast<std::size_t>(partner)].count : 0, Meeting::touch};
  if (half_width_[0] < never) {
    const GrainEvent wall = next_side_wall(self, {half_width_[0] - own_radius, half_width_[1] - own_radius});
    if (wall.time < next.time) next = wall;
  }
  event_[k] = {next.partner, next.partner_count};
  queue_.schedule(i, next.time);
}

template <bool Periodic>
void CellLists<Periodic>::predict_all() {
  double sum = 0, count = 0, now = 0;
  for (int i = 0; i < size(); ++i) {
    predict(i);
    now = lines_[static_cast<std::size_t>(i)].time;
    if (const double wait = queue_.time(i) - now; wait < never) sum += wait, ++count;
  }
  if (sum > 0) queue_.plan(now, count * count / sum);
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
  const std::size_t cell = cell_of(centre_[i]);
  cell_[i] = static_cast<std::int32_t>(cell);
  cell_previous_[i] = -1;
  cell_next_[i] = cell_first_[cell];
  if (cell_first_[cell] >= 0) cell_previous_[static_cast<std::size_t>(cell_first_[cell])] = static_cast<std::int32_t>(i);
  cell_first_[cell] = static_cast<std::int32_t>(i);
}

template <bool Periodic>
void CellLists<Periodic>::take_from_cell(std::size_t i) {
  if (cell_previous_[i] >= 0) cell_next_[static_cast<std::size_t>(cell_previous_[i])] = cell_next_[i];
  else cell_first_[static_cast<std::size_t>(cell_[i])] = cell_next_[i];
  if (cell_next_[i] >= 0) cell_previous_[static_cast<std::size_t>(cell_next_[i])] = cell_previous_[i];
}

template <bool Periodic>
void CellLists<Periodic>::find_neighbours(std::size_t i, bool both_ways) {
  const std::array<double, 3>& centre = centre_[i];
  const double shell_squared = shell_ * shell_;
  std::array<std::array<std::size_t, 3>, 3> around;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<long long>(cells_[axis]);
    const auto home = static_cast<long long>(std::floor(centre[axis] * per_cell_[axis]));
    for (long long step = -1; step <= 1; ++step)
      around[axis][static_cast<std::size_t>(step + 1)] = static_cast<std::size_t>((((home + step) % n) + n) % n);
  }
  const auto ny = static_cast<std::size_t>(cells_[1]), nz = static_cast<std::size_t>(cells_[2]);
  for (const std::size_t x : around[0])
    for (const std::size_t y : around[1])
      for (const std::size_t z : around[2])
        for (std::int32_t j = cell_first_[(x * ny + y) * nz + z]; j >= 0; j = cell_next_[static_cast<std::size_t>(j)]) {
          const std::array<double, 3>& other = centre_[static_cast<std::size_t>(j)];
          const double rx = nearest(other[0] - centre[0], 0), ry = nearest(other[1] - centre[1], 1), rz = nearest(other[2] - centre[2], 2);
          if (rx * rx + ry * ry + rz * rz >= shell_squared || static_cast<std::size_t>(j) == i) continue;
          add_neighbour(i, j);
          if (both_ways) add_neighbour(static_cast<std::size_t>(j), static_cast<std::int32_t>(i));
        }
}

template <bool Periodic>
void CellLists<Periodic>::add_neighbour(std::size_t i, std::int32_t neighbour) {
  if (list_size_[i] == list_room_) widen_lists();
  list_[i * list_room_ + list_size_[i]++] = neighbour;
}

template <bool Periodic>
void CellLists<Periodic>::remove_neighbour(std::size_t i, std::int32_t neighbour) {
  std::int32_t* list = &list_[i * list_room_];
  std::int32_t* found = std::find(list, list + list_size_[i], neighbour);
  EXPECT(found != list + list_size_[i]);
  *found = list[--list_size_[i]];
}

template <bool Periodic>
void CellLists<Periodic>::widen_lists() {
  const std::size_t room = list_room_ + 8;
  std::vector<std::int32_t> wider(lines_.size() * room, 0);
  for (std::size_t i = 0; i < lines_.size(); ++i)
    std::copy_n(&list_[i * list_room_], list_size_[i], &wider[i * room]);
  list_ = std::move(wider);
  list_room_ = room;
}

template <bool Periodic>
void CellLists<Periodic>::leave_neighbourhood(int i) {
  const std::size_t k = static_cast<std::size_t>(i);
  for (std::size_t n = 0; n < list_size_[k]; ++n)
    remove_neighbour(static_cast<std::size_t>(list_[k * list_room_ + n]), i);
  list_size_[k] = 0;
  Line& line = lines_[k];
  if (Periodic) {  // keep coordinates small, so that rounding does not grow with time
    line.x = nearest(line.x, 0);
    line.y = nearest(line.y, 1);
    line.z = nearest(line.z, 2);
  }
  take_from_cell(k);
  centre_[k] = {line.x, line.y, line.z};
  find_neighbours(k, true);
  put_in_cell(k);
}

template <bool Periodic>
GrainSums CellLists<Periodic>::sums(double t) const {
  GrainSums sums;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const Line& line = lines_[i];
    const double m = mass_[i];
    sums.mass += m;
    sums.kinetic += m / 2 * (line.vx * line.vx + line.vy * line.vy + line.vz * line.vz);
    sums.moment += m * (line.x + line.vx * (t - line.time));
    sums.momentum[0] += m * line.vx;
    sums.momentum[1] += m * line.vy;
    sums.momentum[2] += m * line.vz;
  }
  return sums;
}

template <bool Periodic>
double CellLists<Periodic>::bytes_per_grain() const {
  if (lines_.empty()) return 0;
  const double n = static_cast<double>(lines_.size());
  const double arrays = sizeof(Line) + sizeof(Event) + 3 * sizeof(double) + 2 * sizeof(double) + sizeof(std::uint16_t) + 3 * sizeof(std::int32_t);
  return arrays + static_cast<double>(list_room_) * sizeof(std::int32_t) +
         static_cast<double>(cell_first_.size() * sizeof(std::int32_t) + queue_.bytes()) / n;
}

template class CellLists<true>;
template class CellLists<false>;

}  // namespace shakedown
