// SPDX-License-Identifier: MIT
#include "frames.hpp"

#include <fmt/format.h>

#include <cmath>

#include "replay.hpp"

namespace shakedown {

namespace {

void check(const FrameTimes& times, const CollisionLog& log) {
  std::vector<Violation> found;
  if (!(times.rate > 0)) found.push_back({{}, "--rate", "must be above zero", "take e.g. --rate 500Hz"});
  if (!(times.from >= 0 && times.from <= log.end_time))
    found.push_back(
        {{},
         "--from",
         fmt::format("{:g} s is not within the run (it ends at {:g} s)", times.from, log.end_time),
         "choose a time within it"});
  if (!(times.to >= times.from)) found.push_back({{}, "--to", "lies before --from", "exchange them"});
  // 5e7 lines of text are about 8 GB.
  constexpr double most_rows = 5e7;
  const double rows = (std::min(times.to, log.end_time) - times.from) * times.rate *
                      std::max(1.0, static_cast<double>(log.initial.size()));
  if (found.empty() && rows > most_rows)
    found.push_back({{},
                     "--rate",
                     fmt::format("gives {:.3g} positions of grains ({:g} are the most)", rows, most_rows),
                     "take fewer frames a second, or a part of the run with --from and --to"});
  if (!found.empty()) throw InputError(std::move(found));
}

/// Moves the replay on; where the log does not fit, FileError begins with the log's name.
void advance(Replay& replay, double time, const std::filesystem::path& file) {
  try {
    replay.advance_to(time);
  } catch (const FileError& error) {
    throw FileError((file.empty() ? "" : file.string() + ": ") + error.what());
  }
}

}  // namespace

std::int64_t FrameTimes::count(const CollisionLog& log) const {
  return 1 + static_cast<std::int64_t>(std::floor((std::min(to, log.end_time) - from) * rate * (1 + 1e-12)));
}

void for_each_frame(const StoredRun& run, const FrameTimes& times,
                    const std::function<void(const Frame&)>& use) {
  check(times, run.log);
  Replay replay(run.setup, run.log);
  const Vec3 half(run.setup.box.length / 2, run.setup.box.width[0] / 2, run.setup.box.width[1] / 2);
  for (std::int64_t k = 0; k < times.count(run.log); ++k) {
    if (times.stop != nullptr && times.stop->load()) throw Interrupted("nothing was kept");
    advance(replay, times.time(k), run.file);
    Frame frame{k, times.time(k), replay.state(), {}, {}};
    const Vec3 centre(frame.state.x_box, 0, 0);
    frame.box_low = centre - half;
    frame.box_high = centre + half;
    use(frame);
  }
}

}  // namespace shakedown
