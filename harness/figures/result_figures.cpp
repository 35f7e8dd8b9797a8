// SPDX-License-Identifier: MIT
#include "result_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "errors.hpp"
#include "json_file.hpp"
#include "kept_files.hpp"
#include "known_effects.hpp"
#include "made_figures.hpp"

namespace shakedown {

namespace {

/// A kind of figure: which results hold it, and what it is made of.
struct Maker {
  const char* kind;
  bool (*held)(const Json& result);
  Figure (*made)(const Json& result, const FigureRequest& request);
};

bool has_list(const Json& result, const char* key) {
  const auto found = result.find(key);
  return found != result.end() && found->is_array() && !found->empty();
}

bool holds_residuals(const Json& result) { return has_list(result, "curves"); }
bool holds_decay(const Json& result) { return holds_residuals(result) || has_list(result, "peaks_mm"); }
bool holds_energy(const Json& result) {
  return result.contains("energy_loss") || !energy_plots_of(result).empty();
}

const std::vector<Maker>& makers() {
  static const std::vector<Maker> all{
      {"restitution", [](const Json& r) { return has_list(r, "restitution") && has_list(r, "impacts"); },
       [](const Json& r, const FigureRequest&) { return restitution_figure(r); }},
      {"probabilities", [](const Json& r) { return has_list(r, "hypotheses") || has_list(r, "laws"); },
       [](const Json& r, const FigureRequest&) { return probabilities_figure(r); }},
      {"decay", holds_decay, decay_figure},
      {"residuals", holds_residuals, residuals_figure},
      {"ladder", [](const Json& r) { return has_list(r, "ladder"); },
       [](const Json& r, const FigureRequest&) { return ladder_figure(r); }},
      {"energy", holds_energy, energy_figure}};
  return all;
}

/// The files that commands leave in their folders, in the order in which they are looked at.
constexpr std::array files_of_folders{"diagnosis.json", "compare.json", "ladder.json",
                                      "fit.json",       "summary.json", "report.json"};

Json read(const std::filesystem::path& file) {
  Json result;
  read_json_file(file, "a file of results", "name what a command wrote with --json or --out",
                 [&](const std::string& text) { result = Json::parse(text); });
  return result;
}

std::vector<std::filesystem::path> files_of(const std::filesystem::path& result) {
  if (!std::filesystem::is_directory(result)) return {result};
  std::vector<std::filesystem::path> files;
  for (const char* name : files_of_folders)
    if (std::filesystem::exists(result / name)) files.push_back(result / name);
  if (files.empty())
    throw InputError({{{result.string(), 0, 0},
                       "",
                       "holds no results (no diagnosis.json, ladder.json, summary.json ...)",
                       "name a folder that a command wrote with --out, or a file of --json"}});
  return files;
}

std::string joined(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

}  // namespace

const std::vector<std::string>& figure_kinds() {
  static const std::vector<std::string> kinds{"decay",  "residuals",     "ladder",
                                              "energy", "probabilities", "restitution"};
  return kinds;
}

Figure figure_of_result(const std::filesystem::path& result, const FigureRequest& request) {
  keep_unchanged(result);
  std::vector<std::string> held;
  for (const std::filesystem::path& file : files_of(result)) {
    keep_unchanged(file);
    const Json json = read(file);
    for (const Maker& maker : makers()) {
      if (!json.is_object() || !maker.held(json)) continue;
      if (std::find(held.begin(), held.end(), maker.kind) == held.end()) held.push_back(maker.kind);
      if (!request.kind.empty() && request.kind != maker.kind) continue;
      std::optional<Figure> figure;
      read_json_file(file, "a file of results as this program writes them", "run its command again",
                     [&](const std::string&) { figure = maker.made(json, request); });
      return *figure;
    }
  }
  if (held.empty())
    throw InputError({{{result.string(), 0, 0},
                       "",
                       "holds nothing that can be drawn",
                       "name the results of run, compare, ladder, fit, diagnose or bounce"}});
  throw InputError(
      {{{result.string(), 0, 0},
        "",
        fmt::format("holds no figure of the kind '{}'", request.kind),
        "it holds " + joined(held) +
            (request.kind == "energy" ? "; energies stand in the report.json of a folder" : "")}});
}

}  // namespace shakedown
