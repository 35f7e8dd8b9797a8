// SPDX-License-Identifier: MIT
// What the documents say of the program: each command that they show exists with its options, each file of
// the project that they name is there, and the answers that they print are the program's.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
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

/// A figure that a document prints with the command that gives it. Command and figure stand there as they
/// stand here, but for line breaks; of the figure the last number counts that is no error. Runs have the same
/// bytes on every processor (tests/bytes), so the command gives each of its digits.
struct Figure {
  const char *document, *command, *printed;
  std::function<double(const nlohmann::json&)> read;  ///< from what the command gives with --json
  const char* folder = "";                            ///< from which the command is called
};

/// The number at a place of the answer, times a factor.
std::function<double(const nlohmann::json&)> at(const char* place, double factor = 1) {
  return [=](const nlohmann::json& answer) {
    return factor * answer.at(nlohmann::json::json_pointer(place)).get<double>();
  };
}

/// What grains and walls have left of the energy at the release.
double energy_left(const nlohmann::json& answer) {
  double left = 1;
  for (const nlohmann::json& lost : answer.at("energy_loss")) left -= lost.at("mean").get<double>();
  return left;
}

/// With one blank for each stretch of blanks and line breaks.
std::string in_one_line(const std::string& text) {
  return std::regex_replace(text, std::regex(R"(\s+)"), " ");
}

struct Reading {
  double value, unit;  ///< of its last digit
};

/// "16 runs: slope -8.20 +- 0.04" has -8.20 and 0.01.
Reading reading_of(const std::string& printed) {
  const std::regex number(R"((-?\d+(?:\.(\d+))?)(?: \+- \d+(?:\.\d+)?)?)");
  std::smatch last;
  for (std::sregex_iterator one(printed.begin(), printed.end(), number), end; one != end; ++one) last = *one;
  if (last.empty()) return {0, -1};
  return {std::stod(last[1]), std::pow(10.0, -static_cast<double>(last[2].length()))};
}

/// The answer of a command of the documents, asked once. What it names of the tree is there, wherever the
/// test runs.
const nlohmann::json& answer_to(const Figure& figure) {
  static std::map<std::pair<std::string, std::string>, nlohmann::json> known;
  nlohmann::json& answer = known[{figure.folder, figure.command}];
  if (!answer.is_null()) return answer;
  std::vector<std::string> arguments;
  for (std::string word : words_of(figure.command)) {
    std::erase(word, '"');
    const fs::path in_tree = root / figure.folder / word;
    arguments.push_back(fs::is_regular_file(in_tree) ? in_tree.string() : word);
  }
  arguments.erase(arguments.begin());
  arguments.push_back("--json");
  const Outcome outcome = shakedown_program(arguments);
  EXPECT_EQ(outcome.code, 0) << figure.command << "\n" << outcome.err;
  answer = nlohmann::json::parse(outcome.out, nullptr, false);
  return answer;
}

void expect_as_printed(const Figure& figure) {
  SCOPED_TRACE(std::string(figure.document) + ": " + figure.command + ": " + figure.printed);
  const std::string document = in_one_line(contents(root / figure.document));
  EXPECT_NE(document.find(figure.command), std::string::npos) << "the document has another command";
  EXPECT_NE(document.find(figure.printed), std::string::npos) << "the document has another figure";
  const auto [printed, unit] = reading_of(figure.printed);
  const nlohmann::json& answer = answer_to(figure);
  ASSERT_FALSE(answer.is_discarded());
  const double value = figure.read(answer);
  EXPECT_TRUE(std::abs(value - printed) <= unit / 2) << "the command gives " << value;
}

/// The interval that the README prints behind a parameter, "0.0199 (0.0197 to 0.0201)".
std::pair<double, double> interval_in(const std::string& text, const std::string& parameter) {
  const std::regex row(parameter + R"( +\S+ \((\S+) to (\S+)\))");
  std::smatch found;
  if (!std::regex_search(text, found, row)) return {1, 0};
  return {std::stod(found[1]), std::stod(found[2])};
}

