// SPDX-License-Identifier: MIT
// Fits the waveform of a box without grains, which is its likelihood: by least squares of the recorded
// positions on the equation of motion, each run with its own place, speed and origin at the first frame, all
// with one spring and one set of strengths.
#pragma once
#include <vector>

#include "measurement.hpp"
#include "waveform_fit.hpp"

namespace shakedown {

/// Returns all runs of a measurement that swing long enough to be fitted; `every_frame`: without averaging.
std::vector<WaveformRun> waveform_runs(const Measurement& measurement, bool every_frame = false);

/// Returns a start for a fit: the frequency as given (Hz), place, speed and origin of each run by a sine
/// through its first one and a half periods, strengths 0.
Eigen::VectorXd starting_values(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                                double frequency);

/// Returns the minimum near `start`.
WaveformFit fit_waveform(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                         const Eigen::VectorXd& start, const WaveformOptions& options);

/// Returns the same from a start that is right for the first periods only: it fits two periods first, in
/// windows that grow by a factor of 1.4, so that no phase slips.
WaveformFit fit_growing(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                        const Eigen::VectorXd& start, const WaveformOptions& options);

/// Says what one more law does beside a fit, to first order.
struct LawScore {
  double gain = 0;  ///< fall of chi2
  double seen = 0;  ///< share of what it does to the waveform that the fit's own numbers cannot take up
};
/// Returns the score of each of several laws, alone beside the fit.
std::vector<LawScore> scores_of(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                                const std::vector<WaveformLaw>& laws, const WaveformOptions& options);

/// Returns sine and cosine part of a second swing of this frequency (Hz) beside a fit, to first order.
Eigen::Vector2d linear_mode(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                            const WaveformLaw& law, double frequency, const WaveformOptions& options);

/// Returns measured less modelled, m, of each of these runs, which may have more frames than those fitted.
std::vector<Eigen::VectorXd> residuals_of(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                                          const WaveformOptions& options);

/// Returns the setup with what the fit found.
Setup with_laws(Setup setup, const WaveformFit& fit, KnownEffects known);

/// Returns the mean power of the residual a frame, m^2, white noise of deviation s having s^2, from half the
/// swing's frequency (Hz) to three and a half times it: where the laws of a swing act.
double noise_in_band(const WaveformRun& run, const Eigen::VectorXd& residual, double frequency);

}  // namespace shakedown
