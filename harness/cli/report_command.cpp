// SPDX-License-Identifier: MIT
// shakedown report: one page from the folders that other commands left.
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "report_output.hpp"
#include "report_joined.hpp"

namespace shakedown {

Command add_report_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("report", "one HTML page from folders of results");
  const auto folders = std::make_shared<std::vector<std::string>>();
  const auto output = std::make_shared<ReportOutput>();
  output->file = "report.html";
  command.add_option("DIR", *folders, "folders that run, compare, diagnose, crosscheck ... wrote with --out")->required();
  command.add_option("--out", output->file, "the page")->type_name("FILE.html")->capture_default_str();
  return {&command, [folders, output] {
            std::vector<NamedReport> reports;
            for (const std::string& folder : *folders) reports.push_back({std::filesystem::path(folder).lexically_normal().filename().string(), read_report(folder)});
            fmt::print("{}", output->write(joined(std::move(reports)), ""));
            return static_cast<int>(exit_done);
          }};
}

}  // namespace shakedown
