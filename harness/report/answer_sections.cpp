// SPDX-License-Identifier: MIT
#include "answer_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "distributions.hpp"
#include "effects.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "last_fit.hpp"
#include "measured_sections.hpp"
#include "page_figures.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

std::string words_of_set(const std::vector<std::string>& effects) {
  std::string words;
  for (const std::string& effect : effects) {
    const EffectRecord* record = find_effect(effect);
    words += (words.empty() ? "" : " + ") + (effect == unlisted_effect ? std::string("something in no list")
                                             : record != nullptr && !record->label.empty()
                                                 ? std::string(record->label)
                                                 : effect);
  }
  return words.empty() ? "nothing is missing" : words;
}

std::string ids_of_set(const std::vector<std::string>& effects) {
  std::string ids;
  for (const std::string& effect : effects)
    if (effect != unlisted_effect) ids += (ids.empty() ? "" : " + ") + effect;
  return ids;
}

bool is_among(const Hypothesis& one, const std::vector<Hypothesis>& set) {
  return std::any_of(set.begin(), set.end(),
                     [&](const Hypothesis& other) { return other.effects == one.effects; });
}

ReportSection probabilities(const Diagnosis& d) {
  ReportSection section;
  section.title = "What is missing";
  const bool tied = d.answers.size() > 1;
  double held = 0;
  for (const Hypothesis& h : d.answers) held += h.probability;
  ReportBars bars{"", "", "%", {"probability"}, {}, std::nan(""), ""};
  constexpr double shown = 0.01;
  constexpr std::size_t most = 14;
  for (const Hypothesis& h : d.hypotheses) {
    if ((h.probability < shown && !is_among(h, d.answers)) || bars.lines.size() == most) continue;
    bars.lines.push_back({words_of_set(h.effects),
                          ids_of_set(h.effects),
                          {100 * h.probability},
                          {},
                          tied && is_among(h, d.answers) ? Tone::unsure : Tone::plain});
  }
  if (bars.lines.empty()) return section;
  bars.caption =
      tied ? fmt::format("Striped: the data do not tell these {} answers apart; together they hold {:.3g} %.",
                         d.answers.size(), 100 * held)
           : fmt::format("One answer alone holds {:.3g} %.", 100 * held);
  if (d.hypotheses.size() > bars.lines.size())
    bars.caption +=
        fmt::format(" Not shown: {} answers, each less probable.", d.hypotheses.size() - bars.lines.size());
  section.bars = {bars};
  return section;
}

/// Returns the value of a key, SI; NaN where the setup has no such value.
double value_in(const Setup& setup, const std::string& key) {
  if (find_setup_key(key) == nullptr && find_choice(setup, effect_of(key)) == nullptr) return std::nan("");
  try {
    return get_number(setup, key, all_effects());
  } catch (const InputError&) {
    return std::nan("");
  }
}

ReportSection strengths(const Diagnosis& d, const Setup& given) {
  ReportSection section;
  section.title = "How strong";
  for (const DiagnosedParameter& p : d.parameters) {
    const ReadUnit read = read_unit(p.name);
    const auto shown = [&](double value) { return value / read.factor; };
    ReportInterval interval{words_of_key(p.name), p.word.empty() ? read.unit : "", p.word};
    if (p.word.empty()) {
      interval.value = shown(p.value), interval.low = shown(p.low), interval.high = shown(p.high);
      interval.given = shown(value_in(given, p.name));
    }
    section.intervals.push_back(interval);
  }
  if (section.intervals.empty())
    section.paragraphs = {"The numbers stay as the setup has them."};
  else
    section.paragraphs = {"Best values with 95 % intervals; dashed: the value in the setup as given."};
  return section;
}

std::string text_in_mm(double metres) { return std::isfinite(metres) ? for_people(metres * 1e3) : "–"; }

