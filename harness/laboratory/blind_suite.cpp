// SPDX-License-Identifier: MIT
#include "blind_suite.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "fnv.hpp"
#include "naive_answers.hpp"
#include "output_file.hpp"
#include "provenance.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

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
    open();
    const std::vector<BlindCase> cases =
        draw_cases(believed_, options_.counts, design_, laws(), options_.seed, tools_.known);
    seal(cases);
    int done = 0;
    for (const BlindCase& one : cases) {
      answer(one, one.name, one.trial);
      if (!one.more.empty()) {
        Trial more = one.trial;
        more.runs = one.more;
        answer(one, one.name + "_more", more);
      }
      tell(std::to_string(++done) + " of " + std::to_string(cases.size()) + " cases done");
    }
  }

 private:
  void tell(const std::string& line) const {
    if (options_.told) options_.told(line);
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
            {"fault", method_fault_names[static_cast<std::size_t>(tools_.fault)]}};
  }

  /// A folder holds one suite.
  void open() const {
    const fs::path file = folder_ / "plan.json";
    if (!fs::exists(file)) return;
    if (!options_.resume)
      throw InputError({{{file.string(), 0, 0},
                         "",
                         "a suite stands there already",
                         "go on with --resume, or name another folder"}});
    Json there = Json::parse(read_text_file(file));
    there.erase("sealed");
    there.erase("program");
    if (there != plan())
      throw InputError({{{file.string(), 0, 0},
                         "",
                         "is the plan of another suite (other setup, seed or numbers of cases)",
                         "go on with the same ones, or name another folder"}});
  }

  SignalLaws laws() const {
    const fs::path file = folder_ / "strengths.json";
    const fs::path given = fs::exists(file) ? file : options_.strengths;
    SignalLaws table = given.empty() ? SignalLaws{} : read_laws(given);
    const std::vector<std::string> needed = needed_ids();
    const std::string twins = strength_name("", BlindKind::twins);
    for (const std::string& id : needed) {
      if (table.contains(id)) continue;
      // Of the experiment as designed: a worse one is given the same strengths.
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
    const std::string text = read_text_file(file);
    try {
      const Json document = Json::parse(text);
      for (const auto& [id, law] : document.at("signals").items())
        table[id] = {law.at("strength").get<double>(), law.at("signal").get<double>(),
                     law.at("power").get<double>(), law.at("by") == "balance"};
    } catch (const nlohmann::json::exception& problem) {
      throw InputError(
          {{{file.string()},
            "",
            std::string("not a table of signals that this version writes (") + problem.what() + ")",
            "leave it out, and the table is measured anew; an earlier suite's folder has one as "
            "strengths.json"}});
    }
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

  /// What these cases hide; drawn once with no table to learn it.
  std::vector<std::string> needed_ids() const {
    std::vector<std::string> ids;
    for (const BlindCase& one :
         draw_cases(believed_, options_.counts, design_, {}, options_.seed, tools_.known))
      for (const std::string& id : one.strengths)
        if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  void seal(const std::vector<BlindCase>& cases) const {
    Json digests = Json::object();
    for (const BlindCase& one : cases) {
      Json sealed = Json::parse(truth_json(one.trial.hidden, one.trial.recording,
                                           std::string(tools_.laboratory->name()), one.trial.seed));
      sealed["kind"] = blind_kind_names[static_cast<std::size_t>(one.kind)];
      sealed["ids"] = one.ids;
      sealed["signal_to_noise"] = one.signal_to_noise;
      sealed["twin"] = one.twin;
      const std::string text = sealed.dump(2) + "\n";
      digests[one.name] = hexadecimal(fnv1a(text));
      const fs::path file = folder_ / "sealed" / (one.name + ".json");
      if (!fs::exists(file)) write_file(file, text);
    }
    Json document = plan();
    document["program"] = version_line();
    document["sealed"] = digests;
    if (!fs::exists(folder_ / "plan.json")) write_file(folder_ / "plan.json", document.dump(2) + "\n");
  }

  void answer(const BlindCase& one, const std::string& name, const Trial& trial) const {
    const fs::path file = folder_ / "answers" / (name + ".json");
    const bool answered = fs::exists(file);
    Json document = answered ? Json::parse(read_text_file(file)) : Json{{"case", one.name}};
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
    const Workshop workshop{tools_.model, tools_.known, tools_.threads, tools_.stop, {}, nullptr};
    const NaiveAnswers naive = naive_answers(trial.hidden.believed, measured_in(trial, tools_), workshop);
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

void run_blind_suite(const fs::path& folder, const Setup& believed, const TrialTools& tools,
                     const BlindSuiteOptions& options) {
  Suite(folder, believed, tools, options).run();
}

}  // namespace shakedown
