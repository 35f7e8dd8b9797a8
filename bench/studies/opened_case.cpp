// SPDX-License-Identifier: MIT
#include "opened_case.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "effects.hpp"
#include "fnv.hpp"
#include "json_file.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using Names = std::vector<std::string>;

std::optional<double> number_at(const Json& object, const char* key) {
  return object.contains(key) && object[key].is_number() ? std::optional<double>(object[key].get<double>())
                                                         : std::nullopt;
}

Verdict verdict_of(const std::string& name) {
  for (const Verdict verdict :
       {Verdict::adequate, Verdict::refit, Verdict::measurement, Verdict::missing, Verdict::unknown})
    if (name_of(verdict) == name) return verdict;
  return Verdict::unknown;
}

BlindKind kind_of(const std::string& name) {
  const auto found = std::find(blind_kind_names.begin(), blind_kind_names.end(), name);
  return static_cast<BlindKind>(found - blind_kind_names.begin());
}

void read_truth(const Json& truth, OpenedCase& one) {
  one.kind = kind_of(truth.at("kind"));
  one.signal = truth.at("signal_to_noise");
  one.hidden = truth.at("hidden").get<Names>();
  one.ids = truth.value("ids", Names{});
  one.twin = truth.at("twin");
  one.setup = truth.at("setup");
  one.laboratory = truth.at("laboratory").get<std::map<std::string, double>>();
  for (const auto& [key, strength] : truth.at("strengths").items()) {
    if (strength.is_number()) one.strengths[key] = strength;
    if (!strength.is_array()) continue;
    one.strengths[key + ".x"] = strength.at(0);
    one.strengths[key + ".y"] = one.strengths[key + ".z"] =
        std::hypot(strength.at(1).get<double>(), strength.at(2).get<double>());
  }
}

std::set<std::string> with_look_alikes(const Json& diagnosis, const Names& missing) {
  std::set<std::string> names(missing.begin(), missing.end());
  const auto add = [&](const Json& list) {
    for (const Json& item : list)
      if (std::find(missing.begin(), missing.end(), item.value("effect", "")) != missing.end())
        for (const Json& alike : item.at("look_alikes")) names.insert(alike.get<std::string>());
  };
  add(diagnosis.at("ranking"));
  add(diagnosis.at("momentum").at("terms"));
  return names;
}

/// Returns the effects sorted, without what is no part of an answer (a packing).
Names physics_and_camera(Names effects) {
  std::erase_if(effects, [](const std::string& effect) {
    const EffectRecord* record = find_effect(effect);
    return record != nullptr && record->nuisance;
  });
  std::sort(effects.begin(), effects.end());
  return effects;
}

/// Judges an answer of the kind `films` by physics alone: there every run has camera errors, which no answer
/// needs to name.
TrialJudgement judgement_of_physics(const std::string& verdict, const Names& missing, const Names& hidden) {
  Names truth = hidden;
  std::sort(truth.begin(), truth.end());
  const Names named = physics_among(missing, all_effects());
  const bool unknown = verdict == name_of(Verdict::unknown);
  TrialJudgement judgement;
  judgement.detected = unknown || !named.empty();
  judgement.invented = unknown || !std::includes(truth.begin(), truth.end(), named.begin(), named.end());
  judgement.named = !unknown && named == truth;
  return judgement;
}

/// Returns the effects of the camera whose numbers stand out; none from answers that have no such list.
Names camera_standing_out(const Json& diagnosis) {
  std::vector<NuisanceFound> camera;
  for (const Json& number : diagnosis.value("camera", Json::array()))
    camera.push_back({number.at("name"), "", number_at(number, "known_to").value_or(0),
                      number_at(number, "value").value_or(0), number_at(number, "error").value_or(0)});
  return effects_standing_out(camera);
}

TrialJudgement judgement_of(const Json& diagnosis, const OpenedCase& one) {
  if (one.kind == BlindKind::films)
    return judgement_of_physics(diagnosis.at("verdict"), diagnosis.at("missing").get<Names>(), one.hidden);
  return judge(one.hidden, !one.laboratory.empty(), verdict_of(diagnosis.at("verdict")),
               diagnosis.at("missing").get<Names>(), camera_standing_out(diagnosis));
}

/// Returns the effects sorted, without what is no part of an answer: a packing, and errors of the camera
/// where none was hidden.
Names part_of_an_answer(Names effects, BlindKind kind) {
  if (std::find(effects.begin(), effects.end(), "unknown") != effects.end()) return {"unknown"};
  return kind == BlindKind::camera || kind == BlindKind::twins ? physics_and_camera(std::move(effects))
                                                               : physics_among(effects, all_effects());
}

/// Returns the hypotheses; sets that differ only in what is no part of an answer are one.
std::vector<WeighedAnswer> hypotheses_of(const Json& diagnosis, BlindKind kind) {
  std::vector<WeighedAnswer> all;
  for (const Json& hypothesis : diagnosis.value("hypotheses", Json::array())) {
    const Names effects = part_of_an_answer(hypothesis.at("effects").get<Names>(), kind);
    const double probability = number_at(hypothesis, "probability").value_or(0);
    const auto same = std::find_if(all.begin(), all.end(),
                                   [&](const WeighedAnswer& one) { return one.effects == effects; });
    if (same == all.end())
      all.push_back({effects, probability});
    else
      same->probability += probability;
  }
  std::stable_sort(all.begin(), all.end(), [](const WeighedAnswer& a, const WeighedAnswer& b) {
    return a.probability > b.probability;
  });
  return all;
}

