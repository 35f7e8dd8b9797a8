// SPDX-License-Identifier: MIT
// Restitution as a function of the closing speed of which no form is assumed: a curve through a few points,
// whose heights are fitted like any other parameter.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "emulator.hpp"
#include "refit.hpp"

namespace shakedown {

/// The effect of the list that takes a formula for restitutions; null: there is none.
const EffectRecord* restitution_formula(std::span<const EffectRecord* const> known);

/// What the curve may be of ("all", "grains", "walls"), as that effect names it.
std::vector<std::string_view> contacts_of_a_curve(std::span<const EffectRecord* const> known);

/// Closing speeds of the curve's points, m/s, ascending: 0.032 to 1.25 of the box's greatest speed, each 2.5
/// times the one before. Of what impacts dissipate in twelve seconds of the paper's damper 98 % lies between
/// 0.028 and 0.71 of it in a box of 40 mm, between 0.07 and 1.56 in one of 104 mm. Throws InputError where
/// the setup has no such speed.
std::vector<double> speeds_of_curve(const Setup& setup);

/// The setup with such a curve, level, for these contacts: the restitution is the setup's times the curve,
/// which is 1 at the point before the last and falls by fall_1, fall_2 ... from one point to the next. An
/// effect that claims the same part of the model goes. Throws InputError for contacts that there are not.
Setup with_restitution_curve(const Setup& setup, const std::string& contacts,
                             std::span<const EffectRecord* const> known);

/// The effect with the curve, as lines of a setup; empty where there is none.
std::string curve_as_toml(const Setup& setup);

/// The falls, level to begin with. Beforehand each is 0 +- 0.15: a fully plastic contact (speed to the power
/// of -1/4: K. L. Johnson, Contact Mechanics, 1985) falls by 0.2 where the speed rises by 2.5, a viscoelastic
/// one of restitution 0.75 by 0.06.
std::vector<Knob> knobs_of_curve(const Setup& setup, std::span<const EffectRecord* const> known);

/// Where the curve of a fit falls here and rises there: the knobs held to one side, for a law that only
/// falls, or only rises, whichever this one does more. Nothing where it does so already.
std::optional<std::vector<Knob>> held_to_one_side(std::vector<Knob> knobs,
                                                  const std::vector<FittedValue>& fitted,
                                                  std::span<const EffectRecord* const> known);

/// Restitutions of one kind of contact with their standard error, at each speed.
struct RestitutionBand {
  std::vector<double> restitution, error;
  double low(std::size_t i) const;   ///< of the 95 % interval, not below 0
  double high(std::size_t i) const;  ///< not above 1
};
struct RestitutionCurve {
  std::vector<double> speed;  ///< m/s, ascending
  RestitutionBand grains, walls;
};

/// What a fit tells of restitution at each speed, over the range of speeds_of_curve(), whichever effects make
/// it: from the fitted setup, the values of its parameters and their covariance (in the values' units).
/// Between the points of a curve the error has half of what a step at an unknown place there would make.
RestitutionCurve restitution_curve(const Setup& fitted, const std::vector<FittedValue>& values,
                                   const Eigen::MatrixXd& covariance,
                                   std::span<const EffectRecord* const> known);

/// "falls from 0.91 at 0.027 m/s to 0.62 at 1.039 m/s (grains), falls from ... (walls)".
std::string words_of(const RestitutionCurve& curve);

/// As JSON: closing_speed_m_per_s, and of grains and walls restitution, low and high of the 95 % interval at
/// each.
std::string curve_json(const RestitutionCurve& curve);

}  // namespace shakedown
