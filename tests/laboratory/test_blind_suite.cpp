// SPDX-License-Identifier: MIT
#include "blind_suite.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "effects.hpp"
#include "engines.hpp"
#include "naive_answers.hpp"
#include "toml_document.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

std::vector<BlindCase> drawn(std::uint64_t seed = 1, const BlindCounts& counts = full_counts) {
  Strengths unit;
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list) unit[std::string(hideable.id)] = 20;
  return draw_cases(shakedown::Setup{}, counts, full_design(), unit, seed, all_effects());
}

/// A folder of its own, gone afterwards.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("shakedown_blind_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) + "_" +
                                               ::testing::UnitTest::GetInstance()->current_test_info()->name());
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
};

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

}  // namespace

TEST(Hideable, EveryOneCanBePutIntoASetupAtAnyStrengthUpToItsStrongest) {
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list)
      for (const double part : {0.02, 0.3, 1.0}) {
        const shakedown::Setup setup = changed({}, at_strength(hideable, part * hideable.strongest), all_effects());
        ASSERT_EQ(setup.effects.size(), 1u) << hideable.id;
        EXPECT_EQ(setup.effects[0].record->name, hideable.effect);
      }
}

TEST(Hideable, FamiliesHoldLookAlikes) {
  EXPECT_EQ(family_of("blade_viscous_damping"), family_of("clamp_dry_friction"));
  EXPECT_EQ(family_of("camera_com_bias"), family_of("blade_mass"));
  EXPECT_NE(family_of("grain_friction"), family_of("blade_viscous_damping"));
  EXPECT_EQ(family_of("an effect of tomorrow"), "an effect of tomorrow");
}

TEST(BlindCases, AreAsManyOfEachKindAsAskedForUnderNamesThatTellNothing) {
  const std::vector<BlindCase> cases = drawn();
  std::map<BlindKind, int> count;
  std::set<std::string> names;
  int nulls_first = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    ++count[cases[i].kind];
    names.insert(cases[i].name);
    nulls_first += i < 60 && cases[i].kind == BlindKind::null;
  }
  EXPECT_EQ(names.size(), 344u);
  EXPECT_EQ(count[BlindKind::single], 120);
  EXPECT_EQ(count[BlindKind::twins], 20);
  EXPECT_LT(nulls_first, 25);  // 10.5 +- 2.7 expected of a shuffle
}

TEST(BlindCases, AreTheSameForTheSameSeedAndDifferentForAnother) {
  const std::vector<BlindCase> one = drawn(1), same = drawn(1), other = drawn(2);
  int differ = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(digest(one[i].trial.hidden.truth), digest(same[i].trial.hidden.truth));
    EXPECT_EQ(one[i].trial.seed, same[i].trial.seed);
    differ += digest(one[i].trial.hidden.truth) != digest(other[i].trial.hidden.truth);
  }
  EXPECT_GT(differ, 340);
}

TEST(BlindCases, HideWhatTheirKindSays) {
  std::set<std::string> singles;
  for (const BlindCase& one : drawn()) {
    const std::vector<std::string> hidden = hidden_effects(one.trial.hidden);
    EXPECT_EQ(has_other_parameters(one.trial.hidden), one.kind != BlindKind::null) << one.name;
    EXPECT_EQ(hidden.size(), one.ids.size()) << one.name;
    if (one.kind == BlindKind::single) singles.insert(one.ids.at(0));
    const bool fits = one.kind == BlindKind::pair       ? hidden.size() == 2
                      : one.kind == BlindKind::unlisted ? hidden.at(0) == "unknown"
                      : one.kind == BlindKind::camera   ? hidden.at(0).starts_with("camera")
                                                        : hidden.size() < 2;
    EXPECT_TRUE(fits) << one.name;
    EXPECT_EQ(one.twin.empty(), one.kind != BlindKind::twins);
  }
  EXPECT_EQ(singles.size(), 15u);
}

TEST(BlindCases, StrengthsGiveTheSignalOfTheTable) {
  for (const BlindCase& one : drawn()) {
    if (one.kind != BlindKind::single || one.ids[0] != "blade_viscous_damping") continue;
    // Typical strength (0.05 N s/m) has a signal of 20 in this table.
    EXPECT_NEAR(get_number(one.trial.hidden.truth, "blade_viscous_damping.damping"), 0.05 * one.signal_to_noise / 20, 1e-12);
  }
}

