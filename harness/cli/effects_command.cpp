// SPDX-License-Identifier: MIT
// shakedown effects: what a setup may add to the plain model.
#include <fmt/format.h>

#include <memory>

#include "catalogue.hpp"
#include "command.hpp"
#include "effect_asked.hpp"
#include "effects.hpp"
#include "json_output.hpp"

namespace shakedown {

namespace {

struct EffectsArguments {
  std::string name;
  JsonOutput json;
};

int show_effects(const EffectsArguments& arguments) {
  if (arguments.name.empty()) {
    fmt::print(arguments.json.for_people(), "{}", list_effects(all_effects()));
    arguments.json.write(effects_json(all_effects()));
    return exit_done;
  }
  const EffectRecord* const one[] = {&effect_asked(arguments.name)};
  fmt::print(arguments.json.for_people(), "{}", describe_effect(*one[0]));
  arguments.json.write(effects_json(one));
  return exit_done;
}

}  // namespace

Command add_effects_command(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("effects", "the effects that a setup may add, or all about one");
  const auto arguments = std::make_shared<EffectsArguments>();
  command.add_option("NAME", arguments->name, "an effect")->type_name("");
  add_json_option(command, arguments->json);
  return {&command, [arguments] { return show_effects(*arguments); }};
}

}  // namespace shakedown
