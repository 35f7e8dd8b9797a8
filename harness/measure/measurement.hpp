// SPDX-License-Identifier: MIT
// An experiment ready to be compared with a model: each run with what its frames tell and the setup that goes
// with it.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "audit.hpp"
#include "experiment.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// |x_com - x_box| of the packed layer is (1 - b)(1 + s)(L/2 - h): its slope against L tells a camera's bias
/// or scale from the mass.
struct PlateauSlope {
  double slope = 0, error = 0;  ///< per m of box length; 1/2 expected; NaN with one length only
};

struct Measurement {
  /// One recorded run, whole.
  struct Run {
    MeasuredRun recorded;
    RunAudit audit;
    Setup setup;  ///< the user's, with the run's own keys
    /// The setup it was read with drives it to the end, so it is compared over its whole length.
    bool shaken = false;
    /// Period of the spring, s, and release, m, of the setup it was read with: scales that stay while models
    /// are compared. At first those of the paper's damper.
    double period = 1 / 1.23, excursion = 0.1075;
    /// Takes these scales, and whether it is shaken, from a run of the same experiment.
    void keep_scales_of(const Run& other) {
      shaken = other.shaken, period = other.period, excursion = other.excursion;
    }
  };
  std::string title, file;
  std::vector<std::string> notes;     ///< what was assumed in reading, in words
  std::vector<std::string> warnings;  ///< what the frames give reason to say, sentences for people
  std::vector<KnownValue> known;      ///< what was weighed and measured, and how well
  PlateauSlope plateau;
  std::vector<Run> runs;
  Sensor sensor = Sensor::camera;
};

/// Returns what was assumed and what the frames give reason to say.
std::vector<std::string> all_notes(const Measurement& measurement);

/// Returns the setup of one run: the user's, with the run's own keys. Throws InputError that names the run's
/// line for a key that does not exist or does not fit.
Setup setup_of_run(const Setup& setup, const MeasuredRun& run, KnownEffects known);

/// Gives a run the scales of its setup.
void set_scales(Measurement::Run& run);

/// Audits the frames, and gives each run its setup, with what is known put in. Throws as setup_of_run does.
Measurement measurement_of(const Setup& setup, Experiment experiment, KnownEffects known);

/// Audits the frames of an experiment with setups made elsewhere, one for each run.
Measurement measurement_of(const std::vector<Setup>& setups, Experiment experiment);

/// Returns what is known of one run: its own values, and the measurement's where it has none.
std::vector<KnownValue> known_of(const Measurement& measurement, const Measurement::Run& run);

/// Returns the measurement beside another setup of the user: each run gets it with the run's own keys.
Measurement with_setup(Measurement measurement, const Setup& changed, KnownEffects known);

/// Returns the measurement with its frames up to so many seconds after release.
Measurement up_to(Measurement measurement, double seconds);

}  // namespace shakedown
