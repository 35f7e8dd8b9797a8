// SPDX-License-Identifier: MIT
#include "column_tables.hpp"

#include <array>
#include <optional>

#include "experiment_reader.hpp"
#include "suggestion.hpp"
#include "table_text.hpp"

namespace shakedown {

namespace {

using Kind = TomlValue::Kind;
using Violations = std::vector<Violation>;
using Reader = ExperimentReader;

std::vector<std::string> track_names(Reader& reader) {
  const TomlValue* value = reader.find("track");
  if (!value) return {};
  const auto name = [](const TomlValue& item) {
    return item.kind == Kind::integer ? std::to_string(item.integer) : item.text;
  };
  std::vector<std::string> names;
  if (value->kind != Kind::array) names.push_back(name(*value));
  for (const TomlValue& item : value->items) names.push_back(name(item));
  return names;
}

/// What [column.NAME] says, on top of what a wider table said before.
ColumnChoice column_choice(const TomlValue& table, const std::string& path, ColumnChoice choice,
                           double pixel_size, Violations& violations) {
  Reader reader(table, path, violations);
  choice.place = table.place;
  if (reader.find("from")) choice.from = reader.text("from");
  if (reader.find("unit")) choice.unit = reader.text("unit");
  const auto length = [&](const char* key, double otherwise) {
    const TomlValue* value = reader.find(key);
    if (!value || value->kind != Kind::text || !value->text.ends_with("px") || !(pixel_size > 0))
      return reader.number(key, "mm", otherwise);
    const std::string_view digits(value->text.data(), value->text.size() - 2);
    if (const std::optional<double> pixels = cell_number(trimmed(digits), false)) return *pixels * pixel_size;
    reader.report(*value, key, "'" + value->text + "' is not a number of pixels",
                  "write it with a decimal point, e.g. \"1920.5 px\"");
    return otherwise;
  };
  choice.uncertainty = length("uncertainty", choice.uncertainty);
  if (choice.uncertainty < 0)
    reader.report(table, "uncertainty", "is negative", "give one standard deviation");
  choice.origin = length("origin", choice.origin);
  if (reader.find("reversed")) choice.reversed = reader.boolean("reversed");
  if (const auto tracks = track_names(reader); !tracks.empty()) choice.tracks = tracks;
  if (reader.find("track_from")) choice.track_from = reader.text("track_from");
  reader.report_unknown();
  return choice;
}

constexpr std::array<std::string_view, 3> column_names_known{"time", "box_position", "grain_centre"};

}  // namespace

RunColumns read_column_tables(const TomlValue* table, const std::string& path, RunColumns columns,
                              double pixel_size, Violations& violations) {
  if (!table) return columns;
  for (const TomlEntry& entry : table->entries) {
    const std::string below = path + entry.key + ".";
    if (entry.value.kind != Kind::table)
      violations.push_back({entry.place, path + entry.key,
                            "is " + std::string(describe(entry.value.kind)) + " where a table is due",
                            "write [column." + entry.key + "] with from = \"header of the column\""});
    else if (entry.key == "time")
      columns.time =
          column_choice(entry.value, below, columns.time.value_or(ColumnChoice{}), pixel_size, violations);
    else if (entry.key == "box_position")
      columns.box = column_choice(entry.value, below, columns.box, pixel_size, violations);
    else if (entry.key == "grain_centre")
      columns.com =
          column_choice(entry.value, below, columns.com.value_or(ColumnChoice{}), pixel_size, violations);
    else {
      const std::string_view near = nearest(entry.key, column_names_known);
      violations.push_back({entry.place, path + entry.key, "is not a column that shakedown knows",
                            (near.empty() ? "" : "did you mean '" + std::string(near) + "'? ") +
                                "known: " + listed(column_names_known)});
    }
  }
  return columns;
}

}  // namespace shakedown
