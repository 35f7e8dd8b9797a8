// SPDX-License-Identifier: MIT
// The paper's closed-form estimates (its Secs. "Parameters" and "Optimal Dampers"). Its omega is the
// frequency f of the EMPTY box.
#pragma once
#include "setup.hpp"

namespace shakedown {

/// Where in the stroke the layer of grains meets the wall that turns back, by the paper's criterion.
enum class LandingPhase {
  outward,  ///< n < f t_g,peak < n + 1/4: while the wall still moves outwards
  inward,   ///< n + 1/4 < f t_g,peak < n + 1 and n < f t_g,Box < n + 1/2: on the way back, towards the grains
  unfavourable  ///< neither: the wall slows down again, or whole cycles pass without a landing
};
const char* to_string(LandingPhase phase);

struct Theory {
  double beam_stiffness = 0;     ///< N/m, E w h^3 / (4 l^3)
  double beam_frequency = 0;     ///< Hz, of the empty box on that beam
  double stiffness = 0;          ///< N/m, used: M (2 pi f)^2, effects included
  double frequency = 0;          ///< Hz, of the empty box, effects on its mass included
  double total_mass = 0;         ///< kg, M + N m
  double loaded_frequency = 0;   ///< Hz, f sqrt(M / (M + N m))
  double layer_thickness = 0;    ///< m, of the packed grains on an end wall
  double top_speed = 0;          ///< m/s, 2 pi f_loaded Delta0
  double time_to_peak = 0;       ///< s, t_g,peak = (L + Delta0 - layer) / top_speed
  double time_through_box = 0;   ///< s, t_g,Box = (L - layer) / top_speed
  double phase_to_peak = 0;      ///< f t_g,peak
  double phase_through_box = 0;  ///< f t_g,Box
  LandingPhase landing = LandingPhase::unfavourable;
  double optimal_length = 0;  ///< m, pi Delta0 sqrt(M / (M + N m)) + layer
};

/// Returns the estimates for a setup. Throws InputError for domains without a spring, or without a release
/// displacement.
Theory theory_of(const Setup& setup);

/// Returns the thickness of the packed layer, m: whole layers, each of the grains that a fcc layer holds; 20
/// mm for the paper's damper.
double layer_thickness(const Setup& setup);

}  // namespace shakedown
