// SPDX-License-Identifier: MIT
// The answers of a blind suite opened and counted.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "blind_suite.hpp"
#include "effects.hpp"
#include "force_likeness.hpp"
#include "random.hpp"
#include "sealed.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using Names = std::set<std::string>;
using Kept = BlindFigure::Verdict;

/// One case with its answer, opened.
struct Opened {
  std::string name;
  BlindKind kind;
  Json truth, answer, more;  ///< more: a twin's second answer, null without
  std::vector<std::string> hidden, missing;
  double signal = 0;
  Judgement judgement;
  bool lost = false;  ///< no answer: the diagnosis broke down

  const Json& diagnosis() const { return answer["diagnosis"]; }
  std::string verdict() const { return lost ? "no answer" : diagnosis().value("verdict", ""); }
  bool exact() const { return judgement.named; }
};

Verdict verdict_of(const std::string& name) {
  for (const Verdict verdict : {Verdict::adequate, Verdict::refit, Verdict::missing, Verdict::unknown})
    if (name_of(verdict) == name) return verdict;
  return Verdict::unknown;
}

Judgement judgement_of(const Opened& one, const Json& diagnosis) {
  return judge(one.hidden, !one.truth["laboratory"].empty(), verdict_of(diagnosis.value("verdict", "")),
               diagnosis.value("missing", std::vector<std::string>{}));
}

BlindKind kind_of(const std::string& name) {
  const auto found = std::find(blind_kind_names.begin(), blind_kind_names.end(), name);
  return static_cast<BlindKind>(found - blind_kind_names.begin());
}

Opened opened(const fs::path& folder, const std::string& name, const std::string& seal) {
  const fs::path file = folder / "sealed" / (name + ".json");
  const std::string sealed = read_text_file(file);
  if (digest_of_text(sealed) != seal)
    throw InputError({{{file.string(), 0, 0},
                       "",
                       "is not the answer that was sealed (its digest differs from plan.json's)",
                       "run the suite again in another folder"}});
  Opened one;
  one.name = name;
  one.truth = Json::parse(sealed);
  one.kind = kind_of(one.truth["kind"]);
  one.hidden = one.truth["hidden"].get<std::vector<std::string>>();
  one.signal = one.truth["signal_to_noise"];
  one.answer = Json::parse(read_text_file(folder / "answers" / (name + ".json")));
  one.lost = !one.answer.contains("diagnosis");
  if (!one.lost) {
    one.missing = one.diagnosis().value("missing", std::vector<std::string>{});
    one.judgement = judgement_of(one, one.diagnosis());
  }
  if (const fs::path more = folder / "answers" / (name + "_more.json"); fs::exists(more))
    one.more = Json::parse(read_text_file(more));
  return one;
}

/// An effect with those that the diagnosis calls its look-alikes.
Names with_look_alikes(const Opened& one) {
  Names names(one.missing.begin(), one.missing.end());
  const auto add = [&](const Json& list) {
    for (const Json& item : list)
      if (std::find(one.missing.begin(), one.missing.end(), item.value("effect", "")) != one.missing.end())
        for (const Json& alike : item["look_alikes"]) names.insert(alike.get<std::string>());
  };
  add(one.diagnosis()["ranking"]);
  add(one.diagnosis()["momentum"]["terms"]);
  return names;
}

bool first_suspects_family_is_right(const Opened& one) {
  return !one.missing.empty() &&
         std::any_of(one.hidden.begin(), one.hidden.end(), [&](const std::string& effect) {
           return family_of(effect) == family_of(one.missing.front());
         });
}

// ---- counting ----

struct Count {
  int hits = 0, trials = 0;
  void add(bool hit) { hits += hit, ++trials; }
};

std::string in_words(const Share& share) {
  return fmt::format("{} of {} ({:.0f} %, 95 %: {:.0f} to {:.0f} %)", share.hits, share.trials,
                     100 * share.value, 100 * share.low, 100 * share.high);
}

class Table {
 public:
  void at_most(const std::string& what, const Count& count, double limit) { add(what, count, limit, 1e9); }
  void at_least(const std::string& what, const Count& count, double limit) { add(what, count, -1e9, limit); }
  void between(const std::string& what, const Count& count, double low, double high) {
    const Share share = share_of(count.hits, count.trials);
    const bool told = share.trials >= 20;  // fewer cannot come between 90 and 98 %
    rows.push_back({what, fmt::format("{:.0f} to {:.0f} %", 100 * low, 100 * high), words(share),
                    told ? verdict(share, share.value >= low && share.value <= high) : Kept::not_measured});
  }
  void plain(const std::string& what, const std::string& aim, const std::string& found, Kept kept) {
    rows.push_back({what, aim, found, kept});
  }
  /// Told beside the aims.
  void beside(const std::string& what, const Count& count) {
    rows.push_back({what, "-", words(share_of(count.hits, count.trials)), Kept::not_measured});
  }

