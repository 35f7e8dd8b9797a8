// SPDX-License-Identifier: MIT
#include "swept.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "sweep_report.hpp"

namespace shakedown {

namespace {

std::string duration_in_words(double seconds) {
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

}  // namespace

std::string cost_text(const SweepCost& cost, const JobShare& share, int threads) {
  std::string text = fmt::format("{} points, {} runs", cost.points, cost.jobs);
  if (share.of > 1)
    text += fmt::format("; share {} of {} (from {}): {} runs", share.index + 1, share.of, share.source,
                        cost.here);
  if (cost.done > 0) text += fmt::format("; {} of them done before", cost.done);
  if (cost.done == cost.here) return text + "; nothing is left to do\n";
  return text + fmt::format("; a run takes {:.3g} s, the rest about {} on {} thread{}\n", cost.seconds_a_run,
                            duration_in_words(cost.seconds), threads, threads == 1 ? "" : "s");
}

std::string cost_json(const SweepCost& cost, int threads) {
  return nlohmann::ordered_json{{"schema_version", 1},      {"points", cost.points},
                                {"runs", cost.jobs},        {"runs_of_this_share", cost.here},
                                {"done_before", cost.done}, {"seconds_a_run", cost.seconds_a_run},
                                {"threads", threads},       {"seconds", cost.seconds}}
             .dump(2) +
         "\n";
}

Swept swept(const ResultFile& file) {
  Swept swept{file.identity(), file.rows(), {}, {}, {}};
  swept.points = summaries_of(swept.rows);
  swept.finding = finding_of(swept.identity, swept.points);
  swept.digest = results_digest(swept.rows);
  return swept;
}

std::string swept_text(const Swept& swept, const std::string& name, std::size_t jobs) {
  const std::string missing = swept.rows.size() < jobs
                                  ? fmt::format(" of {} so far (the digest of all comes with the last)", jobs)
                                  : "";
  return fmt::format("{}\n{}: {} runs{}, digest {}\n", swept.finding, name, swept.rows.size(), missing,
                     swept.digest);
}

std::string swept_json(const Swept& swept, bool complete) {
  nlohmann::ordered_json axes = nlohmann::ordered_json::array();
  for (const SweepAxis& axis : swept.identity.axes) axes.push_back({{"key", axis.key}, {"unit", axis.unit}});
  return nlohmann::ordered_json{{"schema_version", 1},
                                {"engine", swept.identity.engine},
                                {"axes", axes},
                                {"runs", swept.rows.size()},
                                {"complete", complete},
                                {"digest", swept.digest},
                                {"finding", swept.finding}}
             .dump(2) +
         "\n";
}

}  // namespace shakedown
