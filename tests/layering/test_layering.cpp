// SPDX-License-Identifier: MIT
// Which folder may include which, read off the #include lines: the diagram of the project, held.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "read_sources.hpp"

namespace fs = std::filesystem;

namespace {

/// One library of ours as its CMakeLists.txt declares it.
struct Layer {
  std::string library, folder;
  std::set<std::string> opened, opened_by_headers;  ///< libraries, ours and others'
};

std::set<std::string> words_of(const std::string& list) {
  std::set<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');)
    if (!word.empty()) words.insert(word);
  return words;
}

/// The table that CMake writes: in order of dependency, each library with what it may open.
std::vector<Layer> layers() {
  std::vector<Layer> found;
  std::ifstream file(LAYERS);
  for (std::string line; std::getline(file, line);) {
    Layer layer;
    std::string open, closed;
    std::istringstream(line) >> layer.library >> layer.folder >> open >> closed;
    layer.opened_by_headers = words_of(open.substr(std::string("public=").size()));
    layer.opened = words_of(closed.substr(std::string("private=").size()));
    layer.opened.insert(layer.opened_by_headers.begin(), layer.opened_by_headers.end());
    found.push_back(layer);
  }
  return found;
}

/// How the headers of other people's libraries begin.
const std::map<std::string, std::set<std::string>> headers_of_others{
    {"Eigen3::Eigen", {"Eigen/", "unsupported/Eigen/"}},
    {"fmt::fmt", {"fmt/"}},
    {"nlohmann_json::nlohmann_json", {"nlohmann/"}},
    {"muparser::muparser", {"muParser"}},
    {"PkgConfig::BULLET64", {"Bullet", "bullet/", "LinearMath/", "bt"}},
    {"PkgConfig::NLOPT", {"nlopt"}},
    {"SQLite::SQLite3", {"sqlite3"}},
    {"PkgConfig::SNDFILE", {"sndfile.h"}},
    {"PkgConfig::CAIRO", {"cairo"}},
    {"ZLIB::ZLIB", {"zlib.h"}},
    {"CLI11::CLI11", {"CLI/"}},
    {"pybind11::module", {"pybind11/"}},
    {"Threads::Threads", {}},
};

/// The TOML library is headers alone and no target: one folder reads with it, one turns setups into JSON by
/// it.
bool may_open_toml(const Layer& layer) {
  return layer.library == "setup_file" || layer.library == "ensemble";
}

struct Include {
  fs::path file;
  int line = 0;
  std::string header;
  bool quoted = false;
};

std::vector<Include> includes_of(const fs::path& file) {
  std::vector<Include> found;
  std::ifstream stream(file);
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (!text.starts_with("#include")) continue;
    const std::size_t open = text.find_first_of("<\"");
    if (open == std::string::npos) continue;
    const std::size_t close = text.find_first_of(">\"", open + 1);
    found.push_back({file, line, text.substr(open + 1, close - open - 1), text[open] == '"'});
  }
  return found;
}

/// Library of each of our headers by its plain name; names must be unique, or an include could mean two
/// files.
std::map<std::string, std::string> home_of_headers() {
  std::map<std::string, std::string> home;
  for (const Layer& layer : layers())
    for (const fs::path& file : sources_of(layer.folder))
      if (file.extension() == ".hpp") {
        const auto [place, fresh] = home.emplace(file.filename().string(), layer.library);
        EXPECT_TRUE(fresh) << "two headers are called " << file.filename() << ": in " << place->second
                           << " and " << layer.library;
      }
  return home;
}

std::string where(const Include& include) {
  return fs::relative(include.file, PROJECT_ROOT).string() + ":" + std::to_string(include.line) + ": " +
         include.header;
}

bool starts_with_any(const std::string& header, const std::set<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& prefix) { return header.starts_with(prefix); });
}

/// Headers of C++ have no dot; of C and the system a few are allowed by name.
bool is_standard(const std::string& header) {
  static const std::set<std::string> system{
      "unistd.h",     "signal.h",    "spawn.h",      "stdlib.h",    "experimental/simd",
      "immintrin.h",  "cpuid.h",     "sys/wait.h",   "sys/types.h", "sys/stat.h",
      "sys/mman.h",   "sys/file.h",  "sys/statfs.h", "sys/ioctl.h", "sys/socket.h",
      "netinet/in.h", "arpa/inet.h", "poll.h",       "fcntl.h",     "iconv.h"};
  return header.find_first_of("./") == std::string::npos || system.contains(header);
}

const std::set<std::string> generated{"build_info.hpp"};

}  // namespace

