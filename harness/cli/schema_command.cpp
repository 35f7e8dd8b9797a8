// SPDX-License-Identifier: MIT
// shakedown schema: the keys of setup and experiment files, for people and for editors.
#include <fmt/format.h>

#include <memory>

#include "catalogue.hpp"
#include "command.hpp"
#include "effects.hpp"
#include "experiment_reference.hpp"
#include "json_output.hpp"

namespace shakedown {

namespace {

struct SchemaArguments {
  bool table = false, experiment = false;
  JsonOutput json;
};

int show_schema(const SchemaArguments& arguments) {
  if (arguments.table)
    fmt::print(arguments.json.for_people(), "{}",
               arguments.experiment ? experiment_keys_markdown() : setup_keys_markdown());
  JsonOutput json = arguments.json;
  json.wanted = json.wanted || !arguments.table;  // the schema is what the command is for
  json.write(arguments.experiment ? experiment_schema() : setup_schema(all_effects()));
  return exit_done;
}

}  // namespace

Command add_schema_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "schema", "the JSON Schema of a setup or an experiment file, for editors and programs");
  const auto arguments = std::make_shared<SchemaArguments>();
  command.add_flag("--experiment", arguments->experiment,
                   "of the experiment file, which says what was measured");
  command.add_flag("--table", arguments->table, "the keys as a table for people (Markdown)");
  add_json_option(command, arguments->json);
  return {&command, [arguments] { return show_schema(*arguments); }};
}

}  // namespace shakedown
