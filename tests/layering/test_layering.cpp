// SPDX-License-Identifier: MIT
// Which folder may include which, read off the #include lines: the diagram of the project, held.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

struct Folder {
  std::set<std::string> may_include;       ///< folders of the project
  std::set<std::string> libraries;         ///< prefixes of third-party headers that its .cpp files may open
  std::set<std::string> public_libraries;  ///< and its headers
};

const std::set<std::string> engines{"hardsphere", "softsphere"};

std::set<std::string> with(std::set<std::string> folders, const std::set<std::string>& more) {
  folders.insert(more.begin(), more.end());
  return folders;
}

/// From the floor up; each floor may use what its line names and no more.
std::map<std::string, Folder> folders() {
  const std::set<std::string> ground{"harness/problem"}, laws{"harness/problem", "harness/effects"};
  const std::set<std::string> run = with(laws, with(engines, {"harness/observe"}));
  const std::set<std::string> compare = with(run, {"harness/run", "harness/measure"});
  const std::set<std::string> diagnose = with(compare, {"harness/compare"});
  const std::set<std::string> laboratory = with(diagnose, {"harness/diagnose"});
  const std::set<std::string> report =
      with(laboratory, {"harness/export", "harness/sweep", "harness/fit", "harness/paper"});
  const std::set<std::string> json{"nlohmann/", "fmt/", "toml++/"};
  return {
      {"harness/problem", {{}, {"toml++/", "Eigen/"}, {"Eigen/"}}},
      {"harness/effects", {ground, {"muParser", "nlohmann/", "fmt/", "Eigen/"}, {"Eigen/"}}},
      {"hardsphere", {laws, {"Eigen/"}, {"Eigen/"}}},
      {"softsphere", {laws, {"Eigen/", "Bullet", "bullet/", "LinearMath/", "bt"}, {"Eigen/"}}},
      {"harness/observe", {laws, {"Eigen/"}, {"Eigen/"}}},
      {"harness/run", {run, json, {}}},
      {"harness/sweep", {with(run, {"harness/run"}), {"fmt/", "sqlite3"}, {}}},
      {"harness/measure", {with(laws, {"harness/observe"}), with(json, {"Eigen/"}), {"Eigen/"}}},
      {"harness/compare", {compare, with(json, {"nlopt", "Eigen/", "sqlite3"}), {"Eigen/"}}},
      {"harness/fit", {diagnose, with(json, {"Eigen/"}), {"Eigen/"}}},
      {"harness/diagnose", {diagnose, with(json, {"Eigen/", "sqlite3", "nlopt", "muParser"}), {"Eigen/"}}},
      {"harness/laboratory", {laboratory, json, {}}},
      {"harness/paper",
       {with(laboratory, {"harness/fit", "harness/laboratory"}), with(json, {"Eigen/"}), {"Eigen/"}}},
      {"harness/export", {diagnose, with(json, {"Eigen/"}), {"Eigen/"}}},
      {"harness/report", {report, with(json, {"Eigen/", "zlib.h"}), {"Eigen/"}}},
      {"harness/cli",
       {with(report, {"harness/report", "harness/laboratory"}), with(json, {"CLI/"}), {"CLI/"}}},
  };
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

std::vector<fs::path> sources_of(const std::string& folder) {
  std::vector<fs::path> files;
  const fs::path root = fs::path(PROJECT_ROOT) / folder;
  if (!fs::exists(root)) return files;
  for (const fs::directory_entry& entry : fs::directory_iterator(root))
    if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp")
      files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// Folder of each of our headers by its plain name; names must be unique, or an include could mean two files.
std::map<std::string, std::string> home_of_headers() {
  std::map<std::string, std::string> home;
  for (const auto& [name, rules] : folders())
    for (const fs::path& file : sources_of(name))
      if (file.extension() == ".hpp") {
        const auto [place, fresh] = home.emplace(file.filename().string(), name);
        EXPECT_TRUE(fresh) << "two headers are called " << file.filename() << ": in " << place->second
                           << " and " << name;
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
      "unistd.h",     "experimental/simd", "immintrin.h", "sys/wait.h",   "sys/types.h",
      "sys/stat.h",   "sys/mman.h",        "sys/file.h",  "sys/statfs.h", "sys/ioctl.h",
      "sys/socket.h", "netinet/in.h",      "arpa/inet.h", "poll.h",       "fcntl.h",
      "iconv.h"};
  return header.find_first_of("./") == std::string::npos || system.contains(header);
}

const std::set<std::string> generated{"build_info.hpp"};

}  // namespace

TEST(Layering, EachFolderOpensOnlyTheFoldersBelowIt) {
  const std::map<std::string, std::string> home = home_of_headers();
  for (const auto& [folder, rules] : folders())
    for (const fs::path& file : sources_of(folder))
      for (const Include& include : includes_of(file)) {
        if (!include.quoted || generated.contains(include.header)) continue;
        EXPECT_EQ(include.header.find('/'), std::string::npos)
            << where(include) << ": include our headers by their plain name";
        const auto found = home.find(include.header);
        if (found == home.end()) {
          ADD_FAILURE() << where(include) << ": is none of our headers";
          continue;
        }
        EXPECT_TRUE(found->second == folder || rules.may_include.contains(found->second))
            << where(include) << ": " << folder << " may not open " << found->second;
      }
}

TEST(Layering, ThirdPartyHeadersStayPrivate) {
  for (const auto& [folder, rules] : folders())
    for (const fs::path& file : sources_of(folder))
      for (const Include& include : includes_of(file)) {
        if (include.quoted || is_standard(include.header)) continue;
        const bool is_header = file.extension() == ".hpp";
        EXPECT_TRUE(starts_with_any(include.header, is_header ? rules.public_libraries : rules.libraries))
            << where(include) << (is_header ? ": not in a header" : ": not a library of this folder");
      }
}

TEST(Layering, EveryFolderOfTheProjectIsInTheTable) {
  const std::map<std::string, Folder> table = folders();
  for (const char* root : {"harness", "."})
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(PROJECT_ROOT) / root)) {
      if (!entry.is_directory() || !fs::exists(entry.path() / "CMakeLists.txt")) continue;
      const std::string name = fs::relative(entry.path(), PROJECT_ROOT).string();
      if (name == "tests" || name == "bench") continue;
      EXPECT_TRUE(table.contains(name)) << name;
    }
}

/// Other versions of clang-format break lines elsewhere.
TEST(Layering, EverySourceIsFormatted) {
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
  for (const auto& [folder, rules] : folders())
    for (const fs::path& file : sources_of(folder)) {
      std::ifstream stream(file);
      std::string first;
      std::getline(stream, first);
      EXPECT_EQ(first, "// SPDX-License-Identifier: MIT") << file;
    }
}
