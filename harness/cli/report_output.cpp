// SPDX-License-Identifier: MIT
#include "report_output.hpp"

#include <fmt/format.h>

#include "output_file.hpp"

namespace shakedown {

void ReportOutput::check() const {
  if (!file.empty()) expect_writable(file);
}

std::string ReportOutput::write(const Report& report, const std::string& folder) const {
  if (!folder.empty()) OutputFolder(folder).write(report_file_name, report_json(report));
  if (file.empty()) return "";
  write_report(file, report);
  return fmt::format("report: open {} ({:.2f} MB)\n", file,
                     static_cast<double>(std::filesystem::file_size(file)) / 1e6);
}

void add_report_option(CLI::App& command, ReportOutput& output) {
  command
      .add_option("--report", output.file,
                  "write one HTML page that shows all of this, for any browser, without a network")
      ->type_name("FILE.html");
}

}  // namespace shakedown
