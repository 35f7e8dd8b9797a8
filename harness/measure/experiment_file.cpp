// SPDX-License-Identifier: MIT
#include "experiment_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "base_column.hpp"
#include "column_reading.hpp"
#include "column_tables.hpp"
#include "experiment_keys.hpp"
#include "experiment_reader.hpp"
#include "fnv.hpp"
#include "kept_files.hpp"
#include "prelude.hpp"
#include "quantity.hpp"
#include "table_text.hpp"
#include "toml_document.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

using TomlKind = TomlValue::Kind;
using Violations = std::vector<Violation>;

/// Returns a value of the file as an override of the setup would be written on the command line.
std::string as_written(const TomlValue& value) {
  if (value.kind == TomlKind::text) return toml_string(value.text);
  if (value.kind == TomlKind::integer) return std::to_string(value.integer);
  if (value.kind == TomlKind::boolean) return value.boolean ? "true" : "false";
  if (value.kind == TomlKind::number) return write_number(value.number);
  std::string list;
  for (const TomlValue& item : value.items) list += (list.empty() ? "" : ", ") + as_written(item);
  return "[" + list + "]";
}

void add_overrides(const TomlValue& table, const std::string& path, const std::string& file,
                   MeasuredRun& run) {
  for (const TomlEntry& entry : table.entries) {
    const std::string key = path + entry.key;
    if (entry.value.kind == TomlKind::table) {
      add_overrides(entry.value, key + ".", file, run);
      continue;
    }
    run.overrides.push_back({key, as_written(entry.value), file + ":" + std::to_string(entry.place.line)});
    run.places[key] = entry.place;
  }
}

const Override* find_override(const MeasuredRun& run, std::string_view key) {
  for (const Override& override : run.overrides)
    if (override.key == key) return &override;
  return nullptr;
}

/// Takes the setup's keys of a [[run]] as overrides; a bare word among them is a mistyped key of [[run]] and
/// is reported.
void split_run_keys(const TomlValue& table, const std::string& file, MeasuredRun& run,
                    Violations& violations) {
  TomlValue rest;
  const std::vector<std::string_view> own_keys = names_of_keys(ExperimentTable::run);
  for (const TomlEntry& entry : table.entries) {
    const bool own = std::find(own_keys.begin(), own_keys.end(), entry.key) != own_keys.end();
    if (own && (entry.key != "release" || entry.value.kind != TomlKind::table)) continue;
    if (entry.value.kind == TomlKind::table) {
      rest.entries.push_back(entry);
      continue;
    }
    violations.push_back(
        {entry.place, "run." + entry.key, "is not a key of a run",
         remedy_for_word(entry.key, own_keys) + ", and keys of the setup with a dot, e.g. grains.count"});
  }
  add_overrides(rest, "", file, run);
}

struct Defaults {
  ClockAndScale scale;
  RunColumns columns;
  KnownEffects effects{};  ///< whose numbers [known] may say
};

/// Tells whether the run says that its box holds no grains, so that their centre cannot be missing.
bool is_empty_box(const MeasuredRun& run) {
  const Override* count = find_override(run, "grains.count");
  return count && count->value == "0";
}

void take_length_and_grains(const ExperimentReader& reader, const std::filesystem::path& folder,
                            const std::string& file, MeasuredRun& run) {
  const TomlValue* length = reader.find("box_length");
  run.box_length = reader.number("box_length", std::numeric_limits<double>::quiet_NaN());
  const auto add = [&](const std::string& key, const std::string& value, const SourcePlace& place) {
    run.overrides.push_back({key, value, file + ":" + std::to_string(place.line)});
    run.places[key] = place;
  };
  if (length && std::isfinite(run.box_length))
    add("box.length", toml_string(write_quantity(run.box_length, "m")), length->place);
  if (const TomlValue* grains = reader.find("initial_grains"))
    add("release.initial_grains", toml_string((folder / reader.text("initial_grains")).string()),
        grains->place);
}

/// Takes box.length, as the setup writes it, for box_length.
void take_length_of_setup(const TomlValue& table, MeasuredRun& run, Violations& violations) {
  const TomlValue* box = table.find("box");
  const TomlValue* length = box && box->kind == TomlKind::table ? box->find("length") : nullptr;
  if (!length) return;
  if (std::isfinite(run.box_length)) {
    violations.push_back(
        {length->place, "run.box.length", "is said twice (box_length says it too)", "keep one of the two"});
    return;
  }
  const ValueOrProblem<double> value = number_in(*length, "mm");
  if (const double* metres = std::get_if<double>(&value))
    run.box_length = *metres;  // else the setup complains
}

Start start_of(const ExperimentReader& reader) {
  const std::string word = reader.choice("release");
  return word == "unknown" ? Start::anywhere : word == "at rest" ? Start::from_rest : Start::not_said;
}

