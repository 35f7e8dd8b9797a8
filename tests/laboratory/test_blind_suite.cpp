// SPDX-License-Identifier: MIT
#include "blind_suite.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "effects.hpp"
#include "engines.hpp"
#include "force_likeness.hpp"
#include "naive_answers.hpp"
#include "scratch_folder.hpp"
#include "signal_law.hpp"
#include "toml_document.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

std::vector<BlindCase> drawn(std::uint64_t seed = 1, const BlindCounts& counts = full_counts) {
  SignalLaws unit;
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list) unit[std::string(hideable.id)] = {1, 20};
  return draw_cases(shakedown::Setup{}, counts, full_design(), unit, seed, all_effects());
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

}  // namespace

TEST(Hideable, EveryOneCanBePutIntoASetupAtAnyStrengthUpToItsStrongest) {
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list)
      for (const double part : {0.02, 0.3, 1.0}) {
        const shakedown::Setup setup =
            changed({}, at_strength(hideable, part * hideable.strongest), all_effects());
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

TEST(BlindCases, FifteenMeetEveryEffectAndSixtyMeetEachAtEverySignal) {
  const auto met = [](int singles) {
    std::set<std::string> effects;
    std::set<std::pair<std::string, double>> at_signals;
    for (const BlindCase& one : drawn(1, {0, 0, singles, 0, 0, 0, 0})) {
      effects.insert(one.ids.at(0));
      at_signals.insert({one.ids.at(0), one.signal_to_noise});
    }
    return std::pair(effects.size(), at_signals.size());
  };
  EXPECT_EQ(met(15).first, 15u);
  EXPECT_EQ(met(60).second, 60u);
}

TEST(BlindCases, AreAtTheSignalsOfTheDesign) {
  BlindDesign design = full_design();
  design.signals = {9};
  const SignalLaws viscous{{"blade_viscous_damping", {1, 20}}};
  int met = 0;
  for (const BlindCase& one : draw_cases({}, {0, 0, 30, 0, 0, 0, 0}, design, viscous, 1, all_effects())) {
    if (one.ids.at(0) != "blade_viscous_damping") continue;
    ++met;
    EXPECT_NEAR(one.signal_to_noise, 9, 1e-12);
  }
  EXPECT_EQ(met, 2);
}

TEST(SignalLaw, IsAPowerOfTheStrengthAndOfTheBalanceAloneInverseToTheNoise) {
  const SignalLaw contact{3, 18, 2, false}, force{0.1, 20, 1, true};
  EXPECT_NEAR(contact.signal_at(1.5, 2), 4.5, 1e-12);
  EXPECT_NEAR(contact.strength_for(4.5, 2), 1.5, 1e-12);
  EXPECT_NEAR(force.signal_at(0.2, 2), 20, 1e-12);
  EXPECT_NEAR(force.strength_for(20, 2), 0.2, 1e-12);
}

TEST(SignalLaw, NoiseCountsWithTheMassesThatTheBalanceMultipliesItBy) {
  const shakedown::Setup setup;
  RecordingSettings camera;
  EXPECT_DOUBLE_EQ(relative_noise(camera, setup), 1);
  camera.box_noise *= 3, camera.centre_noise *= 3;
  EXPECT_NEAR(relative_noise(camera, setup), 3, 1e-12);
  camera.centre = false;
  // 3 M s_b / hypot(M s_b, N m s_c) with M = 434 g, N m = 149.48 g, s_b = .2 mm, s_c = .5 mm
  EXPECT_NEAR(relative_noise(camera, setup), 3 * 86.8 / std::hypot(86.8, 74.74), 1e-6);
}

TEST(BlindCases, StrengthsGiveTheSignalOfTheTable) {
  for (const BlindCase& one : drawn()) {
    if (one.kind != BlindKind::single || one.ids[0] != "blade_viscous_damping") continue;
    // Typical strength (0.05 N s/m) has a signal of 20 in this table.
    EXPECT_NEAR(get_number(one.trial.hidden.truth, "blade_viscous_damping.damping"),
                0.05 * one.signal_to_noise / 20, 1e-12);
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
      table["signals"][std::string(hideable.id)] = {
          {"strength", 1}, {"signal", 20}, {"power", 1}, {"by", "ensembles"}};
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
  const auto hard = engine_named("hard");
  const TrialTools tools{hard.get(), hard.get(), all_effects(), 100, 1, nullptr};
  BlindSuiteOptions options;
  options.strengths = folder / "old.json";
  for (const std::string text : {R"({"signals": {"camera_scale": 3}})", R"({"strengths": {}})", "no table"}) {
    write(options.strengths, text);
    try {
      run_blind_suite(folder / "suite", {}, tools, options);
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
  const auto hard = engine_named("hard");
  const TrialTools tools{hard.get(), hard.get(), all_effects(), 100, 1, nullptr};
  BlindSuiteOptions options;
  options.counts = {1, 0, 0, 0, 0, 0, 0};
  options.small = true;
  EXPECT_THROW(run_blind_suite(folder.path(), {}, tools, options), InputError);  // without resume
  options.resume = true;
  // all is answered: nothing is simulated
  EXPECT_NO_THROW(run_blind_suite(folder.path(), {}, tools, options));
  options.seed = 2;
  EXPECT_NE(
      refusal([&] { run_blind_suite(folder.path(), {}, tools, options); }).find("--seed (1 there, 2 here)"),
      std::string::npos);
}

TEST(BlindScores, WhatIsDrawnOtherwiseThanItWasSealedIsNotDiagnosed) {
  const ScratchFolder folder;
  answered(folder.path(), {0, 0, 2, 0, 0, 0, 0},
           [](const nlohmann::json&) { return answer_of("adequate", {}); });
  std::string table = read_text_file(folder / "strengths.json");
  for (std::size_t at = 0; (at = table.find("\"signal\": 20", at)) != table.npos;) table[at + 10] = '3';
  write(folder / "strengths.json", table);
  const auto hard = engine_named("hard");
  const TrialTools tools{hard.get(), hard.get(), all_effects(), 100, 1, nullptr};
  BlindSuiteOptions options;
  options.counts = {0, 0, 2, 0, 0, 0, 0};
  options.small = options.resume = true;
  const std::string text = refusal([&] { run_blind_suite(folder.path(), {}, tools, options); });
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
  EXPECT_EQ(figure(scored(folder.path()), "its form among those offered").found.substr(0, 6), "1 of 1");
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
  trial.hidden = {{}, changed({}, at_strength(*find_hideable("spring_cubic"), 1), all_effects())};
  const Workshop workshop{hard.get(), all_effects(), 0, nullptr, {}, nullptr};
  const NaiveAnswers strong = naive_answers({}, measured_in(trial, tools), workshop);
  EXPECT_EQ(strong.least_error, "spring_cubic");
  EXPECT_EQ(strong.white_noise, "spring_cubic");
  trial.hidden.truth = {};
  // chaos from run to run is no white noise
  EXPECT_NE(naive_answers({}, measured_in(trial, tools), workshop).white_noise, "");
}

TEST(ForceLikeness, IsThatOfTheShapeWithoutItsLinearPart) {
  Trajectory motion;
  for (int i = 0; i < 2000; ++i) {
    const double t = 0.005 * i;
    motion.time.push_back(t);
    motion.x_box.push_back(0.1 * std::cos(7 * t));
    motion.v_box.push_back(-0.7 * std::sin(7 * t));
  }
  const auto force = [&](const char* formula) { return force_along(formula, {{"c", 2.0}}, motion); };
  const std::vector<double> cubic = force("-c*x^3");
  EXPECT_NEAR(force_likeness(cubic, force("c*x^3+5*x"), motion.x_box), 1, 1e-9);
  EXPECT_LT(force_likeness(cubic, force("-c*v"), motion.x_box), 0.05);
  // One is even about a turning point, the other odd.
  EXPECT_LT(force_likeness(cubic, force("-c*v^3"), motion.x_box), 0.05);
  // v and v^3 share 3/4 of the fundamental: cos = (3/4) / sqrt(5/8) = 0.9487.
  EXPECT_NEAR(force_likeness(force("c*v"), force("c*v^3"), motion.x_box), 0.75 / std::sqrt(0.625), 5e-3);
}
