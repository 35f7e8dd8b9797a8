// SPDX-License-Identifier: MIT
// Writes positions, measured or made up, as a table.
#pragma once
#include <filesystem>

#include "experiment.hpp"

namespace shakedown {

/// Writes t_s,x_box_m,x_com_m (the last only where measured): time to 0.1 ms, positions to 1 um; missing
/// positions are blank. Throws FileError.
void write_measured_run(const std::filesystem::path& file, const MeasuredRun& run);

/// Writes an experiment file for tables that write_measured_run has written, one a run under its name +
/// ".csv", with declared uncertainties and each run's own keys. Throws FileError.
void write_experiment(const std::filesystem::path& file, const Experiment& experiment);

}  // namespace shakedown
