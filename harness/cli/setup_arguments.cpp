// SPDX-License-Identifier: MIT
#include "setup_arguments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "effects.hpp"
#include "paper_values.hpp"
#include "setup_file.hpp"

namespace shakedown {

Setup SetupArguments::read(std::span<const std::string_view> elsewhere) const {
  std::vector<Override> given;
  std::vector<Violation> found;
  for (const std::string& text : overrides) {
    try {
      given.push_back(parse_override(text));
    } catch (const InputError& error) {
      found.insert(found.end(), error.violations.begin(), error.violations.end());
    }
  }
  if (!found.empty()) throw InputError(std::move(found));
  const bool bare = rate.find_first_not_of("0123456789.eE+-") == std::string::npos;
  if (!rate.empty()) given.push_back({"run.sample_rate", bare ? rate + " Hz" : rate, "--rate"});
  if (!seed.empty()) given.push_back({"run.seed", seed, "--seed"});
  Setup setup = read_setup(file, all_effects(), given);
  if (strict) refuse_paper_values(setup, file, elsewhere);
  return setup;
}

PaperValues::PaperValues(const Setup& setup, std::span<const std::string_view> elsewhere)
    : taken_(taken_from_paper(setup, elsewhere)) {}

void PaperValues::join(const PaperValues& other) {
  for (const std::string& value : other.taken_)
    if (std::find(taken_.begin(), taken_.end(), value) == taken_.end()) taken_.push_back(value);
}

void PaperValues::print(std::FILE* stream) const { fmt::print(stream, "{}", line_of_paper_values(taken_)); }

std::string PaperValues::added_to(const std::string& json_document) const {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(json_document);
  json["taken_from_paper"] = taken_;
  return json.dump(2) + "\n";
}

void add_strict_option(CLI::App& command, bool& strict) {
  command.add_flag("--strict", strict,
                   "refuse a setup that leaves out what the damper is (masses, lengths, frequency, "
                   "restitutions, release) instead of taking the paper's values");
}

void add_setup_arguments(CLI::App& command, SetupArguments& arguments) {
  command.add_option("SETUP", arguments.file, "setup file (TOML)")->required()->type_name("");
  command
      .add_option("--set", arguments.overrides,
                  "change a key of the setup, e.g. --set box.length=\"65 mm\"; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  add_strict_option(command, arguments.strict);
  command.add_option("--rate", arguments.rate, "samples per second (run.sample_rate)")->type_name("HZ");
  command.add_option("--seed", arguments.seed, "seed of the random numbers (run.seed)")->type_name("N");
}

}  // namespace shakedown
