// SPDX-License-Identifier: MIT
// A blind suite answered and scored: on answers written by hand, and the whole way.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "blind_suite.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "naive_answers.hpp"
#include "scratch_folder.hpp"
#include "toml_document.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

/// A suite of `counts` whose plan and seals exist, each answer written by `answer`.
void answered(const fs::path& folder, const BlindCounts& counts,
              const std::function<std::string(const nlohmann::json& truth)>& answer,
              const shakedown::Setup& believed = {}) {
  const auto hard = engine_named("hard");
  std::atomic<bool> stop = true;  // sealed, then stopped before the first case is measured
  const TrialTools tools{hard.get(), hard.get(), all_effects(), 100, 1, &stop};
  BlindSuiteOptions options;
  options.counts = counts;
  options.small = true;
  fs::create_directories(folder / "answers");
  nlohmann::json table;
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list)
      table["signals"][hideable.id] = {{"strength", 1}, {"signal", 20}, {"power", 1}, {"by", "ensembles"}};
  for (const BlindCase& one : draw_cases(believed, counts, small_design(), {}, options.seed, all_effects()))
    for (const std::string& id : one.strengths) table["signals"][id] = table["signals"]["grain_friction"];
  write(folder / "strengths.json", table.dump());
  EXPECT_THROW(run_blind_suite(folder, believed, tools, options), Interrupted);
  for (const fs::directory_entry& file : fs::directory_iterator(folder / "sealed"))
    write(folder / "answers" / file.path().filename(),
          answer(nlohmann::json::parse(read_text_file(file.path()))));
}

std::string answer_of(const std::string& verdict, const std::vector<std::string>& missing, double p = 0.5) {
  return nlohmann::json{{"diagnosis",
                         {{"verdict", verdict},
                          {"missing", missing},
                          {"parameters", nlohmann::json::object()},
                          {"ranking", nlohmann::json::array()},
                          {"ladder", {{{"step", "as given"}, {"error_box_mm", 0.5}, {"p_value", p}}}},
                          {"noise_floor", {{"box_mm", 0.5}}},
                          {"momentum", {{"p_value", p}, {"terms", nlohmann::json::array()}}},
                          {"seconds", 1.0}}},
                        {"formulas", nlohmann::json::array()}}
      .dump();
}

BlindScore scored(const fs::path& folder) {
  const auto hard = engine_named("hard");
  return score_blind_suite(folder, {hard.get(), hard.get(), all_effects(), 100, 1, nullptr});
}

const BlindFigure& figure(const BlindScore& score, const std::string& what) {
  for (const BlindFigure& one : score.figures)
    if (one.what.starts_with(what)) return one;
  throw std::runtime_error("no figure " + what);
}

/// Of cases that are all answered: nothing is simulated.
void run_suite(const fs::path& folder, const BlindSuiteOptions& options) {
  const auto hard = engine_named("hard");
  run_blind_suite(folder, {}, {hard.get(), hard.get(), all_effects(), 100, 1, nullptr}, options);
}

/// What an InputError says.
std::string refusal(const std::function<void()>& does) {
  try {
    does();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing is refused";
}

constexpr BlindCounts some{10, 0, 15, 5, 4, 0, 0};

}  // namespace

TEST(BlindScores, APerfectDiagnosisMeetsEveryAim) {
  const ScratchFolder folder;
  answered(folder.path(), some, [](const nlohmann::json& truth) {
    const auto hidden = truth["hidden"].get<std::vector<std::string>>();
    return answer_of(hidden.empty() ? "adequate" : "missing", hidden,
                     0.3 + 0.4 * static_cast<double>(truth["seed"].get<std::uint64_t>() % 1000) / 1000);
  });
  const BlindScore score = scored(folder.path());
  EXPECT_EQ(score.answered, 34);
  for (const BlindFigure& one : score.figures)
    EXPECT_NE(one.verdict, BlindFigure::Verdict::missed) << one.what << " " << one.found;
  EXPECT_EQ(figure(score, "exact name, signal to noise 12").verdict, BlindFigure::Verdict::met);
  EXPECT_EQ(figure(score, "both of a pair").found.substr(0, 6), "4 of 4");
}

TEST(BlindScores, ADiagnosisThatAlwaysAccusesTheSameFails) {
  const ScratchFolder folder;
  answered(folder.path(), some,
           [](const nlohmann::json&) { return answer_of("missing", {"blade_viscous_damping"}, 0.001); });
  const BlindScore score = scored(folder.path());
  for (const char* what : {"false alarms", "p-values of the model",
                           "first suspect's class, signal to noise 12", "exact name, signal to noise 12",
                           "camera artefacts called physics", "effects invented", "both of a pair"})
    EXPECT_EQ(figure(score, what).verdict, BlindFigure::Verdict::missed)
        << what << ": " << figure(score, what).found;
}

