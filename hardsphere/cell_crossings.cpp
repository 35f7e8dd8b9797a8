// SPDX-License-Identifier: MIT
#include "cell_crossings.hpp"

#include <algorithm>
#include <bit>

#include "centre_cells.hpp"

namespace shakedown {

namespace {

/// A touch across a cell must not be missed by rounding.
constexpr double least_edge = 1 + 1e-6;
constexpr int most_cells = 65000;  // along an axis

#ifdef __AVX512F__
/// Which of an axis's three offsets enters each of the 27 sums of one offset an axis.
constexpr std::array<std::int32_t, 32> digits_of(std::int32_t step) {
  std::array<std::int32_t, 32> which{};
  for (std::int32_t n = 0; n < 27; ++n) which[static_cast<std::size_t>(n)] = n / step % 3;
  return which;
}
constexpr std::array<std::int32_t, 32> of_x = digits_of(9), of_y = digits_of(3), of_z = digits_of(1);
#endif

int cells_across(double extent, double edge) {
  return static_cast<int>(std::min<double>(most_cells, extent / edge));
}

}  // namespace

bool CellCrossings::can_hold(const State& state, const std::array<double, 3>& extent) {
  if (state.size() == 0) return false;
  for (std::size_t i = 0; i < state.size(); ++i)
    if (state.radius[i] != state.radius[0]) return false;
  double all = 1;
  for (const double e : extent) {
    const int across = cells_across(e, 2 * state.radius[0] * least_edge);
    if (across < 3) return false;
    all *= across;
  }
  return all <= most_cells_for(state.size());
}

CellCrossings::CellCrossings(const State& state, const std::array<double, 3>& extent, double edge)
    : ScheduledGrains(state, extent), place_(state.size()) {
  EXPECT(can_hold(state, extent));
  std::size_t all = 1;
  for (std::size_t axis : {2, 1, 0}) {
    cells_[axis] =
        std::max(3, cells_across(extent[axis], lines_.largest_reach() * std::max(edge, least_edge)));
    edge_[axis] = extent[axis] / cells_[axis];
    const auto n = static_cast<std::size_t>(cells_[axis]);
    for (std::size_t cell = 0; cell < n + 3; ++cell)
      offset_[axis].push_back(static_cast<std::uint32_t>((cell + n - 1) % n * all));
    all *= n;
  }
  cell_first_.assign(all, -1);
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    std::array<double*, 3> x{&lines_[i].x, &lines_[i].y, &lines_[i].z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      *x[axis] -= extent[axis] * std::floor(*x[axis] / extent[axis]);
      place_[i].cell[axis] =
          static_cast<std::uint16_t>(std::min(cells_[axis] - 1, static_cast<int>(*x[axis] / edge_[axis])));
    }
    put_in_cell(i);
  }
}

std::array<double, 3> CellCrossings::separation(const Flight3& a, const Flight3& b) const {
  const Period& period = lines_.period();
  return {period.nearest(b.x[0] - a.x[0], 0), period.nearest(b.x[1] - a.x[1], 1),
          period.nearest(b.x[2] - a.x[2], 2)};
}

void CellCrossings::put_in_cell(std::size_t i) {
  std::int32_t& first = cell_first_[index_of(place_[i].cell)];
  lines_[i].next = first;
  first = static_cast<std::int32_t>(i) | (first >= 0 ? has_next : 0);
}

void CellCrossings::take_from_cell(std::size_t i) {
  std::int32_t *link = &cell_first_[index_of(place_[i].cell)], *link_before = nullptr;
  while ((*link & ~has_next) != static_cast<std::int32_t>(i)) {
    link_before = link;
    link = &lines_[static_cast<std::size_t>(*link & ~has_next)].next;
  }
  *link = lines_[i].next;
  if (*link < 0 && link_before != nullptr) *link_before &= ~has_next;
}

