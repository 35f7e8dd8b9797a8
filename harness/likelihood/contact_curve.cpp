// SPDX-License-Identifier: MIT
#include "contact_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "distributions.hpp"
#include "errors.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "physics.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "suggestion.hpp"
#include "toml_string.hpp"

namespace shakedown {

namespace {

using Known = KnownEffects;

constexpr int points = 5;
constexpr double slowest = 0.032, step = 2.5;  // of the box's greatest speed
/// Index of the point at which the curve is 1: slower impacts make between a tenth and four tenths of the
/// losses.
constexpr int reference = 3;

const Parameter& parameter_of_kind(const EffectRecord& record, ParameterKind kind) {
  const auto found = std::find_if(record.parameters.begin(), record.parameters.end(),
                                  [&](const Parameter& parameter) { return parameter.kind == kind; });
  EXPECT(found != record.parameters.end());
  return *found;
}

std::string key_of(const EffectRecord& record, ParameterKind kind) {
  return std::string(record.name) + "." + std::string(parameter_of_kind(record, kind).name);
}

std::string fall(int i) { return "fall_" + std::to_string(i + 1); }

/// Returns the height of a point over that of the reference, as a formula: "1+fall_2+fall_3".
std::string height(int point) {
  std::string text = "1";
  for (int i = point; i < reference; ++i) text += "+" + fall(i);
  for (int i = reference; i < point; ++i) text += "-" + fall(i);
  return text;
}

bool takes_curve(const CurveLaw& law, const EffectRecord& record) {
  return record.acts_on == ActsOn::contact && record.takes_formula() &&
         record.find(law.coefficient) != nullptr;
}

const EffectRecord& formula_or_refuse(const CurveLaw& law, Known known) {
  const EffectRecord* record = formula_for(law, known);
  EXPECT(record != nullptr);
  return *record;
}

/// Returns "user_restitution.constants.", with which the keys of the falls begin.
std::string constants_of(const CurveLaw& law, Known known) {
  return key_of(formula_or_refuse(law, known), ParameterKind::constants) + ".";
}

std::string formula_through(const CurveLaw& law, const std::vector<double>& speeds) {
  const double at = speeds[static_cast<std::size_t>(reference)];
  std::string text = std::string(law.symbol) + "*curve(ln(v/" + fmt::format("{:.4g}", at) + ")";
  for (int i = 0; i < points; ++i)
    text += fmt::format(", {:.4g}, {}", std::log(speeds[static_cast<std::size_t>(i)] / at), height(i));
  return text + ")";
}

/// Returns the coefficients of grain and wall contacts at these speeds, one kind after the other.
Eigen::VectorXd coefficients_of(const CurveLaw& law, const Setup& setup, const std::vector<double>& speeds) {
  const Physics physics = physics_of(setup);
  Eigen::VectorXd list(2 * std::ssize(speeds));
  Eigen::Index i = 0;
  for (const ContactClass kind : {ContactClass::grain_grain, ContactClass::end_wall})
    for (const double speed : speeds) list[i++] = law.of(physics.contact, kind, speed);
  return list;
}

Setup moved(Setup setup, const std::string& keys, double by, Known known) {
  for (const std::string& key : joined_keys(keys))
    set_number(setup, key, get_number(setup, key, known) + by, known);
  return setup;
}

/// Returns the change of each coefficient by one standard error of this value, to the side where it changes
/// more, because coefficients are cut off at their bounds. A side on which a key would leave its bounds
/// counts as no change.
Eigen::VectorXd change_by(const CurveLaw& law, const FittedValue& value, const Setup& fitted,
                          const std::vector<double>& speeds, Known known) {
  const Eigen::VectorXd here = coefficients_of(law, fitted, speeds);
  Eigen::VectorXd most = Eigen::VectorXd::Zero(here.size());
  for (const double side : {1.0, -1.0}) try {
      const Eigen::VectorXd change =
          side * (coefficients_of(law, moved(fitted, value.key, side * value.error, known), speeds) - here);
      most = (change.array().abs() > most.array().abs()).select(change, most);
    } catch (const InputError&) {
    }
  return most;
}

/// Returns by how much the law may differ from the curve between two of its points, as a standard deviation:
/// half of what a step at an unknown place between them makes.
Eigen::VectorXd between_points(const CurveLaw& law, const Setup& fitted, const std::vector<double>& speeds) {
  const std::vector<double> points_at = speeds_of_curve(fitted);
  const Eigen::VectorXd heights = coefficients_of(law, fitted, points_at);
  Eigen::VectorXd error(2 * std::ssize(speeds));
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    const bool of_walls = i >= std::ssize(speeds);
    const double speed = speeds[static_cast<std::size_t>(i - (of_walls ? std::ssize(speeds) : 0))];
    const double place = std::clamp(std::log(speed / points_at.front()) / std::log(step), 0.0, points - 1.0);
    const auto before = std::min<Eigen::Index>(static_cast<Eigen::Index>(place), points - 2);
    const double share = place - static_cast<double>(before);
    const Eigen::Index at = before + (of_walls ? points : 0);
    error[i] = 0.5 * std::abs(heights[at + 1] - heights[at]) * std::sqrt(std::max(0.0, share * (1 - share)));
  }
  return error;
}

std::string words_of(const ContactBand& band, const std::vector<double>& speed, const char* of) {
  const double first = band.value.front(), last = band.value.back();
  constexpr double level = 5e-3;  // the last digit that is told
  const auto at = [](double v) { return write_quantity(std::round(v * 1e3) / 1e3, "m/s"); };
  if (std::abs(first - last) < level) return fmt::format("stays at {:.2f} ({})", last, of);
  return fmt::format("{} from {:.2f} at {} to {:.2f} at {} ({})", first > last ? "falls" : "rises", first,
                     at(speed.front()), last, at(speed.back()), of);
}

}  // namespace

