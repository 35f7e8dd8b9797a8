// SPDX-License-Identifier: MIT
// What the documents say of the program: each command that they show exists with its options, each file of
// the project that they name is there, and the answers that they print are the program's.
#include <algorithm>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

#include "program.hpp"

namespace fs = std::filesystem;

namespace {

const fs::path root = PROJECT_ROOT;

std::vector<fs::path> documents() {
  std::vector<fs::path> found{root / "README.md"};
  for (const char* folder : {"harness", "hardsphere", "softsphere", "bench", "tests"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".md" && entry.path().string().find("vendor") == std::string::npos)
        found.push_back(entry.path());
  return found;
}

/// Lines of the ```sh blocks, without comments.
std::vector<std::string> shell_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  bool inside = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("```")) {
      inside = !inside && line == "```sh";
    } else if (inside) {
      line = line.substr(0, line.find(" #"));
      if (!line.empty() && !line.starts_with("#")) lines.push_back(line);
    }
  }
  return lines;
}

/// Words of a line; what stands in quotes is one.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  const std::regex word(R"((?:[^\s"]|"[^"]*")+)");
  for (std::sregex_iterator one(line.begin(), line.end(), word), end; one != end; ++one)
    words.push_back(one->str());
  return words;
}

const std::set<std::string> programs{"shakedown", "shakedown-studies"};

/// What a command of one of the two programs says of itself; empty: there is no such command.
const std::string& help_of(const std::string& program, const std::string& command) {
  static std::map<std::pair<std::string, std::string>, std::string> known;
  std::string& text = known[{program, command}];
  if (text.empty()) {
    const std::string help = program_beside(program, {command, "--help"}).out;
    // Both are called shakedown there: it hands words on to the other one.
    if (help.find("Usage: shakedown " + command + " ") != std::string::npos) text = help;
  }
  return text;
}

bool has_word(const std::string& text, const std::string& word) {
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const char after = at + word.size() < text.size() ? text[at + word.size()] : ' ';
    if (after != '-' && !std::isalnum(static_cast<unsigned char>(after))) return true;
  }
  return false;
}

/// "" or what is wrong with a line of a ```sh block.
std::string wrong_with(const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  const auto program = std::find_if(words.begin(), words.end(),
                                    [](const std::string& word) { return programs.contains(word); });
  for (const std::string& word : words)
    if (word.starts_with("harness/examples/") && !fs::exists(root / word)) return word + " is not there";
  if (program == words.end()) {
    const std::string first = words[0].starts_with("./") ? words[0].substr(2) : words[0];
    const bool of_the_project = first.find('/') != std::string::npos && !first.starts_with("build/");
    return of_the_project && !fs::exists(root / first) ? first + " is not there" : "";
  }
  if (program + 1 == words.end()) return "no command";
  const std::string& command = *(program + 1);
  if (command == "--help") return "";
  const std::string& help = help_of(*program, command);
  if (help.empty()) return command + " is no command of " + *program;
  for (auto word = program + 2; word != words.end(); ++word)
    if (word->starts_with("--") && !has_word(help, word->substr(0, word->find('='))))
      return command + " has no option " + *word;
  return "";
}

}  // namespace

TEST(Documents, EachCommandExistsWithItsOptions) {
  int commands = 0;
  for (const fs::path& document : documents())
    for (const std::string& line : shell_lines(contents(document))) {
      ++commands;
      EXPECT_EQ(wrong_with(line), "") << document << ": " << line;
    }
  EXPECT_GT(commands, 40);
}

TEST(Documents, TheCheckFindsWhatIsWrong) {
  EXPECT_NE(wrong_with("shakedown runn setup.toml"), "");
  EXPECT_NE(wrong_with("shakedown run setup.toml --run 16"), "");
  EXPECT_NE(wrong_with("shakedown run harness/examples/L041.toml"), "");
  EXPECT_NE(wrong_with("./harness/quickly"), "");
  EXPECT_NE(wrong_with("shakedown-studies ring-ups --cases 200"), "");
  EXPECT_NE(wrong_with("shakedown-studies ring-downs --case 200"), "");
  EXPECT_EQ(wrong_with("shakedown-studies ring-downs --cases 200 --seed 1"), "");
  EXPECT_EQ(wrong_with("mpirun -n 8 shakedown sweep setup.toml --vary a.b=1:2:1mm --out shared.sqlite"), "");
}

TEST(Documents, EachLinkLeadsSomewhere) {
  const std::regex link(R"(\]\(([^)#:\s]+)\))");
  for (const fs::path& document : documents()) {
    const std::string text = contents(document);
    for (std::sregex_iterator one(text.begin(), text.end(), link), end; one != end; ++one)
      EXPECT_TRUE(fs::exists(document.parent_path() / (*one)[1].str())) << document << ": " << (*one)[1];
  }
}

TEST(Documents, TheSetupReferenceIsWhatTheProgramPrints) {
  const std::string table = shakedown_program({"schema", "--table"}).out;
  EXPECT_NE(contents(root / "harness/setup_file/README.md").find(table), std::string::npos)
      << "put the output of `shakedown schema --table` there";
}

/// The interval that the README prints behind a parameter, "0.0199 (0.0197 to 0.0201)".
std::pair<double, double> interval_in(const std::string& text, const std::string& parameter) {
  const std::regex row(parameter + R"( +\S+ \((\S+) to (\S+)\))");
  std::smatch found;
  if (!std::regex_search(text, found, row)) return {1, 0};
  return {std::stod(found[1]), std::stod(found[2])};
}

TEST(SlowDocuments, TheRecordingOfSomebodyElseGetsTheAnswerOfTheReadMe) {
  const fs::path folder = fs::path(TEST_DATA) / "filmed_pendulum";
  const Outcome outcome = shakedown_program(
      {"diagnose", (folder / "setup.toml").string(), "--data", (folder / "experiment.toml").string()});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const std::string sentence = outcome.out.substr(0, outcome.out.find('\n'));
  EXPECT_NE(contents(root / "README.md").find(sentence), std::string::npos) << sentence;
}

// The tables are of our own laboratory: 0.02 N s/m, 8 mN and 1.26 Hz are hidden.
TEST(SlowDocuments, TheRecordingOfTheReadMeGetsThatAnswer) {
  const fs::path folder = fs::path(TEST_DATA) / "leaf_spring";
  const Outcome outcome = shakedown_program({"diagnose", (folder / "setup.toml").string(), "--data",
                                             (folder / "experiment.toml").string(), "--json"});
  EXPECT_EQ(outcome.code, 1) << outcome.err;
  const nlohmann::json answer = nlohmann::json::parse(outcome.out);
  const auto missing = answer["missing"].get<std::set<std::string>>();
  EXPECT_EQ(missing, (std::set<std::string>{"blade_viscous_damping", "clamp_dry_friction"}));
  const std::string document = contents(root / "README.md");
  for (const char* name : {"blade_viscous_damping.damping", "clamp_dry_friction.force", "spring.frequency"}) {
    const auto [low, high] = interval_in(document, name);
    const double value = answer["parameters"][name]["value"];
    EXPECT_TRUE(low <= value && value <= high)
        << name << " = " << value << ": the README has " << low << " to " << high;
  }
}