/// Takes the grains of cells: first the cells that are not empty, without a branch (most are, unpredictably),
/// then the rare second grains, of which the link to the first tells, so that nobody's line is looked at too
/// early. With AVX-512 sixteen cells at a time, which saves a sixth of all instructions at packing fraction
/// 0.1.
class CellCrossings::Collector {
 public:
  Collector(const CellCrossings& cells, Others& others)
      : first_(cells.cell_first_.data()), lines_(cells.lines_), others_(others) {}

#ifdef __AVX512F__
  /// Offsets of three cells along each axis: their 27 sums.
  void block(const std::uint32_t* x, const std::uint32_t* y, const std::uint32_t* z) {
    const __m512i three_x = three(x), three_y = three(y), three_z = three(z);
    for (std::size_t n = 0; n < 27; n += 16)
      take(sum(pick(three_x, &of_x[n]), pick(three_y, &of_y[n]), pick(three_z, &of_z[n])),
           n == 0 ? 0xffff : 0x7ff);
  }
  /// The same for one cell along the first axis: nine sums.
  void layer(std::uint32_t x, const std::uint32_t* y, const std::uint32_t* z) {
    take(
        sum(_mm512_set1_epi32(static_cast<int>(x)), pick(three(y), of_y.data()), pick(three(z), of_z.data())),
        0x1ff);
  }
#else
  void block(const std::uint32_t* x, const std::uint32_t* y, const std::uint32_t* z) {
    for (std::size_t a = 0; a < 3; ++a) layer(x[a], y, z);
  }
  void layer(std::uint32_t x, const std::uint32_t* y, const std::uint32_t* z) {
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t c = 0; c < 3; ++c) {
        const std::int32_t link = others_[size_] = first_[x + y[b] + z[c]];
        size_ += link >= 0;
        chained_ |= link >= 0 && (link & has_next);
      }
  }
#endif
  /// Fills up with i to a whole vector; returns the number of grains taken.
  std::size_t finish(std::int32_t i) {
    if (chained_) follow_chains();
    for (std::size_t n = 0; n < lane_count; ++n) others_[size_ + n] = i;
    return size_;
  }

 private:
#ifdef __AVX512F__
  static __m512i three(const std::uint32_t* offsets) {
    return _mm512_castsi128_si512(_mm_loadu_si128(reinterpret_cast<const __m128i*>(offsets)));
  }
  static __m512i pick(__m512i from, const std::int32_t* which) {
    return _mm512_maskz_permutexvar_epi32(0xffff, _mm512_loadu_si512(which), from);
  }
  static __m512i sum(__m512i a, __m512i b, __m512i c) { return _mm512_add_epi32(_mm512_add_epi32(a, b), c); }
  void take(__m512i cells, __mmask16 which) {
    const __m512i empty = _mm512_set1_epi32(-1);
    const __m512i link = _mm512_mask_i32gather_epi32(empty, which, cells, first_, 4);
    const __mmask16 taken = _mm512_cmpgt_epi32_mask(link, empty);
    _mm512_storeu_si512(&others_[size_], _mm512_maskz_compress_epi32(taken, link));
    size_ += static_cast<std::size_t>(std::popcount(static_cast<unsigned>(taken)));
    chained_ |= _mm512_mask_test_epi32_mask(taken, link, _mm512_set1_epi32(has_next)) != 0;
  }
#endif
  void follow_chains() {
    const std::size_t cells = size_;
    for (std::size_t n = 0; n < cells; ++n)
      if (others_[n] & has_next) chain(others_[n]);
  }
  void chain(std::int32_t& link) {
    link &= ~has_next;
    for (std::int32_t next = lines_[static_cast<std::size_t>(link)].next; next >= 0;) {
      EXPECT(size_ + lane_count < others_.size());
      const std::int32_t j = next & ~has_next;
      others_[size_++] = j;
      next = next & has_next ? lines_[static_cast<std::size_t>(j)].next : -1;
    }
  }

  const std::int32_t* first_;
  const GrainLines& lines_;
  Others& others_;
  std::size_t size_ = 0;
  bool chained_ = false;
};

std::size_t CellCrossings::collect_around(std::size_t i, Others& others) const {
  Collector collector(*this, others);
  collector.block(around(i, 0), around(i, 1), around(i, 2));
  return collector.finish(static_cast<std::int32_t>(i));
}