TEST(BlindScores, SimplerMethodsStandBeside) {
  const ScratchFolder folder;
  answered(folder.path(), {2, 0, 3, 0, 0, 0, 0}, [](const nlohmann::json& truth) {
    auto answer = nlohmann::json::parse(answer_of("adequate", {}));
    const auto hidden = truth["hidden"].get<std::vector<std::string>>();
    answer["naive"] = {{"least_error", "grain_friction"},
                       {"white_noise", hidden.empty() ? "" : hidden[0]},
                       {"one_seed", ""}};
    return answer.dump();
  });
  const BlindScore score = scored(folder.path());
  EXPECT_EQ(figure(score, "baseline: smallest error after refitting, false alarms").found.substr(0, 6),
            "2 of 2");
  EXPECT_EQ(figure(score, "baseline: Akaike's criterion with white noise, exact").found.substr(0, 6),
            "3 of 3");
  EXPECT_EQ(figure(score, "baseline: smallest error, one seed, exact").found.substr(0, 6), "0 of 3");
}

TEST(BlindScores, ASealedAnswerThatWasTouchedIsRefused) {
  const ScratchFolder folder;
  answered(folder.path(), {1, 0, 0, 0, 0, 0, 0},
           [](const nlohmann::json&) { return answer_of("adequate", {}); });
  const fs::path sealed = folder / "sealed" / "case_0001.json";
  write(sealed, read_text_file(sealed) + " ");
  EXPECT_THROW(scored(folder.path()), InputError);
}

TEST(BlindScores, ATableOfStrengthsThatIsNoneIsNamed) {
  const ScratchFolder folder;
  BlindSuiteOptions options;
  options.strengths = folder / "old.json";
  for (const std::string text : {R"({"signals": {"camera_scale": 3}})", R"({"strengths": {}})", "no table"}) {
    write(options.strengths, text);
    try {
      run_suite(folder / "suite", options);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.violations.front().place.file, options.strengths.string());
    }
  }
}

TEST(BlindScores, AFolderHoldsOneSuite) {
  const ScratchFolder folder;
  answered(folder.path(), {1, 0, 0, 0, 0, 0, 0},
           [](const nlohmann::json&) { return answer_of("adequate", {}); });
  BlindSuiteOptions options;
  options.counts = {1, 0, 0, 0, 0, 0, 0};
  options.small = true;
  EXPECT_THROW(run_suite(folder.path(), options), InputError);  // without resume
  options.resume = true;
  EXPECT_NO_THROW(run_suite(folder.path(), options));
  options.seed = 2;
  EXPECT_NE(refusal([&] { run_suite(folder.path(), options); }).find("--seed (1 there, 2 here)"),
            std::string::npos);
}

TEST(BlindScores, WhatIsDrawnOtherwiseThanItWasSealedIsNotDiagnosed) {
  const ScratchFolder folder;
  answered(folder.path(), {0, 0, 2, 0, 0, 0, 0},
           [](const nlohmann::json&) { return answer_of("adequate", {}); });
  std::string table = read_text_file(folder / "strengths.json");
  for (std::size_t at = 0; (at = table.find("\"signal\": 20", at)) != table.npos;) table[at + 10] = '3';
  write(folder / "strengths.json", table);
  BlindSuiteOptions options;
  options.counts = {0, 0, 2, 0, 0, 0, 0};
  options.small = options.resume = true;
  const std::string text = refusal([&] { run_suite(folder.path(), options); });
  for (const char* word : {"plan.json", "2 of 2 cases", "case_0001", "strengths.json"})
    EXPECT_NE(text.find(word), std::string::npos) << word << " in " << text;
}

TEST(BlindScores, ADamagedFileIsNamed) {
  const ScratchFolder folder;
  answered(folder.path(), {1, 0, 0, 0, 0, 0, 0},
           [](const nlohmann::json&) { return answer_of("adequate", {}); });
  const std::vector<std::pair<std::string, std::string>> damages{
      {"answers/case_0001.json", "{"},
      {"answers/case_0001.json", R"({"diagnosis": {}})"},
      {"plan.json", "{"},
      {"plan.json", "{}"},
      {"plan.json", R"({"sealed": 3})"}};
  for (const auto& [name, damage] : damages) {
    write(folder / name, damage);
    EXPECT_NE(refusal([&] { scored(folder.path()); }).find((folder / name).string()), std::string::npos)
        << name << " " << damage;
  }
}

