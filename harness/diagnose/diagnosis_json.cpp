// SPDX-License-Identifier: MIT
#include <nlohmann/json.hpp>

#include "diagnosis.hpp"
#include "last_fit.hpp"
#include "missing_numbers.hpp"
#include "setup_file.hpp"
#include "unlisted_force.hpp"
#include "validation.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

/// Returns the number; one that is none becomes null with a reason later (explain_missing_numbers).
Json number(double value) { return value; }

std::string reason_of(const Diagnosis& d, const std::string& path) {
  const auto is = [&](std::string_view part) { return path.find(part) != std::string::npos; };
  if (is("held_out") || is("standard_error"))
    return "one box length only, or not fitted: nothing was left out to be predicted";
  if (is("/momentum/") && !d.momentum.possible) return "no momentum balance: " + d.momentum.why_not;
  return "";
}

Json sets_json(const std::vector<Hypothesis>& hypotheses) {
  Json list = Json::array();
  for (const Hypothesis& h : hypotheses)
    list.push_back({{"effects", h.effects}, {"probability", number(h.probability)}});
  return list;
}

Json left_json(const std::vector<Difference>& left) {
  Json list = Json::array();
  for (const Difference& one : left)
    list.push_back({{"of", one.of},
                    {"error_mm", number(one.error * 1e3)},
                    {"floor_mm", number(one.floor * 1e3)},
                    {"share_of_amplitude", number(one.error / one.amplitude)},
                    {"looks_like", one.looks_like}});
  return list;
}

Json momentum_json(const MomentumAudit& audit) {
  Json terms = Json::array();
  for (const FoundTerm& term : audit.terms)
    terms.push_back({{"effect", term.effect},
                     {"parameter", term.parameter},
                     {"value", number(term.value)},
                     {"low", number(term.low)},
                     {"high", number(term.high)},
                     {"unit", term.unit},
                     {"frequency_hz", term.frequency > 0 ? Json(term.frequency) : Json(nullptr)},
                     {"gain", number(term.gain)},
                     {"look_alikes", term.look_alikes}});
  return {{"possible", audit.possible},
          {"chi2_per_dof", number(audit.as_given.chi2_per_degree())},
          {"p_value", number(audit.as_given.p_value)},
          {"chi2_per_dof_final", number(audit.final_fit.chi2_per_degree())},
          {"p_value_final", number(audit.final_fit.p_value)},
          {"unexplained", audit.unexplained},
          {"explained", number(audit.explained)},
          {"rest_mm", number(audit.rest * 1e3)},
          {"wander",
           {{"deviation_mm", number(audit.wander.deviation * 1e3)}, {"time_s", number(audit.wander.time)}}},
          {"terms", terms}};
}

/// Returns the forced runs beside the model; empty where no run is forced.
Json forced_json(const std::vector<DecayComparison>& runs) {
  Json list = Json::array();
  for (const DecayComparison& run : runs) {
    list.push_back({{"run", run.run}});
    for (const ForcedRow& row : rows_of(*run.forced))
      list.back()[row.key] = {{"measured", number(row.number.measured * row.scale)},
                              {"model", number(row.number.model * row.scale)},
                              {"spread", number(row.number.spread * row.scale)}};
  }
  return list;
}

Json parameters_json(const std::vector<DiagnosedParameter>& parameters) {
  Json all = Json::object();
  for (const DiagnosedParameter& p : parameters)
    all[p.name] = p.word.empty() ? Json{{"value", number(p.value)},
                                        {"low", number(p.low)},
                                        {"high", number(p.high)},
                                        {"unit", p.unit}}
                                 : Json{{"value", p.word}, {"low", nullptr}, {"high", nullptr}, {"unit", ""}};
  return all;
}

Json ranking_json(const std::vector<RankedEffect>& ranking) {
  Json list = Json::array();
  for (const RankedEffect& r : ranking)
    list.push_back({{"effect", r.effect},
                    {"gain", number(r.gain)},
                    {"held_out_gain", number(r.held_out_gain)},
                    {"standard_error", number(r.standard_error)},
                    {"value", number(r.value)},
                    {"look_alikes", r.look_alikes}});
  return list;
}