TEST(Layering, EachFolderOpensWhatItsCMakeListsNamesAndAllOfIt) {
  const std::map<std::string, std::string> home = home_of_headers();
  ASSERT_GT(layers().size(), 15u) << LAYERS;
  for (const Layer& layer : layers()) {
    std::set<std::string> used;
    for (const fs::path& file : sources_of(layer.folder))
      for (const Include& include : includes_of(file)) {
        if (!include.quoted || generated.contains(include.header)) continue;
        EXPECT_EQ(include.header.find('/'), std::string::npos)
            << where(include) << ": include our headers by their plain name";
        const auto found = home.find(include.header);
        if (found == home.end()) {
          ADD_FAILURE() << where(include) << ": is none of our headers";
          continue;
        }
        if (found->second == layer.library) continue;
        used.insert(found->second);
        const bool is_header = file.extension() == ".hpp";
        EXPECT_TRUE((is_header ? layer.opened_by_headers : layer.opened).contains(found->second))
            << where(include) << ": " << layer.library << " does not name " << found->second
            << (is_header ? " as PUBLIC" : "");
      }
    for (const std::string& named : layer.opened)
      EXPECT_TRUE(headers_of_others.contains(named) || used.contains(named))
          << layer.folder << "/CMakeLists.txt names " << named << ", which nothing there opens";
  }
}

TEST(Layering, NoFolderOpensOneAboveIt) {
  std::set<std::string> below;
  for (const Layer& layer : layers()) {
    for (const std::string& named : layer.opened)
      EXPECT_TRUE(below.contains(named) || headers_of_others.contains(named))
          << layer.library << " opens " << named << ", which comes after it in CMakeLists.txt";
    below.insert(layer.library);
  }
}

TEST(Layering, ThirdPartyHeadersStayPrivate) {
  for (const Layer& layer : layers())
    for (const fs::path& file : sources_of(layer.folder))
      for (const Include& include : includes_of(file)) {
        if (include.quoted || is_standard(include.header)) continue;
        const bool is_header = file.extension() == ".hpp";
        bool allowed = include.header.starts_with("toml++/") && may_open_toml(layer) && !is_header;
        for (const std::string& named : is_header ? layer.opened_by_headers : layer.opened)
          if (const auto others = headers_of_others.find(named); others != headers_of_others.end())
            allowed = allowed || starts_with_any(include.header, others->second);
        EXPECT_TRUE(allowed) << where(include)
                             << (is_header ? ": not in a header" : ": not a library of this folder");
      }
}

TEST(Layering, EveryFolderOfTheProjectIsInTheTable) {
  std::set<std::string> named;
  for (const Layer& layer : layers()) named.insert(layer.folder);
  for (const char* root : {"harness", "bench", "."})
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(PROJECT_ROOT) / root)) {
      if (!entry.is_directory() || !fs::exists(entry.path() / "CMakeLists.txt")) continue;
      const std::string name = fs::relative(entry.path(), PROJECT_ROOT).string();
      if (name == "tests" || name == "bench" || name == "harness/packaging") continue;
      EXPECT_TRUE(named.contains(name)) << name;
    }
}

/// Sources of a folder may be compiled together (SHAKEDOWN_TOGETHER): two functions of one name would then be
/// overloads of each other, and a call could reach the other one. An alias may be said twice in the same
/// words.
TEST(Layering, NoHiddenNameOfAFolderMeansTwoThings) {
  for (const Layer& layer : layers()) {
    std::map<std::string, std::pair<fs::path, std::string>> first;
    for (const fs::path& file : sources_of(layer.folder))
      for (const auto& [name, line] : hidden_names_of(file)) {
        const auto [place, fresh] = first.emplace(name, std::pair{file, line});
        const bool alias =
            line.ends_with(";") && (line.starts_with("using ") || line.starts_with("namespace "));
        EXPECT_TRUE(fresh || (alias && place->second.second == line))
            << name << " of " << fs::relative(file, PROJECT_ROOT) << " is named by "
            << fs::relative(place->second.first, PROJECT_ROOT) << " too: give one another name";
      }
  }
}

TEST(Layering, NoHiddenNameIsATypeOfAHeaderThatTheFolderOpens) {
  std::map<std::string, Names> types;
  for (const Layer& layer : layers()) types[layer.library] = types_of_headers(layer.folder);
  for (const Layer& layer : layers())
    for (const fs::path& file : sources_of(layer.folder)) {
      if (file.extension() != ".cpp") continue;
      for (const auto& [name, line] : hidden_names_of(file)) {
        for (const std::string& opened : layer.opened)
          EXPECT_FALSE(types[opened].contains(name))
              << name << " of " << fs::relative(file, PROJECT_ROOT) << " is a type of " << opened << " too";
        EXPECT_FALSE(types[layer.library].contains(name))
            << name << " of " << fs::relative(file, PROJECT_ROOT) << " is a type of " << layer.library
            << " too";
      }
    }
}

