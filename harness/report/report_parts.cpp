// SPDX-License-Identifier: MIT
#include "report_parts.hpp"

#include "provenance.hpp"
#include "setup_file.hpp"

namespace shakedown {

std::vector<std::string> citations_of(const Setup& setup) {
  std::vector<std::string> lines;
  for (const EffectChoice& choice : setup.effects)
    lines.push_back(std::string(choice.record->name) + ": " + std::string(choice.record->source));
  return lines;
}

std::string this_command() {
  std::string line;
  for (const std::string& word : provenance_of_this_program().command) {
    const bool plain = word.find_first_of(" \t'\"$&|;<>()*?") == std::string::npos && !word.empty();
    line += line.empty() ? "shakedown" : plain ? " " + word : " '" + word + "'";
  }
  return line;
}

void say_how_to_reproduce(Report& report, const Setup& setup) {
  report.command = this_command();
  report.setup = write_setup(setup);
  report.program = version_line();
  report.citations = citations_of(setup);
}

}  // namespace shakedown
