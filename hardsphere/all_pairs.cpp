// SPDX-License-Identifier: MIT
#include "all_pairs.hpp"

namespace shakedown {

namespace {

constexpr std::size_t strand_count = 8;
using Strands = std::array<double, strand_count>;
double folded(const Strands& s) { return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7])); }

}  // namespace

AllPairs::AllPairs(const State& state, std::array<double, 2> half_width, double attraction_range)
    : size_(state.size()),
      padded_size_(std::max(padded(state.size()), lane_count)),
      half_width_(half_width),
      range_(attraction_range) {
  for (AlignedVector<double>* array : {&x_, &y_, &z_, &vx_, &vy_, &vz_, &time_, &radius_, &mass_})
    array->assign(padded_size_, 0.0);
  event_time_.assign(padded_size_, never);
  partner_.assign(padded_size_, no_partner);
  partner_count_.assign(padded_size_, 0);
  count_.assign(padded_size_, 0);
  meeting_.assign(padded_size_, Meeting::touch);
  for (std::size_t i = 0; i < padded_size_; ++i) {
    if (i >= size_) {  // fills the last lanes: so far away that the square has no end, never met
      x_[i] = 1e200;
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
  sums_time_ = never;
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

template <int K>
struct AllPairs::Selves {
  std::array<Lanes, K> x, y, z, vx, vy, vz, radius;
  Lanes now;

  Selves(const AllPairs& all, const std::array<int, K>& who)
      : now(all.time_[static_cast<std::size_t>(who[0])]) {
    for (std::size_t g = 0; g < K; ++g) {
      const std::size_t k = static_cast<std::size_t>(who[g]);
      x[g] = all.x_[k], y[g] = all.y_[k], z[g] = all.z_[k];
      vx[g] = all.vx_[k], vy[g] = all.vy_[k], vz[g] = all.vz_[k];
      radius[g] = all.radius_[k];
    }
  }
  /// A vector of other grains, of which all share every load, and how each sees it.
  struct Others {
    Lanes x, y, z, vx, vy, vz, radius;
    Others(const AllPairs& all, std::size_t j, const Lanes& now)
        : vx(load(all.vx_, j)), vy(load(all.vy_, j)), vz(load(all.vz_, j)), radius(load(all.radius_, j)) {
      const Lanes flown = now - load(all.time_, j);
      x = load(all.x_, j) + vx * flown, y = load(all.y_, j) + vy * flown, z = load(all.z_, j) + vz * flown;
    }
  };
  /// b = r.w, r^2, a = w^2 of separation r and relative velocity w.
  struct Approach {
    Lanes a, b, reach, apart_squared, c, discriminant;
  };
  Approach approach(std::size_t g, const Others& others) const {
    const Lanes rx = others.x - x[g], ry = others.y - y[g], rz = others.z - z[g];
    const Lanes wx = others.vx - vx[g], wy = others.vy - vy[g], wz = others.vz - vz[g];
    const Lanes reach = others.radius + radius[g], b = rx * wx + ry * wy + rz * wz,
                apart_squared = rx * rx + ry * ry + rz * rz;
    const Lanes c = apart_squared - reach * reach, a = wx * wx + wy * wy + wz * wz;
    return {a, b, reach, apart_squared, c, b * b - a * c};
  }
};

template <int K, bool Well>
std::array<AllPairs::Touch, K> AllPairs::first_touches(const std::array<int, K>& who) {
  const Selves<K> selves(*this, who);
  std::array<Lanes, K> self, best, best_index;
  for (std::size_t g = 0; g < K; ++g)
    self[g] = static_cast<double>(who[g]), best[g] = never, best_index[g] = -1.0;
  Lanes index = lane_index(), smallest_room(smallest_room_);
  const Lanes zero(0.0);
  for (std::size_t j = 0; j < padded_size_; j += lane_count, index += static_cast<double>(lane_count)) {
    const typename Selves<K>::Others others(*this, j, selves.now);
    for (std::size_t g = 0; g < K; ++g) {
      const auto [a, b, reach, apart_squared, c, discriminant] = selves.approach(g, others);
      // t >= c / (-2 b): what cannot beat the best so far needs no root. The grain itself has b = 0.
      const auto may_be_first = b < zero && c <= Lanes(-2.0) * b * best[g];
      if constexpr (!Well)
        if (simd::none_of(may_be_first)) continue;
      simd::where(may_be_first, smallest_room) = simd::min(smallest_room, c);
      auto meets = b < zero && discriminant >= zero;
      if constexpr (!Well) meets = meets && may_be_first;
      Lanes touch;
      if constexpr (Well) {
        // Outside the well its edge is met first; inside, a grain that does not touch comes to the edge from
        // within.
        const Lanes edge = reach + Lanes(range_), c_edge = apart_squared - edge * edge,
                    d_edge = b * b - a * c_edge;
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
  std::array<Touch, K> touches;
  for (std::size_t g = 0; g < K; ++g) {
    const double earliest = simd::hmin(best[g]);
    if (!(earliest < never)) continue;
    Lanes index_of_best(never);
    simd::where(best[g] == Lanes(earliest), index_of_best) = best_index[g];
    touches[g] = {earliest, static_cast<std::int32_t>(simd::hmin(index_of_best))};
  }
  return touches;
}

/// The same time that a lane of the vectorised search finds.
double AllPairs::wait_for_touch(int i, int j) const {
  const Flight3 self = flight(i);
  Flight3 other = flight(j);
  other.advance(self.time);
  const double rx = other.x[0] - self.x[0], ry = other.x[1] - self.x[1], rz = other.x[2] - self.x[2];
  const double wx = other.v[0] - self.v[0], wy = other.v[1] - self.v[1], wz = other.v[2] - self.v[2];
  const double reach = radius(j) + radius(i), b = rx * wx + ry * wy + rz * wz,
               c = rx * rx + ry * ry + rz * rz - reach * reach;
  return std::max(c, 0.0) / (std::sqrt(b * b - (wx * wx + wy * wy + wz * wz) * c) - b);
}

/// Which grain is first is told by estimates, and the root taken of that one alone. Where they cannot tell
/// (touches within 2^-11 of each other), or spheres overlap deeper than any before, everything is done in
/// full; so the answer is the same to the last bit. No branches: whether any of eight grains may come first
/// is as good as random.
template <int K>
std::array<AllPairs::Touch, K> AllPairs::estimated_touches(const std::array<int, K>& who) {
  constexpr double above = 1 + 0x1p-11, below = 1 - 0x1p-11, tiny = 1e-300;
  const Selves<K> selves(*this, who);
  std::array<Lanes, K> best, best_index;
  best.fill(never);
  best_index.fill(-1.0);
  Lanes index = lane_index();
  const Lanes zero(0.0), smallest_room(smallest_room_);
  Lanes::mask_type doubt(false);
  for (std::size_t j = 0; j < padded_size_; j += lane_count, index += static_cast<double>(lane_count)) {
    const typename Selves<K>::Others others(*this, j, selves.now);
    for (std::size_t g = 0; g < K; ++g) {
      const auto [a, b, reach, apart_squared, c, discriminant] = selves.approach(g, others);
      const Lanes root = discriminant * inverse_root_estimate(simd::max(discriminant, Lanes(tiny)));
      const Lanes touch = simd::max(c, zero) * inverse_estimate(root - b);
      const auto meets = b < zero && discriminant >= zero;
      doubt = doubt || (meets && (c < smallest_room ||
                                  (touch > Lanes(below) * best[g] && touch < Lanes(above) * best[g])));
      const auto sooner = meets && touch < best[g];
      simd::where(sooner, best[g]) = touch;
      simd::where(sooner, best_index[g]) = index;
    }
  }
  if (simd::any_of(doubt)) [[unlikely]]
    return first_touches<K, false>(who);
  std::array<Touch, K> touches;
  for (std::size_t g = 0; g < K; ++g) {
    const double earliest = simd::hmin(best[g]);
    if (!(earliest < never)) continue;
    const auto first = best[g] <= Lanes(above * earliest);
    if (simd::popcount(first) != 1) [[unlikely]]
      return first_touches<K, false>(who);
    const int partner = static_cast<int>(
        static_cast<double>(best_index[g][static_cast<std::size_t>(simd::find_first_set(first))]));
    touches[g] = {wait_for_touch(who[g], partner), partner};
  }
  return touches;
}

template <int K, bool Well>
void AllPairs::predict_grains(const std::array<int, K>& who) {
  const double now = time_[static_cast<std::size_t>(who[0])];
  std::array<Touch, K> touches;
  if constexpr (Well || !has_estimates)
    touches = first_touches<K, Well>(who);
  else
    touches = estimated_touches<K>(who);
  next_.grain = -1;
  for (std::size_t g = 0; g < K; ++g) {
    const std::size_t k = static_cast<std::size_t>(who[g]);
    GrainEvent next = next_side_wall(flight(who[g]), side_room(who[g]));
    const double touch = now + touches[g].wait;
    const bool is_pair = touches[g].partner >= 0 && touch <= next.time;
    next.time = is_pair ? touch : next.time;
    next.partner = is_pair ? touches[g].partner : next.partner;
    // unused where there is none
    next.partner_count = count_[static_cast<std::size_t>(std::max(touches[g].partner, 0))];
    if constexpr (Well)
      if (is_pair) next.meeting = meeting_of(who[g], next.partner);
    event_time_[k] = next.time;
    partner_[k] = next.partner;
    partner_count_[k] = next.partner_count;
    meeting_[k] = next.meeting;
  }
}

/// What two grains in or out of each other's well meet next.
Meeting AllPairs::meeting_of(int i, int j) const {
  if (bond_[static_cast<std::size_t>(i) * padded_size_ + static_cast<std::size_t>(j)] == 0)
    return Meeting::capture;
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
  if (range_ > 0)
    predict_grains<1, true>({i});
  else
    predict_grains<1, false>({i});
}
void AllPairs::predict(int i, int j) {
  if (range_ > 0)
    predict_grains<2, true>({i, j});
  else
    predict_grains<2, false>({i, j});
}

void AllPairs::predict_all() {
  for (int i = 0; i < size(); ++i) predict(i);
}

GrainSums AllPairs::sums(double t) {
  if (sums_time_ < never) {
    GrainSums later = sums_;
    later.moment += sums_.momentum[0] * (t - sums_time_);
    return later;
  }
  // Eight sums of every eighth grain, and then theirs, so that rounding does not depend on the machine's
  // width.
  Strands mass{}, kinetic{}, moment{}, px{}, py{}, pz{};
  for (std::size_t j = 0; j < size_; j += strand_count)
    for (std::size_t s = 0; s < std::min(strand_count, size_ - j); ++s) {
      const std::size_t k = j + s;
      const double m = mass_[k], vx = vx_[k], vy = vy_[k], vz = vz_[k];
      mass[s] += m;
      kinetic[s] += m * (vx * vx + vy * vy + vz * vz);
      moment[s] += m * (x_[k] + vx * (t - time_[k]));
      px[s] += m * vx;
      py[s] += m * vy;
      pz[s] += m * vz;
    }
  sums_ = {folded(mass), folded(kinetic) / 2, folded(moment), {folded(px), folded(py), folded(pz)}};
  sums_time_ = t;
  return sums_;
}

double AllPairs::deepest_overlap() const {
  if (size_ == 0) return 0;
  double reach = never;
  for (std::size_t i = 0; i < size_; ++i) reach = std::min(reach, 2 * radius_[i]);
  return -smallest_room_ / (2 * reach);
}

}  // namespace shakedown
