// SPDX-License-Identifier: MIT
#include "bounce_answer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "known_value.hpp"
#include "quantity.hpp"

namespace shakedown {

namespace {

constexpr double surely = 0.95;  // scatter of this probability is named in a sentence

std::string with_interval(const Estimate& value, int digits) {
  return fmt::format("{:.{}f} ({:.{}f} to {:.{}f})", value.value, digits, value.low, digits, value.high,
                     digits);
}

std::string row_of_law(const BounceAnswer& answer, std::size_t i) {
  const LawFit& law = answer.laws[i];
  const LawTest& test = answer.tests[i];
  std::string text = fmt::format("  {:6.1f} %  {:<22}", 100 * law.probability, law.name());
  text += std::isfinite(test.p_value) ? fmt::format(" p {:<8.2g}", test.p_value) : " p -       ";
  for (std::size_t k = 0; k < law.values.size(); ++k)
    text += fmt::format("  {} {}", law.parameters[k].name, with_interval(law.values[k], 4));
  return text + "\n";
}

std::string spread_text(const std::string& name, const Estimate& value, double scale, const std::string& unit,
                        double odds) {
  if (!std::isfinite(value.value)) return "";
  return fmt::format("  {:<34} {:.3g} ({:.3g} to {:.3g}){}{}\n", name, value.value * scale, value.low * scale,
                     value.high * scale, unit,
                     odds < 1 ? fmt::format(", if there is any ({:.1f} %)", 100 * odds) : "");
}

std::string outliers_text(const BounceReading& reading) {
  if (reading.answer.outliers.empty()) return "  no impact stands out\n";
  std::string text;
  for (const Outlier& outlier : reading.answer.outliers)
    text += fmt::format("    {}: {}{}\n", place_of(reading.read.drops[outlier.drop], outlier.impact),
                        outlier.reason,
                        outlier.sigmas != 0 ? fmt::format(" ({:.1f} sigma)", std::abs(outlier.sigmas)) : "");
  return fmt::format("  left out, {} of {} impacts:\n", reading.answer.outliers.size(),
                     reading.answer.laws[0].at.rows.size() + reading.answer.outliers.size()) +
         text;
}

std::string standing_text(const BounceAnswer& answer) {
  const LawTest& test = answer.test;
  if (!std::isfinite(test.p_value)) return "too few impacts to test it";
  return fmt::format(
      "{} free bends beside it lower chi2 from {:.1f} to {:.1f} ({:.0f} degrees), p = {:.2g}{}", test.bends,
      test.chi2, test.chi2 - test.gain, test.degrees, test.p_value,
      std::isfinite(test.chi2_by_timing)
          ? fmt::format("; chi2 a degree by the timing stated alone {:.3g}", test.chi2_by_timing)
          : "");
}

/// Describes a ball that has this drag per mass, for people.
std::string drag_in_words(double log_drag) {
  const double drag = std::exp(log_drag);
  return fmt::format("drag {:.3g}/m, terminal speed {:.0f} m/s", drag, std::sqrt(9.81 / drag));
}

}  // namespace

std::string place_of(const Drop& drop, int impact) {
  return fmt::format("{}{}{}, impact {}", drop.file, drop.name.empty() ? "" : ", ", drop.name, impact);
}

std::vector<double> speeds_told(const BounceAnswer& answer) {
  constexpr int count = 6;
  std::vector<double> speeds;
  for (int i = 0; i < count; ++i)
    speeds.push_back(answer.slowest *
                     std::pow(answer.fastest / answer.slowest, i / static_cast<double>(count - 1)));
  return speeds;
}

BounceReading weigh_drops(ReadDrops read, const BounceOptions& options) {
  BounceReading reading{std::move(read), options, {}, {}};
  reading.answer = choose_law(reading.read.drops, options);
  BounceModel curve = reading.answer.best().model;
  curve.law = LawKind::curve;
  curve.air = AirModel::none;
  curve.ball.reset();
  reading.as_timed = fit_law(reading.answer.flights, curve, options.timing);
  return reading;
}

std::string sentence_of(const BounceReading& reading) {
  const BounceAnswer& answer = reading.answer;
  const LawFit& best = answer.best();
  const Estimate slow = best.restitution_at(answer.slowest), fast = best.restitution_at(answer.fastest);
  std::string text = best.model.law == LawKind::constant
                         ? fmt::format("The restitution is {} from {:.2f} to {:.2f} m/s",
                                       with_interval(slow, 3), answer.slowest, answer.fastest)
                         : fmt::format("The restitution {} from {} at {:.2f} m/s to {} at {:.2f} m/s",
                                       fast.value < slow.value ? "falls" : "rises", with_interval(slow, 3),
                                       answer.slowest, with_interval(fast, 3), answer.fastest);
  text += best.model.law == LawKind::curve
              ? fmt::format(", by no law of the list ({:.0f} %)", 100 * best.probability)
              : fmt::format(", by the law {} ({:.0f} %)", best.name(), 100 * best.probability);
  if (best.model.law != LawKind::curve && !answer.holds()) text += ", which does not hold";
  const Estimate scatter = best.posterior.spread(&SpreadNode::scatter);
  if (answer.scatter_odds > surely)
    text += fmt::format("; it scatters by {} from impact to impact", with_interval(scatter, 4));
  if (best.model.air == AirModel::free) {
    const Estimate first = reading.as_timed.restitution_at(answer.slowest),
                   last = reading.as_timed.restitution_at(answer.fastest);
    text += fmt::format(
        "; as timed, with what the air takes, flights follow each other by {:.3f} at {:.2f} m/s and {:.3f} "
        "at {:.2f} m/s",
        first.value, answer.slowest, last.value, answer.fastest);
  }
  return text + ".";
}

std::string bounce_text(const BounceReading& reading) {
  const BounceAnswer& answer = reading.answer;
  const LawFit& best = answer.best();
  std::string text = sentence_of(reading) + "\n\n";
  for (const std::string& note : reading.read.notes) text += "  " + note + "\n";
  text += fmt::format(
      "\n  probability of the laws (parameters with 95 % intervals, reference speed {:.3g} m/s)\n",
      answer.reference);
  for (std::size_t i = 0; i < answer.laws.size(); ++i)
    if (i < 3 || answer.laws[i].probability > 1e-3) text += row_of_law(answer, i);
  text += fmt::format("  {} {}: {}\n", best.name(), answer.holds() ? "holds" : "does not hold",
                      standing_text(answer));
  if (best.model.air == AirModel::free)
    text += fmt::format("  size and mass were not said (--diameter, --mass): the flights want {}\n",
                        drag_in_words(best.values[law_of(best.model.law).parameters.size()].value));
  text +=
      "\n  restitution by that law, averaged over the laws, and the ratio of flights as timed (with what the "
      "air takes)\n";
  for (const double speed : speeds_told(answer))
    text +=
        fmt::format("    {:6.3f} m/s  {}   {}   {}\n", speed, with_interval(best.restitution_at(speed), 4),
                    with_interval(answer.averaged_at(speed), 4),
                    with_interval(reading.as_timed.restitution_at(speed), 4));
  text += "\n";
  text +=
      spread_text("timing noise of an instant", best.posterior.spread(&SpreadNode::timing), 1e3, " ms", 1);
  text += spread_text("scatter from impact to impact", best.posterior.spread(&SpreadNode::scatter), 1, "",
                      answer.scatter_odds);
  text += spread_text("scatter from drop to drop", best.posterior.spread(&SpreadNode::drop_scatter), 1, "",
                      answer.drop_scatter_odds);
  return text + outliers_text(reading);
}

std::string effect_lines(const BounceReading& reading) {
  const BounceAnswer& answer = reading.answer;
  const LawFit& best = answer.best();
  std::string text;
  const std::string at = write_quantity(answer.reference, "m/s");
  const auto effect = [&](const std::string& law, const std::string& more) {
    text += "[[effect]]\nname = \"velocity_dependent_restitution\"\nlaw = \"" + law + "\"\n" + more +
            "reference_speed = \"" + at + "\"\n";
  };
  if (best.model.law == LawKind::viscoelastic) effect("viscoelastic", "");
  const Estimate scatter = best.posterior.spread(&SpreadNode::scatter);
  if (answer.scatter_odds > surely && std::isfinite(scatter.value))
    text += fmt::format("{}[[effect]]\nname = \"fluctuating_restitution\"\ndeviation = {:.3g}\n",
                        text.empty() ? "" : "\n", scatter.value);
  return text;
}

/// Returns the exponent as a number of the effect, at the speed at which the restitution is told; empty for
/// laws that have none.
std::string exponent_lines(const BounceReading& reading) {
  const LawFit& best = reading.answer.best();
  const bool is_power = best.model.law == LawKind::power;
  if (!is_power && best.model.law != LawKind::plastic) return "";
  const double value = is_power ? best.values[1].value : 0.25,
               error = is_power ? best.values[1].standard_error() : 0;
  return fmt::format(
      "\"velocity_dependent_restitution.exponent\" = \"{:.4g} +- {:.2g}\"\n"
      "\"velocity_dependent_restitution.reference_speed\" = \"{} +- 0\"\n",
      value, error, write_quantity(reading.answer.reference, "m/s"));
}

std::string behind_hashes(const std::string& lines) {
  std::string text;
  for (std::size_t from = 0; from < lines.size();) {
    const std::size_t end = lines.find('\n', from);
    text += (end == from ? "#" : "# ") + lines.substr(from, end - from) + "\n";
    from = end + 1;
  }
  return text;
}

std::string known_lines(const BounceReading& reading, const std::string& contact) {
  const BounceAnswer& answer = reading.answer;
  const Estimate value = answer.averaged_at(answer.reference);
  const auto rounded = [](double number) { return std::round(number * 1e5) / 1e5; };
  const KnownValue known{
      "restitution." + contact, rounded(value.value), std::max(1e-5, rounded(value.standard_error())), {}};
  std::string text = "# " + sentence_of(reading) + "\n";
  text += fmt::format(
      "# Measured from {:.3g} to {:.3g} m/s; the value is that at {:.3g} m/s, averaged over the laws.\n",
      answer.slowest, answer.fastest, answer.reference);
  text += "[known]\n" + known_line(known) + "\n";
  if (const std::string exponent = exponent_lines(reading); !exponent.empty()) {
    const double probability = answer.best().probability;
    if (probability >= surely)
      text += exponent;
    else
      text += fmt::format("# The law {} has {:.0f} %; for it take the # away:\n", answer.best().name(),
                          100 * probability) +
              behind_hashes(exponent);
  }
  const std::string law = effect_lines(reading);
  if (law.empty()) return text;
  return text + "\n# The law, for the setup (take the # away):\n" + behind_hashes(law);
}

}  // namespace shakedown
