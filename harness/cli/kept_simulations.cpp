// SPDX-License-Identifier: MIT
#include "kept_simulations.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "errors.hpp"
#include "experiment_file.hpp"
#include "provenance.hpp"

namespace shakedown {

std::unique_ptr<SimulationJournal> journal_in(const OutputFolder* folder, const std::string& work,
                                              const Experiment& experiment, bool resume) {
  if (folder == nullptr) {
    if (resume)
      throw InputError({{{"--resume", 0, 0},
                         "",
                         "needs the folder of the " + work + " that was interrupted",
                         "name it with --out DIR"}});
    return nullptr;
  }
  const std::filesystem::path file = folder->path() / "simulations.journal";
  if (!resume && std::filesystem::exists(file))
    fmt::print(
        stderr,
        "{} is of a {} that was interrupted; kept as {}.old, and all is simulated anew (--resume would "
        "have gone on)\n",
        file.string(), work, file.filename().string());
  return std::make_unique<SimulationJournal>(
      file, version_line() + ", " + work + " of experiment " + digest(experiment), resume);
}

std::string what_is_kept(const SimulationJournal* journal) {
  return journal ? fmt::format("{} simulations are kept in {}; --resume goes on", journal->kept(),
                               journal->file().string())
                 : "nothing was kept; with --out DIR simulations are, and --resume goes on";
}

}  // namespace shakedown
