// SPDX-License-Identifier: MIT
#include "column_tables.hpp"

#include <array>
#include <cmath>
#include <optional>

#include "experiment_reader.hpp"
#include "table_text.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

using TomlKind = TomlValue::Kind;
using Violations = std::vector<Violation>;

/// A position as people write it beside a column: a length, pixels, or an angle where the column holds one.
class PositionReader {
 public:
  PositionReader(const ExperimentReader& reader, const ColumnChoice& choice, double pixel_size)
      : reader_(&reader), choice_(&choice), pixel_size_(pixel_size) {}

  /// Returns the position, m; nothing when it is absent or wrong (reported).
  std::optional<double> read(std::string_view key) const {
    const TomlValue* value = reader_->find(key);
    if (!value) return std::nullopt;
    if (value->kind == TomlKind::text && value->text.ends_with("px") && pixel_size_ > 0)
      return pixels(*value, key);
    if (choice_->per_radian > 0 || is_unit_of_angle(choice_->unit)) return angle(*value, key);
    return number(*value, key, "mm");
  }

 private:
  std::optional<double> number(const TomlValue& value, std::string_view key, std::string_view unit) const {
    const ValueOrProblem<double> result = number_in(value, unit);
    if (const double* found = std::get_if<double>(&result)) return *found;
    reader_->report(value, key, std::get<Problem>(result).problem, std::get<Problem>(result).remedy);
    return std::nullopt;
  }

  std::optional<double> pixels(const TomlValue& value, std::string_view key) const {
    const std::string_view digits(value.text.data(), value.text.size() - 2);
    if (const std::optional<double> count = cell_number(trimmed(digits), false)) return *count * pixel_size_;
    reader_->report(value, key, "'" + value.text + "' is not a number of pixels",
                    "write it with a decimal point, e.g. \"1920.5 px\"");
    return std::nullopt;
  }

  std::optional<double> angle(const TomlValue& value, std::string_view key) const {
    const bool has_unit =
        value.kind == TomlKind::text && (value.text.ends_with("rad") || value.text.ends_with("deg"));
    if (!has_unit) {
      reader_->report(value, key, "is no angle, where the column holds angles",
                      "write it in rad or deg, e.g. \"3.1416 rad\"");
      return std::nullopt;
    }
    const std::optional<double> radians = number(value, key, "rad");
    return radians ? std::optional(*radians * choice_->per_radian) : std::nullopt;
  }

  const ExperimentReader* reader_;
  const ColumnChoice* choice_;
  double pixel_size_;
};

/// Reads what [column.NAME] says, on top of what a wider table said before.
ColumnChoice column_choice(const TomlValue& table, const std::string& path, ColumnChoice choice,
                           double pixel_size, Violations& violations) {
  const ExperimentReader reader(table, ExperimentTable::column, path, violations);
  choice.place = table.place;
  if (reader.find("from")) choice.from = reader.text("from");
  if (reader.find("unit")) choice.unit = reader.text("unit");
  choice.per_radian = reader.number("per_radian", choice.per_radian);
  const PositionReader position(reader, choice, pixel_size);
  if (const std::optional<double> uncertainty = position.read("uncertainty")) {
    if (*uncertainty < 0)
      reader.report(*reader.find("uncertainty"), "uncertainty", "is negative", "give one standard deviation");
    choice.uncertainty = *uncertainty;
  }
  if (const std::optional<double> origin = position.read("origin")) choice.origin = origin;
  if (reader.find("reversed")) choice.reversed = reader.flag("reversed");
  if (const auto tracks = reader.texts("track"); !tracks.empty()) choice.tracks = tracks;
  if (reader.find("track_from")) choice.track_from = reader.text("track_from");
  reader.report_unknown();
  return choice;
}

/// Reads the column of the box's velocity or acceleration: sets the derivative, and reports an origin, which
/// is of no use there.
ColumnChoice rate_choice(ColumnChoice choice, const TomlEntry& entry, const std::string& path,
                         Violations& violations) {
  choice.derivative = entry.key == "box_velocity" ? 1 : 2;
  if (choice.origin)
    violations.push_back({entry.place, path + "origin",
                          "is of no use here: an integral does not know its middle",
                          "leave it out; a sensor's own offset is taken out by itself"});
  return choice;
}

const std::vector<std::string_view> known_columns{
    "time", "box_position", "box_velocity", "box_acceleration", "grain_centre", "base_position"};

}  // namespace

RunColumns read_column_tables(const TomlValue* table, const std::string& path, RunColumns columns,
                              double pixel_size, Violations& violations) {
  if (!table) return columns;
  for (const TomlEntry& entry : table->entries) {
    const std::string below = path + entry.key + ".";
    const auto choice = [&](const std::optional<ColumnChoice>& wider) {
      return column_choice(entry.value, below, wider.value_or(ColumnChoice{}), pixel_size, violations);
    };
    if (entry.value.kind != TomlKind::table)
      violations.push_back({entry.place, path + entry.key,
                            "is " + std::string(describe(entry.value.kind)) + " where a table is due",
                            "write [column." + entry.key + "] with from = \"header of the column\""});
    else if (entry.key == "time")
      columns.time = choice(columns.time);
    else if (entry.key == "box_position")
      columns.box = choice(columns.box), columns.box.derivative = 0;
    else if (entry.key == "box_velocity" || entry.key == "box_acceleration")
      columns.box = rate_choice(choice(columns.box), entry, below, violations);
    else if (entry.key == "grain_centre")
      columns.com = choice(columns.com);
    else if (entry.key == "base_position")
      columns.base = choice(columns.base);
    else
      violations.push_back({entry.place, path + entry.key, "is not a column that shakedown knows",
                            remedy_for_word(entry.key, known_columns)});
  }
  return columns;
}

}  // namespace shakedown
