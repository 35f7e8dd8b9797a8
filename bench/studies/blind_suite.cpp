// SPDX-License-Identifier: MIT
#include "blind_suite.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <thread>

#include "fnv.hpp"
#include "json_file.hpp"
#include "ledger.hpp"
#include "naive_answers.hpp"
#include "opened_case.hpp"
#include "output_file.hpp"
#include "provenance.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;
using Seals = std::map<std::string, std::string>;  ///< digest of each case's sealed answer

/// Returns the options in which two plans differ:
/// "--seed (8000 there, 1 here), --budget (14000 there, 100 here)".
std::string differences(const Json& there, const Json& here) {
  constexpr std::array<std::pair<const char*, const char*>, 10> options{
      {{"schema_version", "version of the plan"},
       {"seed", "--seed"},
       {"small", "--small"},
       {"variant", "--variant"},
       {"counts", "--cases"},
       {"signals", "--signals"},
       {"believed", "digest of SETUP"},
       {"laboratory", "--laboratory"},
       {"budget", "--budget"},
       {"fault", "--mutation"}}};
  std::string differ;
  for (const auto& [key, option] : options)
    if (const Json& was = there.at(key); was != here.at(key))
      differ += fmt::format("{}{} ({} there, {} here)", differ.empty() ? "" : ", ", option, was.dump(),
                            here.at(key).dump());
  return differ;
}

class Suite {
 public:
  Suite(const fs::path& folder, const Setup& believed, const TrialTools& tools,
        const BlindSuiteOptions& options)
      : folder_(folder),
        believed_(believed),
        tools_(tools),
        options_(options),
        design_(varied(options.small ? small_design() : full_design(), options.variant)) {
    if (!options.signals.empty()) design_.signals = options.signals;
  }

  void run() {
    wait_for_the_draw();
    const Seals sealed_before = open();
    const std::vector<BlindCase> cases = drawn(laws());
    const int asked = std::accumulate(options_.counts.begin(), options_.counts.end(), 0),
              left_out = asked - static_cast<int>(cases.size());
    if (left_out > 0)
      tell(fmt::format(
          "{} of {} cases are left out: the laboratory, engine '{}', does not model what they hide", left_out,
          asked, tools_.laboratory->name()));
    seal(cases, sealed_before);
    std::size_t done = 0;
    for (const BlindCase& one : cases) {
      if (!options_.share.has(done++)) continue;
      answer(one, one.name, one.trial);
      if (!one.more.empty()) {
        Trial more = one.trial;
        more.runs = one.more;
        answer(one, one.name + "_more", more);
      }
      tell(std::to_string(done) + " of " + std::to_string(cases.size()) + " cases done");
    }
  }

 private:
  void tell(const std::string& line) const {
    if (options_.told) options_.told(line);
  }

  std::vector<BlindCase> drawn(const SignalLaws& laws) const {
    return cases_within_reach(
        draw_cases(believed_, options_.counts, design_, laws, options_.seed, tools_.known),
        *tools_.laboratory);
  }

  Json plan() const {
    Json counts = Json::object();
    for (std::size_t kind = 0; kind < options_.counts.size(); ++kind)
      counts[std::string(blind_kind_names[kind])] = options_.counts[kind];
    return {{"schema_version", 1},
            {"seed", options_.seed},
            {"small", options_.small},
            {"variant", options_.variant},
            {"counts", counts},
            {"signals", design_.signals},
            {"believed", digest(believed_)},
            {"laboratory", tools_.laboratory->name()},
            {"budget", tools_.budget},
            {"fault", options_.fault}};
  }

  /// Waits until the first of several processes, which alone measures strengths and seals, has done so.
  void wait_for_the_draw() const {
    using namespace std::chrono_literals;
    if (options_.share.index == 0) return;
    for (bool told = false; !fs::exists(folder_ / "plan.json"); told = true) {
      if (!told) tell("waiting for the process that draws the cases");
      if (tools_.execution.stopped()) throw Interrupted("the cases were not drawn yet");
      std::this_thread::sleep_for(200ms);
    }
  }

