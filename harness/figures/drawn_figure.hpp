// SPDX-License-Identifier: MIT
// A figure laid out.
#pragma once
#include "drawing.hpp"

namespace shakedown {

enum class Width {
  column,  ///< 85 mm
  page     ///< 180 mm
};

/// Lays the figure out: panels below each other, on a whole page two beside each other. Axes carry their
/// units.
Drawing drawn(const Figure& figure, Width width);

}  // namespace shakedown