TEST(BlindCases, AVariantIsTheSameDesignRecordedWorse) {
  const BlindDesign design = full_design();
  EXPECT_EQ(varied(design, "one-repeat").runs.size(), 4u);
  EXPECT_EQ(varied(design, "two-lengths").runs.size(), 2u);
  EXPECT_EQ(varied(design, "two-lengths").runs.back().name, "L104");
  EXPECT_EQ(varied(design, "half-duration").runs.front().overrides.back().value, "\"10 s\"");
  EXPECT_EQ(varied(design, "250fps").recording.frame_rate, 250);
  EXPECT_FALSE(varied(design, "no-centre").recording.centre);
  EXPECT_THROW(varied(design, "no-camera"), InputError);
  for (const std::string_view name : variant_names) EXPECT_NO_THROW(varied(design, name));
}

TEST(BlindCases, CountsAreReadOrRefusedWithTheReason) {
  EXPECT_EQ(parse_counts("singles=3, nulls=2"), (BlindCounts{2, 0, 3, 0, 0, 0, 0}));
  EXPECT_THROW(parse_counts("single=3"), InputError);
  EXPECT_THROW(parse_counts("singles=many"), InputError);
}

// ---- scoring, on answers written by hand ----

namespace {

/// A suite of `counts` whose plan and seals exist, each answer written by `answer`.
void answered(const fs::path& folder, const BlindCounts& counts, const std::function<std::string(const nlohmann::json& truth)>& answer) {
  const auto hard = engine_named("hard");
  std::atomic<bool> stop = true;  // sealed, then stopped before the first case is measured
  const TrialTools tools{hard.get(), hard.get(), all_effects(), 100, 1, &stop};
  BlindSuiteOptions options;
  options.counts = counts;
  options.small = true;
  fs::create_directories(folder / "answers");
  nlohmann::json table;
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list) table["signal_of_strength_1"][std::string(hideable.id)] = 20;
  write(folder / "strengths.json", table.dump());
  EXPECT_THROW(run_blind_suite(folder, {}, tools, options), Interrupted);
  for (const fs::directory_entry& file : fs::directory_iterator(folder / "sealed"))
    write(folder / "answers" / file.path().filename(), answer(nlohmann::json::parse(read_text_file(file.path()))));
}

