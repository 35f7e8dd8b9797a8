// SPDX-License-Identifier: MIT
// Opens and counts the answers of a blind suite.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "blind_suite.hpp"
#include "calibration.hpp"
#include "effects.hpp"
#include "json_file.hpp"
#include "known_effects.hpp"
#include "ledger.hpp"
#include "opened_case.hpp"
#include "random.hpp"
#include "score_table.hpp"
#include "unlisted_score.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using Kept = BlindFigure::Verdict;

Count count(const std::vector<OpenedCase>& cases, const std::function<bool(const OpenedCase&)>& counted,
            const std::function<bool(const OpenedCase&)>& hit) {
  Count result;
  for (const OpenedCase& one : cases)
    if (counted(one)) result.add(hit(one));
  return result;
}

auto of_kind(BlindKind kind) {
  return [kind](const OpenedCase& one) { return one.kind == kind; };
}

/// Selects singles whose signal is at least `low` and less than `high`.
auto singles_at(double low, double high) {
  return [low, high](const OpenedCase& one) {
    return one.kind == BlindKind::single && one.signal >= low && one.signal < high;
  };
}

/// Counts, of what was fitted, the intervals that hold the truth.
void count_covered(const OpenedCase& one, const std::map<std::string, double>& truth, Count& covered) {
  for (const auto& [key, value] : truth)
    if (const auto found = one.found.find(key); found != one.found.end()) {
      const double here = truth_beside(key, value, found->second);
      covered.add(found->second.low <= here && here <= found->second.high);
    }
}

/// Counts the strengths in exact answers whose intervals hold the truth: only there is the effect of each
/// hidden.
Count strengths_covered(const std::vector<OpenedCase>& cases) {
  Count covered;
  for (const OpenedCase& one : cases)
    if (one.exact()) count_covered(one, one.strengths, covered);
  return covered;
}

/// The answers that count: an interval under a wrong model need not hold the truth, but its reader does not
/// know that the model is wrong.
enum class Of { exact_answers, all_answers };

Count parameters_covered(const std::vector<OpenedCase>& cases, const char* key, Of which) {
  Count covered;
  for (const OpenedCase& one : cases)
    if (const auto truth = one.laboratory.find(key);
        truth != one.laboratory.end() && (which == Of::all_answers || one.exact()))
      count_covered(one, {*truth}, covered);
  return covered;
}

void nulls(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  table.at_most("false alarms: something missing where nothing is hidden",
                count(cases, of_kind(BlindKind::null),
                      [](const OpenedCase& one) { return one.lost || one.judgement.detected; }),
                0.03);
  std::vector<double> ensembles, balance;
  for (const OpenedCase& one : cases) {
    if (one.kind != BlindKind::null || one.lost) continue;
    if (one.p_as_given) ensembles.push_back(*one.p_as_given);
    if (one.p_of_balance) balance.push_back(*one.p_of_balance);
  }
  const auto row = [&](const char* what, const std::vector<double>& values) {
    const double p = uniformity_p_value(values);
    table.plain(what, "above 0.01",
                values.empty() ? "no such case" : fmt::format("{:.3f} ({} values)", p, values.size()),
                values.empty() ? Kept::not_measured
                : p > 0.01     ? Kept::met
                               : Kept::missed);
  };
  row("p-values of the model as given are uniform under the null (KS p)", ensembles);
  row("p-values of the momentum balance are uniform under the null (KS p)", balance);
  table.beside(
      "parameters alone: refit, and nothing named",
      count(cases, of_kind(BlindKind::parameters), [](const OpenedCase& one) { return one.exact(); }));
}

