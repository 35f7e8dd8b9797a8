// SPDX-License-Identifier: MIT
#include "camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "moved_in_time.hpp"

namespace shakedown {

namespace {

struct Place {
  double box, centre;
};

/// Returns the place (m) at which lens and tilt show x.
double through_glass(const Camera& camera, double x) {
  const double relative = x / camera_lens_reach;
  return x * (1 + camera.tilt * relative + camera.lens * relative * relative);
}

/// Returns x from the place at which lens and tilt show it, by Newton's method: from the recorded position it
/// converges to rounding in five rounds for any glass that does not fold.
double before_glass(const Camera& camera, double seen) {
  double x = seen;
  if (camera.lens == 0 && camera.tilt == 0) return x;
  for (int round = 0; round < 20; ++round) {
    const double relative = x / camera_lens_reach;
    const double step = (through_glass(camera, x) - seen) /
                        (1 + 2 * camera.tilt * relative + 3 * camera.lens * relative * relative);
    x -= step;
    if (std::abs(step) < 1e-17) break;
  }
  return x;
}

/// Returns the share that the camera shows of the distance from the middle of the box to the grains' centre.
double share_seen(const Camera& camera, double box) {
  const double share = 1 - camera.centre_bias;
  return camera.arc_length > 0 ? share * std::cos(1.5 * box / camera.arc_length) : share;
}

bool needs_box(const Camera& camera) { return camera.centre_bias != 0 || camera.arc_length > 0; }

/// Does to one frame all that the camera does but to its time.
Place in_picture(const Camera& camera, double time, Place at) {
  double centre = at.centre;  // which is all where the box is lost and the camera needs it not
  if (std::isfinite(at.box) || needs_box(camera))
    centre = at.box + share_seen(camera, at.box) * (at.centre - at.box);
  const double shift = camera.drift * time + camera.origin;
  return {(1 + camera.scale) * through_glass(camera, at.box) + shift,
          (1 + camera.scale) * through_glass(camera, (1 + camera.depth) * centre) + shift};
}

Place out_of_picture(const Camera& camera, double time, Place seen) {
  const double shift = camera.drift * time + camera.origin;
  const double box = before_glass(camera, (seen.box - shift) / (1 + camera.scale));
  const double centre = before_glass(camera, (seen.centre - shift) / (1 + camera.scale)) / (1 + camera.depth);
  if (!std::isfinite(box) && !needs_box(camera)) return {box, centre};
  return {box, box + (centre - box) / share_seen(camera, box)};
}

double centre_at(const Recording& recording, std::size_t i) {
  return recording.x_com.empty() ? std::numeric_limits<double>::quiet_NaN() : recording.x_com[i];
}

enum class Way { forth, back };

/// Returns each position as it is when its row of the picture is read, or the inverse. `time` is the
/// camera's.
std::vector<double> read_by_rows(double shutter, const std::vector<double>& time,
                                 const std::vector<double>& position, Way way) {
  if (shutter == 0) return position;
  const double delay = shutter / camera_track;
  const LocalCubics cubics(time, position, std::abs(delay) * camera_track / 2);
  const auto shift = [delay](double x) { return delay * x; };
  return way == Way::forth ? cubics.later(position, shift) : cubics.earlier(position, shift);
}

}  // namespace

Recording recorded_by(const Camera& camera, const Trajectory& trajectory) {
  return seen_through(camera, {trajectory.time, trajectory.x_box, trajectory.x_com});
}

Recording seen_through(const Camera& camera, const Recording& recording) {
  Recording seen{recording.time, read_by_rows(camera.shutter, recording.time, recording.x_box, Way::forth),
                 read_by_rows(camera.shutter, recording.time, recording.x_com, Way::forth)};
  for (std::size_t i = 0; i < seen.time.size(); ++i) {
    const Place place = in_picture(camera, recording.time[i], {seen.x_box[i], centre_at(seen, i)});
    seen.x_box[i] = place.box;
    if (!seen.x_com.empty()) seen.x_com[i] = place.centre;
    seen.time[i] += camera.time_offset;
  }
  return seen;
}

Recording undone(const Camera& camera, const Recording& recording) {
  Recording truth = recording;
  for (std::size_t i = 0; i < truth.time.size(); ++i) {
    truth.time[i] -= camera.time_offset;
    const Place place = out_of_picture(camera, truth.time[i], {recording.x_box[i], centre_at(recording, i)});
    truth.x_box[i] = place.box;
    if (!truth.x_com.empty()) truth.x_com[i] = place.centre;
  }
  truth.x_box = read_by_rows(camera.shutter, truth.time, truth.x_box, Way::back);
  truth.x_com = read_by_rows(camera.shutter, truth.time, truth.x_com, Way::back);
  return truth;
}

std::optional<CameraParameter> camera_parameter_of(const EffectRecord& record) {
  if (record.camera.field == nullptr) return std::nullopt;
  const Parameter& first = record.parameters.front();
  const std::vector<SearchedStrength>& strengths = record.search.strengths;
  return CameraParameter{std::string(record.name) + "." + std::string(first.name), first.typical,
                         record.camera.field, record.camera.optical,
                         !strengths.empty() && strengths.front().inverse};
}

std::vector<CameraParameter> camera_parameters(KnownEffects known) {
  std::vector<CameraParameter> list;
  for (const EffectRecord* record : known)
    if (std::optional<CameraParameter> parameter = camera_parameter_of(*record))
      list.push_back(std::move(*parameter));
  return list;
}

std::optional<CameraParameter> find_camera_parameter(KnownEffects known, std::string_view path) {
  const EffectRecord* record = known.find(effect_of(path));
  std::optional<CameraParameter> parameter;
  if (record != nullptr) parameter = camera_parameter_of(*record);
  return parameter && parameter->path == path ? parameter : std::nullopt;
}

namespace {

using Change = double (*)(double time, double box, double own, double velocity);

struct Changes {
  double Camera::*field;
  Change box, centre;  ///< own: the thing's own position; velocity: its own, m/s
  bool needs_velocity = false;
};

constexpr Change nothing = [](double, double, double, double) { return 0.0; };
constexpr Change same = [](double, double, double own, double) { return own; };
constexpr Change distortion = [](double, double, double own, double) {
  return own * own * own / (camera_lens_reach * camera_lens_reach);
};
constexpr Change to_one_side = [](double, double, double own, double) {
  return own * own / camera_lens_reach;
};
constexpr Change one = [](double, double, double, double) { return 1.0; };
constexpr Change elapsed = [](double time, double, double, double) { return time; };
constexpr Change backwards = [](double, double, double, double velocity) { return -velocity; };
constexpr Change along_rows = [](double, double, double own, double velocity) {
  return velocity * own / camera_track;
};
constexpr Change to_the_box = [](double, double box, double own, double) { return box - own; };
constexpr Change foreshortened = [](double, double box, double own, double) {
  return -1.125 * box * box * (own - box);  // cos(1.5 x/l) - 1 = -(1.5 x)^2 / 2 l^2
};

constexpr std::array<Changes, 10> all_changes{{
    {&Camera::scale, same, same},
    {&Camera::lens, distortion, distortion},
    {&Camera::tilt, to_one_side, to_one_side},
    {&Camera::depth, nothing, same},
    {&Camera::shutter, along_rows, along_rows, true},
    {&Camera::origin, one, one},
    {&Camera::drift, elapsed, elapsed},
    {&Camera::time_offset, backwards, backwards, true},
    {&Camera::centre_bias, nothing, to_the_box},
    {&Camera::arc_length, nothing, foreshortened},
}};

}  // namespace

Recording derivative(const Recording& recording, const CameraParameter& parameter) {
  const Changes& changes = *std::find_if(all_changes.begin(), all_changes.end(),
                                         [&](const Changes& one) { return one.field == parameter.field; });
  const auto of = [&](const std::vector<double>& own, Change change) {
    const std::vector<double> velocity =
        changes.needs_velocity ? LocalCubics(recording.time, own, 0).slope(own) : own;
    std::vector<double> values(own.size());
    for (std::size_t i = 0; i < own.size(); ++i)
      values[i] = change(recording.time[i], recording.x_box[i], own[i], velocity[i]);
    return values;
  };
  return {recording.time, of(recording.x_box, changes.box), of(recording.x_com, changes.centre)};
}

}  // namespace shakedown
