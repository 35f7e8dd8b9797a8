// SPDX-License-Identifier: MIT
// One table holds the keys of an experiment file: reading, messages, JSON schema and reference come from it.
#pragma once
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace shakedown {

constexpr double highest_frame_rate = 1e9;  ///< Hz, above that of any camera

/// The tables of an experiment file whose keys are fixed; those of [known] are in known_value.hpp.
enum class ExperimentTable { file, camera, column, run };

enum class ExperimentKind {
  text,
  texts,     ///< one text or number, or a list of them
  quantity,  ///< a number with the key's unit
  position,  ///< a length, or a number with the unit of the column: "px", "rad", "deg"
  flag,
  choice,  ///< one of `choices`
  table,   ///< keys of its own
  tables,  ///< a list of those
};

struct ExperimentKey {
  ExperimentTable table;
  std::string_view name;  ///< "frame_rate"
  ExperimentKind kind;
  std::string_view unit;  ///< of a quantity, in which people write it; else empty
  double low =
      -std::numeric_limits<double>::infinity();  ///< bounds of a quantity, SI; `low` itself is excluded
  double high = std::numeric_limits<double>::infinity();
  std::string_view example;   ///< as it stands in a file
  std::string_view sentence;  ///< what it is, and what holds without it
  std::vector<std::string_view> choices{};
};

/// Returns every key, table by table.
std::span<const ExperimentKey> experiment_keys();

/// Returns the names of the keys of one table.
std::vector<std::string_view> names_of_keys(ExperimentTable table);

/// Returns the key of this name, which must be there (EXPECT).
const ExperimentKey& experiment_key(ExperimentTable table, std::string_view name);

/// Returns how a table is written: "", "[camera]", "[column.NAME]", "[[run]]".
std::string_view written_name(ExperimentTable table);

}  // namespace shakedown