void read_diagnosis(const Json& diagnosis, OpenedCase& one) {
  one.verdict = diagnosis.at("verdict");
  one.missing = diagnosis.at("missing").get<Names>();
  one.look_alikes = with_look_alikes(diagnosis, one.missing);
  one.answers = {one.missing};
  for (const Json& answer : diagnosis.value("answer_set", Json::array()))
    one.answers.push_back(answer.at("effects").get<Names>());
  for (const auto& [key, parameter] : diagnosis.at("parameters").items()) {
    const auto low = number_at(parameter, "low"), high = number_at(parameter, "high");
    if (low && high) one.found[key] = {*low, *high};
  }
  one.hypotheses = hypotheses_of(diagnosis, one.kind);
  one.p_of_balance = number_at(diagnosis.at("momentum"), "p_value");
  if (const Json& ladder = diagnosis.at("ladder"); !ladder.empty()) {
    one.p_as_given = number_at(ladder.front(), "p_value");
    const auto error = number_at(ladder.back(), "error_box_mm"),
               floor = number_at(diagnosis.at("noise_floor"), "box_mm");
    if (error && floor && *floor > 0) one.error_over_floor = *error / *floor;
  }
  one.seconds = diagnosis.value("seconds", 0.0);
  one.judgement = judgement_of(diagnosis, one);
}

void read_forces(const Json& formulas, OpenedCase& one) {
  for (const Json& formula : formulas) {
    OfferedForce& force = one.forces.emplace_back();
    force.constants = formula.at("constants").get<std::map<std::string, double>>();
    force.forms = formula.at("look_alikes").get<Names>();
    force.forms.push_back(formula.at("formula"));
  }
}

void read_answer(const Json& answer, OpenedCase& one) {
  one.lost = !answer.contains("diagnosis");
  if (!one.lost) read_diagnosis(answer.at("diagnosis"), one);
  if (answer.contains("formulas")) read_forces(answer.at("formulas"), one);
  if (answer.contains("naive")) one.naive = answer.at("naive").get<std::map<std::string, std::string>>();
}

/// Reads the answer with more runs; a diagnosis that broke down is a wrong answer.
void read_answer_with_more_runs(const Json& answer, OpenedCase& one) {
  one.after_more =
      answer.contains("diagnosis") ? judgement_of(answer.at("diagnosis"), one) : TrialJudgement{};
}

void open_answer(const fs::path& file, OpenedCase& one, void (*read)(const Json& answer, OpenedCase& one)) {
  read_answer_file(file, [&](const std::string& text) {
    const Json answer = Json::parse(text);
    read(answer, one);
    one.programs.insert(answer.value("program", "a program that did not say which"));
  });
}

}  // namespace

bool OpenedCase::first_suspects_family_is_right() const {
  const auto family = [](const std::string& effect) {
    const EffectRecord* record = find_effect(effect);
    return record == nullptr ? std::string_view(effect) : family_of(*record);
  };
  return !missing.empty() && std::any_of(hidden.begin(), hidden.end(), [&](const std::string& effect) {
    return family(effect) == family(missing.front());
  });
}

bool OpenedCase::among_the_answers() const {
  if (exact()) return true;
  const Names truth = physics_and_camera(hidden);
  return std::any_of(answers.begin(), answers.end(),
                     [&](const Names& answer) { return physics_and_camera(answer) == truth; });
}

bool OpenedCase::right_or_tied() const {
  constexpr std::size_t most = 3;  // answers: a longer list tells nobody what to do
  return exact() || (answers.size() <= most && among_the_answers());
}

double OpenedCase::probability_of_truth() const {
  const Names truth = part_of_an_answer(hidden, kind);
  for (const WeighedAnswer& one : hypotheses)
    if (one.effects == truth) return one.probability;
  return 0;
}

bool OpenedCase::most_probable_is_right() const {
  return !hypotheses.empty() && hypotheses.front().effects == part_of_an_answer(hidden, kind);
}

bool OpenedCase::names_physics() const { return !physics_among(missing, all_effects()).empty(); }

void read_answer_file(const fs::path& file, const std::function<void(const std::string& text)>& read) {
  read_json_file(file, "an answer of this suite", "remove it; --resume diagnoses the case again", read);
}

OpenedCase open_case(const fs::path& folder, const std::string& name, const std::string& seal) {
  const fs::path file = folder / "sealed" / (name + ".json");
  const std::string sealed = read_text_file(file);
  if (hexadecimal(fnv1a(sealed)) != seal)
    throw InputError({{{file.string(), 0, 0},
                       "",
                       "is not the answer that was sealed (its digest differs from plan.json's)",
                       "run the suite again in another folder"}});
  OpenedCase one;
  one.name = name;
  read_json_file(file, "an answer that this version seals", "score it with the program that sealed it",
                 [&](const std::string& text) { read_truth(Json::parse(text), one); });
  open_answer(folder / "answers" / (name + ".json"), one, read_answer);
  if (const fs::path more = folder / "answers" / (name + "_more.json"); fs::exists(more))
    open_answer(more, one, read_answer_with_more_runs);
  return one;
}

}  // namespace shakedown
