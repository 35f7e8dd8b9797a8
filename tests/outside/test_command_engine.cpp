// SPDX-License-Identifier: MIT
// Any program as an engine: what it is asked, what it may answer, and how a wrong answer is told.
#include "command_engine.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "child_program.hpp"
#include "lammps.hpp"
#include "outside_errors.hpp"
#include "within.hpp"
#include "work_folder.hpp"

using namespace shakedown;

namespace {

/// Two samples of an empty box at rest at 0.1 m.
shakedown::Setup short_run() {
  shakedown::Setup setup = empty_box(0.01);
  setup.release.displacement = 0.1;
  return setup;
}

/// What is said of a program that writes these lines.
std::string said_of(const std::string& table) {
  const ScratchFolder folder;
  const auto engine = make_command_engine(
      "command:" + stand_in(folder, "shift $(($# - 1)); printf '" + table + "' > \"$1\""));
  return message_of<PhysicsError>([&] { engine->run(short_run()); });
}

void expect_parts(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(Command, IsAskedInSI) {
  const ScratchFolder folder;
  const auto engine = make_command_engine(
      "command:" +
      stand_in(folder, "printf 't_s,x_box_m,v_box_m_s,x_com_m\\n0,0.1,0,0\\n' > \"$3\"; echo \"$1\"") +
      " --option");
  shakedown::Setup setup = resting_box();
  setup.run.duration = 0.001;
  add_effect(setup, "grain_friction", {{"grain_grain", 0.2}});
  add_effect(setup, "camera_scale", {{"scale", 0.01}});
  const PlacedGrains grains({{Vec3(0.01, 0, 0), Vec3(0.1, 0.2, 0.3)}});
  setup.grains.count = 1;
  setup.release.initial_grains = grains.path();
  const std::string kept = (folder / "kept").string();
  const std::string kept_run = kept + "/program/run_2";
  const Named named("SHAKEDOWN_KEEP", kept);
  EXPECT_THROW(engine->run(setup, {2, {}}), PhysicsError);
  const auto asked = nlohmann::json::parse(contents_of(kept_run + "/setup.json"));
  EXPECT_EQ(asked["format"], 1);
  EXPECT_EQ(asked["run"], 2);
  EXPECT_EQ(asked["rows"], 1);
  EXPECT_EQ(asked["box"]["mass"], 0.434);
  EXPECT_EQ(asked["grains"][0]["velocity"], (std::vector{0.1, 0.2, 0.3}));
  ASSERT_EQ(asked["effects"].size(), 1u);  // the camera is not the engine's business
  EXPECT_EQ(asked["effects"][0]["name"], "grain_friction");
  EXPECT_EQ(asked["effects"][0]["parameters"]["grain_grain"], 0.2);
  EXPECT_EQ(contents_of(kept_run + "/output.txt"), "--option\n");
}

TEST(Command, MayTellEnergiesOrNot) {
  const ScratchFolder folder;
  const std::string name =
      "command:" +
      stand_in(folder,
               "printf 'x_box_m,t_s,v_box_m_s,lost_end_wall_J\\n0.1,0,0,0\\n0.09,0.01,-1,2e-3\\n' > $2");
  const Trajectory run = make_command_engine(name)->run(short_run());
  EXPECT_EQ(run.engine, name);
  EXPECT_EQ(run.x_box, (std::vector{0.1, 0.09}));
  EXPECT_EQ(run.ledger.contact_loss[1], 2e-3);
  EXPECT_TRUE(std::isnan(run.ledger.contact_loss[0]));
  EXPECT_TRUE(std::isnan(run.total_energy[0]));
  EXPECT_EQ(run.collisions[0], -1);
  EXPECT_GT(run.initial_energy, 0);
  ASSERT_EQ(run.health.notes.size(), 1u);
  expect_parts(run.health.notes[0], {"does not tell energy_J, lost_grain_grain_J, lost_side_wall_J"});
}

TEST(Command, IsToldWhatIsWrongWithItsTable) {
  expect_parts(said_of(""), {"the table was not written", "t_s,x_box_m,v_box_m_s"});
  expect_parts(said_of("t_s,x_box_m\\n"), {"line 1: column 'v_box_m_s' is missing"});
  expect_parts(said_of("t_s,x_box_m,v_box_m_s,height\\n"),
               {"line 1: there is no column 'height'", "x_com_m"});
  expect_parts(said_of("t_s,t_s,x_box_m,v_box_m_s\\n"), {"line 1: column 't_s' is there twice"});
  const std::string head = "t_s,x_box_m,v_box_m_s\\n";
  expect_parts(said_of(head + "0,0.1,0\\n"), {"1 rows where 2 are asked for"});
  expect_parts(said_of(head + "0,0.1,0\\n0.01,nan,0\\n"), {"line 3, column 2: 'nan' is no finite number"});
  expect_parts(said_of(head + "0,0.1,0\\n0.01,0.1\\n"), {"line 3: 2 columns where 3 are due"});
  expect_parts(said_of(head + "0,0.1,0\\n0.02,0.1,0\\n"),
               {"row 2: the time is 0.02 s where 0.01 s is asked for"});
  expect_parts(said_of(head + "0,0.2,0\\n0.01,0.1,0\\n"),
               {"row 1: x_box_m is 0.2 where the run begins at 0.1", "the first row is the state"});
}

TEST(Command, RefusesByExitCodeTwo) {
  const ScratchFolder folder;
  const auto engine =
      make_command_engine("command:" + stand_in(folder, "echo 'no friction here' >&2; exit 2"));
  expect_parts(message_of<InputError>([&] { engine->run(short_run()); }),
               {"refuses this setup (exit code 2): no friction here"});
}

TEST(Command, FailsByAnyOther) {
  const ScratchFolder folder;
  const auto engine = make_command_engine("command:" + stand_in(folder, "echo 'no memory' >&2; exit 1"));
  expect_parts(message_of<PhysicsError>([&] { engine->run(short_run()); }),
               {"ended with exit code 1", "no memory"});
}

TEST(Command, IsStoppedOnRequest) {
  const ScratchFolder folder;
  const auto engine = make_command_engine("command:" + stand_in(folder, "sleep 100"));
  const std::atomic<bool> stop = true;
  EXPECT_THROW(engine->run(short_run(), {0, {}, &stop}), Interrupted);
}

TEST(Command, HasToBeAProgram) {
  expect_parts(message_of<InputError>([] { make_command_engine("command:"); }), {"names no program"});
  expect_parts(message_of<InputError>([] { make_command_engine("command:./none here"); }),
               {"there is no program './none'"});
}

/// The example of the documentation.
class ExampleCommand : public testing::Test {
 protected:
  void SetUp() override {
    if (!program_named("python3")) GTEST_SKIP() << "there is no python3";
  }
  const std::unique_ptr<Engine> example =
      make_command_engine(std::string("command:") + PROJECT_ROOT + "/harness/outside/example/damper.py");
};

TEST_F(ExampleCommand, SwingsAnEmptyBox) {
  const shakedown::Setup setup = empty_box(1);
  const Trajectory run = example->run(setup);
  for (std::size_t k = 0; k < run.time.size(); ++k)
    WITHIN(run.x_box[k], 0.1075 * std::cos(2 * std::numbers::pi * setup.spring.frequency * run.time[k]), 1e-5,
           5.2e-7);
}

TEST_F(ExampleCommand, MeetsAsTheSoftEngineDoes) {
  shakedown::Setup setup;
  setup.soft.steps_per_contact = 50;
  setup.run.duration = 0.3;
  const std::vector<PlacedGrain> grains{{Vec3(0.1, 0, 0), Vec3(0.1, 0.2, 0)},
                                        {Vec3(0.115, 1e-3, 0), Vec3(-0.3, 0, 0.1)}};
  const Trajectory run = run_with(*example, setup, grains),
                   other = run_with(*make_soft_engine(), setup, grains);
  EXPECT_LT(largest_difference(run, other), 9e-6);  // seen: 4.6e-7
}

TEST_F(ExampleCommand, RefusesWhatItDoesNotKnow) {
  shakedown::Setup setup = short_run();
  add_effect(setup, "spring_cubic", {{"coefficient", 0.1}});
  expect_parts(message_of<InputError>([&] { example->run(setup); }),
               {"refuses this setup", "not spring_cubic"});
}

}  // namespace
