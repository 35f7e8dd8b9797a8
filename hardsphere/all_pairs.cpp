// SPDX-License-Identifier: MIT
#include "all_pairs.hpp"

namespace shakedown {

AllPairs::AllPairs(const State& state, std::array<double, 2> half_width, double attraction_range)
    : size_(state.size()), padded_size_(std::max(padded(state.size()), lane_count)), half_width_(half_width), range_(attraction_range) {
  for (AlignedVector<double>* array : {&x_, &y_, &z_, &vx_, &vy_, &vz_, &time_, &radius_, &mass_}) array->assign(padded_size_, 0.0);
  event_time_.assign(padded_size_, never);
  partner_.assign(padded_size_, no_partner);
  partner_count_.assign(padded_size_, 0);
  count_.assign(padded_size_, 0);
  meeting_.assign(padded_size_, Meeting::touch);
  for (std::size_t i = 0; i < padded_size_; ++i) {
    if (i >= size_) {  // fills the last lanes: far away, at rest, never met
      x_[i] = 1e9 * static_cast<double>(i);
      continue;
    }
    x_[i] = state.position[i].x();
    y_[i] = state.position[i].y();
    z_[i] = state.position[i].z();
    vx_[i] = state.velocity[i].x();
    vy_[i] = state.velocity[i].y();
    vz_[i] = state.velocity[i].z();
    radius_[i] = state.radius[i];
    mass_[i] = state.mass[i];
  }
  if (range_ == 0) return;
  bond_.assign(size_ * padded_size_, 0.0);
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if ((state.position[i] - state.position[j]).norm() < state.radius[i] + state.radius[j] + range_)
        set_bond(static_cast<int>(i), static_cast<int>(j), true);
}

void AllPairs::set_bond(int i, int j, bool bond) {
  const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
  bond_[a * padded_size_ + b] = bond_[b * padded_size_ + a] = bond ? 1.0 : 0.0;
}

int AllPairs::bonds() const {
  double sum = 0;
  for (const double bond : bond_) sum += bond;
  return static_cast<int>(sum / 2);
}

Flight3 AllPairs::flight(int i) const {
  const std::size_t k = static_cast<std::size_t>(i);
  return {{x_[k], y_[k], z_[k]}, {vx_[k], vy_[k], vz_[k]}, time_[k]};
}

void AllPairs::set_flight(int i, const Flight3& flight) {
  move_to(i, flight);
  ++count_[static_cast<std::size_t>(i)];
}

void AllPairs::move_to(int i, const Flight3& flight) {
  const std::size_t k = static_cast<std::size_t>(i);
  x_[k] = flight.x[0];
  y_[k] = flight.x[1];
  z_[k] = flight.x[2];
  vx_[k] = flight.v[0];
  vy_[k] = flight.v[1];
  vz_[k] = flight.v[2];
  time_[k] = flight.time;
}

template <int K, bool Well>
void AllPairs::predict_grains(const std::array<int, K>& who) {
  // The grains of an impact share every load of the others' states.
  std::array<Lanes, K> x, y, z, vx, vy, vz, radius, self, best, best_index;
  const double now = time_[static_cast<std::size_t>(who[0])];
  for (std::size_t g = 0; g < K; ++g) {
    const std::size_t k = static_cast<std::size_t>(who[g]);
    x[g] = x_[k], y[g] = y_[k], z[g] = z_[k];
    vx[g] = vx_[k], vy[g] = vy_[k], vz[g] = vz_[k];
    radius[g] = radius_[k];
    self[g] = static_cast<double>(k);
    best[g] = never;
    best_index[g] = -1.0;
  }
  Lanes index = lane_index(), smallest_room(smallest_room_);
  const Lanes zero(0.0);
  for (std::size_t j = 0; j < padded_size_; j += lane_count, index += static_cast<double>(lane_count)) {
    const Lanes flown = Lanes(now) - load(time_, j);
    const Lanes ux = load(vx_, j), uy = load(vy_, j), uz = load(vz_, j), other_radius = load(radius_, j);
    const Lanes px = load(x_, j) + ux * flown, py = load(y_, j) + uy * flown, pz = load(z_, j) + uz * flown;
    for (std::size_t g = 0; g < K; ++g) {
      const Lanes rx = px - x[g], ry = py - y[g], rz = pz - z[g], wx = ux - vx[g], wy = uy - vy[g], wz = uz - vz[g];
      const Lanes reach = other_radius + radius[g];
      const Lanes b = rx * wx + ry * wy + rz * wz, c = rx * rx + ry * ry + rz * rz - reach * reach;
      // t >= c / (-2 b): what cannot beat the best so far needs no root. The grain itself has b = 0.
      const auto may_be_first = b < zero && c <= Lanes(-2.0) * b * best[g];
      if constexpr (!Well)
        if (simd::none_of(may_be_first)) continue;
      simd::where(may_be_first, smallest_room) = simd::min(smallest_room, c);
      const Lanes a = wx * wx + wy * wy + wz * wz, discriminant = b * b - a * c;
      auto meets = b < zero && discriminant >= zero;
      if constexpr (!Well) meets = meets && may_be_first;
      Lanes touch;
      if constexpr (Well) {
        // Outside the well its edge is met first; inside, a grain that does not touch comes to the edge from within.
        const Lanes edge = reach + Lanes(range_), c_edge = rx * rx + ry * ry + rz * rz - edge * edge, d_edge = b * b - a * c_edge;
        const auto inside = load(bond_, static_cast<std::size_t>(who[g]) * padded_size_ + j) > Lanes(0.5);
        const Lanes root_edge = simd::sqrt(simd::max(d_edge, zero));
        Lanes inner = (root_edge - b) / a;
        simd::where(meets, inner) = simd::max(c, zero) / (simd::sqrt(simd::max(discriminant, zero)) - b);
        touch = simd::max(c_edge, zero) / (root_edge - b);
        simd::where(inside, touch) = inner;
        meets = (inside && a > zero) || (!inside && b < zero && d_edge >= zero);
        meets = meets && index != self[g];
        if (simd::none_of(meets)) continue;
      } else {
        if (simd::none_of(meets)) continue;
        touch = simd::max(c, zero) / (simd::sqrt(simd::max(discriminant, zero)) - b);
      }
      const auto sooner = meets && touch < best[g];
      simd::where(sooner, best[g]) = touch;
      simd::where(sooner, best_index[g]) = index;
    }
  }
  smallest_room_ = simd::hmin(smallest_room);
  next_.grain = -1;
  for (std::size_t g = 0; g < K; ++g) {
    const std::size_t k = static_cast<std::size_t>(who[g]);
    GrainEvent next = next_side_wall(flight(who[g]), side_room(who[g]));
    const double earliest = simd::hmin(best[g]);
    if (earliest < never && now + earliest <= next.time) {
      Lanes index_of_best(never);
      simd::where(best[g] == Lanes(earliest), index_of_best) = best_index[g];
      next.time = now + earliest;
      next.partner = static_cast<std::int32_t>(simd::hmin(index_of_best));
      next.partner_count = count_[static_cast<std::size_t>(next.partner)];
      if constexpr (Well) next.meeting = meeting_of(who[g], next.partner);
    }
    event_time_[k] = next.time;
    partner_[k] = next.partner;
    partner_count_[k] = next.partner_count;
    meeting_[k] = next.meeting;
  }
}

/// What two grains in or out of each other's well meet next.
Meeting AllPairs::meeting_of(int i, int j) const {
  if (bond_[static_cast<std::size_t>(i) * padded_size_ + static_cast<std::size_t>(j)] == 0) return Meeting::capture;
  const Flight3 self = flight(i);
  Flight3 other = flight(j);
  other.advance(self.time);
  double a = 0, b = 0, c = -(radius(i) + radius(j)) * (radius(i) + radius(j));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double r = other.x[axis] - self.x[axis], w = other.v[axis] - self.v[axis];
    a += w * w;
    b += r * w;
    c += r * r;
  }
  return b < 0 && b * b - a * c >= 0 ? Meeting::touch : Meeting::escape;
}

