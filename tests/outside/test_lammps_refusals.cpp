// SPDX-License-Identifier: MIT
// What cannot be done is said in a sentence; a run is stopped on request; files are kept on request.
#include <cstdlib>

#include "lammps.hpp"
#include "outside_errors.hpp"
#include "work_folder.hpp"

using namespace shakedown;

namespace {

TEST(LammpsRefuses, EffectsThatItHasNoWordsFor) {
  shakedown::Setup setup;
  add_effect(setup, "grain_polydispersity", {{"relative_deviation", 0.05}});
  add_effect(setup, "grain_friction", {{"grain_grain", 0.2}, {"tangential_restitution", 0.5}});
  add_effect(setup, "blade_arc", {});
  const std::string text = message_of<InputError>([&] { make_lammps_engine()->run(setup); });
  for (const char* part :
       {"grain_polydispersity: is not modelled by engine 'lammps'", "for grains of one size",
        "grain_friction: is not modelled", "tangential_restitution 1", "blade_arc: is not modelled"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(LammpsRefuses, AFormulaThatItHasNoWordsFor) {
  shakedown::Setup setup = empty_box(1);
  add_effect(setup, "user_force", {{"force", std::string("1e-3*atanh(x)")}});
  const std::string text = message_of<InputError>([&] { make_lammps_engine()->run(setup); });
  for (const char* part : {"user_force.force", "'atanh' has no words in LAMMPS", "--engine hard or soft"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(LammpsRefuses, APeriodicCell) {
  shakedown::Setup setup;
  setup.domain = Domain::periodic;
  EXPECT_NE(
      message_of<InputError>([&] { make_lammps_engine()->run(setup); }).find("periodic is not modelled"),
      std::string::npos);
}

TEST(LammpsRefuses, ToRunWhereItIsNotInstalled) {
  const Named named("SHAKEDOWN_LAMMPS", "no_such_lmp");
  EXPECT_FALSE(has_lammps());
  const std::string text = message_of<InputError>([&] { make_lammps_engine()->run(empty_box(1)); });
  EXPECT_NE(text.find("there is no program 'no_such_lmp'"), std::string::npos) << text;
  EXPECT_NE(text.find("SHAKEDOWN_LAMMPS"), std::string::npos) << text;
}

TEST(LammpsRefuses, AnAnswerThatIsAnError) {
  const ScratchFolder folder;
  const Named named("SHAKEDOWN_LAMMPS",
                    stand_in(folder, "echo 'ERROR: Lost atoms: original 38 current 37'\nexit 1"));
  const std::string text = message_of<PhysicsError>([&] { make_lammps_engine()->run(empty_box(1)); });
  EXPECT_NE(text.find("ended with exit code 1"), std::string::npos) << text;
  EXPECT_NE(text.find("ERROR: Lost atoms"), std::string::npos) << text;
}

TEST(LammpsRefuses, AnAnswerThatIsIncomplete) {
  const ScratchFolder folder;
  const Named named("SHAKEDOWN_LAMMPS",
                    stand_in(folder, "echo title > motion.csv; echo 0,0.1,0,0,0 >> motion.csv"));
  EXPECT_NE(message_of<PhysicsError>([&] {
              make_lammps_engine()->run(empty_box(1));
            }).find("1 rows where 101 were asked for"),
            std::string::npos);
}

TEST(LammpsRefuses, ToGoOnWhenStopped) {
  const ScratchFolder folder;
  const Named named("SHAKEDOWN_LAMMPS", stand_in(folder, "sleep 100"));
  const std::atomic<bool> stop = true;
  EXPECT_THROW(make_lammps_engine()->run(empty_box(1), {0, {}, &stop}), Interrupted);
}

TEST_F(WithLammps, FilesAreKeptOnRequestAndRunAgain) {
  const ScratchFolder folder;
  const std::string kept = (folder / "kept").string();
  const Named named("SHAKEDOWN_KEEP", kept);
  lammps->run(empty_box(0.1), {4, {}});
  for (const char* name : {"in.lammps", "bodies.data", "motion.csv", "end.csv", "output.txt", "error.txt"})
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(kept) / "lammps" / "run_4" / name)) << name;
  EXPECT_NE(contents_of(std::filesystem::path(kept) / "lammps" / "run_4" / "in.lammps")
                .find("# A granular damper for LAMMPS"),
            std::string::npos);
}

}  // namespace
