// SPDX-License-Identifier: MIT
// Makes curves for the eye: each measured run beside ensembles of the model, at the same moments.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine.hpp"
#include "execution.hpp"
#include "known_effects.hpp"
#include "measurement.hpp"
#include "report.hpp"

namespace shakedown {

/// One number of an ensemble over time: mean and standard deviation of one run; NaN where no run has it.
struct EnsembleCurve {
  std::vector<double> mean, sd;
};

/// An ensemble of one setup as the camera of the setup sees it.
struct ModelMotion {
  EnsembleCurve box, centre;                        ///< m
  EnsembleCurve energy;                             ///< J, total
  std::array<EnsembleCurve, contact_classes> loss;  ///< J
  Health health;                                    ///< the worst of all runs
  std::int64_t collisions = 0;                      ///< of all runs
  int runs = 0;
};

struct MeasuredAgainstModel {
  std::string run;
  Setup given, amended;
  std::vector<double> time;                ///< s, of frames, CurveOptions::rate of them a second
  std::vector<double> box, centre;         ///< m, measured then; NaN where no frame is
  double box_noise = 0, centre_noise = 0;  ///< m, standard deviation of one frame
  ModelMotion as_given, final_model;       ///< as_given.runs == 0: there is nothing to compare with
  /// Measured less mean over its expected spread (of run to run, of the mean, and of the camera).
  std::vector<double> box_residual, centre_residual;
  /// The same of the setup as given; empty without one.
  std::vector<double> given_box_residual, given_centre_residual;
};

struct CurveOptions {
  int runs = 24;  ///< of each ensemble
  int first_run = 0;
  Execution execution{};
  double rate = 50;  ///< Hz, of the curves
  KnownEffects known;
  std::function<void(double fraction)> progress;
  /// The final model of each measured run; empty: `final_setup` with the run's own keys.
  std::vector<Setup> final_of_run{};
  bool from_first_frame = false;  ///< models begin at the first frame and not at time 0
};

/// Simulates the ensembles and puts each measured run beside them. `given` may be null: only the final model
/// is simulated. Throws what engines throw, and Interrupted.
std::vector<MeasuredAgainstModel> measured_against_model(const Measurement& measurement, const Setup* given,
                                                         const Setup& final_setup, const Engine& engine,
                                                         const CurveOptions& options);

/// Makes the section of the curves themselves: of each run positions, errors (mm) and residuals (in expected
/// spreads), of the box and, where measured, of the grains' centre.
ReportSection curves_section(const std::vector<MeasuredAgainstModel>& runs, const std::string& title);
/// Makes the section "Where it fails": rms residuals by time and run, by phase and by amplitude of the swing.
ReportSection failure_section(const std::vector<MeasuredAgainstModel>& runs);
/// Makes the section "Where the energy goes": means of the final model's runs, mJ over time.
ReportSection energy_section(const std::vector<MeasuredAgainstModel>& runs);
/// Returns lines on how well the engines kept their promises in the simulations drawn here, the worst of all.
std::vector<std::string> health_lines(const std::vector<MeasuredAgainstModel>& runs);

/// Makes a replay of each measured run with grains (among the first `most`), simulated by the hard engine
/// with the final setup. `bytes`: of all replays together.
std::vector<ReportReplay> replays_of(const std::vector<MeasuredAgainstModel>& runs, std::size_t most = 5,
                                     std::size_t bytes = 760'000);

}  // namespace shakedown
