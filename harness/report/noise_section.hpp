// SPDX-License-Identifier: MIT
#pragma once
#include "measurement.hpp"
#include "report.hpp"

namespace shakedown {

/// Density of the track's amplitude, from the frames alone.
struct TrackSpectrum {
  std::vector<double> frequency;  ///< Hz, up to half the frame rate
  std::vector<double> density;    ///< m/sqrt(Hz)
};
/// Finds it from positions `x` (m, NaN where missing) in even frames, `interval` s apart: means over windows
/// of 512 frames or, of a shorter run, of half of them, each weighed by the four terms of Blackman and
/// Harris, so that a swing does not spill over noise (F. J. Harris, Proc. IEEE 66, 51 (1978)). Missing frames
/// lie on the straight line between their neighbours. Empty: fewer than 64 frames.
TrackSpectrum spectrum_of_track(const std::vector<double>& x, double interval);

/// Returns the same density, m/sqrt(Hz), of noise as it was found: its deviation, and its memory from frame
/// to frame.
double density_of(const NoiseFound& noise, double interval, double frequency);

/// Shows the noise of each run against time, and its spectrum.
ReportSection noise_section(const Measurement& measurement);

}  // namespace shakedown
