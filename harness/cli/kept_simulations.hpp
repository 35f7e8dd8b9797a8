// SPDX-License-Identifier: MIT
// Lets work that was interrupted go on with the simulations that it has made.
#pragma once
#include <memory>
#include <string>

#include "experiment.hpp"
#include "output_file.hpp"
#include "simulation_journal.hpp"

namespace shakedown {

/// Opens the journal of `work` ("diagnosis") on this experiment, in its folder; nothing without a folder to
/// keep it in. One that is there and not to be resumed is set aside, and that is said. Throws InputError for
/// --resume without a folder or with a journal of something else, FileError.
std::unique_ptr<SimulationJournal> journal_in(const OutputFolder* folder, const std::string& work,
                                              const Experiment& experiment, bool resume);

/// Returns what an interrupted user reads. `journal` may be null.
std::string what_is_kept(const SimulationJournal* journal);

}  // namespace shakedown
