// SPDX-License-Identifier: MIT
#include "layer_check.hpp"

#include <cmath>
#include <cstdlib>

#include "audit.hpp"
#include "quantity.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

// h repeats to 0.2 mm between lengths (seen: 7.67 to 7.86 mm in one experiment); a length that is off by less
// than twice this is not told.
constexpr double layer_scatter = 0.75e-3;  // m

struct Layer {
  const MeasuredRun* run;
  double length, thickness, plateau;  ///< m; `thickness` is h above
};

bool same_grains(const Setup& a, const Setup& b) {
  return a.grains.count == b.grains.count && a.grains.diameter == b.grains.diameter &&
         a.box.width == b.box.width;
}

std::vector<Layer> layers_like(const Experiment& experiment, const std::vector<Setup>& setups,
                               const Setup& like) {
  std::vector<Layer> layers;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    if (!experiment.runs[i].has_com() || !same_grains(setups[i], like)) continue;
    const double plateau = audit_run(experiment.runs[i]).plateau, length = setups[i].box.length;
    if (std::isfinite(plateau))
      layers.push_back({&experiment.runs[i], length, length / 2 - plateau, plateau});
  }
  return layers;
}

std::string mm(double metres) { return write_quantity(std::round(metres * 1e4) / 1e4, "mm"); }

/// Returns the run that a wrong one was exchanged with, or nullptr: each fits the other's length.
const Layer* exchanged_with(const std::vector<Layer>& layers, const Layer& wrong, double thickness) {
  const auto fits = [&](const Layer& layer, double length) {
    return std::abs(length / 2 - layer.plateau - thickness) < layer_scatter;
  };
  for (const Layer& other : layers)
    if (other.run != wrong.run && fits(wrong, other.length) && fits(other, wrong.length) &&
        !fits(other, other.length))
      return &other;
  return nullptr;
}

void judge(const std::vector<Layer>& layers, std::vector<std::string>& notes) {
  std::vector<double> thicknesses;
  for (const Layer& layer : layers) thicknesses.push_back(layer.thickness);
  const double thickness = median(thicknesses);
  for (const Layer& layer : layers) {
    if (std::abs(layer.thickness - thickness) < layer_scatter) continue;
    const double length = 2 * (layer.plateau + thickness);
    const std::string found = layer.run->name + ": box_length: the grains rest " + mm(layer.plateau) +
                              " from the middle of the box, as in a box of " + mm(length) + ", not " +
                              mm(layer.length) + ". ";
    if (const Layer* other = exchanged_with(layers, layer, thickness)) {
      if (&layer < other)
        notes.push_back(found + "Exchanged with " + other->run->name + "? Exchange their file");
    } else {
      notes.push_back(found + "Filed under a wrong length? Write box_length = \"" + mm(length) +
                      "\" under its [[run]] if that is right (or its grains are others)");
    }
  }
}

}  // namespace

std::vector<std::string> notes_on_layers(const Experiment& experiment, const std::vector<Setup>& setups) {
  std::vector<std::string> notes;
  constexpr std::size_t enough = 3;  // so that most of them can be right
  for (std::size_t i = 0; i < setups.size(); ++i) {
    bool seen = setups[i].grains.count == 0;
    for (std::size_t j = 0; j < i; ++j) seen = seen || same_grains(setups[j], setups[i]);
    if (seen) continue;
    const std::vector<Layer> layers = layers_like(experiment, setups, setups[i]);
    if (layers.size() >= enough) judge(layers, notes);
  }
  return notes;
}

}  // namespace shakedown
