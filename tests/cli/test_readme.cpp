// SPDX-License-Identifier: MIT
// The README as a stranger follows it: every ```sh block, in order, in one shell, from a folder that holds
// what the tree holds.
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "program.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path root = PROJECT_ROOT;

/// The ```sh blocks as printed, without the one that builds the program.
std::vector<std::string> blocks(const std::string& text) {
  std::vector<std::string> found;
  std::istringstream stream(text);
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (line == "```sh") {
      inside = true;
      found.emplace_back();
    } else if (line.starts_with("```")) {
      inside = false;
    } else if (inside) {
      found.back() += line + "\n";
    }
  }
  std::erase_if(found, [](const std::string& block) { return block.starts_with("./harness/quickstart"); });
  return found;
}

/// The answers as printed: blocks without a language, cut at lines of dots.
std::vector<std::vector<std::string>> answers(const std::string& text) {
  std::vector<std::vector<std::string>> found;
  std::istringstream stream(text);
  bool inside = false, plain = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("```")) {
      inside = !inside;
      plain = inside && line == "```";
      if (plain) found.emplace_back();
    } else if (plain && line != "  ...") {
      found.back().push_back(line);
    }
  }
  return found;
}

/// Words without what differs between processors: of a number the first three digits.
std::string rough(const std::string& line) {
  std::string text;
  int digits = 0;
  bool significant = false;
  for (const char c : line) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit && c != '.') digits = 0, significant = false;
    significant = significant || (digit && c != '0');
    if (significant && digit && ++digits > 3) continue;
    text += c;
  }
  return text;
}

}  // namespace

class SlowReadMe : public WithFolder {
 protected:
  /// Each command of the blocks by itself: one that says with 1 that the data reject a model has done its
  /// work.
  Outcome run_all(const std::vector<std::string>& commands) const {
    for (const char* part : {"harness", "tests", "README.md"})
      fs::create_directory_symlink(root / part, folder / part);
    fs::create_directories(folder / "build/release");
    fs::create_symlink(SHAKEDOWN, folder / "build/release/shakedown");
    std::string script = "set -u\ncd '" + folder.path().string() + "'\n";
    script +=
        "trap 'code=$?; [ $code -le 1 ] || { echo \"exit $code: $BASH_COMMAND\" >&2; exit $code; }' ERR\n";
    for (const std::string& block : commands) script += block;
    const std::string file_of_script = file("blocks.sh", script + "exit 0\n");
    Outcome outcome;
    const int status = std::system(
        ("bash " + file_of_script + " > " + in_folder("out.txt") + " 2> " + in_folder("err.txt")).c_str());
    outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    outcome.out = contents(in_folder("out.txt"));
    outcome.err = contents(in_folder("err.txt"));
    return outcome;
  }
};

TEST_F(SlowReadMe, EveryBlockRunsInOrderAndGivesTheAnswersThatArePrinted) {
  const std::string text = contents(root / "README.md");
  const std::vector<std::string> commands = blocks(text);
  ASSERT_GT(commands.size(), 4u);
  const Outcome outcome = run_all(commands);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("command not found"), std::string::npos) << outcome.err;
  for (const char* made : {"out/ring_down.html", "out/report.html", "out/diagnosis/setup.toml",
                           "out/drops.html", "out/lengths.sqlite"})
    EXPECT_TRUE(fs::exists(folder / made)) << made << "\n" << outcome.err;
  // All that the commands made lies in `out`.
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.path()))
    EXPECT_TRUE(entry.is_symlink() || entry.path().filename() == "out" ||
                entry.path().filename() == "build" || entry.path().extension() == ".txt" ||
                entry.path().extension() == ".sh")
        << entry.path();
  EXPECT_NE(outcome.out.find("clamp_dry_friction"), std::string::npos);
  std::istringstream printed(outcome.out);
  std::string all;
  for (std::string line; std::getline(printed, line);) all += rough(line) + "\n";
  const auto shown = answers(text);
  ASSERT_GE(shown.size(), 2u);
  for (const std::vector<std::string>& answer : shown)
    for (const std::string& line : answer)
      EXPECT_NE(all.find(rough(line) + "\n"), std::string::npos) << "the program does not print: " << line;
}

TEST(ReadMe, SaysHowToCiteAndWhereToReport) {
  const std::string text = contents(root / "README.md"), citation = contents(root / "CITATION.cff");
  const std::string doi = "10.1103/PhysRevE.84.011301";
  EXPECT_NE(text.find(doi), std::string::npos);
  EXPECT_NE(citation.find("doi: " + doi), std::string::npos);
  for (const char* said :
       {"CITATION.cff", "CHANGELOG.md", "CONTRIBUTING.md", "the shakedown authors", "microgravity"})
    EXPECT_NE(text.find(said), std::string::npos) << said;
}