std::string answer_of(const std::string& verdict, const std::vector<std::string>& missing, double p = 0.5) {
  return nlohmann::json{{"diagnosis",
                         {{"verdict", verdict}, {"missing", missing}, {"parameters", nlohmann::json::object()}, {"ranking", nlohmann::json::array()},
                          {"ladder", {{{"step", "as given"}, {"error_box_mm", 0.5}, {"p_value", p}}}}, {"noise_floor", {{"box_mm", 0.5}}},
                          {"momentum", {{"p_value", p}, {"terms", nlohmann::json::array()}}}, {"seconds", 1.0}}},
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

constexpr BlindCounts some{10, 0, 15, 5, 4, 0, 0};

}  // namespace

TEST(BlindScores, APerfectDiagnosisMeetsEveryAim) {
  const Folder folder;
  answered(folder.path, some, [](const nlohmann::json& truth) {
    const auto hidden = truth["hidden"].get<std::vector<std::string>>();
    return answer_of(hidden.empty() ? "adequate" : "missing", hidden, 0.3 + 0.4 * static_cast<double>(truth["seed"].get<std::uint64_t>() % 1000) / 1000);
  });
  const BlindScore score = scored(folder.path);
  EXPECT_EQ(score.answered, 34);
  for (const BlindFigure& one : score.figures) EXPECT_NE(one.verdict, BlindFigure::Verdict::missed) << one.what << " " << one.found;
  EXPECT_EQ(figure(score, "exact name, signal to noise 12").verdict, BlindFigure::Verdict::met);
  EXPECT_EQ(figure(score, "both of a pair").found.substr(0, 6), "4 of 4");
}

TEST(BlindScores, ADiagnosisThatAlwaysAccusesTheSameFails) {
  const Folder folder;
  answered(folder.path, some, [](const nlohmann::json&) { return answer_of("missing", {"blade_viscous_damping"}, 0.001); });
  const BlindScore score = scored(folder.path);
  for (const char* what : {"false alarms", "p-values of the model", "first suspect's class, signal to noise 12", "exact name, signal to noise 12",
                           "camera artefacts called physics", "effects invented", "both of a pair"})
    EXPECT_EQ(figure(score, what).verdict, BlindFigure::Verdict::missed) << what << ": " << figure(score, what).found;
}

TEST(BlindScores, SimplerMethodsStandBeside) {
  const Folder folder;
  answered(folder.path, {2, 0, 3, 0, 0, 0, 0}, [](const nlohmann::json& truth) {
    auto answer = nlohmann::json::parse(answer_of("adequate", {}));
    const auto hidden = truth["hidden"].get<std::vector<std::string>>();
    answer["naive"] = {{"least_error", "grain_friction"}, {"white_noise", hidden.empty() ? "" : hidden[0]}, {"one_seed", ""}};
    return answer.dump();
  });
  const BlindScore score = scored(folder.path);
  EXPECT_EQ(figure(score, "baseline: smallest error after refitting, false alarms").found.substr(0, 6), "2 of 2");
  EXPECT_EQ(figure(score, "baseline: Akaike's criterion with white noise, exact").found.substr(0, 6), "3 of 3");
  EXPECT_EQ(figure(score, "baseline: smallest error, one seed, exact").found.substr(0, 6), "0 of 3");
}

TEST(BlindScores, ASealedAnswerThatWasTouchedIsRefused) {
  const Folder folder;
  answered(folder.path, {1, 0, 0, 0, 0, 0, 0}, [](const nlohmann::json&) { return answer_of("adequate", {}); });
  const fs::path sealed = folder.path / "sealed" / "case_0001.json";
  write(sealed, read_text_file(sealed) + " ");
  EXPECT_THROW(scored(folder.path), InputError);
}

TEST(BlindScores, AFolderHoldsOneSuite) {
  const Folder folder;
  answered(folder.path, {1, 0, 0, 0, 0, 0, 0}, [](const nlohmann::json&) { return answer_of("adequate", {}); });
  const auto hard = engine_named("hard");
  const TrialTools tools{hard.get(), hard.get(), all_effects(), 100, 1, nullptr};
  BlindSuiteOptions options;
  options.counts = {1, 0, 0, 0, 0, 0, 0};
  options.small = true;
  EXPECT_THROW(run_blind_suite(folder.path, {}, tools, options), InputError);  // without resume
  options.resume = true;
  EXPECT_NO_THROW(run_blind_suite(folder.path, {}, tools, options));  // all is answered: nothing is simulated
  options.seed = 2;
  EXPECT_THROW(run_blind_suite(folder.path, {}, tools, options), InputError);
}

// ---- the whole way, with real diagnoses ----

TEST(SlowBlindSuite, NullsAndACameraErrorAreToldApart) {
  const Folder folder;
  const auto soft = engine_named("soft"), hard = engine_named("hard");
  const TrialTools tools{soft.get(), hard.get(), all_effects(), 4000, 1, nullptr};
  fs::create_directories(folder.path);
  write(folder.path / "strengths.json", R"({"signal_of_strength_1": {"camera_com_bias": 55}})");  // as measured by the suite itself
  BlindSuiteOptions options;
  options.counts = {2, 0, 0, 1, 0, 0, 0};
  options.small = true;
  run_blind_suite(folder.path, {}, tools, options);
  const BlindScore score = scored(folder.path);
  EXPECT_EQ(score.answered, 3);
  EXPECT_EQ(figure(score, "false alarms").found.substr(0, 6), "0 of 2");
  EXPECT_EQ(figure(score, "camera artefacts named exactly").found.substr(0, 6), "1 of 1");
}

TEST(SlowNaiveAnswers, NameAStrongForceAndNeverFallSilent) {
  const auto hard = engine_named("hard");
  const TrialTools tools{hard.get(), hard.get(), all_effects(), 4000, 0, nullptr};
  Trial trial;
  trial.runs = small_design().runs;
  trial.hidden = {{}, changed({}, at_strength(*find_hideable("spring_cubic"), 1), all_effects())};
  const Workshop workshop{hard.get(), all_effects(), 0, nullptr, {}, nullptr};
  const NaiveAnswers strong = naive_answers({}, measured_in(trial, tools), workshop);
  EXPECT_EQ(strong.least_error, "spring_cubic");
  EXPECT_EQ(strong.white_noise, "spring_cubic");
  EXPECT_NE(strong.one_seed, "");
  trial.hidden.truth = {};
  EXPECT_NE(naive_answers({}, measured_in(trial, tools), workshop).least_error, "");  // some effect always fits a little better
}
