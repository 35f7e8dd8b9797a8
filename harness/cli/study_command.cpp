// SPDX-License-Identifier: MIT
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "command.hpp"
#include "errors.hpp"
#include "program_place.hpp"

namespace shakedown {

namespace {

int run_study(const std::string& name, std::vector<std::string> words) {
  std::string studies = (program_folder() / "shakedown-studies").string(), study = name;
  std::vector<char*> arguments{studies.data(), study.data()};
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  execv(studies.c_str(), arguments.data());
  throw FileError(studies + ": cannot be run (" + std::strerror(errno) +
                  "); build it: cmake --build --preset release --target shakedown-studies");
}

}  // namespace

Command add_study_command(CLI::App& program, const char* name, const char* description) {
  CLI::App* parser = program.add_subcommand(name, description);
  parser->set_help_flag();  // shakedown-studies has the help
  parser->prefix_command();
  return {parser, [parser, name] { return run_study(name, parser->remaining()); }};
}

}  // namespace shakedown
