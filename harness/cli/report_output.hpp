// SPDX-License-Identifier: MIT
#pragma once
#include <CLI/CLI.hpp>
#include <string>

#include "report.hpp"

namespace shakedown {

/// The option --report FILE.html of the commands that have something to show.
struct ReportOutput {
  std::string file;

  /// Tells whether a report must be made: for the page, or to be kept in a folder of results (empty: there is
  /// none).
  bool wanted(const std::string& folder) const { return !file.empty() || !folder.empty(); }
  /// Throws FileError when the page cannot be written; to be called before long work.
  void check() const;
  /// Writes the page and keeps the report in the folder. Returns a line for people: what to open, with its
  /// size.
  std::string write(const Report& report, const std::string& folder) const;
};

/// Adds the option. The variable must outlive the parsing.
void add_report_option(CLI::App& command, ReportOutput& output);

}  // namespace shakedown
