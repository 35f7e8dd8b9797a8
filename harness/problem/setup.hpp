// SPDX-License-Identifier: MIT
// What is simulated, as the user states it. SI units; defaults are the paper's damper at L = 40 mm (Table I).
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "effect.hpp"

namespace shakedown {

/// Where the grains live: a box on a spring (the damper), a box held still at x = 0, or a periodic cell
/// without walls.
enum class Domain { damper, closed, periodic };

/// A periodic cell must be wider than this in diameters of its largest grain: the three list cells across it
/// must each hold a grain, with something to spare for rounding.
constexpr double least_period_in_diameters = 3 * (1 + 1e-6);

/// Arrangement of the grains at release (harness/setup_file/README.md, "Packings").
enum class Packing { fcc, square, random, spread };

/// Frames a second of a camera, and samples a second of a simulation, of which nothing is said, Hz.
constexpr double usual_frame_rate = 500;

struct Setup {
  Domain domain = Domain::damper;

  struct Box {
    double mass = 0.434;                      ///< kg, without grains
    double length = 0.040;                    ///< m, inner length along x
    std::array<double, 2> width{0.05, 0.05};  ///< m, inner widths along y and z
  } box;

  struct Spring {
    double frequency = 1.23;  ///< Hz, of the EMPTY box: k = M (2 pi f)^2
  } spring;

  /// The steel blade that is the spring; only for the beam formula k = E w h^3 / (4 l^3), never for the
  /// dynamics.
  struct Blade {
    double youngs_modulus = 2.06e11;  ///< Pa
    double width = 0.030;             ///< m
    double thickness = 0.0015;        ///< m
    double length = 0.590;            ///< m
  } blade;

  struct Grains {
    int count = 37;
    double diameter = 0.010;  ///< m
    double mass = 4.04e-3;    ///< kg
  } grains;

  struct Restitution {
    double grain_grain = 0.75;
    double grain_wall = 0.76;  ///< end walls and side walls
  } restitution;

  struct Release {
    double displacement = 0.1075;  ///< m, of the box, at rest
    Packing packing = Packing::fcc;
    std::string initial_grains;  ///< CSV file id,x,y,z,vx,vy,vz; empty: use the packing
    /// Set for the runs of an experiment (there is no key for it): m, where the box was when initial_grains
    /// were measured. From another place of release they move with the box. An ensemble of them has its
    /// chaos: where every velocity is zero nobody measured them, and they are drawn as those of a packing
    /// are; others are known to a thousandth.
    std::optional<double> grains_measured_at;
    /// Kinetic energy of the grains as a fraction of the spring energy (damper); ignored when initial_grains
    /// is given and tells velocities.
    double kinetic_energy_fraction = 2e-5;
    double grain_speed = 1.0;  ///< m/s, root mean square speed of the grains in domains without a spring
  } release;

  struct Run {
    double duration = 22;                   ///< s
    double sample_rate = usual_frame_rate;  ///< Hz
    std::uint64_t seed = 1;
  } run;

  /// Regularisation of inelastic collapse in the event-driven engine (hardsphere/README.md).
  struct Hard {
    double wall_elastic_fraction = 0.02;  ///< end-wall impacts slower than this times the box's current top
                                          ///< speed are elastic (paper, Eq. elasticlimit)
    double pair_elastic_speed = 1e-3;     ///< m/s; grain-grain impacts slower than this are elastic
    double wall_elastic_speed = 0;  ///< m/s; end- and side-wall impacts slower than this are elastic; both
                                    ///< are raised where layers are pressed on walls (as above)
    double kick_interval =
        2e-3;  ///< s; drag and formulas act on grains in impulses so far apart, second order in it
  } hard;

  struct Soft {
    double contact_time = 3e-4;     ///< s, half period of the contact oscillator
    double steps_per_contact = 20;  ///< need not be whole
  } soft;

  struct Bullet {
    bool defaults = false;    ///< Bullet untouched, to show what that does
    double time_step = 1e-4;  ///< s
  } bullet;

  std::vector<EffectChoice> effects;

  /// Where each given key stands ("box.mass" -> file:line:column), for messages.
  std::map<std::string, SourcePlace> places;
};

/// Returns the setup's choice of this effect, null where it has none; valid until the setup's list is
/// changed.
inline const EffectChoice* find_choice(const Setup& setup, std::string_view name) {
  for (const EffectChoice& choice : setup.effects)
    if (choice.record->name == name) return &choice;
  return nullptr;
}

/// Returns where a key was given; no place when it was not.
inline SourcePlace place_of(const Setup& setup, const std::string& key) {
  const auto found = setup.places.find(key);
  return found == setup.places.end() ? SourcePlace{} : found->second;
}

}  // namespace shakedown