TEST(Documents, FiguresAreReadWithTheirDigits) {
  const Reading slope = reading_of("16 runs: slope of |peaks| -8.20 +- 0.04"),
                share = reading_of("L065: 0.2618");
  EXPECT_EQ(slope.value, -8.20);
  EXPECT_DOUBLE_EQ(slope.unit, 0.01);
  EXPECT_EQ(share.value, 0.2618);
  EXPECT_DOUBLE_EQ(share.unit, 1e-4);
}

TEST(Documents, FiguresAreWhatTheCommandBesideThemGives) {
  const char* const sixteen = "shakedown run harness/examples/L040.toml --runs 16";
  for (const Figure& figure : std::vector<Figure>{
           {"harness/README.md", sixteen, "slope of |peaks| -8.20 +- 0.04", at("/slope_mm_per_s/mean")},
           {"harness/README.md", sixteen, "frequency 1.0479 +- 0.0001", at("/frequency_hz/mean")},
           {"harness/README.md", sixteen, "first peak below 10 mm 12.90 +- 0.12",
            at("/first_small_peak_s/mean")},
           {"harness/README.md", "shakedown theory harness/examples/L065.toml", "f t_g,peak = 0.2618",
            at("/f_t_g_peak")},
           {"harness/setup_file/README.md",
            "shakedown run harness/examples/L040.toml --runs 16 --set release.packing=random",
            "98.3 +- 0.3 mm with `random`", at("/peaks_mm/1/mean")},
           {"harness/effects/README.md", "shakedown effects grain_friction", "it adds 0.01 +- 0.02",
            at("/0/hard_soft_difference/0/added_to_plain_model_mm_per_s")},
       })
    expect_as_printed(figure);
}

// Each a few seconds of a core.
TEST(SlowDocuments, FiguresAreWhatTheCommandBesideThemGives) {
  const char* const attracting =
      "shakedown run harness/examples/L040.toml --runs 64 --set run.duration=9s --set "
      "grain_cohesion.force=20mN --set grain_cohesion.range=0.02mm";
  const char* const steel =
      "shakedown bounce drops_on_steel.csv --mass \"4.04 g\" --diameter \"10 mm\" --contact grain_grain";
  const char* const wall =
      "shakedown bounce drops_on_wall.csv --mass \"4.04 g\" --diameter \"10 mm\" --contact grain_wall";
  for (const Figure& figure : std::vector<Figure>{
           {"hardsphere/README.md",
            "shakedown run harness/examples/L040.toml --set \"run.duration=8 s\" --runs 200",
            "from 0.1749 +- 0.0003", energy_left},
           {"harness/README.md",
            "shakedown run harness/examples/L065.toml --set oscillating_acceleration.amplitude.x=1m/s^2 "
            "--set "
            "oscillating_acceleration.frequency=1.05Hz --set run.duration=38.1s",
            "to 1.86 m", at("/forced/amplitude_mm", 1e-3)},
           {"harness/effects/README.md",
            "shakedown run harness/examples/L040.toml --runs 16 --set run.duration=9s --set "
            "spring.frequency=1.225444Hz --set grain_friction.grain_grain=0.4137 --set "
            "grain_friction.grain_wall=0.4137 --set restitution.grain_grain=0.66088 --set "
            "restitution.grain_wall=0.68664",
            "L = 40 mm the slope is -8.83 +- 0.06", at("/slope_mm_per_s/mean")},
           {"harness/effects/README.md", attracting, "| hard | -8.42 +- 0.05 | -8.32 +- 0.16",
            at("/slope_mm_per_s/mean")},
           {"harness/bounce/README.md", steel, "The drops say 0.9501 +- 0.0007",
            at("/averaged_at_reference/value"), "tests/data/puzzle"},
           {"harness/bounce/README.md", wall, "and 0.9003 +- 0.0009", at("/averaged_at_reference/value"),
            "tests/data/puzzle"},
       })
    expect_as_printed(figure);
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
