// SPDX-License-Identifier: MIT
// What a page makes of its knobs is what the program makes of the same numbers (page/model.js in node,
// knobs_check.mjs).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "camera.hpp"
#include "effects.hpp"
#include "knobs_report.hpp"
#include "output_file.hpp"
#include "random.hpp"
#include "scratch_folder.hpp"
#include "setup_file.hpp"
#include "swing_motion.hpp"
#include "waveform_search.hpp"

using namespace shakedown;
using Json = nlohmann::ordered_json;

namespace {

bool has_node() { return std::system("node --version > /dev/null 2>&1") == 0; }

std::vector<std::vector<double>> as_lists(const std::vector<Eigen::VectorXd>& places) {
  std::vector<std::vector<double>> lists;
  for (const Eigen::VectorXd& place : places) lists.emplace_back(place.data(), place.data() + place.size());
  return lists;
}

Json answers_of_page(const ReportKnobs& knobs, const std::vector<Eigen::VectorXd>& places,
                     bool as_stated = false) {
  const ScratchFolder folder;
  const Json questions{
      {"knobs", Json::parse(knobs_json(knobs))}, {"places", as_lists(places)}, {"as_stated", as_stated}};
  write_file(folder / "questions.json", questions.dump());
  const std::string command =
      "node " PROJECT_ROOT "/tests/knobs/knobs_check.mjs " PROJECT_ROOT "/harness/report/page/model.js " +
      (folder / "questions.json").string() + " > " + (folder / "answers.json").string();
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream stream(folder / "answers.json");
  return Json::parse(stream);
}

/// Two ring-downs with four laws, at values that some fit might have found.
LastFit two_swings() {
  SwingFound found;
  shakedown::Setup setup;
  setup.grains.count = 0;
  const std::vector<std::pair<std::string, double>> acting{{"blade_viscous_damping.damping", 0.02},
                                                           {"clamp_dry_friction.force", 8e-3},
                                                           {"spring_cubic.coefficient", -0.05},
                                                           {"spring_quadratic.coefficient", 0.03}};
  std::vector<double> values{0.08, 0.05, 1e-3, 0.04, -0.1, -5e-4, 1.26};
  for (const WaveformLaw& law : waveform_laws(setup, all_effects()))
    for (const auto& [key, value] : acting)
      if (law.term.key() == key) found.fit.laws.push_back(law), values.push_back(value);
  found.fit.value = Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
  for (const char* name : {"a", "b"}) {
    WaveformRun run{name, setup, {}, {}, 1e-4, 1e-4, 0.1, 1.0 / 240};
    for (int i = 1; i < 1500; ++i) run.time.push_back(i / 240.0);
    run.x.assign(run.time.size(), 0.0);
    found.fit.residual.push_back(Eigen::VectorXd::Zero(std::ssize(run.time)));
    found.runs.push_back(run);
  }
  found.residual = found.fit.residual;
  return {{}, {}, found};
}

Setup setup_at(const LastFit& fit, std::size_t run, const std::vector<TurnedNumber>& numbers,
               const Eigen::VectorXd& place) {
  Setup setup = with_laws(fit.swing->runs[run].setup, fit.swing->fit, all_effects());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double at = place[static_cast<Eigen::Index>(k)];
    if (numbers[k].inverse && at == 0) continue;
    set_number(setup, numbers[k].key, numbers[k].inverse ? 1 / std::sqrt(at) : at, all_effects());
  }
  return setup;
}

/// m, as the camera of the setup sees it.
std::vector<double> swing_by_program(const LastFit& fit, std::size_t run, const Setup& setup) {
  const WaveformRun& of = fit.swing->runs[run];
  const Eigen::VectorXd& value = fit.swing->fit.value;
  const auto first = 3 * static_cast<Eigen::Index>(run);
  std::vector<double> time{of.start_time()};
  time.insert(time.end(), of.time.begin(), of.time.end());
  const Physics physics = physics_of(setup);
  std::vector<double> x = swing_of(physics, {value[first], value[first + 1]}, time, 10 * of.amplitude);
  EXPECT_EQ(x.size(), time.size());
  x = seen_through(physics.camera, {time, x, {}}).x_box;
  for (double& one : x) one += value[first + 2];
  x.erase(x.begin());
  return x;
}

}  // namespace