void AllPairs::predict(int i) {
  if (range_ > 0) predict_grains<1, true>({i});
  else predict_grains<1, false>({i});
}
void AllPairs::predict(int i, int j) {
  if (range_ > 0) predict_grains<2, true>({i, j});
  else predict_grains<2, false>({i, j});
}

void AllPairs::predict_all() {
  for (int i = 0; i < size(); ++i) predict(i);
}

GrainSums AllPairs::sums(double t) const {
  Lanes mass(0.0), kinetic(0.0), moment(0.0), px(0.0), py(0.0), pz(0.0);
  for (std::size_t j = 0; j < padded_size_; j += lane_count) {
    const Lanes m = load(mass_, j), vx = load(vx_, j), vy = load(vy_, j), vz = load(vz_, j);
    mass += m;
    kinetic += m * (vx * vx + vy * vy + vz * vz);
    moment += m * (load(x_, j) + vx * (Lanes(t) - load(time_, j)));
    px += m * vx;
    py += m * vy;
    pz += m * vz;
  }
  return {simd::reduce(mass), simd::reduce(kinetic) / 2, simd::reduce(moment), {simd::reduce(px), simd::reduce(py), simd::reduce(pz)}};
}

double AllPairs::deepest_overlap() const {
  if (size_ == 0) return 0;
  double reach = never;
  for (std::size_t i = 0; i < size_; ++i) reach = std::min(reach, 2 * radius_[i]);
  return -smallest_room_ / (2 * reach);
}

}  // namespace shakedown
