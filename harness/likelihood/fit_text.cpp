// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "fit.hpp"
#include "missing_numbers.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

double in_unit(double si, const std::string& unit) { return si / std::get<Unit>(parse_unit(unit)).si; }

Json runs_json(const std::vector<RunComparison>& runs) {
  Json list = Json::array();
  for (const RunComparison& run : runs)
    list.push_back({{"run", run.run},
                    {"error_box_mm", 1e3 * run.error_box},
                    {"spread_box_mm", 1e3 * run.floor_box},
                    {"error_com_mm", run.floor_centre > 0 ? 1e3 * run.error_centre : std::nan("")},
                    {"spread_com_mm", run.floor_centre > 0 ? 1e3 * run.floor_centre : std::nan("")}});
  return list;
}

/// Returns a length in mm; "-" where the grains' centre was not tracked.
std::string of_centre(const RunComparison& run, double metres) {
  return run.floor_centre > 0 ? fmt::format("{:.3f}", 1e3 * metres) : "-";
}

std::string runs_text(const std::string& title, const std::vector<RunComparison>& runs) {
  if (runs.empty()) return "";
  std::string text =
      fmt::format("  {:<22} {:>9} {:>9} {:>12} {:>9}\n", title, "box, mm", "spread", "centre, mm", "spread");
  for (const RunComparison& run : runs)
    text +=
        fmt::format("    {:<20} {:>9.3f} {:>9.3f} {:>12} {:>9}\n", run.run, 1e3 * run.error_box,
                    1e3 * run.floor_box, of_centre(run, run.error_centre), of_centre(run, run.floor_centre));
  return text;
}

}  // namespace

std::string words_of_constant(const Fit& fit) {
  if (!fit.constant) return "";
  std::string what, speeds;
  for (const ContactCurve& curve : fit.curves) {
    what += (what.empty() ? "" : " or ") + std::string(curve.law->coefficient);
    speeds += (speeds.empty() ? "" : " or ") + std::string(curve.law->speed);
  }
  const std::string leaves = fmt::format("{:.2f} times the misfit of its own runs, p = {:.3f}",
                                         fit.constant->scatter, fit.constant->p_value);
  const ConstantBeside& beside = *fit.constant;
  if (beside.standing == Standing::holds)
    return fmt::format("the measurements do not tell whether {} depends on the {}: a constant holds too ({})",
                       what, speeds, leaves);
  if (beside.standing == Standing::undecided || beside.of_curves == Standing::undecided)
    return fmt::format("whether {} depends on the {} is undecided: a constant {} ({})", what, speeds,
                       beside.standing == Standing::undecided ? "neither holds nor fails" : "fails", leaves);
  return beside.of_curves == Standing::holds
             ? fmt::format("the measurements tell that {} depends on the {}: a constant fails ({})", what,
                           speeds, leaves)
             : fmt::format(
                   "more is missing than {} that depends on the {}: with it and with a constant the "
                   "model fails (a constant {})",
                   what, speeds, leaves);
}

std::string fit_json(const Fit& fit) {
  Json parameters = Json::array(), correlation = Json::array();
  for (const FittedParameter& p : fit.parameters)
    parameters.push_back({{"key", p.key},
                          {"unit", p.unit},
                          {"start", in_unit(p.start, p.unit)},
                          {"value", in_unit(p.value, p.unit)},
                          {"low", in_unit(p.low, p.unit)},
                          {"high", in_unit(p.high, p.unit)},
                          {"told", p.told},
                          {"remark", p.remark}});
  for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i) {
    correlation.push_back(Json::array());
    for (Eigen::Index j = 0; j < fit.correlation.cols(); ++j)
      correlation.back().push_back(fit.correlation(i, j));
  }
  Json document{{"schema_version", 1},
                {"parameters", parameters},
                {"correlation", correlation},
                {"p_value", fit.p_value},
                {"scatter", fit.scatter},
                {"holds", fit.judgement.holds()},
                {"standing", std::string(name_of(fit.judgement.standing))},
                {"reason", fit.judgement.reason},
                {"camera", nuisances_json(fit.beside)},
                {"runs_used", runs_json(fit.used)},
                {"runs_left_out", runs_json(fit.left_out)},
                {"simulations", fit.runs},
                {"setup", write_setup(fit.fitted)}};
  for (const ContactCurve& curve : fit.curves)
    document[std::string(curve.law->coefficient) + "_curve"] = Json::parse(curve_json(curve));
  if (fit.constant)
    document["constant_in_place_of_curve"] = {{"p_value", fit.constant->p_value},
                                              {"scatter", fit.constant->scatter},
                                              {"standing", std::string(name_of(fit.constant->standing))}};
  explain_missing_numbers(document, [](const std::string& path) -> std::string {
    if (path == "/p_value") return "an empty box has no ensembles: its waveform is judged";
    if (path.ends_with("com_mm")) return "the grains' centre was not tracked";
    return path.rfind("/correlation/", 0) == 0 ? "the data do not tell one of the two" : "";
  });
  return document.dump(2) + "\n";
}

std::string fit_text(const Fit& fit) {
  std::string text;
  for (const FittedParameter& p : fit.parameters) {
    text += fmt::format("  {:<28} {:.5g}{} (95 %: {:.5g} to {:.5g}; started at {:.5g})\n", p.key,
                        in_unit(p.value, p.unit), p.unit.empty() ? "" : " " + p.unit, in_unit(p.low, p.unit),
                        in_unit(p.high, p.unit), in_unit(p.start, p.unit));
    if (!p.remark.empty()) text += "    " + p.remark + "\n";
  }
  for (Eigen::Index i = 0; i < fit.correlation.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      text +=
          fmt::format("  correlation of {} and {}: {:.2f}\n", fit.parameters[static_cast<std::size_t>(j)].key,
                      fit.parameters[static_cast<std::size_t>(i)].key, fit.correlation(i, j));
  for (const ContactCurve& curve : fit.curves)
    text += "  " + std::string(curve.law->coefficient) + " " + words_of(curve) + "\n";
  if (fit.constant) text += "  " + words_of_constant(fit) + "\n";
  if (std::isfinite(fit.p_value))
    text += fmt::format("  misfit {:.2f} times that of the model's own runs, p = {:.3f}\n", fit.scatter,
                        fit.p_value);
  text += "  fitted model " + fit.judgement.reason + "\n" + nuisances_text(fit.beside);
  for (const RunComparison& run : fit.used) text += validation_text(run.validation);
  text += runs_text("runs fitted", fit.used) + runs_text("runs foretold", fit.left_out);
  return text + (fit.runs > 0 ? fmt::format("  {} simulations, {:.1f} s\n", fit.runs, fit.seconds)
                              : fmt::format("  by the waveform, {:.1f} s\n", fit.seconds));
}

}  // namespace shakedown