Json steps_json(const std::vector<LadderStep>& ladder) {
  Json list = Json::array();
  for (const LadderStep& s : ladder)
    list.push_back({{"step", s.step},
                    {"error_box_mm", number(s.error_box * 1e3)},
                    {"error_com_mm", number(s.error_centre * 1e3)},
                    {"held_out_error_box_mm", number(s.held_out_error_box * 1e3)},
                    {"p_value", number(s.p_value)},
                    {"scatter", number(s.scatter)}});
  return list;
}

Json force_curves_json(const std::vector<ForceCurve>& curves) {
  Json list = Json::array();
  for (const ForceCurve& curve : curves)
    list.push_back({{"of", std::string(quantity_of(curve.of)) + "_at_" + std::string(variable_of(curve.of))},
                    {"argument", curve.argument},
                    {"value", curve.value},
                    {"error", curve.error},
                    {"gain", number(curve.gain)}});
  return list;
}

Json free_restitution_json(const FreeRestitution& law) {
  return {{"setup", write_setup(law.setup)},
          {"without", steps_json({law.without}).front()},
          {"with", steps_json({law.with}).front()},
          {"restitution_curve", Json::parse(curve_json(law.curve))}};
}

Json failures_json(const std::vector<FailureCell>& where) {
  Json list = Json::array();
  for (const FailureCell& c : where)
    list.push_back({{"run", c.run.empty() ? Json(nullptr) : Json(c.run)},
                    {"observable", c.observable},
                    {"what", c.what},
                    {"from_s", c.from},
                    {"to_s", c.to},
                    {"error_mm", number(c.error * 1e3)},
                    {"sigmas", number(c.sigmas)},
                    {"p_value", number(c.p_value)}});
  return list;
}

}  // namespace

std::string diagnosis_json(const Diagnosis& d) {
  const LadderStep last = d.ladder.empty() ? LadderStep{} : d.ladder.back();
  Json all{
      {"schema_version", 2},
      {"engine", d.engine},
      {"verdict", std::string(name_of(d.verdict))},
      {"sentence", d.sentence},
      {"missing", d.missing},
      {"not_fitted", d.promised ? Json(d.promised->effect) : Json(nullptr)},
      {"hypotheses", sets_json(d.hypotheses)},
      {"answer_set", sets_json(d.answers)},
      {"judgement",
       {{"standing", std::string(name_of(d.judgement.standing))}, {"reason", d.judgement.reason}}},
      {"left", left_json(d.left)},
      {"validation", validation_json(d.validation)},
      {"forced", forced_json(d.forced)},
      {"explained", number(d.explained)},
      {"camera", nuisances_json(d.camera)},
      {"parameters", parameters_json(d.parameters)},
      {"ranking", ranking_json(d.ranking)},
      {"ladder", steps_json(d.ladder)},
      {"noise_floor",
       {{"box_mm", number(last.floor_box * 1e3)}, {"com_mm", number(last.floor_centre * 1e3)}}},
      {"where", failures_json(d.where)},
      {"momentum", momentum_json(d.momentum)},
      {"curves", d.last_fit ? curves_json(*d.last_fit) : Json::array()},
      {"force_formula", d.force_formula.empty() ? Json(nullptr) : Json(d.force_formula)},
      {"force_curves", d.momentum.unlisted ? force_curves_json(d.momentum.curves) : Json::array()},
      {"free_restitution", d.free_restitution ? free_restitution_json(*d.free_restitution) : Json(nullptr)},
      {"next_experiments", d.next_experiments},
      {"notes", d.notes},
      {"not_tried", d.not_tried},
      {"seconds", d.seconds},
      {"runs_simulated", d.runs_simulated}};
  explain_missing_numbers(all, [&](const std::string& path) { return reason_of(d, path); });
  return all.dump(2) + "\n";
}

}  // namespace shakedown
