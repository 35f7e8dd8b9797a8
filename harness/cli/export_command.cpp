// SPDX-License-Identifier: MIT
// shakedown export: a run as trajectories that other programs open.
#include <fmt/format.h>

#include <memory>

#include "command.hpp"
#include "effects.hpp"
#include "export_run.hpp"
#include "interruption.hpp"
#include "quantity_option.hpp"

namespace shakedown {

namespace {

struct ExportArguments {
  std::string run, format = "xyz", rate, from, to, folder;
};

int export_stored(const ExportArguments& arguments) {
  const ExportFormat format = export_format_named(arguments.format);
  const StoredRun run = read_collision_log(arguments.run, all_effects());
  FrameTimes times;
  times.stop = catch_interruption();
  times.rate = quantity_option("--rate", arguments.rate, "Hz", run.setup.run.sample_rate, "1000");
  times.from = quantity_option("--from", arguments.from, "s", times.from);
  times.to = quantity_option("--to", arguments.to, "s", times.to);
  std::filesystem::path folder = arguments.folder;
  if (folder.empty())
    folder = std::filesystem::is_directory(arguments.run) ? std::filesystem::path(arguments.run) / "export"
                                                          : "export";
  const Exported exported = export_run(run, times, format, folder);
  fmt::print("{} frames of {} grains: open {}\n", exported.frames, run.log.initial.size(),
             exported.open.string());
  return exit_done;
}

}  // namespace

Command add_export_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand(
      "export", "trajectories for OVITO, ASE, ParaView, LAMMPS tools, numpy, from a collision log");
  const auto arguments = std::make_shared<ExportArguments>();
  command.add_option("RUN", arguments->run, "folder of `shakedown run --out DIR --log`, or a collision log")
      ->required();
  command.add_option("--as", arguments->format, "xyz, lammps, vtp, npy or csv")
      ->type_name("FORMAT")
      ->capture_default_str();
  command
      .add_option("--rate", arguments->rate,
                  "frames a second of simulated time, e.g. 10kHz (default: the setup's)")
      ->type_name("RATE");
  command.add_option("--from", arguments->from, "first moment, e.g. 3.2s (default: release)")
      ->type_name("TIME");
  command.add_option("--to", arguments->to, "last moment (default: the end)")->type_name("TIME");
  command.add_option("--out", arguments->folder, "folder to write into (default: RUN/export)")
      ->type_name("DIR");
  return {&command, [arguments] { return export_stored(*arguments); }};
}

}  // namespace shakedown