TEST(BlindScores, AForceInNoListIsFoundBesideWhatIsBelieved) {
  const ScratchFolder folder;
  const shakedown::Setup believed =
      changed({}, overrides_of_effect("grain_friction=grain_grain:0.1"), all_effects());
  answered(
      folder.path(), {0, 0, 0, 0, 0, 1, 0},
      [](const nlohmann::json& truth) {
        auto answer = nlohmann::json::parse(answer_of("unknown", {}));
        answer["formulas"].push_back({{"formula", truth["strengths"]["user_force.force"]},
                                      {"constants", {{"c", 1.0}, {"x0", 0.045}, {"w", 0.012}}},
                                      {"look_alikes", nlohmann::json::array()}});
        return answer.dump();
      },
      believed);
  EXPECT_EQ(figure(scored(folder.path()), "its form, where there is one").found.substr(0, 6), "1 of 1");
}

TEST(BlindScores, ACaseLostIsWrongInEveryFigure) {
  const ScratchFolder folder;
  answered(folder.path(), {2, 0, 2, 2, 2, 0, 2}, [](const nlohmann::json& truth) {
    nlohmann::json answer{{"error", "grains overlap"}, {"program", "shakedown 9"}};
    if (truth["kind"] == "nulls" || truth["kind"] == "singles")
      answer["naive"] = nlohmann::json::object(), answer["naive_error"] = "grains overlap";
    return answer.dump();
  });
  for (const fs::directory_entry& sealed : fs::directory_iterator(folder / "sealed"))
    if (nlohmann::json::parse(read_text_file(sealed.path()))["kind"] == "twins")
      write(folder / "answers" / (sealed.path().stem().string() + "_more.json"), R"({"error": "overlap"})");
  const BlindScore score = scored(folder.path());
  EXPECT_EQ(score.lost, 10);
  EXPECT_EQ(score.programs.at("shakedown 9"), 10);
  const std::vector<std::pair<std::string, std::string>> expected{
      {"false alarms", "2 of 2"},
      {"camera artefacts called physics", "2 of 2"},
      {"effects invented", "8 of 8"},
      {"final error of the box", "0 of 6"},
      {"both of a pair", "0 of 2"},
      {"twins told apart", "0 of 2"},
      {"baseline: smallest error after refitting, exact", "0 of 2"},
      {"baseline: smallest error after refitting, false alarms", "2 of 2"}};
  for (const auto& [what, found] : expected)
    EXPECT_TRUE(figure(score, what).found.starts_with(found + " "))
        << what << ": " << figure(score, what).found;
}

TEST(BlindScores, TwinsMayBeToldApartOrCalledAlike) {
  const ScratchFolder folder;
  int answers = 0;
  // the right one alone, both as look-alikes, the wrong one
  answered(folder.path(), {0, 0, 0, 0, 0, 0, 3}, [&](const nlohmann::json& truth) {
    const std::string hidden = truth["hidden"][0], twin = truth["twin"];
    const std::string named = answers == 0 ? hidden : twin;
    auto answer = nlohmann::json::parse(answer_of("missing", {named}));
    if (answers++ == 1) answer["diagnosis"]["ranking"] = {{{"effect", twin}, {"look_alikes", {hidden}}}};
    return answer.dump();
  });
  const BlindScore score = scored(folder.path());
  EXPECT_EQ(figure(score, "twins: both named as look-alikes").found.substr(0, 6), "1 of 3");
  EXPECT_EQ(figure(score, "twins: both named, or the hidden one alone").found.substr(0, 6), "2 of 3");
}

TEST(BlindScores, IntervalsOfParametersAreCountedOfRightAndOfAllAnswers) {
  const ScratchFolder folder;
  int answers = 0;
  answered(folder.path(), {0, 4, 0, 0, 0, 0, 0}, [&](const nlohmann::json& truth) {
    // the first names an effect that is not there, and its interval misses
    const bool wrong = answers++ == 0;
    auto answer =
        nlohmann::json::parse(wrong ? answer_of("missing", {"grain_friction"}) : answer_of("refit", {}));
    const double frequency = truth["laboratory"]["spring.frequency"];
    answer["diagnosis"]["parameters"]["spring.frequency"] = {{"low", wrong ? frequency + 1 : frequency - 1},
                                                             {"high", frequency + 2}};
    return answer.dump();
  });
  const BlindScore score = scored(folder.path());
  const std::string what = "intervals of spring.frequency hold the truth ";
  EXPECT_EQ(figure(score, what + "(named exactly)").found.substr(0, 6), "3 of 3");
  EXPECT_EQ(figure(score, what + "(all answers)").found.substr(0, 6), "3 of 4");
}

// ---- the whole way, with real diagnoses ----