const CurveLaw& restitution_against_speed() {
  static const CurveLaw law{.coefficient = "restitution",
                            .speed = "closing speed",
                            .symbol = "e",
                            .highest = 1,
                            .believed = 0.15,
                            .steepest_rise = -0.4,
                            .steepest_fall = 0.5,
                            .of = [](const ContactLaw& contact, ContactClass kind, double speed) {
                              return contact.restitution_of(kind, speed);
                            }};
  return law;
}

const CurveLaw& friction_against_slip() {
  static const CurveLaw law{.coefficient = "friction",
                            .speed = "slip speed",
                            .symbol = "mu",
                            .highest = std::numeric_limits<double>::infinity(),
                            .believed = 0.25,
                            .steepest_rise = -0.45,
                            .steepest_fall = 0.75,
                            .of = [](const ContactLaw& contact, ContactClass kind, double speed) {
                              return contact.friction_of(kind, Vec3(speed, 0, 0));
                            }};
  return law;
}

const EffectRecord* formula_for(const CurveLaw& law, Known known) {
  for (const EffectRecord* record : known)
    if (takes_curve(law, *record)) return record;
  return nullptr;
}

std::vector<std::string_view> contacts_of_a_curve(const CurveLaw& law, Known known) {
  return parameter_of_kind(formula_or_refuse(law, known), ParameterKind::choice).choices;
}

std::vector<double> speeds_of_curve(const Setup& setup) {
  const double top = 2 * std::numbers::pi * setup.spring.frequency * std::abs(setup.release.displacement);
  if (!(top > 0) || setup.grains.count == 0)
    throw InputError({{{},
                       "a curve against a speed",
                       "has no range of speeds (nothing is let go, or there are no grains)",
                       "give a setup with grains whose box is let go"}});
  std::vector<double> speeds{slowest * top};
  while (std::ssize(speeds) < points) speeds.push_back(step * speeds.back());
  return speeds;
}

namespace {

/// Tells whether the coefficient is 0 in all of these contacts, at this speed (m/s).
bool is_none(const CurveLaw& law, const Setup& setup, const std::string& contacts, double speed) {
  const ContactLaw contact = physics_of(setup).contact;
  for (const ContactClass kind : {ContactClass::grain_grain, ContactClass::end_wall, ContactClass::side_wall})
    if (contacts == "all" || (contacts == "grains") == (kind == ContactClass::grain_grain))
      if (law.of(contact, kind, speed) > 0) return false;
  return true;
}

}  // namespace

Setup with_contact_curve(const CurveLaw& law, const Setup& setup, const std::string& contacts, Known known) {
  const EffectRecord& record = formula_or_refuse(law, known);
  const std::string option = "--" + std::string(law.coefficient) + "-curve";
  const std::vector<std::string_view> possible = contacts_of_a_curve(law, known);
  if (std::find(possible.begin(), possible.end(), contacts) == possible.end())
    throw InputError(
        {{{option, 0, 0}, contacts, "is no kind of contact", "take one of " + listed(possible)}});
  Setup bare = setup;
  std::erase_if(bare.effects,
                [&](const EffectChoice& choice) { return choice.record->claims == record.claims; });
  const std::vector<double> speeds = speeds_of_curve(setup);
  if (is_none(law, bare, contacts, speeds.back()))
    throw InputError({{{option, 0, 0},
                       std::string(law.coefficient),
                       "is 0 in this setup, so no curve can be made of it",
                       "give it a value, and free it beside the curve"}});
  std::string falls;
  for (int i = 0; i + 1 < points; ++i) falls += (i > 0 ? ", " : "") + fall(i) + " = 0";
  const std::string origin = std::string(law.coefficient) + " curve";
  const std::vector<Override> overrides{
      {key_of(record, ParameterKind::choice), contacts, origin},
      {key_of(record, ParameterKind::text), toml_string(formula_through(law, speeds)), origin},
      {key_of(record, ParameterKind::constants), "{" + falls + "}", origin}};
  return with_overrides(std::move(bare), overrides, known);
}

