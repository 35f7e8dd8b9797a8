// SPDX-License-Identifier: MIT
// A coefficient of the contacts as a function of a speed of which no form is assumed: a curve through a few
// points, whose heights are fitted like any other parameter.
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
#include "refit.hpp"

namespace shakedown {

/// Which coefficient, and what is believed of its curve beforehand.
struct CurveLaw {
  std::string_view coefficient;  ///< "restitution"; so is called the formula of the effect that takes it
  std::string_view speed;        ///< "closing speed"
  std::string_view symbol;       ///< of the setup's own value in the formula
  double highest = 1;            ///< the coefficient is not above
  double believed = 0;           ///< each fall is 0 +- this, over the height at the reference
  /// Bounds of a fall: three times what is believed, less to the rising side, where the heights below the
  /// reference would come to nothing.
  double steepest_rise = 0, steepest_fall = 0;
  double (*of)(const ContactLaw&, ContactClass, double speed) = nullptr;
};

/// Restitution against the closing speed. A fully plastic contact (speed to the power of -1/4: K. L. Johnson,
/// Contact Mechanics, 1985) falls by 0.2 where the speed rises by 2.5, a viscoelastic one of restitution 0.75
/// by 0.06.
const CurveLaw& restitution_against_speed();

/// The coefficient of friction against the slip speed. Where a film of lubricant carries it halves or doubles
/// within a decade (R. Stribeck, Z. VDI 46, 1341 (1902)): by 0.25 where the speed rises by 2.5; dry metals
/// change by a tenth of that. The coefficient has no bound above.
const CurveLaw& friction_against_slip();

/// The effect of the list that takes a formula for this coefficient; null: there is none.
const EffectRecord* formula_for(const CurveLaw& law, KnownEffects known);

/// What the curve may be of ("all", "grains", "walls"), as that effect names it.
std::vector<std::string_view> contacts_of_a_curve(const CurveLaw& law, KnownEffects known);

/// Speeds of the curve's points, m/s, ascending: 0.032 to 1.25 of the box's greatest speed, each 2.5
/// times the one before. Of what impacts dissipate in twelve seconds of the paper's damper 98 % lies between
/// closing speeds of 0.028 and 0.71 of it in a box of 40 mm, of 0.07 and 1.56 in one of 104 mm. Throws
/// InputError where the setup has no such speed.
std::vector<double> speeds_of_curve(const Setup& setup);

/// The setup with such a curve, level, for these contacts: the coefficient is the setup's times the curve,
/// which is 1 at the point before the last and falls by fall_1, fall_2 ... from one point to the next. An
/// effect that claims the same part of the model goes. Throws InputError for contacts that there are not, and
/// where the setup's coefficient is 0.
Setup with_contact_curve(const CurveLaw& law, const Setup& setup, const std::string& contacts,
                         KnownEffects known);

/// The effect with the curve, as lines of a setup; empty where there is none.
std::string curve_as_toml(const CurveLaw& law, const Setup& setup);

/// The falls, level to begin with, as believed beforehand.
std::vector<Knob> knobs_of_curve(const CurveLaw& law, const Setup& setup, KnownEffects known);

/// Whether one of these knobs moves the coefficient: where none does a curve would stand for its level too.
bool moves_the_level(const CurveLaw& law, const Setup& setup, const std::vector<Knob>& knobs,
                     KnownEffects known);

/// Where the curve of a fit falls here and rises there: the knobs held to one side, for a law that only
/// falls, or only rises, whichever this one does more. Nothing where it does so already.
std::optional<std::vector<Knob>> held_to_one_side(const CurveLaw& law, std::vector<Knob> knobs,
                                                  const std::vector<FittedValue>& fitted, KnownEffects known);

/// The coefficient of one kind of contact with its standard error, at each speed.
struct ContactBand {
  std::vector<double> value, error;
};
struct ContactCurve {
  const CurveLaw* law = nullptr;
  std::vector<double> speed;  ///< m/s, ascending
  ContactBand grains, walls;
  double low(const ContactBand& band, std::size_t i) const;   ///< of the 95 % interval, not below 0
  double high(const ContactBand& band, std::size_t i) const;  ///< not above the law's highest
};

/// What a fit tells of the coefficient at each speed, over the range of speeds_of_curve(), whichever effects
/// make it: from the fitted setup, the values of its parameters and their covariance (in the values' units).
/// Between the points of a curve the error has half of what a step at an unknown place there would make.
ContactCurve contact_curve(const CurveLaw& law, const Setup& fitted, const std::vector<FittedValue>& values,
                           const Eigen::MatrixXd& covariance, KnownEffects known);

/// "falls from 0.91 at 0.027 m/s to 0.62 at 1.039 m/s (grains), falls from ... (walls)".
std::string words_of(const ContactCurve& curve);

/// As JSON: the speed (closing_speed_m_per_s or slip_speed_m_per_s), and of grains and walls the coefficient
/// by its name, low and high of the 95 % interval at each.
std::string curve_json(const ContactCurve& curve);

}  // namespace shakedown
