// SPDX-License-Identifier: MIT
// Reads what an experiment file says about the columns of its tables.
#pragma once
#include <string>
#include <vector>

#include "column_reading.hpp"
#include "toml_document.hpp"

namespace shakedown {

/// Reads the [column.*] of the file, or of one run on top of those; `table` may be null. `pixel_size`: m, 0
/// where not said.
RunColumns read_column_tables(const TomlValue* table, const std::string& path, RunColumns columns,
                              double pixel_size, std::vector<Violation>& violations);

}  // namespace shakedown
