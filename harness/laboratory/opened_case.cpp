// SPDX-License-Identifier: MIT
#include "opened_case.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "effects.hpp"
#include "fnv.hpp"
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
  for (const Verdict verdict : {Verdict::adequate, Verdict::refit, Verdict::missing, Verdict::unknown})
    if (name_of(verdict) == name) return verdict;
  return Verdict::unknown;
}

BlindKind kind_of(const std::string& name) {
  const auto found = std::find(blind_kind_names.begin(), blind_kind_names.end(), name);
  return static_cast<BlindKind>(found - blind_kind_names.begin());
}

void read_truth(const Json& truth, OpenedCase& one) {
  one.kind = kind_of(truth["kind"]);
  one.signal = truth["signal_to_noise"];
  one.hidden = truth["hidden"].get<Names>();
  one.twin = truth["twin"];
  one.setup = truth["setup"];
  one.laboratory = truth["laboratory"].get<std::map<std::string, double>>();
  for (const auto& [key, strength] : truth["strengths"].items()) {
    if (strength.is_number()) one.strengths[key] = strength;
    if (!strength.is_array()) continue;
    one.strengths[key + ".x"] = strength[0];
    one.strengths[key + ".y"] = one.strengths[key + ".z"] =
        std::hypot(strength[1].get<double>(), strength[2].get<double>());
  }
}

std::set<std::string> with_look_alikes(const Json& diagnosis, const Names& missing) {
  std::set<std::string> names(missing.begin(), missing.end());
  const auto add = [&](const Json& list) {
    for (const Json& item : list)
      if (std::find(missing.begin(), missing.end(), item.value("effect", "")) != missing.end())
        for (const Json& alike : item["look_alikes"]) names.insert(alike.get<std::string>());
  };
  add(diagnosis["ranking"]);
  add(diagnosis["momentum"]["terms"]);
  return names;
}

Judgement judgement_of(const Json& diagnosis, const OpenedCase& one) {
  return judge(one.hidden, !one.laboratory.empty(), verdict_of(diagnosis["verdict"]),
               diagnosis["missing"].get<Names>());
}

void read_diagnosis(const Json& diagnosis, OpenedCase& one) {
  one.verdict = diagnosis["verdict"];
  one.missing = diagnosis["missing"].get<Names>();
  one.look_alikes = with_look_alikes(diagnosis, one.missing);
  for (const auto& [key, parameter] : diagnosis["parameters"].items()) {
    const auto low = number_at(parameter, "low"), high = number_at(parameter, "high");
    if (low && high) one.found[key] = {*low, *high};
  }
  one.p_of_balance = number_at(diagnosis["momentum"], "p_value");
  if (const Json& ladder = diagnosis["ladder"]; !ladder.empty()) {
    one.p_as_given = number_at(ladder.front(), "p_value");
    const auto error = number_at(ladder.back(), "error_box_mm"),
               floor = number_at(diagnosis["noise_floor"], "box_mm");
    if (error && floor && *floor > 0) one.error_over_floor = *error / *floor;
  }
  one.seconds = diagnosis.value("seconds", 0.0);
  one.judgement = judgement_of(diagnosis, one);
}

void read_forces(const Json& formulas, OpenedCase& one) {
  for (const Json& formula : formulas) {
    OfferedForce& force = one.forces.emplace_back();
    force.constants = formula["constants"].get<std::map<std::string, double>>();
    force.forms = formula["look_alikes"].get<Names>();
    force.forms.push_back(formula["formula"]);
  }
}

}  // namespace

bool OpenedCase::first_suspects_family_is_right() const {
  return !missing.empty() && std::any_of(hidden.begin(), hidden.end(), [&](const std::string& effect) {
    return family_of(effect) == family_of(missing.front());
  });
}

bool OpenedCase::names_physics() const {
  return std::any_of(missing.begin(), missing.end(), [](const std::string& effect) {
    const EffectRecord* record = find_effect(effect);
    return record != nullptr && record->acts_on != ActsOn::camera;
  });
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
  read_truth(Json::parse(sealed), one);
  const Json answer = Json::parse(read_text_file(folder / "answers" / (name + ".json")));
  one.lost = !answer.contains("diagnosis");
  if (!one.lost) read_diagnosis(answer["diagnosis"], one);
  if (answer.contains("formulas")) read_forces(answer["formulas"], one);
  if (answer.contains("naive")) one.naive = answer["naive"].get<std::map<std::string, std::string>>();
  if (const fs::path more = folder / "answers" / (name + "_more.json"); fs::exists(more))
    if (const Json second = Json::parse(read_text_file(more)); second.contains("diagnosis"))
      one.after_more = judgement_of(second["diagnosis"], one);
  return one;
}

}  // namespace shakedown