void append(Violations& violations, Violations more) {
  violations.insert(violations.end(), std::make_move_iterator(more.begin()),
                    std::make_move_iterator(more.end()));
}

/// Returns the relative error of the clock: what the table calls 1 s is 1 s times 1 plus this.
double clock_error(const MeasuredRun& run, const Experiment& experiment) {
  for (const std::vector<KnownValue>* values : {&run.known, &std::as_const(experiment).known})
    if (const KnownValue* clock = find_known(*values, "clock")) return clock->value;
  return 0;
}

void read_series(const Table& table, RunColumns columns, const ClockAndScale& scale, MeasuredRun& run,
                 Experiment& experiment, Violations& violations) {
  if (columns.com &&
      (columns.com->from.empty() || (is_empty_box(run) && !find_column(table, columns.com->from))))
    columns.com.reset();
  if (is_empty_box(run)) columns.com.reset();
  if (columns.base && columns.base->from.empty()) columns.base.reset();
  RunSeries series = read_columns(table, columns, scale);
  append(violations, std::move(series.violations));
  experiment.notes.insert(experiment.notes.end(), series.notes.begin(), series.notes.end());
  run.time = std::move(series.time);
  const double clock = 1 + clock_error(run, experiment);
  for (double& when : run.time) when *= clock;
  for (auto& [when, place] : series.base) when *= clock;
  if (!series.base.empty()) add_base_motion(series.base, run);
  run.x_box = std::move(series.x_box);
  run.x_com = std::move(series.x_com);
  // Frames before the stated release are no part of the motion that starts there.
  run.release_stated = scale.release_time.has_value();
  if (run.release_stated && run.start != Start::anywhere) run = counted_from(std::move(run), 0);
  if (violations.empty() && run.time.size() < 5)
    violations.push_back({run.place, "run.release_time", "lies after the end of the recording",
                          "give the time that the table's clock shows at the release"});
  run.box_uncertainty = columns.box.uncertainty;
  run.origin_stated = columns.box.origin.has_value();
  if (run.has_com() && columns.com) run.com_uncertainty = columns.com->uncertainty;
  const double rate = typical_rate(run.time);
  run.frame_rate = scale.frame_rate > 0 ? scale.frame_rate : rate;
  if (rate > highest_frame_rate) {
    violations.push_back({run.place, "column.time", "shows more than 1e9 frames a second in " + run.file,
                          "give the clock's unit, e.g. unit = \"ms\""});
  } else if (columns.time && scale.frame_rate > 0 && rate > 0 &&
             std::abs(rate / scale.frame_rate - 1) > 0.02) {
    experiment.notes.push_back(run.file + ": frame_rate says " + write_quantity(scale.frame_rate, "Hz") +
                               ", the table's clock runs at about " +
                               write_quantity(std::round(rate * 100) / 100, "Hz") + ": the clock is used");
    run.frame_rate = rate;
  }
}

void read_run(const TomlValue& table, const std::filesystem::path& folder, const Defaults& defaults,
              Experiment& experiment, Violations& violations) {
  MeasuredRun run;
  const ExperimentReader reader(table, ExperimentTable::run, "run.", violations);
  const std::string file = reader.text("file");
  if (file.empty())
    violations.push_back({table.place, "run.file", "is missing", "name the table of this run"});
  ClockAndScale scale = defaults.scale;
  scale.frame_rate = reader.number("frame_rate", scale.frame_rate);
  if (reader.find("release_time")) scale.release_time = reader.number("release_time", 0);
  run.place = table.place;
  run.start = start_of(reader);
  if (const TomlValue* known = reader.table("known"))
    run.known = read_known(*known, "run.known.", violations, defaults.effects);
  for (const KnownValue& one : run.known)
    if (!may_differ_between_runs(one.key))
      violations.push_back({one.place, "run.known." + one.key, "is the same in all runs of an experiment",
                            "say it once, in [known]"});
  take_length_and_grains(reader, folder, experiment.file, run);
  split_run_keys(table, experiment.file, run, violations);
  take_length_of_setup(table, run, violations);
  const RunColumns columns = read_column_tables(reader.table("column"), "run.column.", defaults.columns,
                                                scale.pixel_size, violations);
  if (columns.box.from.empty())
    violations.push_back(
        {table.place, "column.box_position.from", "is missing",
         "name the header of the box's position (or of its velocity, in column.box_velocity)"});
  if (file.empty() || columns.box.from.empty()) return;
  run.file = (folder / file).string();
  run.name = std::filesystem::path(file).stem().string();
  const auto same =
      std::count_if(experiment.runs.begin(), experiment.runs.end(), [&](const MeasuredRun& other) {
        return std::filesystem::path(other.file).stem().string() == run.name;
      });
  if (same > 0) run.name += "#" + std::to_string(same + 1);
  try {
    read_series(read_table(run.file), columns, scale, run, experiment, violations);
  } catch (const InputError& error) {
    append(violations, error.violations);
  }
  experiment.runs.push_back(std::move(run));
}

}  // namespace