/// Other versions of clang-format break lines elsewhere.
TEST(SlowLayering, EverySourceIsFormatted) {
  const std::string clang_format = "clang-format-14";
  if (std::system((clang_format + " --version > /dev/null 2>&1").c_str()) != 0)
    GTEST_SKIP() << "needs clang-format-14 (apt-get install clang-format-14)";
  const std::string check = "cd " PROJECT_ROOT
                            " && find hardsphere softsphere harness bench tests -name '*.[ch]pp' -print0 |"
                            " xargs -0 " +
                            clang_format + " --dry-run -Werror";
  EXPECT_EQ(std::system(check.c_str()), 0) << "remedy: clang-format-14 -i on the files named above";
}

TEST(Layering, EverySourceNamesItsLicence) {
  for (const Layer& layer : layers())
    for (const fs::path& file : sources_of(layer.folder)) {
      std::ifstream stream(file);
      std::string first;
      std::getline(stream, first);
      EXPECT_EQ(first, "// SPDX-License-Identifier: MIT") << file;
    }
}

TEST(Layering, NoFunctionIsLongerThanItIsReadAtOnce) {
  constexpr int most = 60;
  std::size_t seen = 0;
  for (const Layer& layer : layers())
    for (const fs::path& file : sources_of(layer.folder))
      for (const LongFunction& one : functions_of(file)) {
        ++seen;
        EXPECT_LE(one.lines, most) << fs::relative(file, PROJECT_ROOT).string() << ":" << one.line << ": "
                                   << one.head << " has a part that is worth a name";
      }
  EXPECT_GT(seen, 2000u);  // of some four thousand: it finds them
}

/// Returns the statements of a source that move a member out of an object and name the whole object as
/// another argument. Arguments are evaluated in any order, by GCC from the right: the other one may read what
/// is gone.
std::vector<std::string> statements_that_read_what_they_move(std::istream& source) {
  std::string text;
  for (std::string line; std::getline(source, line);) text += line.substr(0, line.find("//")) + ' ';
  const std::regex moved(R"(std::move\((\w+)\.\w+\))");
  std::vector<std::string> found;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of(";{}", begin), text.size());
    const std::string statement = text.substr(begin, end - begin);
    for (std::sregex_iterator at(statement.begin(), statement.end(), moved), none; at != none; ++at)
      if (std::regex_search(statement, std::regex(R"([(,]\s*)" + at->str(1) + R"(\s*[,)])")))
        found.push_back(statement);
    begin = end + 1;
  }
  return found;
}

TEST(Layering, NoCallReadsWhatItMovesAway) {
  std::istringstream wrong("table = joined(left_out_of(d), std::move(d.table));"),
      right("table = joined(left_out, std::move(d.table), d.missing);");
  EXPECT_EQ(statements_that_read_what_they_move(wrong).size(), 1u);
  EXPECT_EQ(statements_that_read_what_they_move(right).size(), 0u);
  for (const Layer& layer : layers())
    for (const fs::path& file : sources_of(layer.folder)) {
      std::ifstream stream(file);
      for (const std::string& statement : statements_that_read_what_they_move(stream))
        ADD_FAILURE() << fs::relative(file, PROJECT_ROOT).string() << ":" << statement;
    }
}

TEST(Layering, NoFunctionHasMoreParametersThanAreKeptInMind) {
  constexpr int most = 6;
  std::size_t seen = 0;
  for (const Layer& layer : layers())
    for (const fs::path& file : sources_of(layer.folder)) {
      std::ifstream stream(file);
      std::string text;
      for (std::string line; std::getline(stream, line);) text += line.substr(0, line.find("//")) + '\n';
      for (const ParameterList& one : parameter_lists_of(text)) {
        ++seen;
        EXPECT_LE(one.parameters, most) << fs::relative(file, PROJECT_ROOT).string() << ":" << one.line
                                        << ": " << one.name << " takes things that are worth a type";
      }
    }
  EXPECT_GT(seen, 1000u);
  const std::vector<ParameterList> found = parameter_lists_of(
      "void f(int a, const std::map<int, int>& b,\n       double c = g(1, 2)) {\n  h(a, b, c);\n}\n");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].parameters, 3);
}

TEST(Layering, TestsCompareNumbersWithinWhatWasSeen) {
  const fs::path tests = fs::path(PROJECT_ROOT) / "tests";
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(tests)) {
    const fs::path& file = entry.path();
    if ((file.extension() != ".cpp" && file.extension() != ".hpp") || file == tests / "within.hpp" ||
        file.filename() == "test_layering.cpp")
      continue;
    std::ifstream source(file);
    for (const int line : bare_comparisons(source))
      ADD_FAILURE() << file << ":" << line << ": WITHIN of tests/within.hpp names the error seen";
  }
  std::istringstream source(
      "EXPECT_NEAR(a, b, 1);\nEXPECT_NEAR(a, b, c);  // not WITHIN: c is drawn\n\n// not WITHIN: drawn\n"
      "ASSERT_NEAR(a, b, c);\nASSERT_NEAR(a, b, c);\n");
  EXPECT_EQ(bare_comparisons(source), (std::vector<int>{1, 6}));
}