void singles(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  const auto family = [](const OpenedCase& one) { return one.first_suspects_family_is_right(); };
  const auto exact = [](const OpenedCase& one) { return one.exact(); };
  table.at_least("first suspect's class, signal to noise 12 and more",
                 count(cases, singles_at(9, 1e9), family), 0.95);
  table.at_least("exact name, signal to noise 12 and more", count(cases, singles_at(9, 1e9), exact), 0.85);
  table.at_least("first suspect's class, signal to noise 6", count(cases, singles_at(4.5, 9), family), 0.80);
  table.beside(
      "hidden one among the answers that hold 95 %, signal to noise 12 and more",
      count(cases, singles_at(9, 1e9), [](const OpenedCase& one) { return one.among_the_answers(); }));
  table.beside("exact name, or one of at most three that are told to be tied, signal to noise 12 and more",
               count(cases, singles_at(9, 1e9), [](const OpenedCase& one) { return one.right_or_tied(); }));
  table.beside("exact name, signal to noise 6", count(cases, singles_at(4.5, 9), exact));
  table.beside("first suspect's class, signal to noise 3", count(cases, singles_at(0, 4.5), family));
}

void widths(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  table.between("intervals of the strengths hold the truth (named exactly)", strengths_covered(cases), 0.90,
                0.98);
  for (const char* key : {"restitution.grain_grain", "restitution.grain_wall", "spring.frequency"}) {
    table.beside(fmt::format("intervals of {} hold the truth (named exactly)", key),
                 parameters_covered(cases, key, Of::exact_answers));
    table.beside(fmt::format("intervals of {} hold the truth (all answers)", key),
                 parameters_covered(cases, key, Of::all_answers));
  }
  Count fallen;
  for (const OpenedCase& one : cases)
    if (one.kind == BlindKind::single || one.kind == BlindKind::pair || one.kind == BlindKind::camera)
      if (one.lost || one.error_over_floor) fallen.add(!one.lost && *one.error_over_floor <= 1.2);
  table.at_least("final error of the box within 1.2 of its floor", fallen, 0.90);
}

void inventions(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  table.at_most("camera artefacts called physics",
                count(cases, of_kind(BlindKind::camera),
                      [](const OpenedCase& one) { return one.lost || one.names_physics(); }),
                0.05);
  table.beside("camera artefacts named exactly, as missing or as errors of the measurement",
               count(cases, of_kind(BlindKind::camera), [](const OpenedCase& one) { return one.exact(); }));
  table.at_most("effects invented (named, not hidden)",
                count(
                    cases,
                    [](const OpenedCase& one) {
                      return one.kind != BlindKind::twins && one.kind != BlindKind::unlisted;
                    },
                    [](const OpenedCase& one) { return one.lost || one.judgement.invented; }),
                0.05);
  table.at_least(
      "both of a pair named",
      count(cases, of_kind(BlindKind::pair),
            [](const OpenedCase& one) {
              return std::all_of(one.hidden.begin(), one.hidden.end(), [&](const std::string& effect) {
                return std::find(one.missing.begin(), one.missing.end(), effect) != one.missing.end();
              });
            }),
      0.85);
}

void films(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  const auto of_films = of_kind(BlindKind::films);
  table.at_most(
      "films by cameras as they are: physics invented",
      count(cases, of_films, [](const OpenedCase& one) { return one.lost || one.judgement.invented; }), 0.03);
  table.at_least("films: physics named exactly, signal to noise 12 and more",
                 count(
                     cases, [&](const OpenedCase& one) { return of_films(one) && one.signal >= 9; },
                     [](const OpenedCase& one) { return one.exact(); }),
                 0.90);
  table.beside("films: nothing hidden, nothing named",
               count(
                   cases, [&](const OpenedCase& one) { return of_films(one) && one.hidden.empty(); },
                   [](const OpenedCase& one) { return one.exact(); }));
}

void dampers(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  const auto exact = [](const OpenedCase& one) { return one.exact(); };
  table.beside(
      "other dampers: named exactly, signal to noise 12 and more",
      count(
          cases, [](const OpenedCase& one) { return one.kind == BlindKind::dampers && one.signal >= 9; },
          exact));
  table.beside(
      "other dampers: nothing hidden, nothing named",
      count(
          cases, [](const OpenedCase& one) { return one.kind == BlindKind::dampers && one.hidden.empty(); },
          exact));
}

