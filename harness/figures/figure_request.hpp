// SPDX-License-Identifier: MIT
// Says which figure of which run somebody wants from a result. It stands by itself so that the makers of
// figures (made_figures.hpp) and the choice among them (result_figures.hpp) share it.
#pragma once
#include <string>

namespace shakedown {

/// The figure that is wanted of a result.
struct FigureRequest {
  std::string kind;                ///< of figure_kinds; empty: the first that the result holds
  std::string run;                 ///< of several; empty: all
  std::string observable = "box";  ///< or "centre", of the grains
};

}  // namespace shakedown
