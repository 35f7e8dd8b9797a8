// SPDX-License-Identifier: MIT
// The likelihood of a box without grains is its waveform: least squares of the recorded positions on the
// equation of motion, each run with its own place, speed and origin at the first frame, all with one spring
// and one set of strengths.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "known_effects.hpp"
#include "measurement.hpp"
#include "momentum_terms.hpp"

namespace shakedown {

/// A law that may act beside what the setup has: one strength, or a swing of its own that dies away.
struct WaveformLaw {
  MomentumTerm term;
  bool is_mode = false;        ///< a second swing: amplitude (sine and cosine part), frequency, rate
  bool only_waveform = false;  ///< nothing else than a waveform tells it
  std::string family{};        ///< of its record
  std::string frequency_key{}, phase_key{}, rate_key{};  ///< of a second swing
  std::vector<std::string> keys{};  ///< what a user asks for: the value is theirs; empty: the term's key
  /// How many numbers of the fit are its own.
  Eigen::Index width() const { return is_mode ? 4 : 1; }
  bool operator==(const WaveformLaw& other) const;
};

/// One run, frames that are many in a period averaged in groups.
struct WaveformRun {
  std::string name;
  Setup setup;
  std::vector<double> time, x;                              ///< s, m
  double white = 0;                                         ///< m, noise of these frames by the frames alone
  double noise = 0;                                         ///< m, what they are weighed by
  double amplitude = 0;                                     ///< m
  double begin = std::numeric_limits<double>::quiet_NaN();  ///< s, of the first frame as recorded: place and
                                                            ///< speed are those there; NaN: time.front()
  double start_time() const { return std::isfinite(begin) ? begin : time.front(); }
};

/// All runs of a measurement that swing long enough to be fitted; `every_frame`: without averaging.
std::vector<WaveformRun> waveform_runs(const Measurement& measurement, bool every_frame = false);

/// Values at a minimum.
struct WaveformFit {
  std::vector<WaveformLaw> laws;
  /// Three a run (place, speed, origin), the spring's frequency in Hz, then each law's.
  Eigen::VectorXd value;
  Eigen::MatrixXd covariance;  ///< of `value`, with the runs' noise
  double chi2 = 0;
  Eigen::Index frames = 0;
  std::vector<Eigen::VectorXd> residual;  ///< m, of each run
  bool possible = false;                  ///< the model can be simulated

  Eigen::Index first_of(std::size_t law) const;  ///< index of its first value
  double frequency() const { return value[static_cast<Eigen::Index>(3 * residual.size())]; }
  double rms() const;  ///< m, over all frames
};

struct WaveformOptions {
  KnownEffects known;
  int evaluations = 40;  ///< of the model with its derivatives, at most
  bool free_frequency = true;
  double believed_frequency = 0, believed_error = 0;  ///< Hz, beforehand; no error: nothing is
  double until = 1e300;                               ///< s from the first frame of each run
  int threads = 1;                                    ///< the fit does not depend on it
};

/// A start for a fit: frequency as given (Hz), places and speeds from the first half period, strengths small.
Eigen::VectorXd starting_values(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                                double frequency);

/// The minimum near `start`.
WaveformFit fit_waveform(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                         const Eigen::VectorXd& start, const WaveformOptions& options);

/// The same from a start that is right for the first periods only: in windows that grow by a half, so that no
/// phase slips.
WaveformFit fit_growing(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                        const Eigen::VectorXd& start, const WaveformOptions& options);

/// One more law beside a fit, to first order; each of several alone.
struct LawScore {
  double gain = 0;  ///< fall of chi2
  double seen = 0;  ///< share of what it does to the waveform that the fit's own numbers cannot take up
};
std::vector<LawScore> scores_of(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                                const std::vector<WaveformLaw>& laws, const WaveformOptions& options);

/// Sine and cosine part of a second swing of this frequency beside a fit, to first order.
Eigen::Vector2d linear_mode(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                            const WaveformLaw& law, double frequency, const WaveformOptions& options);

/// Measured less modelled, m, of each of these runs, which may have more frames than those fitted.
std::vector<Eigen::VectorXd> residuals_of(const std::vector<WaveformRun>& runs, const WaveformFit& fit,
                                          const WaveformOptions& options);

/// The setup with what the fit found.
Setup with_laws(Setup setup, const WaveformFit& fit, KnownEffects known);

/// Mean power of the residual a frame, m^2, white noise of deviation s having s^2, from half the swing's
/// frequency to three and a half times it: where the laws of a swing act.
double noise_in_band(const WaveformRun& run, const Eigen::VectorXd& residual, double frequency);

}  // namespace shakedown