void twins(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  const auto detected = [](const OpenedCase& one) {
    return one.kind == BlindKind::twins && !one.lost && one.judgement.detected;
  };
  const auto both = [](const OpenedCase& one) {
    return one.look_alikes.contains(one.hidden.front()) && one.look_alikes.contains(one.twin);
  };
  table.at_least("twins: both named as look-alikes (of those that were seen)", count(cases, detected, both),
                 0.80);
  // Naming the hidden one alone counts too: the pair was told apart although the signal is weak.
  table.beside(
      "twins: both named, or the hidden one alone",
      count(cases, detected, [&](const OpenedCase& one) { return both(one) || one.judgement.named; }));
  table.beside("twins seen at all", count(cases, of_kind(BlindKind::twins),
                                          [](const OpenedCase& one) { return one.judgement.detected; }));
  table.beside(
      "twins told apart with the runs that decide",
      count(
          cases,
          [](const OpenedCase& one) { return one.kind == BlindKind::twins && one.after_more.has_value(); },
          [](const OpenedCase& one) { return one.after_more->named; }));
}

/// Scores guesses on the same cases: an effect at random, and always the effect hidden most often.
void baselines(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  std::set<std::string> all;
  for (const Hideable& hideable : hideable_effects()) all.insert(std::string(hideable.effect->name));
  const std::vector<std::string> list(all.begin(), all.end());
  Random random(7, 0, Stream::other);
  Count guessed;
  std::map<std::string, int> hidden;
  for (const OpenedCase& one : cases) {
    if (one.kind != BlindKind::single) continue;
    guessed.add(list[std::min(list.size() - 1, static_cast<std::size_t>(random.uniform() *
                                                                        static_cast<double>(list.size())))] ==
                one.hidden.front());
    ++hidden[one.hidden.front()];
  }
  Count always{0, guessed.trials};
  for (const auto& [effect, times] : hidden) always.hits = std::max(always.hits, times);
  table.beside("baseline: an effect at random, exact", guessed);
  table.beside("baseline: always the effect hidden most often, exact", always);
  constexpr std::array<std::pair<const char*, const char*>, 3> naive{
      {{"least_error", "smallest error after refitting"},
       {"white_noise", "Akaike's criterion with white noise"},
       {"one_seed", "smallest error, one seed"}}};
  for (const auto& [key, what] : naive) {
    Count exact, alarms;
    for (const OpenedCase& one : cases) {
      if (!one.naive) continue;
      const auto named = one.naive->find(key);
      const bool lost = named == one.naive->end();
      if (one.kind == BlindKind::single)
        exact.add(!lost && named->second == one.hidden.front());
      else
        alarms.add(lost || !named->second.empty());
    }
    table.beside(fmt::format("baseline: {}, exact", what), exact);
    table.beside(fmt::format("baseline: {}, false alarms", what), alarms);
  }
}

std::string line_of(const OpenedCase& one) {
  const auto joined = [](const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : " + ") + name;
    return text.empty() ? "-" : text;
  };
  return fmt::format("{} {:<10} {:<5} snr {:>5.1f}  hidden {}  answer {} {}  error/floor {}  {:.0f} s",
                     one.name, blind_kind_names[static_cast<std::size_t>(one.kind)],
                     one.exact() ? "right" : "WRONG", one.signal, joined(one.hidden), one.verdict,
                     joined(one.missing),
                     one.error_over_floor ? fmt::format("{:.2f}", *one.error_over_floor) : "-", one.seconds);
}

