// SPDX-License-Identifier: MIT
// shakedown add: a setup with one effect more.
#include <fmt/format.h>

#include <memory>

#include "added_effect.hpp"
#include "command.hpp"
#include "output_file.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

struct AddArguments {
  std::string setup, effect, out;
  std::vector<std::string> values;
};

int add(const AddArguments& arguments) {
  const std::filesystem::path file = arguments.setup, out = arguments.out;
  const AmendedSetup amended =
      with_effect_added(read_text_file(file), file, arguments.effect, arguments.values, out.parent_path());
  if (!amended.as_written)
    fmt::print(stderr,
               "note: {} was written anew, without its comments (its effects stand in one line, or a path "
               "counts from another folder)\n",
               arguments.setup);
  if (out.empty()) {
    fmt::print("{}", amended.text);
  } else {
    write_file(out, amended.text);
    fmt::print("wrote {}\n", out.string());
  }
  return exit_done;
}

}  // namespace

Command add_add_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("add", "write a setup with one effect more, its comments kept");
  const auto arguments = std::make_shared<AddArguments>();
  command.add_option("SETUP", arguments->setup, "setup file (TOML)")->required()->type_name("");
  command.add_option("EFFECT", arguments->effect, "`shakedown effects` lists them")
      ->required()
      ->type_name("");
  command
      .add_option("values", arguments->values,
                  "its parameters, e.g. grain_grain=0.2 acceleration.x=0.1m/s^2; none: its typical strength")
      ->type_name("KEY=VALUE");
  command
      .add_option("--out", arguments->out,
                  "the file to write (may be SETUP itself); default: standard output")
      ->type_name("FILE");
  return {&command, [arguments] { return add(*arguments); }};
}

}  // namespace shakedown
