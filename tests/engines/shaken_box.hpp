// SPDX-License-Identifier: MIT
// A box that is shaken: x = A cos(w t), grains in it, no gravity. It is a million times as heavy as its
// grains, so that its spring alone moves it, and loses a millionth of its energy a period.
#pragma once
#include <string>

#include "setup.hpp"

namespace shakedown {

struct ShakenBox {
  int grains = 10;
  double diameter = 0.01, grain_mass = 4.04e-3;  ///< m, kg
  double width = 0.0101;            ///< m, both ways across; as wide as a grain: they stand in a column
  double thickness = 0.1;           ///< m, of the grains when they lie together at a wall
  double clearance = 0.05;          ///< m, L_g: inner length less that
  double amplitude = 0.02;          ///< m
  double frequency = 2;             ///< Hz
  double restitution = 0.5;         ///< of all contacts
  int settling = 20, periods = 40;  ///< the loss is that of `periods` after `settling`
};

Setup setup_of(const ShakenBox& box);

/// Energy lost in a period over m A^2 w^2, m the mass of all grains.
struct ShakenLoss {
  double mean, spread;  ///< of one period
};
ShakenLoss loss_of(const std::string& engine, const ShakenBox& box);

/// The same when all grains go as one: they leave a wall where it is fastest, fly at A w, and give all they
/// have in the frame of the other wall when it meets them, twice a period: (1 - cos s)^2 with s - sin s =
/// L_g/A, at most 4 at L_g = pi A. Beyond, they would miss the wall on its way to them (A. Sack, M. Heckel,
/// J. E. Kollmer, F. Zimber and T. Poeschel, Phys. Rev. Lett. 111, 018001 (2013)).
double collected_loss(double clearance_over_amplitude);

}  // namespace shakedown
