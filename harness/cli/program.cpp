// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "command.hpp"
#include "errors.hpp"
#include "interruption.hpp"
#include "manual.hpp"
#include "provenance.hpp"

namespace shakedown {
namespace {

/// The arguments in the reverse order that the parser wants. "--json" may go without a file; a setup after it
/// is the setup, not a file to overwrite.
std::vector<std::string> reversed_arguments(int count, char** words) {
  std::vector<std::string> arguments(words + 1, words + count);
  for (std::size_t i = 0; i + 1 < arguments.size(); ++i)
    if (arguments[i] == "--json" && arguments[i + 1].ends_with(".toml")) arguments[i] = "--json=-";
  std::reverse(arguments.begin(), arguments.end());
  return arguments;
}

/// Does the work and returns the exit code; prints errors.
int guarded(const std::function<int()>& work) {
  try {
    return work();
  } catch (const InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return exit_bad_input;
  } catch (const PhysicsError& error) {
    fmt::print(stderr, "the engine cannot keep its promise: {}\n", error.what());
    return exit_promise_broken;
  } catch (const FileError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return exit_bad_file;
  } catch (const Interrupted& error) {
    fmt::print(stderr, "interrupted: {}\n", error.what());
    return exit_interrupted;
  } catch (const std::exception& error) {
    fmt::print(stderr, "this is a bug of the program, please report it: {}\n", error.what());
  }
  return exit_bug;
}

int run_chosen(const std::vector<Command>& commands) {
  for (const Command& command : commands)
    if (command.parser->parsed()) return command.run();
  EXPECT(!"one command is required");
  return exit_bug;
}

/// `--write-manual DIR`, for packages: it is no option that a help shows.
bool asks_for_manual(int count, char** words) {
  return count == 3 && std::string_view(words[1]) == "--write-manual";
}

int written_manual(const CLI::App& program, char** words) {
  write_manual(words[2], std::filesystem::path(words[0]).filename().string(), program);
  return exit_done;
}

}  // namespace

int run_program(const char* name, const char* description, std::vector<Command> (*add)(CLI::App&), int count,
                char** words) {
  CLI::App program(description, name);
  program.set_version_flag("--version", version_line());
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done, 1 the data reject the model, 2 usage or setup, 3 an engine broke its promise, 4 "
      "file,\n"
      "70 a bug of the program, 130 interrupted with results kept.");
  const std::vector<Command> commands = add(program);
  if (asks_for_manual(count, words)) return guarded([&] { return written_manual(program, words); });
  try {
    program.parse(reversed_arguments(count, words));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // help or version
    if (const std::vector<std::string> words_left = program.remaining();
        program.get_subcommands().empty() && !words_left.empty())
      fmt::print(stderr, "there is no command or option '{}'\nRun with --help for more information.\n",
                 words_left.front());
    else
      program.exit(error);
    return exit_bad_input;
  }
  return guarded([&] { return run_chosen(commands); });
}

}  // namespace shakedown