  /// Returns the seals of the suite in the folder, none where a suite is to begin. A folder holds one suite.
  Seals open() const {
    const fs::path file = folder_ / "plan.json";
    if (!fs::exists(file)) return {};
    if (!options_.resume && options_.share.of == 1)
      throw InputError({{{file.string(), 0, 0},
                         "",
                         "a suite stands there already",
                         "go on with --resume, or name another folder"}});
    Seals seals;
    std::string others;
    read_json_file(file, "the plan of a suite", "put back the one that was there, or name another folder",
                   [&](const std::string& text) {
                     const Json there = Json::parse(text);
                     others = differences(there, plan());
                     there.at("sealed").get_to(seals);
                   });
    if (!others.empty())
      throw InputError({{{file.string(), 0, 0},
                         "",
                         "is the plan of another suite (" + others + ")",
                         "go on with the same ones, or name another folder"}});
    return seals;
  }

  SignalLaws laws() const {
    const fs::path file = folder_ / "strengths.json";
    const fs::path given = fs::exists(file) ? file : options_.strengths;
    SignalLaws table = given.empty() ? SignalLaws{} : read_laws(given);
    const std::vector<std::string> needed = needed_ids();
    const std::string twins = strength_name("", BlindKind::twins);
    for (const std::string& id : needed) {
      if (table.contains(id)) continue;
      // Strengths are measured in the experiment as designed; a worse variant gets the same ones.
      const bool twin = id.starts_with(twins);
      const std::vector<PlannedRun> runs =
          twin ? twin_runs() : (options_.small ? small_design() : full_design()).runs;
      const SignalSettings settings{runs, options_.small ? 48 : 96};
      table[id] = signal_law(*find_hideable(twin ? id.substr(twins.size()) : id), believed_,
                             options_.seed + 77, settings, tools_);
      tell("a typical " + id + " has signal to noise " +
           std::to_string(table[id].signal_at(1, 1)).substr(0, 5));
      save(file, table);
    }
    save(file, table);
    return table;
  }

  static SignalLaws read_laws(const fs::path& file) {
    SignalLaws table;
    read_json_file(file, "a table of signals that this version writes",
                   "leave it out, and the table is measured anew; an earlier suite's folder has one as "
                   "strengths.json",
                   [&](const std::string& text) {
                     const Json document = Json::parse(text);
                     for (const auto& [id, law] : document.at("signals").items())
                       table[id] = {law.at("strength").get<double>(), law.at("signal").get<double>(),
                                    law.at("power").get<double>(), law.at("by") == "balance"};
                   });
    return table;
  }

  static void save(const fs::path& file, const SignalLaws& table) {
    Json values = Json::object();
    for (const auto& [id, law] : table)
      values[id] = {{"strength", law.strength},
                    {"signal", law.signal},
                    {"power", law.power},
                    {"by", law.by_balance ? "balance" : "ensembles"}};
    write_file(file, Json{{"schema_version", 2}, {"signals", values}}.dump(2) + "\n");
  }

