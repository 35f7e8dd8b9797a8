// SPDX-License-Identifier: MIT
// A full disk, a read-only folder, a power cut at calls that change a file (the first, the last and some
// between), an input that vanishes, two programs on one folder: nothing is lost, nothing stands there in
// part, and one sentence says what happened.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <future>
#include <iterator>
#include <map>
#include <ostream>
#include <thread>

#include "program.hpp"

namespace fs = std::filesystem;

namespace {

using Files = std::map<std::string, std::string>;  ///< name below the folder, contents

Files files_in(const fs::path& folder) {
  Files files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = contents(entry.path());
  return files;
}

/// A command that writes into the folder "OUT", with inputs of "IN".
struct Writer {
  std::string name;
  std::vector<std::string> arguments;
  bool one_set = false;  ///< its files are of one run, all or none
  bool dear = false;     ///< takes about a second
};

/// A box without grains: what is asked of it takes a second, and writes what others write.
std::vector<std::string> asked_of_the_film(const std::string& command, const std::vector<std::string>& more) {
  std::vector<std::string> words{command,    "IN/film/setup.toml", "--data",    "IN/film/experiment.toml",
                                 "--out",    "OUT/answer",         "--json",    "OUT/answer.json",
                                 "--report", "OUT/answer.html",    "--threads", "1"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::vector<Writer> writers() {
  return {
      {"run", {"run", "IN/setup.toml", "--runs", "2", "--every-series", "--log", "--out", "OUT/k"}, true},
      {"run_json", {"run", "IN/setup.toml", "--json", "OUT/a.json", "--report", "OUT/a.html"}},
      {"sweep",
       {"sweep", "IN/setup.toml", "--vary", "box.length=40mm,50mm", "--out", "OUT/r.sqlite", "--threads", "1",
        "--resume", "--table", "OUT/r.csv"}},
      {"merge", {"merge", "OUT/all.sqlite", "IN/r.sqlite", "--table", "OUT/all.csv"}},
      {"export_xyz", {"export", "IN/k", "--out", "OUT/x", "--rate", "100Hz"}},
      {"export_vtp", {"export", "IN/k", "--as", "vtp", "--out", "OUT/x", "--rate", "40Hz"}},
      {"export_npy", {"export", "IN/k", "--as", "npy", "--out", "OUT/x", "--rate", "40Hz"}},
      {"hide", {"hide", "IN/setup.toml", "--engine", "hard", "--lengths", "40mm,50mm", "--out", "OUT/case"}},
      {"import", {"import", "IN/a.csv", "--replace", "--out", "OUT/experiment.toml"}},
      {"add", {"add", "IN/setup.toml", "clamp_dry_friction", "--out", "OUT/more.toml"}},
      {"theory",
       {"theory", "IN/setup.toml", "--set", "run.duration=4 s", "--out", "OUT/curve.csv", "--json",
        "OUT/theory.json"}},
      {"bounce", {"bounce", "IN/throws.csv", "--known", "OUT/known.toml", "--report", "OUT/drops.html"}},
      {"crosscheck",
       {"crosscheck", "IN/setup.toml", "--engines", "hard,soft", "--runs", "2", "--out", "OUT/c"}},
      {"report", {"report", "IN/k", "--out", "OUT/page.html"}},
      {"export_csv", {"export", "IN/k", "--as", "csv", "--out", "OUT/x", "--rate", "40Hz"}},
      {"export_lammps", {"export", "IN/k", "--as", "lammps", "--out", "OUT/x", "--rate", "40Hz"}},
      {"plot_svg", {"plot", "IN/k", "--out", "OUT/decay.svg"}},
      {"plot_pdf", {"plot", "IN/k", "--kind", "energy", "--out", "OUT/energy.pdf"}},
      {"effects_json", {"effects", "--json", "OUT/effects.json"}},
      {"import_json",
       {"import", "IN/a.csv", "--replace", "--out", "OUT/x.toml", "--json", "OUT/columns.json"}},
      {"sweep_json",
       {"sweep", "IN/setup.toml", "--vary", "box.length=40mm,50mm", "--out", "OUT/r.sqlite", "--threads", "1",
        "--resume", "--json", "OUT/r.json", "--report", "OUT/r.html"}},
      {"merge_json",
       {"merge", "OUT/all.sqlite", "IN/r.sqlite", "--json", "OUT/all.json", "--report", "OUT/all.html"}},
      {"hide_json",
       {"hide", "IN/setup.toml", "--engine", "hard", "--lengths", "40mm", "--out", "OUT/case", "--truth",
        "OUT/truth.json", "--json", "OUT/hide.json"}},
      {"crosscheck_json",
       {"crosscheck", "IN/setup.toml", "--engines", "hard,soft", "--runs", "2", "--json", "OUT/c.json",
        "--report", "OUT/c.html"}},
      {"bounce_json", {"bounce", "IN/throws.csv", "--json", "OUT/drops.json"}},
      {"ladder", asked_of_the_film("ladder", {}), false, true},
      {"check",
       {"check", "linear-decay", "--engines", "hard", "--lengths", "40", "--baselines", "OUT/decay.csv",
        "--update", "--json", "OUT/check.json"},
       false,
       true},
      {"compare", asked_of_the_film("compare", {}), false, true},
      {"fit", asked_of_the_film("fit", {"--free", "spring.frequency"}), false, true},
      {"diagnose", asked_of_the_film("diagnose", {}), false, true},
  };
}

/// Tells whether it takes less than some tens of milliseconds.
bool is_light(const Writer& writer) {
  constexpr const char* longer[] = {"bounce", "hide", "crosscheck", "sweep_json", "merge_json"};
  return !writer.dear && std::none_of(std::begin(longer), std::end(longer),
                                      [&](const char* name) { return writer.name.starts_with(name); });
}

/// Those that write in ways of their own.
std::vector<Writer> quick_writers() {
  constexpr const char* alike[] = {"export_csv", "export_lammps", "plot", "effects_json", "import_json"};
  std::vector<Writer> quick = writers();
  std::erase_if(quick, [&](const Writer& writer) {
    return !is_light(writer) || std::any_of(std::begin(alike), std::end(alike),
                                            [&](const char* name) { return writer.name.starts_with(name); });
  });
  return quick;
}

/// Tells whether seconds stand in it, which no two runs share.
bool is_timed(const std::string& name) {
  return name.ends_with(".json") || name.ends_with(".html") || name.ends_with("numbers.csv");
}

class Faults : public WithFolder {
 protected:
  static constexpr const char* variables[] = {"LD_PRELOAD", "FAULT_UNDER", "FAULT_AT", "FAULT_KIND",
                                              "FAULT_COUNT"};
  void SetUp() override {
    fs::create_directory(folder / "IN");
    file("IN/setup.toml",
         "grains.count = 3\n[run]\nduration = \"0.3 s\"\nsample_rate = \"100 Hz\"\n[box]\nlength = \"40 "
         "mm\"\n");
    file("IN/a.csv", "frame,x_px\n0,900\n1,890\n2,870\n3,840\n4,800\n5,750\n");
    // Two drops: their laws are weighed in a fifth of the time of all five.
    const std::string throws = contents(TEST_DATA "/drops/throws.csv");
    file("IN/throws.csv", throws.substr(0, throws.find("\n3,1,") + 1));
    file("IN/empty.toml", "grains.count = 0\n[run]\nduration = \"4 s\"\n[box]\nlength = \"40 mm\"\n");
    expect_done({"hide", "IN/empty.toml", "--engine", "hard", "--lengths", "40mm", "--out", "IN/film"});
    expect_done({"run", "IN/setup.toml", "--log", "--out", "IN/k"});
    expect_done({"sweep", "IN/setup.toml", "--vary", "box.length=40mm,50mm", "--out", "IN/r.sqlite"});
    empty_out();
  }
  void TearDown() override {
    for (const char* name : variables) ::unsetenv(name);
  }

  std::vector<std::string> placed(std::vector<std::string> words) const {
    for (std::string& word : words)
      for (const char* place : {"IN/", "OUT/"})
        if (word.starts_with(place)) word = in_folder(word);
    return words;
  }
  void expect_done(const std::vector<std::string>& arguments) const {
    const Outcome outcome = shakedown_program(placed(arguments));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  void empty_out() const {
    fs::remove_all(folder / "OUT");
    fs::create_directory(folder / "OUT");
  }
  Files out() const { return files_in(folder / "OUT"); }

  /// `at` 0: nothing fails, calls are counted.
  Outcome with_fault(const std::vector<std::string>& arguments, const std::string& kind, long at,
                     const std::string& under = "OUT") const {
    const std::string values[] = {FAULTS, in_folder(under), std::to_string(at), kind, in_folder("calls")};
    for (std::size_t i = 0; i < std::size(values); ++i) ::setenv(variables[i], values[i].c_str(), 1);
    const Outcome outcome = shakedown_program(placed(arguments));
    for (const char* name : variables) ::unsetenv(name);
    return outcome;
  }
  long calls_of(const Writer& writer) const {
    empty_out();
    const Outcome outcome = with_fault(writer.arguments, "", 0);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return std::strtol(contents(folder / "calls").c_str(), nullptr, 10);
  }

  static bool is_of_sqlite(const Writer& writer) {
    return writer.name.starts_with("sweep") || writer.name.starts_with("merge");
  }
  static void expect_one_sentence(const Outcome& outcome, const std::string& reason) {
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    const std::size_t said = outcome.err.find("cannot be");
    ASSERT_NE(said, std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(reason, said), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.err.find("cannot be", said + 1), std::string::npos) << outcome.err;
  }

  static void expect_whole(const Files& files, const Files& reference) {
    for (const auto& [name, bytes] : files) {
      if (name.find(".partial-") != std::string::npos || name.find(".sqlite") != std::string::npos) continue;
      if (name.find("simulations.journal") != std::string::npos) continue;  // to go on from
      if (name.ends_with(".being-written") || name.find(".unfinished") != std::string::npos) continue;
      const auto whole = reference.find(name);
      if (whole == reference.end()) {
        ADD_FAILURE() << name << " is there, and is of no whole result";
      } else if (is_timed(name)) {
        constexpr std::size_t end = 3;  // "\n}\n", "l>\n"
        EXPECT_EQ(bytes.substr(bytes.size() - std::min(bytes.size(), end)),
                  whole->second.substr(whole->second.size() - end))
            << name;
      } else {
        EXPECT_EQ(bytes, whole->second) << name;
      }
    }
  }
  static std::vector<std::string> names_of(const Files& files) {
    std::vector<std::string> names;
    for (const auto& [name, bytes] : files)
      if (name.find(".sqlite-") == std::string::npos) names.push_back(name);
    return names;
  }

  void expect_nothing_half(const Writer& writer, const std::string& kind, long at,
                           const Files& reference) const {
    SCOPED_TRACE(writer.name + " " + kind + " at call " + std::to_string(at));
    empty_out();
    const Outcome outcome = with_fault(writer.arguments, kind, at);
    const Files left = out();
    expect_whole(left, reference);
    if (kind == "KILL") {
      EXPECT_EQ(outcome.code, -9);
    } else {
      // SQLite has its own words, and closes a file that is whole without the last of its tidying.
      const bool tidying = is_of_sqlite(writer) && at > 1 && outcome.code == 0;
      if (!tidying)
        expect_one_sentence(outcome, is_of_sqlite(writer) ? "(" : kind == "EROFS" ? "Read-only" : "No space");
      for (const auto& [name, bytes] : left) EXPECT_EQ(name.find(".partial-"), std::string::npos) << name;
      // The page's data come after the results.
      const std::size_t page = reference.size() - left.size() == 1 && !left.contains("k/report.json") ? 1 : 0;
      if (writer.one_set) {
        EXPECT_TRUE(left.empty() || left.size() + page == reference.size()) << left.size();
      }
    }
    // The same again, with a disk that works, makes it whole.
    const Outcome again = shakedown_program(placed(writer.arguments));
    EXPECT_EQ(again.code, 0) << again.err;
    expect_whole(out(), reference);
    for (const std::string& name : names_of(reference))
      EXPECT_TRUE(fs::exists(folder / "OUT" / name)) << name;
  }

  /// At so many calls, from the first to the last.
  void try_all(const Writer& writer, long most) const {
    const long calls = calls_of(writer);
    const Files reference = out();
    ASSERT_GT(calls, 0) << writer.name;
    const long tries = std::min(calls, most);
    for (const char* kind : {"ENOSPC", "EROFS", "KILL"})
      for (long i = 0; i < tries; ++i)
        expect_nothing_half(writer, kind, tries == 1 ? 1 : 1 + i * (calls - 1) / (tries - 1), reference);
    RecordProperty("calls", std::to_string(calls));
  }
};

class EachWriter : public Faults, public testing::WithParamInterface<Writer> {};
void PrintTo(const Writer& writer, std::ostream* out) { *out << writer.name; }
class SlowEachWriter : public EachWriter {};

}  // namespace

TEST_P(EachWriter, LeavesNothingHalf) { try_all(GetParam(), 3); }
TEST_P(SlowEachWriter, LeavesNothingHalfAtAnyCall) {
  constexpr long all = 1000;
  try_all(GetParam(), GetParam().dear ? 4 : is_light(GetParam()) ? all : 12);
}

INSTANTIATE_TEST_SUITE_P(Commands, EachWriter, testing::ValuesIn(quick_writers()),
                         [](const auto& writer) { return writer.param.name; });
INSTANTIATE_TEST_SUITE_P(Commands, SlowEachWriter, testing::ValuesIn(writers()),
                         [](const auto& writer) { return writer.param.name; });

/// What stands in a folder is of the earlier run or of the new one, also where the new one fails.
TEST_F(Faults, AFolderGetsOneRunsFiles) {
  const std::vector<std::string> earlier{"run", "IN/setup.toml", "--log", "--out", "OUT/k"},
      later{"run", "IN/setup.toml", "--set", "box.length=65mm", "--out", "OUT/k"};
  expect_done(earlier);
  const Files before = out();
  const Outcome counted = with_fault(later, "", 0);
  ASSERT_EQ(counted.code, 0) << counted.err;
  const Files after = out();
  const long calls = std::strtol(contents(folder / "calls").c_str(), nullptr, 10);
  for (long at = 1; at <= calls; at += std::max(1L, calls / 12)) {
    empty_out();
    expect_done(earlier);
    const Outcome outcome = with_fault(later, "ENOSPC", at);
    SCOPED_TRACE(at);
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    const Files left = out();
    if (left.empty()) continue;  // the old ones had gone, and the new ones did not come
    const bool old_ones = left.at("k/series.csv") == before.at("k/series.csv");
    EXPECT_EQ(left.contains("k/collisions.log"), old_ones);
    EXPECT_EQ(left.at("k/setup.toml"), (old_ones ? before : after).at("k/setup.toml"));
  }
}

/// An input that goes while the command reads: at the first time that it opens it, the second, and so on.
TEST_F(Faults, AFileThatVanishesIsNamedAndNothingHalfIsLeft) {
  for (const Writer& writer : writers()) {
    if (!is_light(writer) || is_of_sqlite(writer)) continue;  // SQLite opens files in its own ways
    empty_out();
    const Outcome counted = with_fault(writer.arguments, "VANISH", 0, "IN");
    ASSERT_EQ(counted.code, 0) << counted.err;
    const Files reference = out();
    const long opened = std::strtol(contents(folder / "calls").c_str(), nullptr, 10);
    for (long at = 1; at <= opened; ++at) {
      SCOPED_TRACE(writer.name + ", the file opened as number " + std::to_string(at));
      empty_out();
      const Outcome outcome = with_fault(writer.arguments, "VANISH", at, "IN");
      expect_whole(out(), reference);
      if (outcome.code == 0) continue;  // what it had was enough
      EXPECT_EQ(outcome.code, 4) << outcome.err;
      EXPECT_NE(outcome.err.find(in_folder("IN")), std::string::npos) << outcome.err;
      EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
  }
}

/// While the first works the second is told so.
TEST_F(Faults, OfTwoProgramsOnOneFolderOneWrites) {
  const auto run = [this](const char* runs, const char* length) {
    return shakedown_program(placed({"run", "IN/setup.toml", "--runs", runs, "--set",
                                     std::string("box.length=") + length, "--out", "OUT/k"}));
  };
  std::future<Outcome> first = std::async(std::launch::async, [&] { return run("3000", "50mm"); });
  using namespace std::chrono_literals;
  while (!fs::exists(folder / "OUT/k/.being-written") && first.wait_for(0s) != std::future_status::ready)
    std::this_thread::yield();
  const Outcome second = run("40", "60mm");
  EXPECT_EQ(first.get().code, 0);
  EXPECT_EQ(second.code, 4);
  EXPECT_NE(second.err.find("another program is writing its results there"), std::string::npos) << second.err;
  const Files left = out();
  EXPECT_NE(left.at("k/setup.toml").find("50 mm"), std::string::npos);
}