  std::vector<BlindFigure> rows;

 private:
  static std::string words(const Share& share) {
    return share.trials == 0 ? "no such case" : in_words(share);
  }
  static Kept verdict(const Share& share, bool good) {
    return share.trials == 0 ? Kept::not_measured : good ? Kept::met : Kept::missed;
  }
  void add(const std::string& what, const Count& count, double most, double least) {
    const Share share = share_of(count.hits, count.trials);
    const bool upper = most > -1e8 && least > 1e8;
    rows.push_back({what,
                    fmt::format("at {} {:.0f} %", upper ? "most" : "least", 100 * (upper ? most : least)),
                    words(share), verdict(share, upper ? share.value <= most : share.value >= least)});
  }
};

Count count(const std::vector<Opened>& cases, const std::function<bool(const Opened&)>& counted,
            const std::function<bool(const Opened&)>& hit) {
  Count result;
  for (const Opened& one : cases)
    if (counted(one)) result.add(hit(one));
  return result;
}

auto of_kind(BlindKind kind) {
  return [kind](const Opened& one) { return one.kind == kind; };
}

/// Singles whose signal is near `signal` (the drawn ones, or what the strongest sensible effect reaches).
auto singles_at(double low, double high) {
  return [low, high](const Opened& one) {
    return one.kind == BlindKind::single && one.signal >= low && one.signal < high;
  };
}

std::optional<double> number_at(const Json& object, const char* key) {
  return object.contains(key) && object[key].is_number() ? std::optional<double>(object[key].get<double>())
                                                         : std::nullopt;
}

void count_covered(const Json& found, double truth, Count& covered) {
  const auto low = number_at(found, "low"), high = number_at(found, "high");
  if (low && high) covered.add(*low <= truth && truth <= *high);
}

/// Fitted strengths of hidden effects that were named, and whether their intervals hold the truth.
Count strengths_covered(const std::vector<Opened>& cases) {
  Count covered;
  for (const Opened& one : cases) {
    if (one.lost || !one.exact()) continue;
    for (const auto& [key, truth] : one.truth["strengths"].items()) {
      const Json& parameters = one.diagnosis()["parameters"];
      if (truth.is_number() && parameters.contains(key))
        count_covered(parameters[key], truth.get<double>(), covered);
      if (truth.is_array())
        for (std::size_t axis = 0; axis < 3; ++axis)
          if (const std::string component = key + "." + "xyz"[axis]; parameters.contains(component))
            count_covered(parameters[component], truth[axis].get<double>(), covered);
    }
  }
  return covered;
}

Count parameters_covered(const std::vector<Opened>& cases, const char* key) {
  Count covered;
  for (const Opened& one : cases)
    if (!one.lost && one.exact() && one.truth["laboratory"].contains(key) &&
        one.diagnosis()["parameters"].contains(key))
      count_covered(one.diagnosis()["parameters"][key], one.truth["laboratory"][key].get<double>(), covered);
  return covered;
}

std::optional<double> error_over_floor(const Opened& one) {
  if (one.lost || one.diagnosis()["ladder"].empty()) return {};
  const auto error = number_at(one.diagnosis()["ladder"].back(), "error_box_mm"),
             floor = number_at(one.diagnosis()["noise_floor"], "box_mm");
  if (!error || !floor || *floor <= 0) return {};
  return *error / *floor;
}