TEST(Knobs, OfABoxAloneMoveItAsTheProgramDoes) {
  if (!has_node()) GTEST_SKIP() << "node is not installed";
  const LastFit fit = two_swings();
  shakedown::Setup user;
  user.grains.count = 0;
  const std::vector<TurnedNumber> numbers =
      turned_numbers(*fit.swing, user, {"blade_viscous_damping", "clamp_dry_friction"}, all_effects());
  ASSERT_GE(numbers.size(), 9u);
  std::vector<Eigen::VectorXd> places;
  Random random(5, 0, Stream::other);
  for (int i = 0; i < 10; ++i) {
    Eigen::VectorXd place(std::ssize(numbers));
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      const bool tried = numbers[k].role != NumberRole::suspect || random.uniform() < 0.5;
      place[static_cast<Eigen::Index>(k)] =
          tried ? numbers[k].low + random.uniform() * (numbers[k].high - numbers[k].low) : numbers[k].best;
    }
    places.push_back(place);
  }
  const Json answers = answers_of_page(knobs_of(numbers, fit, user), places);
  double most = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t r = 0; r < 2; ++r) {
      const std::vector<double> expected = swing_by_program(fit, r, setup_at(fit, r, numbers, places[i]));
      const Json& curve = answers[i]["runs"][r]["curves"][0];
      ASSERT_EQ(curve.size(), expected.size());
      for (std::size_t t = 0; t < expected.size(); ++t)
        most = std::max(most, std::abs(curve[t].get<double>() * 1e-3 - expected[t]));
    }
  RecordProperty("farthest_um", std::to_string(most * 1e6));
  EXPECT_LT(most, 4e-8);  // of noise of 100 um a frame; 2 nm seen
}

// Terms of every kind: powers of sums, products in which a number stands twice, and the hill about the
// numbers as given.
TEST(Knobs, OfABoxWithGrainsTakeTheSharesOfTheProgram) {
  if (!has_node()) GTEST_SKIP() << "node is not installed";
  TurnedModel model;
  ReportKnobs knobs;
  knobs.kind = "response";
  for (const double given : {0.7, 0.2, 1.3}) {
    TurnedNumber number;
    number.given = given, number.best = given + 0.1, number.from = number.low = given - 1,
    number.to = number.high = given + 1;
    model.numbers.push_back(number);
    ReportKnobs::Number shown;
    shown.role = "parameter", shown.given = number.given, shown.best = number.best;
    knobs.numbers.push_back(shown);
  }
  model.terms = {{{{0, 2.0}}, 1},
                 {{{1, 0.5}, {2, -1.0}}, 2},
                 {{{2, 1.5}}, 3},
                 {{{0, 1.0}, {1, 2.0}}, TurnedTerm::product},
                 {{{0, 1.0}, {0, 1.0}, {2, 3.0}}, TurnedTerm::product},
                 {{{0, 1.0}, {1, 1.0}, {2, 1.0}}, 0}};
  for (const TurnedTerm& term : model.terms) {
    ReportKnobs::Term& shown = knobs.terms.emplace_back();
    shown.power = term.power;
    for (const auto& [k, weight] : term.weights)
      shown.numbers.push_back(static_cast<double>(k)), shown.weights.push_back(weight);
  }
  const auto count = std::ssize(model.terms);
  Random random(8, 0, Stream::other);
  const Eigen::MatrixXd columns = Eigen::MatrixXd::NullaryExpr(5, count, [&] { return random.normal(); });
  const Eigen::MatrixXd root =
      Eigen::MatrixXd::NullaryExpr(1 + count, 1 + count, [&] { return random.normal(); });
  const Eigen::MatrixXd square = root.transpose() * root;
  ReportKnobs::Run& run = knobs.runs.emplace_back();
  ReportKnobs::Curve& curve = run.curves.emplace_back();
  curve.name = "box", curve.time = {0, 1, 2, 3, 4};
  curve.measured = curve.spread = curve.best = curve.given = {1, 1, 1, 1, 1};
  for (Eigen::Index j = 0; j < count; ++j)
    curve.columns.emplace_back(columns.col(j).begin(), columns.col(j).end());
  for (Eigen::Index i = 0; i <= count; ++i)
    run.square.emplace_back(square.row(i).begin(), square.row(i).end());
  std::vector<Eigen::VectorXd> places{model.places(&TurnedNumber::best), model.places(&TurnedNumber::given)};
  for (int i = 0; i < 8; ++i)
    places.push_back(model.places(&TurnedNumber::given) +
                     Eigen::VectorXd::NullaryExpr(3, [&] { return random.uniform() - 0.5; }));
  const Json answers = answers_of_page(knobs, places);
  double most = 0, most_chi2 = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::VectorXd shares = model.shares(places[i]);
    Eigen::VectorXd left(1 + count);
    left << 1, -shares;
    const double chi2 = left.dot(square * left);
    most_chi2 = std::max(most_chi2, std::abs(answers[i]["runs"][0]["chi2"].get<double>() / chi2 - 1));
    for (Eigen::Index t = 0; t < 5; ++t)
      most = std::max(
          most, std::abs(answers[i]["runs"][0]["curves"][0][static_cast<std::size_t>(t)].get<double>() - 1 -
                         columns.row(t).dot(shares)));
  }
  RecordProperty("farthest", std::to_string(most));
  RecordProperty("farthest_chi2", std::to_string(most_chi2));
  EXPECT_LT(most, 1e-2);       // of columns of 1, packed for a screen
  EXPECT_LT(most_chi2, 1e-7);  // nine digits
}
