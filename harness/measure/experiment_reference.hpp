// SPDX-License-Identifier: MIT
// Describes the experiment file for people and for editors, from the tables of keys that read it.
#pragma once
#include <string>

namespace shakedown {

/// Returns the JSON Schema (draft 2020-12) of an experiment file, with a line end.
std::string experiment_schema();

/// Returns every key with its unit, example and meaning, and the conventions, in Markdown.
std::string experiment_keys_markdown();

}  // namespace shakedown
