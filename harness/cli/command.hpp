// SPDX-License-Identifier: MIT
#pragma once
#include <CLI/CLI.hpp>
#include <functional>
#include <vector>

namespace shakedown {

/// Exit codes of every command.
enum ExitCode : int {
  exit_done = 0,            ///< done; the model holds
  exit_model_rejected = 1,  ///< the data reject the model
  exit_bad_input = 2,       ///< usage or setup
  exit_promise_broken = 3,  ///< an engine could not keep its promise
  exit_bad_file = 4,        ///< a file cannot be read or written
  exit_bug = 70,            ///< an error that the program did not foresee
  exit_interrupted = 130    ///< Ctrl-C; what was done is kept
};

/// A subcommand: what parses its arguments, and what it then does (returns the exit code).
struct Command {
  CLI::App* parser = nullptr;
  std::function<int()> run;
};

/// Parses the words, runs the command that they name, and returns its exit code; prints errors.
int run_program(const char* name, const char* description, std::vector<Command> (*add)(CLI::App&), int count,
                char** words);

/// Adds every command, in the order of `shakedown --help`. A new command is one file, a line here and one
/// in commands.cpp.
std::vector<Command> add_commands(CLI::App& program);

/// Each adds its words and options to the program and returns what runs it.
Command add_run_command(CLI::App& program);
Command add_theory_command(CLI::App& program);
Command add_compare_command(CLI::App& program);
Command add_diagnose_command(CLI::App& program);
Command add_hide_command(CLI::App& program);
Command add_add_command(CLI::App& program);
Command add_ladder_command(CLI::App& program);
Command add_export_command(CLI::App& program);
Command add_report_command(CLI::App& program);
Command add_effects_command(CLI::App& program);
Command add_import_command(CLI::App& program);
Command add_schema_command(CLI::App& program);
Command add_crosscheck_command(CLI::App& program);
Command add_check_command(CLI::App& program);
Command add_sweep_command(CLI::App& program);
Command add_merge_command(CLI::App& program);
Command add_fit_command(CLI::App& program);
Command add_bounce_command(CLI::App& program);
Command add_plot_command(CLI::App& program);
/// `paper` and `blind-suite`: hands its words to shakedown-studies, which lies beside this program.
Command add_study_command(CLI::App& program, const char* name, const char* description);

}  // namespace shakedown
