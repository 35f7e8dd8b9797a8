// SPDX-License-Identifier: MIT
#include "hidden_answer.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace shakedown {

std::string case_text(const std::filesystem::path& folder, const std::filesystem::path& truth,
                      const Experiment& experiment) {
  return fmt::format(
      "{0} runs in {1}\nwhat is hidden: {2} (do not look before the diagnosis is made)\n"
      "shakedown diagnose {1}/setup.toml --data {1}/experiment.toml\n",
      experiment.runs.size(), folder.string(), truth.string());
}

std::string case_json(const std::filesystem::path& folder, const std::filesystem::path& truth,
                      const Experiment& experiment) {
  std::vector<std::string> names;
  for (const MeasuredRun& run : experiment.runs) names.push_back(run.name);
  return nlohmann::ordered_json{
      {"schema_version", 1}, {"folder", folder.string()}, {"truth", truth.string()}, {"runs", names}}
      .dump();
}

namespace {

nlohmann::ordered_json json_of_share(const Share& share) {
  return {{"hits", share.hits},
          {"trials", share.trials},
          {"share", share.value},
          {"low", share.low},
          {"high", share.high}};
}

}  // namespace

std::string power_text(const HiddenCase& hidden, const Power& power) {
  std::string names;
  for (const std::string& effect : hidden_effects(hidden)) names += (names.empty() ? "" : " + ") + effect;
  std::string text = fmt::format(
      "hidden: {}\n  something is found missing: {}\n  answered exactly:           {}\n  answers:\n",
      names.empty() ? "nothing" : names, in_words(power.detected), in_words(power.named));
  for (const auto& [answer, times] : power.answers) text += fmt::format("    {:>3}  {}\n", times, answer);
  return text;
}

std::string power_json(const HiddenCase& hidden, const Power& power) {
  nlohmann::ordered_json answers = nlohmann::ordered_json::object();
  for (const auto& [answer, times] : power.answers) answers[answer] = times;
  return nlohmann::ordered_json{{"schema_version", 1},
                                {"hidden", hidden_effects(hidden)},
                                {"detected", json_of_share(power.detected)},
                                {"named", json_of_share(power.named)},
                                {"answers", answers}}
             .dump(2) +
         "\n";
}

}  // namespace shakedown