std::size_t CellCrossings::collect_ahead(std::size_t i, std::size_t axis, int step, Others& others) const {
  Collector collector(*this, others);
  collector.layer(around(i, axis)[1 + step], around(i, (axis + 1) % 3), around(i, (axis + 2) % 3));
  return collector.finish(static_cast<std::int32_t>(i));
}

/// Fetches far ahead the grain's own lines, which say where to look later: at its partner and at the cells
/// around. The grains in those cells come in time by themselves: fetching them as well costs 6 to 12 %.
void CellCrossings::prefetch(int i, int days) const {
  const std::size_t k = static_cast<std::size_t>(i);
  if (days == looks[0]) {
    queue_.prefetch(i);
    lines_.prefetch(k);
    __builtin_prefetch(&place_[k]);
    return;
  }
  const Place& place = place_[k];
  if (!place.crosses && place.partner >= 0) {
    const auto j = static_cast<std::size_t>(place.partner);
    lines_.prefetch(j);
    queue_.prefetch(place.partner);
    __builtin_prefetch(&place_[j]);
  }
  const std::uint32_t *x = around(k, 0), *y = around(k, 1), *z = around(k, 2);
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b) __builtin_prefetch(&cell_first_[x[a] + y[b] + z[1]]);
}

void CellCrossings::predict(int i) {
  const std::size_t k = static_cast<std::size_t>(i);
  const Flight3 self = flight(i);
  Others others;
  const std::size_t size = collect_around(k, others);
  place_[k].pair_time = never;
  place_[k].partner = no_partner;
  remember(k, self.time, lines_.first_touch<true>(k, self, others.data(), size, never));
  schedule(k, self, self.time);
}

void CellCrossings::leave_neighbourhood(int i, double now) {
  const std::size_t k = static_cast<std::size_t>(i), axis = place_[k].axis;
  const int step = lines_.flight(k).v[axis] > 0 ? 1 : -1;
  take_from_cell(k);
  int cell = place_[k].cell[axis] + step;
  if (cell < 0 || cell == cells_[axis]) {
    double* const x[] = {&lines_[k].x, &lines_[k].y, &lines_[k].z};
    *x[axis] -= step * lines_.period().extent[axis];
    cell -= step * cells_[axis];
  }
  place_[k].cell[axis] = static_cast<std::uint16_t>(cell);
  put_in_cell(k);
  Others others;
  const std::size_t size = collect_ahead(k, axis, step, others);
  // The flight keeps its anchor: a crossing rounds nothing.
  const Flight3 anchor = flight(i);
  Flight3 self = anchor;
  self.advance(now);
  remember(k, now, lines_.first_touch<true>(k, self, others.data(), size, place_[k].pair_time - now));
  schedule(k, anchor, now);
}

void CellCrossings::remember(std::size_t i, double now, const GrainLines::Touch& touch) {
  if (touch.partner < 0) return;
  place_[i].pair_time = now + touch.wait;
  place_[i].partner = touch.partner;
  place_[i].partner_count = lines_[static_cast<std::size_t>(touch.partner)].count;
}

void CellCrossings::schedule(std::size_t i, const Flight3& anchor, double now) {
  Place& place = place_[i];
  // Signs and the nearest edge are as good as random: no branches on them.
  std::array<double, 3> until;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double v = anchor.v[axis], edge = (place.cell[axis] + static_cast<int>(v > 0)) * edge_[axis];
    until[axis] = v != 0 ? (edge - anchor.x[axis]) / v : never;
  }
  const double wait = std::min({until[0], until[1], until[2]});
  place.axis = static_cast<std::uint8_t>((wait != until[0]) * (1 + (wait != until[1])));
  // rounding may have put it a little beyond its edge
  const double crossing = std::max(now, anchor.time + wait);
  place.crosses = crossing < place.pair_time;
  queue_.schedule(static_cast<int>(i), std::min(crossing, place.pair_time));
}

double CellCrossings::bytes_per_grain() const {
  return sizeof(Place) +
         static_cast<double>(lines_.bytes() + cell_first_.size() * sizeof(std::int32_t) + queue_.bytes()) /
             static_cast<double>(lines_.size());
}

}  // namespace shakedown