TEST(SlowBlindSuite, NullsAndACameraErrorAreToldApart) {
  const ScratchFolder folder;
  const auto soft = engine_named("soft"), hard = engine_named("hard");
  const TrialTools tools{soft.get(), hard.get(), all_effects(), 4000, 1, nullptr};
  // as measured by the suite itself
  write(folder / "strengths.json",
        R"({"signals": {"camera_com_bias": {"strength": 1, "signal": 55, "power": 1, "by": "balance"}}})");
  BlindSuiteOptions options;
  options.counts = {2, 0, 0, 1, 0, 0, 0};
  options.small = true;
  run_blind_suite(folder.path(), {}, tools, options);
  const BlindScore score = scored(folder.path());
  EXPECT_EQ(score.answered, 3);
  EXPECT_EQ(figure(score, "false alarms").found.substr(0, 6), "0 of 2");
  EXPECT_EQ(figure(score, "camera artefacts named exactly").found.substr(0, 6), "1 of 1");
}

TEST(SlowNaiveAnswers, NameAStrongForceAndAccuseWhereNothingIsHidden) {
  const auto hard = engine_named("hard");
  const TrialTools tools{hard.get(), hard.get(), all_effects(), 4000, 0, nullptr};
  Trial trial;
  trial.runs = small_design().runs;
  trial.hidden = {{}, changed({}, at_strength(*find_hideable("spring_cubic"), 2), all_effects())};
  Workshop workshop{hard.get(), all_effects(), {0}};
  EnsembleCache ensembles;  // much is simulated for both
  workshop.store.recordings = &ensembles;
  const auto answers = [&] {
    return naive_answers({}, measurement_of(shakedown::Setup{}, measured_in(trial, tools), all_effects()),
                         workshop);
  };
  const NaiveAnswers strong = answers();
  EXPECT_EQ(strong.least_error, "spring_cubic");
  EXPECT_EQ(strong.white_noise, "spring_cubic");
  trial.hidden.truth = {};
  // chaos from run to run is no white noise
  EXPECT_NE(answers().white_noise, "");
}

TEST(BlindSuites, SeveralProcessesAnswerEachItsShare) {
  const ScratchFolder folder;
  answered(folder.path(), {3, 0, 3, 0, 0, 0, 0},
           [](const nlohmann::json&) { return answer_of("adequate", {}); });
  for (const char* gone : {"case_0002.json", "case_0006.json"}) fs::remove(folder / "answers" / gone);
  EXPECT_FALSE(all_answered(folder.path()));
  BlindSuiteOptions options;
  options.counts = {3, 0, 3, 0, 0, 0, 0};
  options.small = true;
  options.share = {0, 2, "a test"};  // cases 1, 3 and 5, which have their answers
  run_suite(folder.path(), options);
  EXPECT_FALSE(all_answered(folder.path()));
  options.share = {1, 2, "a test"};
  std::atomic<bool> stop = true;
  const auto hard = engine_named("hard");
  EXPECT_THROW(
      run_blind_suite(folder.path(), {}, {hard.get(), hard.get(), all_effects(), 100, 1, &stop}, options),
      Interrupted);
  answered(folder / "another", {1, 0, 0, 0, 0, 0, 0},
           [](const nlohmann::json&) { return answer_of("adequate", {}); });
  EXPECT_TRUE(all_answered(folder / "another"));
}

TEST(BlindSuites, AProcessThatDoesNotDrawWaitsForTheDraw) {
  const ScratchFolder folder;
  BlindSuiteOptions options;
  options.share = {1, 2, "a test"};
  std::atomic<bool> stop = true;  // else it would wait without end
  const auto hard = engine_named("hard");
  EXPECT_THROW(
      run_blind_suite(folder.path(), {}, {hard.get(), hard.get(), all_effects(), 100, 1, &stop}, options),
      Interrupted);
  EXPECT_FALSE(fs::exists(folder / "plan.json"));
}

TEST(BlindScores, ProbabilitiesAreReadAndWhatDiffersInThePackingAloneIsOneAnswer) {
  const ScratchFolder folder;
  answered(folder.path(), {0, 0, 4, 0, 0, 0, 0}, [](const nlohmann::json& truth) {
    auto answer = nlohmann::json::parse(answer_of("missing", truth["hidden"]));
    auto with_packing = truth["hidden"].get<std::vector<std::string>>();
    with_packing.push_back("initial_packing");
    answer["diagnosis"]["hypotheses"] = {{{"effects", truth["hidden"]}, {"probability", 0.5}},
                                         {{"effects", with_packing}, {"probability", 0.3}},
                                         {{"effects", nlohmann::json::array()}, {"probability", 0.2}}};
    return answer.dump();
  });
  const BlindScore score = scored(folder.path());
  EXPECT_EQ(figure(score, "mean log score, 0").found, "0.22 (4 cases)");  // -ln 0.8
  EXPECT_EQ(figure(score, "reliability: first answers with probability 0.80").found.substr(0, 6), "4 of 4");
}