std::vector<std::string> row_of(const Difference& one, double amplitude) {
  const double share = one.error / (std::isfinite(one.amplitude) ? one.amplitude : amplitude),
               times = times_floor(one);
  return {one.of,
          text_in_mm(one.error),
          std::isfinite(share) ? for_people(100 * share) : "–",
          text_in_mm(one.floor),
          std::isfinite(times) ? for_people(times) : "–",
          one.looks_like};
}

ReportSection what_is_left(const Diagnosis& d) {
  ReportSection section;
  section.title = "What is left";
  section.paragraphs = {"Final model " + d.judgement.reason + "."};
  if (d.momentum.possible && d.momentum.wander.deviation > 0)
    section.paragraphs.push_back(fmt::format("The track wanders by {} mm over {} s.",
                                             for_people(d.momentum.wander.deviation * 1e3),
                                             for_people(d.momentum.wander.time)));
  const bool named = std::any_of(d.left.begin(), d.left.end(),
                                 [](const Difference& one) { return !one.looks_like.empty(); });
  std::vector<std::string> columns{"of", "left, mm", "% of the swing", "noise and spread, mm", "times that"};
  if (named) columns.push_back("looks like");
  ReportTable all{"", "", columns, {}, false}, runs{"Run by run", "", columns, {}, true};
  if (d.last_fit && d.last_fit->ensembles)
    all.caption =
        "What each run has of its own (its trigger, its release) counts at its most probable, which a bare "
        "rms does not.";
  const double amplitude = d.left.empty() ? std::nan("") : d.left.front().amplitude;
  for (const Difference& one : d.left) {
    std::vector<std::string> row = row_of(one, amplitude);
    row.resize(columns.size());
    (one.of == "box" || one.of == "grains' centre" ? all : runs).rows.push_back(std::move(row));
  }
  if (!all.rows.empty()) section.tables.push_back(all);
  if (!runs.rows.empty()) section.tables.push_back(runs);
  return section;
}

}  // namespace

ReadUnit read_unit(const std::string& key) {
  std::string unit = unit_of_key(key, all_effects());
  for (const auto& [large, small] : {std::pair{"m", "mm"}, {"s", "ms"}, {"N", "mN"}, {"kg", "g"}})
    if (unit == large) {
      unit = small;
      break;
    }
  const auto parsed = parse_unit(unit);
  const Unit* size = std::get_if<Unit>(&parsed);
  return {unit, size != nullptr && size->si > 0 ? size->si : 1};
}

std::string words_of_key(const std::string& name) {
  // What is of one run only is told with it: "camera_origin.origin of a".
  const std::size_t end = std::min(name.find(' '), name.size());
  const std::string key = name.substr(0, end), of_run = name.substr(end);
  static const std::map<std::string, std::string, std::less<>> words{
      {"restitution.grain_grain", "restitution of two grains"},
      {"restitution.grain_wall", "restitution at the walls"},
      {"spring.frequency", "frequency of the empty box"},
      {"box.mass", "mass of the box"},
      {"grains.mass", "mass of a grain"},
      {"release.displacement", "place of the release"},
      {"release.packing", "packing at the release"}};
  if (const auto found = words.find(key); found != words.end()) return found->second + of_run;
  const std::string first(key.substr(0, key.find('&')));
  const EffectRecord* record = find_effect(std::string(effect_of(first)));
  if (record == nullptr || record->label.empty()) return name;
  const std::size_t dot = first.find('.');
  const std::string rest = dot == std::string::npos ? "" : first.substr(dot + 1);
  const bool alone = record->parameters.size() == 1;
  return std::string(record->label) + (alone || rest.empty() ? "" : ": " + rest) + of_run;
}

std::vector<ReportSection> answer_of(const Diagnosis& diagnosis, const Setup& given) {
  std::vector<ReportSection> sections;
  if (ReportSection table = probabilities(diagnosis); !table.bars.empty())
    sections.push_back(std::move(table));
  sections.push_back(strengths(diagnosis, given));
  if (!diagnosis.left.empty()) sections.push_back(what_is_left(diagnosis));
  if (!diagnosis.camera.empty()) sections.push_back(nuisances_section(diagnosis.camera));
  return sections;
}

}  // namespace shakedown
