// SPDX-License-Identifier: MIT
#include "export_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "npy_file.hpp"
#include "output_file.hpp"
#include "paraview_files.hpp"
#include "replay.hpp"
#include "text_frames.hpp"

namespace shakedown {

namespace {

template <class Lines>
std::filesystem::path write_text(const StoredRun& run, const FrameTimes& times,
                                 const std::filesystem::path& file, const std::string& header,
                                 Lines&& lines) {
  GrowingFile to(file);
  to.add(header);
  for_each_frame(run, times, [&](const Frame& frame) { to.add(lines(frame)); });
  to.finish();
  return file;
}

/// Writes two files a frame: where not all can be written, or the log ends before, those that were are taken
/// back.
std::filesystem::path write_paraview(const StoredRun& run, const FrameTimes& times,
                                     const OutputFolder& folder) {
  std::vector<PvdEntry> entries;
  std::vector<std::filesystem::path> written;
  const auto write = [&](int part, double time, const std::string& name, const std::string& contents) {
    folder.write(name, contents);
    written.push_back(name);
    entries.push_back({time, part, name});
  };
  try {
    for_each_frame(run, times, [&](const Frame& frame) {
      write(0, frame.time, fmt::format("frames/grains_{:06}.vtp", frame.number), grains_vtp(frame));
      write(1, frame.time, fmt::format("frames/box_{:06}.vtp", frame.number), box_vtp(frame));
    });
    folder.write("motion.pvd", pvd(entries));
    // An earlier export had more frames.
    std::vector<std::filesystem::path> left;
    for (std::size_t frame = entries.size() / 2;; ++frame) {
      const std::array<std::string, 2> two{fmt::format("frames/grains_{:06}.vtp", frame),
                                           fmt::format("frames/box_{:06}.vtp", frame)};
      if (!std::filesystem::exists(folder.path() / two[0]) &&
          !std::filesystem::exists(folder.path() / two[1]))
        break;
      left.insert(left.end(), two.begin(), two.end());
    }
    folder.remove(left);
  } catch (...) {
    folder.remove(written);
    throw;
  }
  return folder.path() / "motion.pvd";
}

void append_flat(std::vector<double>& to, const std::vector<Vec3>& values) {
  for (const Vec3& v : values) to.insert(to.end(), v.begin(), v.end());
}

std::filesystem::path write_arrays(const StoredRun& run, const FrameTimes& times,
                                   const OutputFolder& folder) {
  std::vector<double> time, position, velocity, spin, box;
  const State& initial = run.log.initial;
  for_each_frame(run, times, [&](const Frame& frame) {
    time.push_back(frame.time);
    append_flat(position, frame.state.position);
    append_flat(velocity, frame.state.velocity);
    append_flat(spin, frame.state.spin);
    box.insert(box.end(), {frame.state.x_box, frame.state.v_box});
  });
  const std::size_t frames = time.size(), n = initial.size();
  folder.write("time.npy", npy({frames}, time));
  folder.write("position.npy", npy({frames, n, 3}, position));
  folder.write("velocity.npy", npy({frames, n, 3}, velocity));
  if (!spin.empty()) folder.write("spin.npy", npy({frames, n, 3}, spin));
  folder.write("box.npy", npy({frames, 2}, box));
  folder.write("radius.npy", npy({n}, initial.radius));
  folder.write("mass.npy", npy({n}, initial.mass));
  folder.write("box_size.npy",
               npy({3}, {run.setup.box.length, run.setup.box.width[0], run.setup.box.width[1]}));
  return folder.path();
}

}  // namespace

ExportFormat export_format_named(std::string_view name) {
  const auto found = std::find(export_format_names.begin(), export_format_names.end(), name);
  if (found == export_format_names.end())
    throw InputError({{{},
                       "--as",
                       "there is no format '" + std::string(name) + "'",
                       "take one of xyz, lammps, vtp, npy, csv"}});
  return static_cast<ExportFormat>(found - export_format_names.begin());
}

Exported export_run(const StoredRun& run, const FrameTimes& times, ExportFormat format,
                    const std::filesystem::path& folder) {
  const OutputFolder to(folder, OutputFolder::Use::alone);
  const auto written = [&]() -> std::filesystem::path {
    switch (format) {
      case ExportFormat::xyz: return write_text(run, times, folder / "motion.xyz", "", extended_xyz);
      case ExportFormat::lammps: return write_text(run, times, folder / "motion.lammpstrj", "", lammps_dump);
      case ExportFormat::csv: {
        Replay replay(run.setup, run.log);
        return write_text(run, times, folder / "motion.csv", csv_header(!replay.state().spin.empty()),
                          csv_lines);
      }
      case ExportFormat::vtp: return write_paraview(run, times, to);
      case ExportFormat::npy: return write_arrays(run, times, to);
    }
    EXPECT(false);
    return {};
  };
  return {written(), times.count(run.log)};
}

}  // namespace shakedown
