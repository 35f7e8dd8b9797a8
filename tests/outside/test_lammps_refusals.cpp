// SPDX-License-Identifier: MIT
// What cannot be done is said in a sentence; a run is stopped on request; files are kept on request.
#include <cstdlib>

#include "lammps.hpp"
#include "work_folder.hpp"

using namespace shakedown;

namespace {

/// The message of the error that a call throws.
template <class Error, class Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

/// SHAKEDOWN_LAMMPS, put back at the end.
class Named {
 public:
  explicit Named(const std::string& program) {
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, program.c_str(), 1);
  }
  ~Named() {
    if (before_.empty())
      ::unsetenv(name);
    else
      ::setenv(name, before_.c_str(), 1);
  }
  Named(const Named&) = delete;
  Named& operator=(const Named&) = delete;

 private:
  static constexpr const char* name = "SHAKEDOWN_LAMMPS";
  std::string before_;
};

/// A shell script that stands for LAMMPS.
std::string stand_in(const ScratchFolder& folder, const std::string& lines) {
  const std::filesystem::path file = folder / "lmp";
  std::ofstream(file) << "#!/bin/sh\n" << lines << "\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file.string();
}

TEST(LammpsRefuses, EffectsThatItHasNoWordsFor) {
  shakedown::Setup setup;
  add_effect(setup, "grain_polydispersity", {{"relative_deviation", 0.05}});
  add_effect(setup, "grain_friction", {{"grain_grain", 0.2}, {"tangential_restitution", 0.5}});
  add_effect(setup, "pendulum", {});
  const std::string text = message_of<InputError>([&] { make_lammps_engine()->run(setup); });
  for (const char* part :
       {"grain_polydispersity: is not modelled by engine 'lammps'", "for grains of one size",
        "grain_friction: is not modelled", "tangential_restitution 1", "pendulum: is not modelled"})
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
  const Named named("no_such_lmp");
  EXPECT_FALSE(has_lammps());
  const std::string text = message_of<InputError>([&] { make_lammps_engine()->run(empty_box(1)); });
  EXPECT_NE(text.find("there is no program 'no_such_lmp'"), std::string::npos) << text;
  EXPECT_NE(text.find("SHAKEDOWN_LAMMPS"), std::string::npos) << text;
}

TEST(LammpsRefuses, AnAnswerThatIsAnError) {
  const ScratchFolder folder;
  const Named named(stand_in(folder, "echo 'ERROR: Lost atoms: original 38 current 37'\nexit 1"));
  const std::string text = message_of<PhysicsError>([&] { make_lammps_engine()->run(empty_box(1)); });
  EXPECT_NE(text.find("ended with exit code 1"), std::string::npos) << text;
  EXPECT_NE(text.find("ERROR: Lost atoms"), std::string::npos) << text;
}

TEST(LammpsRefuses, AnAnswerThatIsIncomplete) {
  const ScratchFolder folder;
  const Named named(stand_in(folder, "echo title > motion.csv; echo 0,0.1,0,0,0 >> motion.csv"));
  EXPECT_NE(message_of<PhysicsError>([&] {
              make_lammps_engine()->run(empty_box(1));
            }).find("1 rows where 101 were asked for"),
            std::string::npos);
}

TEST(LammpsRefuses, ToGoOnWhenStopped) {
  const ScratchFolder folder;
  const Named named(stand_in(folder, "sleep 100"));
  const std::atomic<bool> stop = true;
  EXPECT_THROW(make_lammps_engine()->run(empty_box(1), {0, {}, &stop}), Interrupted);
}

TEST_F(WithLammps, FilesAreKeptOnRequestAndRunAgain) {
  const ScratchFolder folder;
  const std::string kept = (folder / "kept").string();
  lammps->run(empty_box(0.1), {0, {}, nullptr, false, kept});
  for (const char* name : {"in.lammps", "bodies.data", "motion.csv", "end.csv", "output.txt", "error.txt"})
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(kept) / name)) << name;
  EXPECT_NE(contents_of(std::filesystem::path(kept) / "in.lammps").find("# A granular damper for LAMMPS"),
            std::string::npos);
}

}  // namespace
