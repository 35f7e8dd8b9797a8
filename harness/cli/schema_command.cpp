// SPDX-License-Identifier: MIT
// shakedown schema: the setup file's keys, for people and for editors.
#include <fmt/format.h>

#include <memory>

#include "catalogue.hpp"
#include "command.hpp"
#include "effects.hpp"
#include "json_output.hpp"

namespace shakedown {

namespace {

struct SchemaArguments {
  bool table = false;
  JsonOutput json;
};

int show_schema(const SchemaArguments& arguments) {
  if (arguments.table) fmt::print(arguments.json.for_people(), "{}", setup_keys_markdown());
  JsonOutput json = arguments.json;
  json.wanted = json.wanted || !arguments.table;  // the schema is what the command is for
  json.write(setup_schema(all_effects()));
  return exit_done;
}

}  // namespace

Command add_schema_command(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("schema", "the JSON Schema of a setup file, for editors and programs");
  const auto arguments = std::make_shared<SchemaArguments>();
  command.add_flag("--table", arguments->table, "the keys as a table for people (Markdown)");
  add_json_option(command, arguments->json);
  return {&command, [arguments] { return show_schema(*arguments); }};
}

}  // namespace shakedown
