// SPDX-License-Identifier: MIT
// Describes a coefficient of the contacts as a function of a speed without assuming its form: by a curve
// through a few points, whose heights are fitted like any other parameter.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator.hpp"
#include "known_effects.hpp"
#include "physics.hpp"
#include "refit_result.hpp"

namespace shakedown {

/// Says which coefficient has a curve, and what is believed of the curve beforehand.
struct CurveLaw {
  std::string_view coefficient;  ///< "restitution": also the effect's parameter that takes the formula
  std::string_view speed;        ///< "closing speed"
  std::string_view symbol;       ///< "e", which stands for the setup's own value in the formula
  double highest = 1;            ///< upper bound of the coefficient
  double believed = 0;           ///< standard deviation of each fall, over the height at the reference
  /// Bounds of a fall: about three times what is believed, less on the rising side, where the heights below
  /// the reference would come to nothing.
  double steepest_rise = 0, steepest_fall = 0;
  double (*of)(const ContactLaw&, ContactClass, double speed) = nullptr;
};

/// Returns the law of restitution against the closing speed. A fully plastic contact (speed to the power of
/// -1/4: K. L. Johnson, Contact Mechanics, 1985) falls by 0.2 where the speed rises by a factor of 2.5, a
/// viscoelastic one of restitution 0.75 by 0.06.
const CurveLaw& restitution_against_speed();

/// Returns the law of the coefficient of friction against the slip speed. Where a film of lubricant carries
/// the contact, the coefficient halves or doubles within a decade of speed (R. Stribeck, Z. VDI 46, 1341
/// (1902)): by 0.25 where the speed rises by a factor of 2.5; dry metals change by a tenth of that. The
/// coefficient has no upper bound.
const CurveLaw& friction_against_slip();

/// Returns the effect of the list that takes a formula for this coefficient; null where there is none.
const EffectRecord* formula_for(const CurveLaw& law, KnownEffects known);

/// Returns the contacts that a curve may be for ("all", "grains", "walls"), by the names of that effect.
std::vector<std::string_view> contacts_of_a_curve(const CurveLaw& law, KnownEffects known);

/// Returns the speeds of the curve's points, m/s, ascending: from 0.032 to 1.25 of the box's greatest speed,
/// each 2.5 times the one before. In twelve seconds of the paper's damper 98 % of what impacts dissipate lies
/// between closing speeds of 0.028 and 0.71 of it in a box of 40 mm, of 0.07 and 1.56 in one of 104 mm.
/// Throws InputError where the setup has no such speed.
std::vector<double> speeds_of_curve(const Setup& setup);

/// Returns the setup with such a curve for these contacts, level to begin with: the coefficient is the
/// setup's times the curve, which is 1 at the point before the last and falls by fall_1, fall_2 ... from one
/// point to the next. An effect that claims the same part of the model is removed. Throws InputError for
/// contacts that do not exist, and where the setup's coefficient is 0.
Setup with_contact_curve(const CurveLaw& law, const Setup& setup, const std::string& contacts,
                         KnownEffects known);

/// Returns the effect that has the curve as lines of a setup file; empty where there is none.
std::string curve_as_toml(const CurveLaw& law, const Setup& setup);

/// Returns a knob for each fall of the setup's curve, with what is believed of it beforehand.
std::vector<Knob> knobs_of_curve(const CurveLaw& law, const Setup& setup, KnownEffects known);

/// Tells whether one of these knobs moves the coefficient. Where none does, a curve would stand for its level
/// too.
bool moves_the_level(const CurveLaw& law, const Setup& setup, const std::vector<Knob>& knobs,
                     KnownEffects known);

/// Returns the knobs bounded so that the curve only falls, or only rises, whichever the fitted one does more;
/// nothing where the fitted curve already does only one of the two.
std::optional<std::vector<Knob>> held_to_one_side(const CurveLaw& law, std::vector<Knob> knobs,
                                                  const std::vector<FittedValue>& fitted, KnownEffects known);

/// Holds the coefficient of one kind of contact and its standard error, at each speed.
struct ContactBand {
  std::vector<double> value, error;
};
struct ContactCurve {
  const CurveLaw* law = nullptr;
  std::vector<double> speed;  ///< m/s, ascending
  ContactBand grains, walls;
  double low(const ContactBand& band, std::size_t i) const;   ///< low end of the 95 % interval, not below 0
  double high(const ContactBand& band, std::size_t i) const;  ///< high end, not above the law's highest
};

/// Returns what a fit tells of the coefficient at 60 speeds over the range of speeds_of_curve(), whichever
/// effects make it. `fitted`: the fitted setup; `values`, `covariance`: its parameters and their covariance,
/// in their units. Between the points of a curve the error includes half of what a step at an unknown place
/// there would make.
ContactCurve contact_curve(const CurveLaw& law, const Setup& fitted, const std::vector<FittedValue>& values,
                           const Eigen::MatrixXd& covariance, KnownEffects known);

/// Returns the curve in words: "falls from 0.91 at 0.027 m/s to 0.62 at 1.039 m/s (grains), falls from ...
/// (walls)".
std::string words_of(const ContactCurve& curve);

/// Returns the curve as JSON: the speeds (closing_speed_m_per_s or slip_speed_m_per_s), and for grains and
/// walls the coefficient under its name with low and high of its 95 % interval, at each speed.
std::string curve_json(const ContactCurve& curve);

}  // namespace shakedown
