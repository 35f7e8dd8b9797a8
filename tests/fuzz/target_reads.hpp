// SPDX-License-Identifier: MIT
// The reading of each kind of bytes (targets.hpp). They throw InputError and FileError as a command does.
#pragma once
#include <string_view>

namespace shakedown {

void read_as_setup(std::string_view bytes);       ///< and written, and read again: the same
void read_as_experiment(std::string_view bytes);  ///< its tables are those of corpus/experiment_tables
void read_as_film(std::string_view bytes);        ///< the table of a run, audited
void read_as_table(std::string_view bytes);       ///< and what `import` makes of it
void read_as_drops(std::string_view bytes);
void read_as_formula(std::string_view bytes);
void read_as_grains(std::string_view bytes);
void read_as_log(
    std::string_view bytes);  ///< without its sum, which is put right; and the first of its replay
void read_as_journal(std::string_view bytes);
void read_as_results(std::string_view bytes);  ///< of a sweep (SQLite)
void read_as_report(std::string_view bytes);
void read_as_baselines(std::string_view bytes);
void read_as_sound(std::string_view bytes);
void read_as_curve(std::string_view bytes);  ///< a table of user_force, which its setup then holds
void read_as_words(std::string_view bytes);  ///< quantities, axes of sweeps, --set

}  // namespace shakedown
