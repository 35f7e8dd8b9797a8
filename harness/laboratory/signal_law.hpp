// SPDX-License-Identifier: MIT
// Measures how much of a signal a hidden strength leaves once everything that the user may refit has been
// refitted.
#pragma once
#include <algorithm>
#include <limits>
#include <vector>

#include "hideable.hpp"

namespace shakedown {

/// Says what is filmed and how much is simulated.
struct SignalSettings {
  std::vector<PlannedRun> runs;
  int count = 96;  ///< simulations of each different setup and round
  /// Where the momentum balance sees more than this the ensembles are not asked.
  double enough = std::numeric_limits<double>::infinity();
};

/// Holds the nonlinear-profile signal to noise: sqrt of what chi2 keeps above its expectation after
/// restitutions and frequency have been refitted without the effect.
struct Signal {
  double by_balance = 0, by_ensembles = 0;
  double most() const { return std::max(by_balance, by_ensembles); }  ///< the larger of the two
};

/// Returns the signal of the hidden case, measured with a camera of the default noise. Of a force in no list
/// it is what the balance keeps with the known effects that imitate it best, since no method can miss an
/// effect whose place another takes.
Signal signal_to_noise(const HiddenCase& hidden, std::uint64_t seed, const SignalSettings& settings,
                       const TrialTools& tools);

/// Returns how far what is hidden and its best imitation by another effect lie apart in these runs, standard
/// errors: sqrt of how much more chi2 the imitation leaves, restitutions, frequency and strength refitted,
/// than the hidden effect itself, so with the truth given. By the balance where it sees both, else by
/// ensembles. The setup of `hidden` has that one effect; nobody tells two apart that lie less than two or
/// three standard errors from each other.
double distance_of_imitation(const HiddenCase& hidden, const std::string& imitation, std::uint64_t seed,
                             const SignalSettings& settings, const TrialTools& tools);

/// Describes signal to noise against strength: signal (strength / here)^power, from two measurements. What
/// the balance sees is proportional to the strength and to the inverse of the camera's noise. Inside the
/// contacts a refit takes up the first order, so that the power may be two, and chaos from run to run is
/// larger than the camera's noise.
struct SignalLaw {
  double strength = 1, signal = 0;
  double power = 1;
  bool by_balance = false;

  double signal_at(double strength_of_it, double noise) const;  ///< noise: the camera's over the default's
  /// Returns the strength that has this signal.
  double strength_for(double signal_wanted, double noise) const;
};

/// Measures the law near a signal of 20, where it is well above its own error, and at half that strength. Of
/// an effect on box or grains it is ideal_signal(): of a judge who knows the form and owes nothing to any
/// diagnosis. Of an error of the camera and of a force in no list it is signal_to_noise().
SignalLaw signal_law(const Hideable& hideable, const Setup& believed, std::uint64_t seed,
                     const SignalSettings& settings, const TrialTools& tools);

/// Returns what the momentum balance makes of a camera's noise, over what it makes of the default's: the
/// box's counts with its mass, the centre's with that of the grains.
double relative_noise(const RecordingSettings& recording, const Setup& setup);

}  // namespace shakedown
