// SPDX-License-Identifier: MIT
#include "centre_cells.hpp"

#include <algorithm>
#include <cmath>

#include "errors.hpp"

namespace shakedown {

CentreCells::CentreCells(std::size_t grains, const std::array<double, 3>& extent, double reach, bool periodic)
    : slot_(grains, none) {
  std::array<double, 3> least_edge{reach, reach, reach};
  double all = 0, widest = reach;
  while (true) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double across = std::min(extent[axis] / least_edge[axis], 1e9);
      // Open axes get two spare cells, so that the two ends of the grains' room never share one through the
      // wrap.
      cells_[axis] = periodic ? std::max(3, static_cast<int>(across))
                              : std::max(3, static_cast<int>(std::ceil(across)) + 2);
      edge_[axis] = periodic ? extent[axis] / cells_[axis] : least_edge[axis];
      per_edge_[axis] = 1 / edge_[axis];
      widest = std::max(widest, least_edge[axis]);
    }
    all = static_cast<double>(cells_[0]) * cells_[1] * cells_[2];
    if (all <= most_cells_for(grains)) break;
    least_edge[static_cast<std::size_t>(std::max_element(cells_.begin(), cells_.end()) - cells_.begin())] *=
        2;
  }
  // Single precision from a cell's corner errs by some 1e-7 of its width.
  reach_squared_ = static_cast<float>(reach * reach * (1 + 1e-5 * (widest / reach)));
  first_.assign(static_cast<std::size_t>(all), none);
}

CentreCells::Place CentreCells::place(const std::array<double, 3>& centre) const {
  Place place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double home = std::floor(centre[axis] * per_edge_[axis]);
    double cell = home < 0 ? home + cells_[axis] : home;
    if (!(cell >= 0 && cell < cells_[axis])) [[unlikely]] {
      cell -= cells_[axis] * std::floor(cell / cells_[axis]);
      // Of a place so far away that a cell is less than its rounding, or of none, any cell will do.
      cell = cell >= 0 ? std::min(cell, cells_[axis] - 1.0) : 0.0;
    }
    place.cell[axis] = std::min(static_cast<int>(cell), cells_[axis] - 1);
    place.from_corner[axis] = static_cast<float>(centre[axis] - home * edge_[axis]);
  }
  return place;
}

std::int32_t CentreCells::new_block(std::size_t cell) {
  std::int32_t block = unused_;
  if (block == none) {
    block = static_cast<std::int32_t>(block_.size());
    block_.emplace_back();
    next_.push_back(none);
    cell_.push_back(none);
  } else {
    unused_ = next_[static_cast<std::size_t>(block)];
  }
  const std::size_t b = static_cast<std::size_t>(block);
  for (auto* axis : {&block_[b].x, &block_[b].y, &block_[b].z}) axis->fill(far_away);
  block_[b].grain.fill(none);
  next_[b] = first_[cell];
  cell_[b] = static_cast<std::int32_t>(cell);
  first_[cell] = block;
  return block;
}

void CentreCells::drop_block(std::int32_t block) {
  const std::size_t b = static_cast<std::size_t>(block);
  std::int32_t* link = &first_[static_cast<std::size_t>(cell_[b])];
  while (*link != block) link = &next_[static_cast<std::size_t>(*link)];
  *link = next_[b];
  next_[b] = unused_;
  unused_ = block;
}

/// Returns the first lane that holds this grain; block_size where none does.
template <class Grains>
std::size_t lane_of(const Grains& grains, std::int32_t grain) {
  std::size_t lane = 0;
  while (lane < grains.size() && grains[lane] != grain) ++lane;
  return lane;
}

void CentreCells::put(std::int32_t grain, const Place& place) {
  const std::size_t cell = index_of(place.cell[0], place.cell[1], place.cell[2]);
  std::int32_t block = first_[cell];
  std::size_t lane = block_size;
  for (; block != none; block = next_[static_cast<std::size_t>(block)])
    if ((lane = lane_of(block_[static_cast<std::size_t>(block)].grain, none)) < block_size) break;
  if (block == none) block = new_block(cell), lane = 0;
  Block& to = block_[static_cast<std::size_t>(block)];
  to.x[lane] = place.from_corner[0];
  to.y[lane] = place.from_corner[1];
  to.z[lane] = place.from_corner[2];
  to.grain[lane] = grain;
  slot_[static_cast<std::size_t>(grain)] =
      block * static_cast<std::int32_t>(block_size) + static_cast<std::int32_t>(lane);
}

void CentreCells::take(std::int32_t grain) {
  const std::size_t slot = static_cast<std::size_t>(slot_[static_cast<std::size_t>(grain)]),
                    lane = slot % block_size;
  Block& from = block_[slot / block_size];
  from.x[lane] = far_away;
  from.grain[lane] = none;
  if (std::all_of(from.grain.begin(), from.grain.end(), [](std::int32_t g) { return g == none; }))
    drop_block(static_cast<std::int32_t>(slot / block_size));
}

std::size_t CentreCells::find(const Place& place, std::vector<std::int32_t>& near) const {
  std::array<std::array<int, 3>, 3> cell;
  // the place, counted from the corner of the cell before, at and after
  std::array<std::array<float, 3>, 3> from;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int home = place.cell[axis], n = cells_[axis];
    const float here = place.from_corner[axis], edge = static_cast<float>(edge_[axis]);
    cell[axis] = {home == 0 ? n - 1 : home - 1, home, home == n - 1 ? 0 : home + 1};
    from[axis] = {here + edge, here, here - edge};
  }
  std::size_t size = 0;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t b = 0; b < 3; ++b)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::int32_t n = first_[index_of(cell[0][a], cell[1][b], cell[2][c])]; n != none;
             n = next_[static_cast<std::size_t>(n)]) {
          const Block& block = block_[static_cast<std::size_t>(n)];
          std::array<float, block_size> apart_squared;
          for (std::size_t lane = 0; lane < block_size; ++lane) {
            const float x = block.x[lane] - from[0][a], y = block.y[lane] - from[1][b],
                        z = block.z[lane] - from[2][c];
            apart_squared[lane] = x * x + y * y + z * z;
          }
          if (size + block_size > near.size()) near.resize(2 * (size + block_size));
          size += append_where_less(near.data() + size, block.grain, apart_squared, reach_squared_);
        }
  return size;
}

}  // namespace shakedown
