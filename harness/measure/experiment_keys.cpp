// SPDX-License-Identifier: MIT
#include "experiment_keys.hpp"

#include <algorithm>
#include <array>

#include "expect.hpp"

namespace shakedown {

namespace {

using Where = ExperimentTable;
using Kind = ExperimentKind;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double longest_box = 1000;  // m; nobody swings a longer one, and a typing error ends here
constexpr double largest_pixel = 1;   // m, likewise
constexpr double longest_arm = 1000;  // m a radian

const std::vector<ExperimentKey>& table() {
  static const std::vector<ExperimentKey> keys{
      {Where::file, "title", Kind::text, "", -infinity, infinity, "\"brass balls, July\"",
       "Stands over reports. Without it: the name of the file."},
      {Where::file, "camera", Kind::table, "", -infinity, infinity, "[camera]",
       "What holds of the whole film."},
      {Where::file, "column", Kind::table, "", -infinity, infinity, "[column.box_position]",
       "Which column is what: time, box_position (or box_velocity, box_acceleration), grain_centre, "
       "base_position."},
      {Where::file, "known", Kind::table, "", -infinity, infinity, "[known]",
       "What was weighed and measured, and how well."},
      {Where::file, "run", Kind::tables, "", -infinity, infinity, "[[run]]", "The recordings, one each."},
      {Where::camera, "frame_rate", Kind::quantity, "Hz", 0, highest_frame_rate, "\"500 Hz\"",
       "Frames a second of the motion itself (of a slow-motion film those while filming). Needed where no "
       "column is a clock, or it counts frames; else the clock is used."},
      {Where::camera, "pixel_size", Kind::quantity, "mm", 0, largest_pixel, "\"0.12 mm\"",
       "The length that one pixel shows in the plane of the motion. Needed where positions are in px."},
      {Where::camera,
       "sensor",
       Kind::choice,
       "",
       -infinity,
       infinity,
       "\"encoder\"",
       "What measured the positions; errors of lens, shutter, arc and depth are asked of cameras alone. "
       "Without "
       "it: camera where there are pixels, numbered frames, a frame_rate or a track of grains, else other.",
       {"camera", "encoder", "ranger", "gyro", "other"}},
      {Where::column, "from", Kind::text, "", -infinity, infinity, "\"x_box_mm\"",
       "Header of the column, with or without its unit in brackets. Empty: not measured."},
      {Where::column, "unit", Kind::text, "", -infinity, infinity, "\"mm\"",
       "Unit of the numbers: m, cm, mm, um, px, rad, deg; of the time s, ms, us, frame. Without it: what the "
       "header says in brackets."},
      {Where::column, "origin", Kind::position, "mm", -infinity, infinity, "\"250 mm\"",
       "What the column reads where the spring is relaxed (the box at rest, nothing else pulling); it is "
       "subtracted. Without it: 0 is taken, as not stated."},
      {Where::column, "reversed", Kind::flag, "", -infinity, infinity, "true",
       "The column grows away from the side of the release. Without it: false."},
      {Where::column, "per_radian", Kind::quantity, "mm", 0, longest_arm, "\"100 mm\"",
       "Of angles: the length of the setup that one radian is, e.g. the distance of the box from the pivot."},
      {Where::column, "uncertainty", Kind::position, "mm", -infinity, infinity, "\"0.2 mm\"",
       "Standard deviation of one frame. Without it: found from the frames."},
      {Where::column, "track", Kind::texts, "", -infinity, infinity, "[\"1\", \"2\"]",
       "Of tables with one row a track and frame: the number of the track; of several their mean is taken."},
      {Where::column, "track_from", Kind::text, "", -infinity, infinity, "\"TRACK_ID\"",
       "Header of the column with the numbers of tracks. Without it: TRACK_ID, particle, Track or id."},
      {Where::run, "file", Kind::text, "", -infinity, infinity, "\"L040.csv\"",
       "The table of this run, from the folder of the experiment file. One table may hold several runs."},
      {Where::run, "box_length", Kind::quantity, "mm", 0, longest_box, "\"40 mm\"",
       "Inner length of the box along the motion in this run. Without it: the setup's."},
      {Where::run, "frame_rate", Kind::quantity, "Hz", 0, highest_frame_rate, "\"240 Hz\"",
       "As in [camera], of this run."},
      {Where::run, "release_time", Kind::quantity, "s", -infinity, infinity, "\"0.3 s\"",
       "What the clock of the table shows at the release. Without it: 0."},
      {Where::run,
       "release",
       Kind::choice,
       "",
       -infinity,
       infinity,
       "\"unknown\"",
       "How the recording begins: from rest at release.displacement, or somewhere in the motion with a "
       "position and speed of its own. Without it: unknown for an empty box, else at rest.",
       {"at rest", "unknown"}},
      {Where::run, "initial_grains", Kind::text, "", -infinity, infinity, "\"grains.csv\"",
       "Table id,x,y,z,vx,vy,vz (m, m/s) of the grains at release, from the folder of the experiment file. "
       "They move with the box to where a diagnosis finds it released. Where every velocity is 0 nobody "
       "measured them: each simulation draws its own."},
      {Where::run, "column", Kind::table, "", -infinity, infinity, "column.box_position.from = \"x2\"",
       "Columns of this run alone, on top of those of the file."},
      {Where::run, "known", Kind::table, "", -infinity, infinity, "known.\"box.mass\" = \"450 g +- 1 g\"",
       "What is known of this run alone; goes before what the file says."},
  };
  return keys;
}

}  // namespace

std::span<const ExperimentKey> experiment_keys() { return table(); }

std::vector<std::string_view> names_of_keys(ExperimentTable of) {
  std::vector<std::string_view> names;
  for (const ExperimentKey& key : table())
    if (key.table == of) names.push_back(key.name);
  return names;
}

const ExperimentKey& experiment_key(ExperimentTable of, std::string_view name) {
  const auto found = std::find_if(table().begin(), table().end(), [&](const ExperimentKey& key) {
    return key.table == of && key.name == name;
  });
  EXPECT(found != table().end());
  return *found;
}

std::string_view written_name(ExperimentTable of) {
  constexpr std::array<std::string_view, 4> names{"", "[camera]", "[column.NAME]", "[[run]]"};
  return names[static_cast<std::size_t>(of)];
}

}  // namespace shakedown
