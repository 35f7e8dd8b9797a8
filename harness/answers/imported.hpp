// SPDX-License-Identifier: MIT
// Tells what was found in tables that were imported, and what the user must fill in.
#pragma once
#include <string>

#include "import_tables.hpp"

namespace shakedown {

/// Returns it as text for a terminal. `file`: the experiment file that was written.
std::string imported_text(const ImportedTables& imported, const std::string& file);
/// Returns it as JSON text.
std::string imported_json(const ImportedTables& imported, const std::string& file);

}  // namespace shakedown