void nulls(const std::vector<Opened>& cases, Table& table) {
  table.at_most("false alarms: something missing where nothing is hidden",
                count(cases, of_kind(BlindKind::null),
                      [](const Opened& one) { return one.lost || one.judgement.detected; }),
                0.03);
  std::vector<double> ensembles, balance;
  for (const Opened& one : cases) {
    if (one.kind != BlindKind::null || one.lost) continue;
    if (!one.diagnosis()["ladder"].empty())
      if (const auto p = number_at(one.diagnosis()["ladder"].front(), "p_value")) ensembles.push_back(*p);
    if (const auto p = number_at(one.diagnosis()["momentum"], "p_value")) balance.push_back(*p);
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
  table.beside("parameters alone: refit, and nothing named",
               count(cases, of_kind(BlindKind::parameters), [](const Opened& one) { return one.exact(); }));
}

void singles(const std::vector<Opened>& cases, Table& table) {
  const auto family = [](const Opened& one) { return first_suspects_family_is_right(one); };
  const auto exact = [](const Opened& one) { return one.exact(); };
  table.at_least("first suspect's class, signal to noise 12 and more",
                 count(cases, singles_at(9, 1e9), family), 0.95);
  table.at_least("exact name, signal to noise 12 and more", count(cases, singles_at(9, 1e9), exact), 0.85);
  table.at_least("first suspect's class, signal to noise 6", count(cases, singles_at(4.5, 9), family), 0.80);
  table.beside("exact name, signal to noise 6", count(cases, singles_at(4.5, 9), exact));
  table.beside("first suspect's class, signal to noise 3", count(cases, singles_at(0, 4.5), family));
}

void widths(const std::vector<Opened>& cases, Table& table) {
  table.between("intervals of the strengths hold the truth", strengths_covered(cases), 0.90, 0.98);
  for (const char* key : {"restitution.grain_grain", "restitution.grain_wall", "spring.frequency"})
    table.beside(fmt::format("intervals of {} hold the truth", key), parameters_covered(cases, key));
  Count fallen;
  for (const Opened& one : cases)
    if (one.kind == BlindKind::single || one.kind == BlindKind::pair || one.kind == BlindKind::camera)
      if (const auto ratio = error_over_floor(one)) fallen.add(*ratio <= 1.2);
  table.at_least("final error of the box within 1.2 of its floor", fallen, 0.90);
}

bool names_physics(const Opened& one) {
  return std::any_of(one.missing.begin(), one.missing.end(), [](const std::string& name) {
    const EffectRecord* record = find_effect(name);
    return record != nullptr && record->acts_on != ActsOn::camera;
  });
}

void inventions(const std::vector<Opened>& cases, Table& table) {
  table.at_most("camera artefacts called physics", count(cases, of_kind(BlindKind::camera), names_physics),
                0.05);
  table.beside("camera artefacts named exactly",
               count(cases, of_kind(BlindKind::camera), [](const Opened& one) { return one.exact(); }));
  table.at_most(
      "effects invented (named, not hidden)",
      count(
          cases,
          [](const Opened& one) { return one.kind != BlindKind::twins && one.kind != BlindKind::unlisted; },
          [](const Opened& one) { return one.judgement.invented; }),
      0.05);
  table.at_least(
      "both of a pair named",
      count(cases, of_kind(BlindKind::pair),
            [](const Opened& one) {
              return std::all_of(one.hidden.begin(), one.hidden.end(), [&](const std::string& effect) {
                return std::find(one.missing.begin(), one.missing.end(), effect) != one.missing.end();
              });
            }),
      0.85);
}

// ---- forces in no list ----

/// One of the formulas offered is the hidden force to within its strength.
bool form_is_offered(const Opened& one, const TrialTools& tools) {
  if (one.lost || !one.answer.contains("formulas")) return false;
  Setup truth = parse_setup(one.truth["setup"].get<std::string>(), one.name, tools.known);
  truth.run.duration = 8;
  const Trajectory motion = tools.model->run(truth);
  const EffectChoice& hidden = truth.effects.front();
  const std::vector<double> force = force_along(hidden.text("force"), hidden.constants("constants"), motion);
  for (const Json& found : one.answer["formulas"]) {
    const auto constants = found["constants"].get<std::map<std::string, double>>();
    std::vector<std::string> forms = found["look_alikes"].get<std::vector<std::string>>();
    forms.push_back(found["formula"].get<std::string>());
    for (const std::string& form : forms) {
      try {
        if (force_likeness(force, force_along(form, constants, motion), motion.x_box) > 0.95) return true;
      } catch (const FormulaProblem&) {  // a look-alike with constants of its own
      }
    }
  }
  return false;
}

void unlisted(const std::vector<Opened>& cases, const TrialTools& tools, Table& table) {
  table.at_least("a force in no list: \"none of the known effects\"",
                 count(cases, of_kind(BlindKind::unlisted), [](const Opened& one) { return one.exact(); }),
                 0.85);
  table.at_least("its form among those offered (cosine above 0.95)",
                 count(cases, of_kind(BlindKind::unlisted),
                       [&](const Opened& one) { return form_is_offered(one, tools); }),
                 0.80);
}

void twins(const std::vector<Opened>& cases, Table& table) {
  const auto detected = [](const Opened& one) {
    return one.kind == BlindKind::twins && !one.lost && one.judgement.detected;
  };
  table.at_least("twins: both named as look-alikes (of those that were seen)",
                 count(cases, detected,
                       [](const Opened& one) {
                         const Names names = with_look_alikes(one);
                         return names.contains(one.hidden.front()) &&
                                names.contains(one.truth["twin"].get<std::string>());
                       }),
                 0.80);
  table.beside("twins seen at all", count(cases, of_kind(BlindKind::twins),
                                          [](const Opened& one) { return one.judgement.detected; }));
  table.beside(
      "twins told apart with all lengths, other numbers of grains and an empty box",
      count(
          cases,
          [](const Opened& one) { return one.kind == BlindKind::twins && one.more.contains("diagnosis"); },
          [](const Opened& one) { return judgement_of(one, one.more["diagnosis"]).named; }));
}

/// What luck and prejudice come to, on the same cases.
void baselines(const std::vector<Opened>& cases, Table& table) {
  Names all;
  for (const Hideable& hideable : hideable_effects()) all.insert(std::string(hideable.effect));
  const std::vector<std::string> list(all.begin(), all.end());
  Random random(7, 0, Stream::other);
  Count guessed, always;
  for (const Opened& one : cases) {
    if (one.kind != BlindKind::single) continue;
    guessed.add(list[std::min(list.size() - 1, static_cast<std::size_t>(random.uniform() *
                                                                        static_cast<double>(list.size())))] ==
                one.hidden.front());
    always.add(one.hidden.front() == "blade_viscous_damping");
  }
  table.beside("baseline: an effect at random, exact", guessed);
  table.beside("baseline: always viscous damping, exact", always);
  constexpr std::array<std::pair<const char*, const char*>, 3> naive{
      {{"least_error", "smallest error after refitting"},
       {"white_noise", "Akaike's criterion with white noise"},
       {"one_seed", "smallest error, one seed"}}};
  for (const auto& [key, what] : naive) {
    Count exact, alarms;
    for (const Opened& one : cases) {
      if (!one.answer.contains("naive")) continue;
      const std::string named = one.answer["naive"][key];
      if (one.kind == BlindKind::single)
        exact.add(named == one.hidden.front());
      else
        alarms.add(!named.empty());
    }
    table.beside(fmt::format("baseline: {}, exact", what), exact);
    table.beside(fmt::format("baseline: {}, false alarms", what), alarms);
  }
}

std::string line_of(const Opened& one) {
  const auto joined = [](const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : " + ") + name;
    return text.empty() ? "-" : text;
  };
  const auto ratio = error_over_floor(one);
  return fmt::format("{} {:<10} {:<5} snr {:>5.1f}  hidden {}  answer {} {}  error/floor {}  {:.0f} s",
                     one.name, blind_kind_names[static_cast<std::size_t>(one.kind)],
                     one.exact() ? "right" : "WRONG", one.signal, joined(one.hidden), one.verdict(),
                     joined(one.missing), ratio ? fmt::format("{:.2f}", *ratio) : "-",
                     one.lost ? 0.0 : one.diagnosis().value("seconds", 0.0));
}

