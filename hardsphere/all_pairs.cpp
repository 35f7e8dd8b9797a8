// SPDX-License-Identifier: MIT
#include "all_pairs.hpp"

namespace shakedown {

namespace {

constexpr std::size_t strand_count = 8;
using Strands = std::array<double, strand_count>;
double folded(const Strands& s) { return ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7])); }

/// Two grains of separation r and relative velocity w: b = r.w, a = w^2, c = r^2 - reach^2.
template <class L>
struct Approach {
  L a, b, reach, apart_squared, c, discriminant;
};

/// What two grains with a square well of `range` come to next: outside it the edge, inside either each other
/// or the edge from within. The wait is a quotient of a root and |b|, never of a difference that cancels.
template <class L>
class InWell {
 public:
  [[gnu::always_inline]] InWell(const Approach<L>& pair, double range, const typename L::mask_type& inside)
      : a_(pair.a), size_of_b_(simd::abs(pair.b)) {
    const L zero = 0.0, edge = pair.reach + L(range), beyond = pair.apart_squared - edge * edge;
    const auto approach = pair.b < zero;
    touch_ = inside && approach && pair.discriminant >= zero;
    squared_ = pair.b * pair.b - pair.a * beyond;
    meets_ = (inside && pair.a > zero) || (!inside && approach && squared_ >= zero);
    far_side_ = inside && !touch_ && pair.b <= zero;
    room_ = beyond;
    simd::where(inside, room_) = -beyond;
    simd::where(touch_, room_) = pair.c;
    simd::where(touch_, squared_) = pair.discriminant;
  }
  const typename L::mask_type& meets() const { return meets_; }
  const typename L::mask_type& may_touch() const { return touch_; }  ///< each other, before the edge
  const L& squared_root() const { return squared_; }
  /// Numerator and denominator of the wait, from the root.
  [[gnu::always_inline]] std::array<L, 2> quotient(const L& root) const {
    const L sum = root + size_of_b_;
    std::array<L, 2> parts{simd::max(room_, L(0.0)), sum};
    simd::where(far_side_, parts[0]) = sum;
    simd::where(far_side_, parts[1]) = a_;
    return parts;
  }

