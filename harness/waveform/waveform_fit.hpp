// SPDX-License-Identifier: MIT
// Describes what a fit of waveforms is made of: laws, runs, options, and the values at a minimum.
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "known_effects.hpp"
#include "momentum_terms.hpp"
#include "setup.hpp"

namespace shakedown {

/// Describes a law that may act beside what the setup has: one strength, or a swing of its own that dies
/// away.
struct WaveformLaw {
  MomentumTerm term;
  bool is_mode = false;        ///< a second swing: amplitude (sine and cosine part), frequency, rate
  bool only_waveform = false;  ///< nothing else than a waveform tells it
  std::string family{};        ///< of its record
  std::string frequency_key{}, phase_key{}, rate_key{};  ///< of a second swing
  std::vector<std::string> keys{};  ///< what a user asks for: the value is theirs; empty: the term's key
  /// Returns how many numbers of the fit are its own.
  Eigen::Index width() const { return is_mode ? 4 : 1; }
  bool operator==(const WaveformLaw& other) const;
};

/// Holds one run; frames that are many in a period are averaged in groups.
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

/// Holds the values at a minimum.
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
  /// Returns the frequency of the spring, Hz.
  double frequency() const { return value[static_cast<Eigen::Index>(3 * residual.size())]; }
  double rms() const;  ///< m, over all frames
};

/// Says how a waveform is fitted.
struct WaveformOptions {
  KnownEffects known;
  int evaluations = 40;  ///< of the model with its derivatives, at most
  bool free_frequency = true;
  double believed_frequency = 0, believed_error = 0;  ///< Hz, beforehand; no error: nothing is
  double until = 1e300;                               ///< s from the first frame of each run
  int threads = 1;                                    ///< the fit does not depend on it
};

}  // namespace shakedown