namespace {

/// Returns the sensor as said, else a camera where something tells of one: pixels, a rate of frames, grains
/// that are seen.
Sensor sensor_of(const std::string& said, const Defaults& defaults, const Experiment& experiment) {
  const std::vector<std::string_view>& words = experiment_key(ExperimentTable::camera, "sensor").choices;
  for (std::size_t i = 0; i < words.size(); ++i)
    if (said == words[i]) return static_cast<Sensor>(i);
  const bool films = defaults.scale.frame_rate > 0 || defaults.scale.pixel_size > 0 ||
                     std::any_of(experiment.runs.begin(), experiment.runs.end(),
                                 [](const MeasuredRun& run) { return run.has_com(); });
  return films ? Sensor::camera : Sensor::other;
}

/// Returns the tree of the file; throws InputError with what to do where a table or a setup was given
/// instead.
TomlValue parsed_experiment(std::string_view text, const std::string& name) {
  TomlValue root;
  try {
    root = parse_toml(text, name);
  } catch (const InputError&) {
    std::size_t rows = 0;
    try {
      const Table table = parse_table(text, name);
      rows = table.columns.size() > 1 ? table.rows() : 0;
    } catch (const InputError&) {
      if (text.find('\0') != text.npos) throw;  // a spreadsheet or the like: says how to export it
    }
    if (rows < 3) throw;
    throw InputError({{{name, 1, 1},
                       "",
                       "is a table, not an experiment file",
                       "import it first: shakedown import " + name}});
  }
  if (!root.find("run") && (root.find("box") || root.find("grains") || root.find("spring")))
    throw InputError(
        {{{name, 1, 1},
          "",
          "is a setup, not an experiment file",
          "give the experiment file that lists the measured tables; shakedown import writes one"}});
  return root;
}

}  // namespace

Experiment parse_experiment(std::string_view text, const std::string& name,
                            const std::filesystem::path& folder, KnownEffects effects) {
  const TomlValue root = parsed_experiment(text, name);
  Experiment experiment;
  experiment.file = name;
  Violations violations;
  const ExperimentReader reader(root, ExperimentTable::file, "", violations);
  experiment.title = reader.text("title");
  Defaults defaults;
  defaults.effects = effects;
  const TomlValue* runs = reader.find("run");
  const TomlValue* columns = reader.table("column");
  std::string sensor;
  if (const TomlValue* camera = reader.table("camera")) {
    const ExperimentReader of_camera(*camera, ExperimentTable::camera, "camera.", violations);
    defaults.scale.frame_rate = of_camera.number("frame_rate", 0);
    defaults.scale.pixel_size = of_camera.number("pixel_size", 0);
    sensor = of_camera.choice("sensor");
    of_camera.report_unknown();
  }
  defaults.columns = read_column_tables(columns, "column.", {}, defaults.scale.pixel_size, violations);
  if (const TomlValue* known = reader.table("known"))
    experiment.known = read_known(*known, "known.", violations, effects);
  reader.report_unknown();
  if (!runs || runs->kind != TomlKind::array || runs->items.empty())
    violations.push_back(
        {{name, 0, 0}, "run", "is missing (no run to compare with)", "add [[run]] with file and box_length"});
  else
    for (const TomlValue& run : runs->items) read_run(run, folder, defaults, experiment, violations);
  if (!violations.empty()) throw InputError(std::move(violations));
  experiment.sensor = sensor_of(sensor, defaults, experiment);
  if (experiment.title.empty()) experiment.title = std::filesystem::path(name).stem().string();
  return experiment;
}

Experiment read_experiment(const std::filesystem::path& file, KnownEffects effects) {
  keep_unchanged(file);
  return parse_experiment(read_text_file(file), file.string(), file.parent_path(), effects);
}

std::string digest(const Experiment& experiment) {
  std::uint64_t hash = fnv_start;
  const auto text = [&](const std::string& part) { hash = fnv1a(part + '\n', hash); };
  const auto number = [&](double part) { hash = fnv_step(hash, std::bit_cast<std::uint64_t>(part)); };
  const auto known_values = [&](const std::vector<KnownValue>& known) {
    for (const KnownValue& one : known) text(one.key), number(one.value), number(one.error);
  };
  known_values(experiment.known);
  for (const MeasuredRun& run : experiment.runs) {
    text(run.name);
    known_values(run.known);
    number(static_cast<double>(run.start)), number(run.origin_stated);
    for (const Override& one : run.overrides) text(one.key), text(one.value);
    for (const double part : {run.box_length, run.frame_rate, run.box_uncertainty, run.com_uncertainty})
      number(part);
    for (const std::vector<double>* column : {&run.time, &run.x_box, &run.x_com}) {
      number(static_cast<double>(column->size()));
      for (const double part : *column) number(part);
    }
  }
  return hexadecimal(hash);
}

}  // namespace shakedown
