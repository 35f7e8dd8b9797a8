// SPDX-License-Identifier: MIT
// shakedown import: an experiment file for tables as a tracking program wrote them.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command.hpp"
#include "import_tables.hpp"
#include "imported.hpp"
#include "json_output.hpp"
#include "kept_files.hpp"
#include "output_file.hpp"

namespace shakedown {

namespace {

struct ImportArguments {
  std::vector<std::string> files;
  std::string out = "experiment.toml";
  bool replace = false;
  ImportOptions known;
  JsonOutput json;
};

int import_files(const ImportArguments& arguments) {
  const std::filesystem::path out = arguments.out;
  if (std::filesystem::exists(out) && !arguments.replace)
    throw InputError({{{},
                       "--out",
                       out.string() + " exists already (it may hold what you filled in)",
                       "name another file, or add --replace"}});
  for (const std::string& file : arguments.files) keep_unchanged(file);
  expect_writable(out);
  arguments.json.check();
  const ImportedTables imported =
      import_tables({arguments.files.begin(), arguments.files.end()}, out.parent_path(), arguments.known);
  write_file(out, imported.experiment);
  fmt::print(arguments.json.for_people(), "{}", imported_text(imported, out.string()));
  arguments.json.write(imported_json(imported, out.string()));
  return exit_done;
}

}  // namespace

Command add_import_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "import", "write an experiment file for tables as a tracking program wrote them");
  const auto arguments = std::make_shared<ImportArguments>();
  command
      .add_option("files", arguments->files,
                  "tables of one layout: CSV, tabs, Tracker, TrackMate, trackpy, ImageJ, spreadsheets")
      ->required();
  command.add_option("--out", arguments->out, "the experiment file to write")->capture_default_str();
  command.add_option("--frame-rate", arguments->known.frame_rate, "frames a second, \"240 Hz\"")
      ->type_name("RATE");
  command.add_option("--pixel", arguments->known.pixel_size, "length that one pixel shows, \"0.25 mm\"")
      ->type_name("LENGTH");
  command
      .add_option("--origin", arguments->known.origin,
                  "what positions read where the spring is relaxed, \"640 px\"")
      ->type_name("POSITION");
  command
      .add_option("--length", arguments->known.lengths,
                  "inner length of the box, \"40 mm\": one for all tables, or again for each")
      ->type_name("LENGTH")
      ->expected(1)
      ->take_all();
  command.add_flag("--replace", arguments->replace, "overwrite it");
  add_json_option(command, arguments->json);
  return {&command, [arguments] { return import_files(*arguments); }};
}

}  // namespace shakedown
