// SPDX-License-Identifier: MIT
#include "decay_baselines.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <tuple>

#include "data_file.hpp"
#include "kept_files.hpp"
#include "output_file.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

/// Returns a number as the file has it: in millimetres to nine digits, readable and far finer than any
/// spread.
double in_file(double si) { return std::round(si * 1e12) / 1e9; }

Json interval_json(const Interval& allowed, const Statistic& found) {
  return {{"low", in_file(allowed.low)},
          {"high", in_file(allowed.high)},
          {"mean", in_file(found.mean)},
          {"sd", in_file(found.sd)}};
}

Json baseline_json(const DecayBaseline& baseline) {
  return {{"engine", baseline.engine},
          {"length_mm", in_file(baseline.length)},
          {"slope_mm_per_s", interval_json(baseline.slope, baseline.slope_found)},
          {"curvature_mm_per_s2", interval_json(baseline.curvature, baseline.curvature_found)},
          {"origin",
           {{"runs", baseline.slope_found.n},
            {"seed", baseline.seed},
            {"version", baseline.version},
            {"commit", baseline.commit}}}};
}

Interval interval_from(const Json& json) {
  return {1e-3 * json.at("low").get<double>(), 1e-3 * json.at("high").get<double>()};
}

Statistic statistic_from(const Json& json, int runs) {
  return {1e-3 * json.at("mean").get<double>(), 1e-3 * json.at("sd").get<double>(), runs};
}

DecayBaseline baseline_from(const Json& json) {
  const Json &slope = json.at("slope_mm_per_s"), &curvature = json.at("curvature_mm_per_s2"),
             &origin = json.at("origin");
  const int runs = origin.at("runs").get<int>();
  return {json.at("engine").get<std::string>(),
          1e-3 * json.at("length_mm").get<double>(),
          interval_from(slope),
          interval_from(curvature),
          statistic_from(slope, runs),
          statistic_from(curvature, runs),
          origin.at("seed").get<std::uint64_t>(),
          origin.at("version").get<std::string>(),
          origin.at("commit").get<std::string>()};
}

bool same_case(const DecayBaseline& baseline, const std::string& engine, double length) {
  return baseline.engine == engine && std::abs(baseline.length - length) < 1e-9;
}

}  // namespace

std::filesystem::path default_decay_baselines() { return data_file("linear_decay.json", DECAY_BASELINES); }

std::vector<DecayBaseline> read_decay_baselines(const std::filesystem::path& file) {
  expect_no_pipe(file);
  std::ifstream stream(file);
  if (!stream)
    throw FileError(file.string() +
                    ": cannot be read; name the baselines with --baselines, or make them with --update");
  try {
    const Json json = Json::parse(stream);
    std::vector<DecayBaseline> baselines;
    for (const Json& entry : json.at("baselines")) baselines.push_back(baseline_from(entry));
    return baselines;
  } catch (const Json::exception& error) {
    throw InputError({{{file.string()},
                       "baselines",
                       std::string("these are no baselines (") + error.what() + ")",
                       "make them anew with --update and another --baselines FILE"}});
  }
}

void write_decay_baselines(const std::filesystem::path& file, const std::vector<DecayBaseline>& baselines) {
  Json json{
      {"schema_version", 1},
      {"about",
       "shakedown check linear-decay: intervals for the mean over 8 runs or more of the paper's damper, "
       "mean +- 4 sd sqrt(1/8 + 1/runs); rewritten by --update"},
      {"baselines", Json::array()}};
  for (const DecayBaseline& baseline : baselines) json["baselines"].push_back(baseline_json(baseline));
  write_file(file, json.dump(2) + "\n");
}

const DecayBaseline* find_baseline(const std::vector<DecayBaseline>& baselines, const std::string& engine,
                                   double length) {
  for (const DecayBaseline& baseline : baselines)
    if (same_case(baseline, engine, length)) return &baseline;
  return nullptr;
}

std::vector<DecayBaseline> updated(std::vector<DecayBaseline> baselines,
                                   const std::vector<DecayBaseline>& fresh) {
  for (const DecayBaseline& entry : fresh) {
    std::erase_if(baselines,
                  [&](const DecayBaseline& old) { return same_case(old, entry.engine, entry.length); });
    baselines.push_back(entry);
  }
  std::ranges::sort(baselines, {},
                    [](const DecayBaseline& entry) { return std::tie(entry.engine, entry.length); });
  return baselines;
}

std::string decay_checks_json(const std::vector<DecayCheck>& checks) {
  Json json{{"schema_version", 1},
            {"passed", std::ranges::all_of(checks, &DecayCheck::passed)},
            {"checks", Json::array()}};
  for (const DecayCheck& check : checks)
    json["checks"].push_back(
        {{"engine", check.engine},
         {"length_mm", in_file(check.length)},
         {"check", check.name},
         {"passed", check.passed},
         {"value", std::isfinite(check.value) ? Json(check.value) : Json(nullptr)},
         {"allowed", check.allowed ? Json{check.allowed->low, check.allowed->high} : Json(nullptr)},
         {"remark", check.remark}});
  return json.dump(2) + "\n";
}

}  // namespace shakedown
