// SPDX-License-Identifier: MIT
#include "setup_arguments.hpp"

#include "effects.hpp"
#include "setup_file.hpp"

namespace shakedown {

Setup SetupArguments::read() const {
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
  return read_setup(file, all_effects(), given);
}

void add_setup_arguments(CLI::App& command, SetupArguments& arguments) {
  command.add_option("SETUP", arguments.file, "setup file (TOML)")->required()->type_name("");
  command
      .add_option("--set", arguments.overrides,
                  "change a key of the setup, e.g. --set box.length=\"65 mm\"; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--rate", arguments.rate, "samples per second (run.sample_rate)")->type_name("HZ");
  command.add_option("--seed", arguments.seed, "seed of the random numbers (run.seed)")->type_name("N");
}

}  // namespace shakedown