void seconds(const std::vector<Opened>& cases, Table& table) {
  std::vector<double> all;
  for (const Opened& one : cases)
    if (!one.lost) all.push_back(one.diagnosis().value("seconds", 0.0));
  if (all.empty()) return;
  std::sort(all.begin(), all.end());
  double sum = 0;
  for (const double one : all) sum += one;
  table.plain("seconds of a diagnosis: median, longest; hours of all", "-",
              fmt::format("{:.0f}, {:.0f}; {:.2f}", all[all.size() / 2], all.back(), sum / 3600),
              Kept::not_measured);
}

}  // namespace

BlindScore score_blind_suite(const fs::path& folder, const TrialTools& tools) {
  const Json plan = Json::parse(read_text_file(folder / "plan.json"));
  BlindScore score;
  std::vector<Opened> cases;
  for (const auto& [name, seal] : plan["sealed"].items()) {
    ++score.planned;
    if (fs::exists(folder / "answers" / (name + ".json")))
      cases.push_back(opened(folder, name, seal.get<std::string>()));
  }
  score.answered = static_cast<int>(cases.size());
  Table table;
  nulls(cases, table);
  singles(cases, table);
  widths(cases, table);
  inventions(cases, table);
  unlisted(cases, tools, table);
  twins(cases, table);
  baselines(cases, table);
  seconds(cases, table);
  score.figures = table.rows;
  for (const Opened& one : cases) score.cases.push_back(line_of(one));
  return score;
}

std::string blind_score_text(const BlindScore& score) {
  std::string text = fmt::format("{} of {} cases answered\n", score.answered, score.planned);
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
  return Json{{"schema_version", 1},
              {"planned", score.planned},
              {"answered", score.answered},
              {"figures", figures},
              {"cases", score.cases}}
             .dump(2) +
         "\n";
}

}  // namespace shakedown
