// SPDX-License-Identifier: MIT
// Asks the momentum channel which outside forces the setup lacks. It answers from the measured positions
// alone, with no simulation, because whatever happens in the contacts, M x_box'' + N m x_com'' = -k x_box +
// F.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "balance_rules.hpp"
#include "force_shapes.hpp"
#include "judgement.hpp"
#include "known_effects.hpp"
#include "measurement.hpp"
#include "momentum_terms.hpp"
#include "nuisance_found.hpp"

namespace shakedown {

/// Says how good one version of the balance is. The p-value allows for the noise being known to 2 % of its
/// variance only; NaN where it was not or could not be computed, which is never in order.
struct BalanceFit {
  double chi2 = 0, degrees = 0, p_value = std::numeric_limits<double>::quiet_NaN();
  /// Returns chi2 over the degrees of freedom; 0 without any.
  double chi2_per_degree() const { return degrees > 0 ? chi2 / degrees : 0; }
};

/// Describes a term that the data ask for.
struct FoundTerm {
  std::string effect, parameter, unit;
  TermKind kind = TermKind::physics;
  std::string key() const { return effect + "." + parameter; }  ///< "effect.parameter"
  double value = 0, low = 0, high = 0;  ///< of the parameter, SI, 95 % interval; what the setup has included
  double gain = 0;                      ///< rise of chi2 without it
  double frequency = 0, phase = 0;      ///< Hz, rad; of a sine only
  std::vector<std::pair<std::string, double>> besides{};  ///< keys that its presence needs besides, SI
  std::vector<std::string> look_alikes{};  ///< terms whose columns differ by less than the noise can tell
};

/// Holds one term alone, whether it is needed or not, for the ranking.
struct SingleTerm {
  std::string effect;
  double gain = 0, value = 0, error = 0;
};

/// Holds one constant of a formula.
struct FormulaConstant {
  std::string name, unit;
  double value = 0, low = 0, high = 0;  ///< SI, 95 % interval
};

/// Holds a force ready for user_force on the box.
struct ForceFormula {
  std::string formula, sentence;
  std::vector<FormulaConstant> constants;  ///< the strength first
  double gain = 0;                         ///< rise of chi2 without it
  std::vector<std::string> look_alikes;    ///< formulas that fit as well, within the noise
};

/// Holds the force that the known terms leave, as a curve s g(argument) (see ShapeOf) with standard errors.
struct ForceCurve {
  ShapeOf of = ShapeOf::position;
  std::vector<double> argument, value, error;
  double gain = 0;        ///< fall of chi2
  double parameters = 0;  ///< effective number
};

/// Holds the balance of one run.
struct RunBalance {
  std::string run;
  BalanceFit as_given, final_fit;
  double missing_force = 0;        ///< N, rms of the force that the setup lacks, noise taken off
  double missing_force_noise = 0;  ///< N, one standard deviation of a window's mean force
};

/// Holds a set of effects that may be missing, and how probable it is among all sets compared.
struct WeighedSet {
  std::vector<std::string> effects;  ///< empty: nothing is
  double probability = 0;
};

/// Holds another set that the balance cannot rule out; ensembles may.
struct BalanceAlternative {
  double log_odds = 0;  ///< ln of its probability over that of the set found
  std::vector<FoundTerm> terms;
  double frequency = 0, frequency_low = 0, frequency_high = 0;  ///< Hz, of the empty box
  BalanceFit final_fit;
};

/// Holds all that the balance says of a measurement.
struct MomentumAudit {
  bool possible = false;
  std::string why_not;                                          ///< when there is no run with both positions
  BalanceFit as_given;                                          ///< the setup as it is
  BalanceFit refitted;                                          ///< with the spring frequency free
  BalanceFit final_fit;                                         ///< with all terms found
  double frequency = 0, frequency_low = 0, frequency_high = 0;  ///< Hz, of the empty box, in the final fit
  std::vector<FoundTerm> terms;                                 ///< in the order added
  std::vector<SingleTerm> ranking;  ///< each alone beside the free frequency, best first
  std::vector<RunBalance> runs;
  /// A force in no list closes the balance much better than any set of known terms: `formulas` say which,
  /// `terms` what else.
  bool unlisted = false;
  double unlisted_log_odds = 0;  ///< ln odds of the formulas over the best set of known terms
  std::vector<ForceFormula> formulas;
  std::vector<ForceCurve> curves;                ///< where something is unlisted or unexplained, best first
  bool unexplained = false;                      ///< no set of known terms brings the balance into order
  std::vector<std::string> seen;                 ///< keys of all strengths that leave a trace in the balance
  std::vector<BalanceAlternative> alternatives;  ///< most probable first
  std::vector<WeighedSet> sets;                  ///< most probable first, those that hold 99 % together
  double log_odds = 0;                           ///< ln of the first one's probability over that of nothing
  std::vector<NuisanceFound> nuisances;
  Wander wander;           ///< of the track, as the balance shows it
  double white_noise = 0;  ///< m, of a frame, the largest of all runs
  double most_wander = 0;  ///< m, that a track can wander by: what is more is physics that nothing explains
  /// Returns the noise of a frame as a model may leave it, m: white noise, and as much wander as a track can
  /// have.
  double noise() const { return std::hypot(white_noise, std::min(wander.deviation, most_wander)); }
  /// Returns the wander of the tracks as features have it: no more than a track can wander by beside its
  /// white noise.
  Wander wander_of_tracks() const {
    return {std::min(wander.deviation, most_wander_of_noise * white_noise), wander.time};
  }
  /// Tells whether the track wanders by more than three times the white noise of its frames: that is itself
  /// an answer.
  bool wanders_much() const { return wander.deviation > most_wander_of_noise * white_noise; }
  double rest = 0;           ///< m, rms of what remains, as a displacement of the spring
  double rest_as_given = 0;  ///< m, the same of the setup as it is
  double explained = 0;      ///< share of chi2 as given that the final fit takes away
  bool only_moving = false;  ///< windows at rest left out, because a dry friction sticks there
  /// Returns this balance as a test for the judgement. `fit`: of the setup as it is, or of what was found.
  ModelTest test_of(const BalanceFit& fit) const;
};

/// Says how the balance is asked.
struct MomentumOptions {
  double window_periods = 0.6;  ///< length of a window in periods of the empty box (0.5 s at 1.23 Hz)
  double hop = 0.25;            ///< of a window
  double accept_p = 0.01;       ///< below: formulas are looked for
  int most_sines = 2;
  bool formulas = true;                                   ///< false: known terms alone
  std::function<bool()> out_of_time{};                    ///< asked before formulas; may be empty
  std::vector<std::string> effects{};                     ///< only these may be missing; empty: all
  std::optional<Wander> wander{};                         ///< of the track; none: the most probable one
  double lowest_frequency = 0.1, highest_frequency = 10;  ///< Hz, scan for forcing
};

/// Asks the balance of a measurement. `known`: the effects that may be missing.
MomentumAudit audit_momentum(const Measurement& measurement, KnownEffects known,
                             const MomentumOptions& options = {});

}  // namespace shakedown
