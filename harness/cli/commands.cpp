// SPDX-License-Identifier: MIT
#include "command.hpp"

namespace shakedown {

std::vector<Command> add_commands(CLI::App& program) {
  return {
      add_run_command(program),
      add_theory_command(program),
      add_sweep_command(program),
      add_merge_command(program),
      add_import_command(program),
      add_bounce_command(program),
      add_compare_command(program),
      add_fit_command(program),
      add_study_command(program, "paper", "what of the paper holds, statement by statement"),
      add_diagnose_command(program),
      add_add_command(program),
      add_ladder_command(program),
      add_hide_command(program),
      add_study_command(program, "blind-suite", "the diagnosis on trial: many hidden cases, scored"),
      add_export_command(program),
      add_report_command(program),
      add_plot_command(program),
      add_effects_command(program),
      add_schema_command(program),
      add_crosscheck_command(program),
      add_check_command(program),
  };
}

}  // namespace shakedown