void seconds(const std::vector<OpenedCase>& cases, ScoreTable& table) {
  std::vector<double> all;
  for (const OpenedCase& one : cases)
    if (!one.lost) all.push_back(one.seconds);
  if (all.empty()) return;
  std::sort(all.begin(), all.end());
  double sum = 0;
  for (const double one : all) sum += one;
  table.plain("seconds of a diagnosis: median, longest; hours of all", "-",
              fmt::format("{:.0f}, {:.0f}; {:.2f}", all[all.size() / 2], all.back(), sum / 3600),
              Kept::not_measured);
}

/// Tells the ledger that the answers are opened, and returns whether somebody had seen this seed before it
/// was answered.
bool told_to_ledger(const fs::path& file, const LedgerKey& key, bool all_answered) {
  SeedLedger ledger(file);
  if (all_answered) ledger.answered(key);
  ledger.opened(key);
  return ledger.seen(key);
}

}  // namespace

BlindScore score_blind_suite(const fs::path& folder, const TrialTools& tools, const fs::path& ledger) {
  std::map<std::string, std::string> seals;
  LedgerKey key{"blind-suite", 0, ""};
  read_json_file(folder / "plan.json", "the plan of a suite",
                 "put back the one that was there when the suite began", [&](const std::string& text) {
                   const Json plan = Json::parse(text);
                   plan.at("sealed").get_to(seals);
                   key.seed = plan.at("seed");
                   key.drawn = plan.value("drawn", "");
                 });
  BlindScore score;
  std::vector<OpenedCase> cases;
  for (const auto& [name, seal] : seals)
    if (fs::exists(folder / "answers" / (name + ".json"))) cases.push_back(open_case(folder, name, seal));
  score.planned = static_cast<int>(seals.size());
  score.answered = static_cast<int>(cases.size());
  for (const OpenedCase& one : cases) {
    score.lost += one.lost;
    for (const std::string& program : one.programs) ++score.programs[program];
  }
  score.seen = told_to_ledger(ledger, key, score.answered == score.planned);
  ScoreTable table;
  nulls(cases, table);
  singles(cases, table);
  widths(cases, table);
  inventions(cases, table);
  films(cases, table);
  dampers(cases, table);
  unlisted_forces(cases, tools, table);
  twins(cases, table);
  log_scores(cases, table);
  reliability(cases, table);
  coverage_by_quantile(cases, table);
  baselines(cases, table);
  seconds(cases, table);
  score.figures = table.rows;
  for (const OpenedCase& one : cases) score.cases.push_back(line_of(one));
  return score;
}

std::string blind_score_text(const BlindScore& score) {
  std::string text = fmt::format("{} of {} cases answered{}\n", score.answered, score.planned,
                                 score.seen ? " (SEEN: this seed had been opened before)" : "");
  for (const auto& [program, answers] : score.programs) text += fmt::format("  {} by {}\n", answers, program);
  if (score.lost > 0) text += fmt::format("  {} broke down, and count as wrong in every line\n", score.lost);
  for (const BlindFigure& figure : score.figures)
    text += fmt::format("  {:<72} {:<13} {:<42} {}\n", figure.what, figure.aim, figure.found,
                        figure.verdict == Kept::met      ? "met"
                        : figure.verdict == Kept::missed ? "MISSED"
                                                         : "");
  return text;
}

std::string blind_score_json(const BlindScore& score) {
  Json figures = Json::array();
  for (const BlindFigure& figure : score.figures)
    figures.push_back(
        {{"what", figure.what},
         {"aim", figure.aim},
         {"found", figure.found},
         {"met", figure.verdict == Kept::not_measured ? Json(nullptr) : Json(figure.verdict == Kept::met)}});
  return Json{{"schema_version", 1},        {"seen", score.seen},  {"planned", score.planned},
              {"answered", score.answered}, {"lost", score.lost},  {"programs", score.programs},
              {"figures", figures},         {"cases", score.cases}}
             .dump(2) +
         "\n";
}

}  // namespace shakedown
