// SPDX-License-Identifier: MIT
// shakedown report: one page from the folders that other commands left.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <memory>

#include "command.hpp"
#include "kept_files.hpp"
#include "named_files.hpp"
#include "report_joined.hpp"
#include "report_output.hpp"
#include "sweep_report.hpp"

namespace shakedown {

namespace {

/// Tells whether a place is a sweep's one file of results; everything else leaves a folder.
bool is_result_file(const std::filesystem::path& file) {
  constexpr std::string_view magic = "SQLite format 3";
  std::string beginning(magic.size(), ' ');
  std::ifstream stream(file, std::ios::binary);
  return std::filesystem::is_regular_file(file) &&
         stream.read(beginning.data(), static_cast<std::streamsize>(magic.size())) && beginning == magic;
}

/// Returns names for folders: the last part of the path, or the whole path where two share it.
std::vector<std::string> names_of(const std::vector<std::string>& places) {
  std::vector<std::string> paths, names;
  for (const std::string& place : places)
    paths.push_back((std::filesystem::path(place) / "").parent_path().string());
  const auto last = [](const std::string& path) { return std::filesystem::path(path).filename().string(); };
  for (const std::string& path : paths) {
    const auto shares = [&](const std::string& other) { return last(other) == last(path); };
    names.push_back(std::ranges::count_if(paths, shares) > 1 ? path : last(path));
  }
  return names;
}

NamedReport stored_report(const std::filesystem::path& place, const std::string& name) {
  return {name, is_result_file(place) ? report_of(ResultFile(place), name) : read_report(place)};
}

/// The page goes over no result that it shows: a file, or one in a folder.
void keep_results(const std::filesystem::path& place) {
  keep_unchanged(place);
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(place, none))
    if (entry.is_regular_file(none) && is_result(entry.path())) keep_unchanged(entry.path());
}

}  // namespace

Command add_report_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("report", "one HTML page from folders of results");
  const auto folders = std::make_shared<std::vector<std::string>>();
  const auto output = std::make_shared<ReportOutput>();
  output->file = "report.html";
  command
      .add_option("DIR", *folders,
                  "folders that run, compare, diagnose, fit, ladder, paper, crosscheck wrote with --out, and "
                  "files of sweep")
      ->required();
  command.add_option("--out", output->file, "the page")->type_name("FILE.html")->capture_default_str();
  return {&command, [folders, output] {
            std::vector<NamedReport> reports;
            for (const std::string& place : *folders) keep_results(place);
            output->check();
            const std::vector<std::string> names = names_of(*folders);
            for (std::size_t i = 0; i < names.size(); ++i)
              reports.push_back(stored_report((*folders)[i], names[i]));
            fmt::print("{}", output->write(joined(std::move(reports)), ""));
            return static_cast<int>(exit_done);
          }};
}

}  // namespace shakedown