 private:
  L a_, size_of_b_, squared_, room_;
  typename L::mask_type meets_, touch_, far_side_;
};

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
  Approach<Lanes> approach(std::size_t g, const Others& others) const {
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
  std::array<Lanes, K> best, best_index;
  best.fill(never);
  best_index.fill(-1.0);
  Lanes index = lane_index(), smallest_room(smallest_room_);
  const Lanes zero(0.0);
  for (std::size_t j = 0; j < padded_size_; j += lane_count, index += static_cast<double>(lane_count)) {
    const typename Selves<K>::Others others(*this, j, selves.now);
    for (std::size_t g = 0; g < K; ++g) {
      const Approach<Lanes> pair = selves.approach(g, others);
      const auto& [a, b, reach, apart_squared, c, discriminant] = pair;
      // t >= c / (-2 b): what cannot beat the best so far needs no root. The grain itself has b = 0.
      const auto may_be_first = b < zero && c <= Lanes(-2.0) * b * best[g];
      if constexpr (!Well)
        if (simd::none_of(may_be_first)) continue;
      simd::where(may_be_first, smallest_room) = simd::min(smallest_room, c);
      Lanes touch;
      Lanes::mask_type meets;
      if constexpr (Well) {
        const InWell<Lanes> well(pair, range_, bonds(who[g], j));
        meets = well.meets();
        if (simd::none_of(meets)) continue;
        const auto [over, under] = well.quotient(simd::sqrt(simd::max(well.squared_root(), zero)));
        touch = over / under;
      } else {
        meets = may_be_first && discriminant >= zero;
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
    const auto partner = static_cast<std::int32_t>(simd::hmin(index_of_best));
    touches[g] = Well ? touch_of<Well>(who[g], partner) : Touch{earliest, partner};
  }
  return touches;
}

/// Returns the touch of i with j, the same to the last bit as a lane of the vectorised search finds.
template <bool Well>
AllPairs::Touch AllPairs::touch_of(int i, int j) const {
  const Flight3 self = flight(i);
  Flight3 other = flight(j);
  other.advance(self.time);
  const double rx = other.x[0] - self.x[0], ry = other.x[1] - self.x[1], rz = other.x[2] - self.x[2];
  const double wx = other.v[0] - self.v[0], wy = other.v[1] - self.v[1], wz = other.v[2] - self.v[2];
  const double reach = radius(j) + radius(i), b = rx * wx + ry * wy + rz * wz,
               apart_squared = rx * rx + ry * ry + rz * rz;
  const double c = apart_squared - reach * reach, a = wx * wx + wy * wy + wz * wz,
               discriminant = b * b - a * c;
  if constexpr (!Well) return {std::max(c, 0.0) / (std::sqrt(discriminant) - b), j};
  using One = simd::simd<double, simd::simd_abi::scalar>;
  const InWell<One> well({a, b, reach, apart_squared, c, discriminant}, range_, One::mask_type(bonded(i, j)));
  const auto [over, under] = well.quotient(simd::sqrt(simd::max(well.squared_root(), One(0.0))));
  const Meeting meeting = !bonded(i, j)                    ? Meeting::capture
                          : simd::any_of(well.may_touch()) ? Meeting::touch
                                                           : Meeting::escape;
  return {(over / under)[0], j, meeting};
}

/// Finds by estimates which grain is first, and takes the root of that one alone. Where estimates cannot tell
/// (touches within 2^-11 of each other), or spheres overlap deeper than any before, everything is done in
/// full; so the answer is the same to the last bit. There are no branches, as it is as good as random whether
/// any of eight grains may come first.
template <int K, bool Well>
std::array<AllPairs::Touch, K> AllPairs::estimated_touches(const std::array<int, K>& who) {
  constexpr double above = 1 + 0x1p-11, below = 1 - 0x1p-11, tiny = 1e-300;
  const Selves<K> selves(*this, who);
  std::array<Lanes, K> best, best_index;  // of each lane
  best.fill(never);
  best_index.fill(-1.0);
  Lanes index = lane_index();
  const Lanes zero(0.0), smallest_room(smallest_room_);
  Lanes::mask_type doubt(false);
  for (std::size_t j = 0; j < padded_size_; j += lane_count, index += static_cast<double>(lane_count)) {
    const typename Selves<K>::Others others(*this, j, selves.now);
    for (std::size_t g = 0; g < K; ++g) {
      const Approach<Lanes> pair = selves.approach(g, others);
      const auto& [a, b, reach, apart_squared, c, discriminant] = pair;
      const auto estimate = [&tiny](const Lanes& x) {
        return x * inverse_root_estimate(simd::max(x, Lanes(tiny)));
      };
      Lanes touch;
      Lanes::mask_type meets;
      if constexpr (Well) {
        const InWell<Lanes> well(pair, range_, bonds(who[g], j));
        const auto [over, under] = well.quotient(estimate(simd::max(well.squared_root(), zero)));
        meets = well.meets();
        touch = over * inverse_estimate(under);
      } else {
        meets = b < zero && discriminant >= zero;
        touch = simd::max(c, zero) * inverse_estimate(estimate(discriminant) - b);
      }
      doubt = doubt || (meets && c < smallest_room);
      doubt = doubt || (meets && touch > Lanes(below) * best[g] && touch < Lanes(above) * best[g]);
      const auto sooner = meets && touch < best[g];
      simd::where(sooner, best[g]) = touch;
      simd::where(sooner, best_index[g]) = index;
    }
  }
  if (simd::any_of(doubt)) [[unlikely]]
    return first_touches<K, Well>(who);
  std::array<Touch, K> touches;
  for (std::size_t g = 0; g < K; ++g) {
    const double earliest = simd::hmin(best[g]);
    if (!(earliest < never)) continue;
    const Lanes nearly(above * earliest);
    const auto first = best[g] <= nearly;
    if (simd::popcount(first) != 1) [[unlikely]]
      return first_touches<K, Well>(who);
    const int partner = static_cast<int>(
        static_cast<double>(best_index[g][static_cast<std::size_t>(simd::find_first_set(first))]));
    touches[g] = touch_of<Well>(who[g], partner);
  }
  return touches;
}

template <int K, bool Well>
void AllPairs::predict_grains(const std::array<int, K>& who) {
  const double now = time_[static_cast<std::size_t>(who[0])];
  std::array<Touch, K> touches;
  if constexpr (has_estimates)
    touches = estimated_touches<K, Well>(who);
  else
    touches = first_touches<K, Well>(who);
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
      if (is_pair) next.meeting = touches[g].meeting;
    event_time_[k] = next.time;
    partner_[k] = next.partner;
    partner_count_[k] = next.partner_count;
    meeting_[k] = next.meeting;
  }
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

/// Most grains have nothing ahead of them for the 2 ms between two kicks: a touch is no earlier than
/// c / (-2 b), so that needs no root, and each pair is looked at once.
void AllPairs::predict_all_before(double end) {
  if (size_ == 0) return;
  constexpr double rounding = 1e-9;
  find_who_may_touch((end - time_[0]) * (1 + rounding), may_touch_);
  next_.grain = -1;
  for (int i = 0; i < size(); ++i) {
    const std::size_t k = static_cast<std::size_t>(i);
    if (may_touch_[k] != 0) {
      predict(i);
      continue;
    }
    const GrainEvent next = next_side_wall(flight(i), side_room(i));
    event_time_[k] = next.time;
    partner_[k] = next.partner;
    partner_count_[k] = next.partner_count;
    meeting_[k] = next.meeting;
  }
}

/// Marks every grain that may touch another, or meet the edge of a well, within `wait`.
void AllPairs::find_who_may_touch(double wait, std::vector<char>& may) const {
  may.assign(padded_size_, 0);
  const Lanes twice_wait(-2 * wait), zero(0.0);
  for (std::size_t i = 0; i < size_; ++i) {
    const Lanes x(x_[i]), y(y_[i]), z(z_[i]), vx(vx_[i]), vy(vy_[i]), vz(vz_[i]),
        reach_of_i(radius_[i] + range_);
    for (std::size_t j = i / lane_count * lane_count; j < padded_size_; j += lane_count) {
      const Lanes rx = load(x_, j) - x, ry = load(y_, j) - y, rz = load(z_, j) - z;
      const Lanes reach = load(radius_, j) + reach_of_i,
                  b = rx * (load(vx_, j) - vx) + ry * (load(vy_, j) - vy) + rz * (load(vz_, j) - vz),
                  c = rx * rx + ry * ry + rz * rz - reach * reach;
      auto meet = b < zero && c <= twice_wait * b;
      if (range_ > 0) meet = meet || bonds(static_cast<int>(i), j);
      if (simd::none_of(meet)) continue;
      may[i] = 1;
      for (std::size_t lane = 0; lane < lane_count; ++lane) may[j + lane] |= static_cast<char>(meet[lane]);
    }
  }
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
