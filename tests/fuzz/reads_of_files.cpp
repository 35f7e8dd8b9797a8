// SPDX-License-Identifier: MIT
#include <string>

#include "collision_log_file.hpp"
#include "decay_baselines.hpp"
#include "drop_tables.hpp"
#include "effects.hpp"
#include "fnv.hpp"
#include "output_file.hpp"
#include "replay.hpp"
#include "report.hpp"
#include "result_file.hpp"
#include "scratch_folder.hpp"
#include "simulation_journal.hpp"
#include "target_reads.hpp"

namespace shakedown {

namespace {

std::filesystem::path written(std::string_view bytes) {
  static const ScratchFolder folder;
  write_file(folder / "bytes", bytes);
  return folder / "bytes";
}

}  // namespace

void read_as_drops(std::string_view bytes) {
  const DropReading reading;
  (void)gross_outliers(drops_of_table(parse_bounce_table(std::string(bytes), "drops.csv"), reading).drops);
}

/// Most damage is noticed by the sum; what a person edits, sum and all, is refused later or replayed.
void read_as_log(std::string_view bytes) {
  std::string whole(bytes);
  const std::uint64_t sum = fnv1a(whole);
  whole.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  const StoredRun stored = read_collision_log(written(whole), all_effects());
  Replay replay(stored.setup, stored.log);
  constexpr int steps = 2000;
  for (int i = 0; i < steps && replay.step(); ++i) {
  }
  (void)replay.state();
}

void read_as_journal(std::string_view bytes) {
  const std::filesystem::path file = written(bytes);
  std::int64_t kept = 0;
  {
    SimulationJournal journal(file, "fuzz", true);
    journal.keep("one more", {Eigen::VectorXd::Constant(2, 0.5)});
    kept = journal.kept();
  }
  const SimulationJournal again(file, "fuzz", true);
  EXPECT(again.kept() == kept && again.find("one more").has_value());
}

void read_as_results(std::string_view bytes) {
  const ResultFile file(written(bytes));
  const std::vector<ResultRow> rows = file.rows();
  (void)results_digest(rows);
  (void)summary_csv(file.identity(), summaries_of(rows));
}

void read_as_report(std::string_view bytes) {
  const Report report = read_report(written(bytes));
  (void)report_html(report);
  const std::string text = report_json(report);
  EXPECT(report_json(read_report(written(text))) == text);
}

void read_as_baselines(std::string_view bytes) { (void)read_decay_baselines(written(bytes)); }

void read_as_sound(std::string_view bytes) {
  DropReading reading;
  reading.as = "sound";
  (void)gross_outliers(read_drops(written(bytes).string(), reading).drops);
}

}  // namespace shakedown