std::string curve_as_toml(const CurveLaw& law, const Setup& setup) {
  for (const EffectChoice& choice : setup.effects)
    if (takes_curve(law, *choice.record)) return write_effect(choice).substr(1);
  return "";
}

std::vector<Knob> knobs_of_curve(const CurveLaw& law, const Setup& setup, Known known) {
  const std::string constants = constants_of(law, known);
  std::vector<Knob> knobs;
  for (int i = 0; i + 1 < points; ++i) {
    const std::string key = constants + fall(i);
    knobs.push_back({key, get_number(setup, key, known), law.believed, law.steepest_rise, law.steepest_fall,
                     true, 0, law.believed});
  }
  return knobs;
}

bool moves_the_level(const CurveLaw& law, const Setup& setup, const std::vector<Knob>& knobs, Known known) {
  constexpr double within_bounds = 0.01;  // so small a step keeps every key where it may be
  const std::vector<double> speeds = speeds_of_curve(setup);
  return std::any_of(knobs.begin(), knobs.end(), [&](const Knob& knob) {
    const FittedValue value{knob.key, knob.centre, knob.low, knob.high, within_bounds * knob.width, false};
    return !change_by(law, value, setup, speeds, known).isZero();
  });
}

std::optional<std::vector<Knob>> held_to_one_side(const CurveLaw& law, std::vector<Knob> knobs,
                                                  const std::vector<FittedValue>& fitted, Known known) {
  const std::string constants = constants_of(law, known);
  double falls = 0, rises = 0;
  for (const FittedValue& value : fitted)
    if (value.key.starts_with(constants)) (value.value > 0 ? falls : rises) += std::abs(value.value);
  if (falls == 0 || rises == 0) return {};
  for (Knob& knob : knobs) {
    if (!knob.key.starts_with(constants)) continue;
    for (const FittedValue& value : fitted)
      if (value.key == knob.key) knob.centre = value.value;
    (falls > rises ? knob.low : knob.high) = 0;
    knob.centre = std::clamp(knob.centre, knob.low, knob.high);
  }
  return knobs;
}

double ContactCurve::low(const ContactBand& band, std::size_t i) const {
  return std::max(0.0, band.value[i] - normal_95 * band.error[i]);
}
double ContactCurve::high(const ContactBand& band, std::size_t i) const {
  return std::min(law->highest, band.value[i] + normal_95 * band.error[i]);
}

ContactCurve contact_curve(const CurveLaw& law, const Setup& fitted, const std::vector<FittedValue>& values,
                           const Eigen::MatrixXd& covariance, Known known) {
  EXPECT(covariance.rows() == std::ssize(values) && covariance.cols() == std::ssize(values));
  constexpr int drawn = 60;  // for the eye
  ContactCurve curve;
  curve.law = &law;
  const std::vector<double> ends = speeds_of_curve(fitted);
  for (int i = 0; i < drawn; ++i)
    curve.speed.push_back(ends.front() * std::pow(ends.back() / ends.front(), i / (drawn - 1.0)));
  const Eigen::VectorXd coefficient = coefficients_of(law, fitted, curve.speed);
  Eigen::MatrixXd slopes(coefficient.size(), std::ssize(values));
  for (std::size_t k = 0; k < values.size(); ++k)
    slopes.col(static_cast<Eigen::Index>(k)) =
        values[k].error > 0 ? change_by(law, values[k], fitted, curve.speed, known) / values[k].error
                            : Eigen::VectorXd::Zero(coefficient.size()).eval();
  Eigen::VectorXd variance = (slopes * covariance * slopes.transpose()).diagonal().cwiseMax(0);
  if (find_choice(fitted, formula_or_refuse(law, known).name) != nullptr)
    variance += between_points(law, fitted, curve.speed).cwiseAbs2();
  ContactBand* const bands[] = {&curve.grains, &curve.walls};
  for (Eigen::Index i = 0; i < coefficient.size(); ++i) {
    ContactBand& band = *bands[i / drawn];
    band.value.push_back(coefficient[i]);
    band.error.push_back(std::sqrt(variance[i]));
  }
  return curve;
}

std::string words_of(const ContactCurve& curve) {
  return words_of(curve.grains, curve.speed, "grains") + ", " + words_of(curve.walls, curve.speed, "walls");
}

}  // namespace shakedown
