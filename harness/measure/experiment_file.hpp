// SPDX-License-Identifier: MIT
// The experiment file: which table is which run, which column is what, in which unit. The tables themselves
// stay untouched.
#pragma once
#include <filesystem>
#include <string_view>

#include "experiment.hpp"
#include "known_effects.hpp"

namespace shakedown {

/// Reads an experiment file and its tables. Throws InputError with every violation at once (those of the
/// tables with their line), FileError when a file cannot be read. Paths of tables and initial_grains count
/// from the experiment file's folder.
///
///   title                      text
///   [camera]                   frame_rate "500 Hz", pixel_size "0.12 mm" (where positions are in px)
///   [column.time]              from = header, unit ("s", "ms", "frame"); without it rows are frames
///   [column.box_position]      from, unit ("m", "mm", "px"), uncertainty of one frame; origin (subtracted),
///   reversed = true, [column.grain_centre]      track = "1" or ["1", "2"] (mean) and track_from for tables
///   with one row a track and frame
///   [known]                    "box.mass" = "434 g +- 2 g": what was weighed and measured (known_value.hpp),
///   of `effects` too
///   [[run]]                    file, box_length; frame_rate, release_time (on the table's clock), known,
///   release = "unknown"
///   initial_grains, column.* of this
///                              run alone (from = "": not measured), any key of the setup, e.g. grains.count
///                              = 0
Experiment read_experiment(const std::filesystem::path& file, KnownEffects effects = {});

/// The same from text; tables are looked for in `folder`, `name` stands for the file in messages.
Experiment parse_experiment(std::string_view text, const std::string& name,
                            const std::filesystem::path& folder, KnownEffects effects = {});

/// A short digest of what was measured and in which setups: changes with any number.
std::string digest(const Experiment& experiment);

/// Frames a second by the median interval of these times (s); 0: fewer than two.
double typical_rate(const std::vector<double>& time);

/// True when the first position and speed of the run are its own: it says release = "unknown", or says
/// nothing and its box is empty. `setup` is that of the run.
bool starts_anywhere(const MeasuredRun& run, const Setup& setup);

/// What is known of one run: its own values, and the experiment's where it has none.
std::vector<KnownValue> known_of(const Experiment& experiment, const MeasuredRun& run);

}  // namespace shakedown
