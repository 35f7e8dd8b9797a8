// SPDX-License-Identifier: MIT
// Which list centres lie near a place: cells as wide as the search reaches, each a block or more of eight
// centres in single precision, counted from the cell's corner. A block is tested in vector lanes, and periods
// need no thought: the step from cell to cell is known. Rounding is allowed for by a wider reach, so that
// none is missed; a neighbour too many costs a pair test and changes nothing. Beside lists linked from grain
// to grain: a third of the time of a renewal.
#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "lanes.hpp"

namespace shakedown {

/// Returns how many cells a system is cut into at most: in a dilute one most are empty, and more of them
/// would only take memory.
inline double most_cells_for(std::size_t grains) {
  return std::clamp(64.0 * static_cast<double>(grains), 0x1p24, 0x1p31 - 1);
}

class CentreCells {
 public:
  /// `reach`: m. Places may lie outside of `extent`: cells wrap around. Cells are wider than the search
  /// reaches where there would be too many.
  CentreCells(std::size_t grains, const std::array<double, 3>& extent, double reach, bool periodic);

  /// A place as a cell sees it.
  struct Place {
    std::array<int, 3> cell;
    std::array<float, 3> from_corner;  ///< m
  };
  /// Returns the place of a centre (m).
  Place place(const std::array<double, 3>& centre) const;

  /// Enters a grain's centre at this place.
  void put(std::int32_t grain, const Place& place);
  /// Removes the centre of a grain that was put in.
  void take(std::int32_t grain);
  /// Writes the grains whose centres lie within reach of a place, and perhaps some a hundred thousandth (in
  /// wide cells more) beyond, to `near`, which grows as needed; returns how many.
  std::size_t find(const Place& place, std::vector<std::int32_t>& near) const;

  /// Returns the memory held, B, for the cells and all grains.
  std::size_t bytes() const {
    return first_.size() * sizeof(std::int32_t) + block_.size() * (sizeof(Block) + 2 * sizeof(std::int32_t)) +
           slot_.size() * sizeof(std::int32_t);
  }

 private:
  static constexpr std::size_t block_size = 8;
  static constexpr std::int32_t none = -1;
  static constexpr float far_away = 1e30F;  // where no grain is
  struct alignas(64) Block {
    std::array<float, block_size> x, y, z;
    std::array<std::int32_t, block_size> grain;
  };

  /// Returns the place of a cell in first_.
  std::size_t index_of(int x, int y, int z) const {
    return (static_cast<std::size_t>(x) * static_cast<std::size_t>(cells_[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(cells_[2]) +
           static_cast<std::size_t>(z);
  }
  /// Puts an empty block in front of the others of a cell, and returns it.
  std::int32_t new_block(std::size_t cell);
  /// Takes a block out of its cell, to be used again.
  void drop_block(std::int32_t block);

  std::array<int, 3> cells_{};
  std::array<double, 3> edge_{}, per_edge_{};
  float reach_squared_ = 0;
  std::vector<std::int32_t> first_;  // block of each cell
  AlignedVector<Block> block_;
  std::vector<std::int32_t> next_;  // of each block: the next of its cell, or the next unused one
  std::vector<std::int32_t> cell_;  // of each block
  std::vector<std::int32_t> slot_;  // of each grain, block_size to a block
  std::int32_t unused_ = none;
};

}  // namespace shakedown