  /// Returns the names of what these cases hide, found by drawing them once without a table of strengths.
  std::vector<std::string> needed_ids() const {
    std::vector<std::string> ids;
    for (const BlindCase& one : drawn({}))
      for (const std::string& id : one.strengths)
        if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  /// Seals the answers. One that was sealed is never sealed anew: what is diagnosed must be what it tells of.
  void seal(const std::vector<BlindCase>& cases, const Seals& sealed_before) const {
    const bool begins = sealed_before.empty();
    Seals seals;
    std::vector<std::string> drawn_otherwise;
    for (const BlindCase& one : cases) {
      const std::string text = sealed_answer(one);
      const std::string& seal = seals[one.name] = hexadecimal(fnv1a(text));
      const auto before = sealed_before.find(one.name);
      if (!begins && (before == sealed_before.end() || before->second != seal))
        drawn_otherwise.push_back(one.name);
      else if (const fs::path file = folder_ / "sealed" / (one.name + ".json"); begins || !fs::exists(file))
        write_file(file, text);
    }
    if (!drawn_otherwise.empty())
      throw InputError({{{(folder_ / "plan.json").string(), 0, 0},
                         "sealed",
                         fmt::format("{} of {} cases are no longer drawn as they were sealed, the first: {} "
                                     "(another program, or another strengths.json)",
                                     drawn_otherwise.size(), cases.size(), drawn_otherwise.front()),
                         "go on with the program and the strengths.json that it began with, or name another "
                         "folder"}});
    if (!begins) return;
    Json document = plan();
    document["program"] = version_line();
    document["drawn"] = SeedLedger(options_.ledger).begin("blind-suite", options_.seed, version_line()).drawn;
    document["sealed"] = seals;
    write_file(folder_ / "plan.json", document.dump(2) + "\n");
  }

  std::string sealed_answer(const BlindCase& one) const {
    Json sealed = Json::parse(truth_json(one.trial.hidden, one.trial.recording,
                                         std::string(tools_.laboratory->name()), one.trial.seed));
    sealed["kind"] = blind_kind_names[static_cast<std::size_t>(one.kind)];
    sealed["ids"] = one.ids;
    sealed["signal_to_noise"] = one.signal_to_noise;
    sealed["twin"] = one.twin;
    return sealed.dump(2) + "\n";
  }

  void answer(const BlindCase& one, const std::string& name, const Trial& trial) const {
    const fs::path file = folder_ / "answers" / (name + ".json");
    const bool answered = fs::exists(file);
    Json document{{"case", one.name}, {"program", version_line()}};
    if (answered) read_answer_file(file, [&](const std::string& text) { document = Json::parse(text); });
    // also of a suite that was answered without them
    const bool ask_simpler_methods = options_.baselines && !document.contains("naive") &&
                                     (one.kind == BlindKind::null || one.kind == BlindKind::single);
    if (answered && !ask_simpler_methods) return;
    // a case lost is a wrong answer, not the end of the suite
    if (!answered) {
      try {
        put_diagnosis(trial, document);
      } catch (const PhysicsError& error) {
        document["error"] = error.what();
      }
    }
    if (ask_simpler_methods) {
      document["naive"] = Json::object();
      try {
        put_naive_answers(trial, document);
      } catch (const PhysicsError& error) {
        document["naive_error"] = error.what();
      }
    }
    write_file(file, document.dump(2) + "\n");
  }

  void put_diagnosis(const Trial& trial, Json& document) const {
    const Diagnosis diagnosis = diagnose_trial(trial, tools_);
    document["diagnosis"] = Json::parse(diagnosis_json(diagnosis));
    Json formulas = Json::array();
    for (const ForceFormula& found : diagnosis.momentum.formulas) {
      Json constants = Json::object();
      for (const FormulaConstant& constant : found.constants) constants[constant.name] = constant.value;
      formulas.push_back(
          {{"formula", found.formula}, {"constants", constants}, {"look_alikes", found.look_alikes}});
    }
    document["formulas"] = formulas;
  }

  void put_naive_answers(const Trial& trial, Json& document) const {
    const Workshop workshop{tools_.model, tools_.known, tools_.execution};
    const NaiveAnswers naive = naive_answers(
        trial.hidden.believed,
        measurement_of(trial.hidden.believed, measured_in(trial, tools_), tools_.known), workshop);
    document["naive"] = {
        {"least_error", naive.least_error}, {"white_noise", naive.white_noise}, {"one_seed", naive.one_seed}};
  }

  fs::path folder_;
  const Setup& believed_;
  const TrialTools& tools_;
  const BlindSuiteOptions& options_;
  BlindDesign design_;
};

}  // namespace

bool all_answered(const fs::path& folder) {
  for (const fs::directory_entry& sealed : fs::directory_iterator(folder / "sealed"))
    if (!fs::exists(folder / "answers" / sealed.path().filename())) return false;
  return true;
}

void run_blind_suite(const fs::path& folder, const Setup& believed, const TrialTools& tools,
                     const BlindSuiteOptions& options) {
  Suite(folder, believed, tools, options).run();
}

}  // namespace shakedown
