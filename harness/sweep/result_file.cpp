// SPDX-License-Identifier: MIT
#include "result_file.hpp"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <sstream>

#include "errors.hpp"
#include "fnv.hpp"
#include "kept_files.hpp"
#include "quantity.hpp"
#include "run_numbers.hpp"
#include "series_file.hpp"
#include "sql.hpp"
#include "statistic.hpp"

namespace shakedown {

namespace {

constexpr const char* schema_version = "2";

[[noreturn]] void refuse(const std::filesystem::path& file, std::string problem, std::string remedy) {
  throw InputError({{{file.string(), 0, 0}, "", std::move(problem), std::move(remedy)}});
}

[[noreturn]] void refuse_damaged(const std::filesystem::path& file) {
  throw FileError(
      file.string() +
      ": is damaged (what it holds is not what was written); take a copy of it, or sweep again into "
      "another file");
}

std::string column_name(std::string_view name) { return "\"" + std::string(name) + "\""; }

/// Returns the statements that make the tables of a new file. Each axis and each number is a column, so that
/// people can query them.
std::string tables_for(const SweepIdentity& identity) {
  std::string varied, numbers;
  for (const SweepAxis& axis : identity.axes) varied += ", " + column_name(axis.column()) + " REAL";
  for (const RunNumber& number : run_numbers()) numbers += ", " + column_name(number.name) + " REAL";
  numbers += ", record TEXT";
  return "CREATE TABLE IF NOT EXISTS about(name TEXT PRIMARY KEY, value TEXT);"
         "CREATE TABLE IF NOT EXISTS sessions(program TEXT, started TEXT DEFAULT CURRENT_TIMESTAMP);"
         "CREATE TABLE IF NOT EXISTS runs(point TEXT, run INTEGER" +
         varied + ", failure TEXT, engine_seconds REAL" + numbers +
         ", PRIMARY KEY(point, run)) WITHOUT ROWID;";
}

std::string axes_text(const std::vector<SweepAxis>& axes) {
  std::string text;
  for (const SweepAxis& axis : axes) text += axis.key + "\t" + axis.unit + "\n";
  return text;
}

std::vector<SweepAxis> axes_of(const std::string& text) {
  std::vector<SweepAxis> axes;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    axes.push_back({line.substr(0, line.find('\t')), line.substr(line.find('\t') + 1), {}});
  return axes;
}

std::map<std::string, std::string> about(const Database& database) {
  std::map<std::string, std::string> found;
  SqlStatement tables(database, "SELECT 1 FROM sqlite_master WHERE name = 'about'");
  if (!tables.step()) return found;
  SqlStatement lines(database, "SELECT name, value FROM about");
  while (lines.step()) found[lines.text(0)] = lines.text(1);
  return found;
}

std::map<std::string, std::string> about(const SweepIdentity& identity) {
  return {{"schema_version", schema_version},
          {"engine", identity.engine},
          {"base_digest", identity.base_digest},
          {"base_setup", identity.base_setup},
          {"axes", axes_text(identity.axes)}};
}

/// Returns what two sweeps differ in, or nothing.
std::string difference(std::map<std::string, std::string> a, std::map<std::string, std::string> b) {
  if (a["schema_version"] != b["schema_version"]) return "was written by another version of this program";
  if (a["engine"] != b["engine"])
    return fmt::format("holds results of engine {}, not {}", a["engine"], b["engine"]);
  if (a["axes"] != b["axes"]) return "holds a sweep over other keys";
  if (a["base_digest"] != b["base_digest"]) return "holds a sweep of another setup";
  return "";
}

/// Returns the journal that SQLite shall keep. A write-ahead log costs no wait for the disk after each run,
/// but needs memory shared by all writers and so one machine; on file systems that may be shared by several
/// the rollback journal works wherever locks do. With both a killed program loses nothing.
const char* journal_for(const std::filesystem::path& file) {
  // ext, xfs, btrfs, tmpfs, overlay, zfs, f2fs
  constexpr std::array<long, 7> local{0xEF53,     0x58465342, 0x9123683E, 0x01021994,
                                      0x794c7630, 0x2fc12fc1, 0xF2F52010};
  struct statfs found {};
  const bool is_local = ::statfs(file.c_str(), &found) == 0 &&
                        std::find(local.begin(), local.end(), static_cast<long>(found.f_type)) != local.end();
  return is_local ? "WAL" : "TRUNCATE";
}

/// Lets one process after another open the file: of several that make it at once SQLite refuses all but one
/// the change of journal, however long they would wait. Locks the folder, since the file itself carries
/// SQLite's locks; where a file system has no such locks nothing is gained or lost.
class OpeningTurn {
 public:
  explicit OpeningTurn(const std::filesystem::path& file)
      : folder_(::open((file.has_parent_path() ? file.parent_path() : std::filesystem::path(".")).c_str(),
                       O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (folder_ >= 0) (void)::flock(folder_, LOCK_EX);
  }
  ~OpeningTurn() {
    if (folder_ >= 0) ::close(folder_);
  }
  OpeningTurn(const OpeningTurn&) = delete;
  OpeningTurn& operator=(const OpeningTurn&) = delete;

 private:
  int folder_;
};

/// Returns a digest of everything in a row but the time that it took, so that a row that was damaged is not
/// taken for a result.
std::string record_of(const ResultRow& row) {
  std::string text = fmt::format("{} {} {}", row.point, row.run, row.failure);
  for (const std::vector<double>& numbers : {row.varied, row.numbers})
    for (const double number : numbers) text += " " + write_number(number);
  return hexadecimal(fnv1a(text));
}

/// Refuses a file with pages that are missing or of another time, and one with views and triggers, which this
/// program makes none of: they run what somebody else wrote, perhaps without end.
void expect_sound(const Database& database, const std::filesystem::path& file) {
  if (SqlStatement(database, "SELECT 1 FROM sqlite_master WHERE type IN ('view', 'trigger')").step())
    refuse_damaged(file);
  SqlStatement check(database, "PRAGMA quick_check(1)");
  if (!check.step() || check.text(0) != "ok") refuse_damaged(file);
}

/// Returns false where there is no file, or one that a program was stopped in making. Opens it to write, for
/// what a stopped program left half done is to be taken back first.
bool is_begun(const std::filesystem::path& file) {
  return std::filesystem::exists(file) &&
         SqlStatement(Database(file, Database::Access::write), "SELECT 1 FROM sqlite_master").step();
}

int column_count(const Database& database) {
  SqlStatement columns(database, "SELECT count(*) FROM pragma_table_info('runs')");
  columns.step();
  return columns.whole(0);
}

}  // namespace

struct ResultFile::Inside {
  std::filesystem::path file;
  SweepIdentity identity;
  Database database;
  std::mutex mutex;
  std::unique_ptr<SqlStatement> insert;

  Inside(const std::filesystem::path& path, Database::Access access) : file(path), database(path, access) {}
  int first_number() const { return 4 + static_cast<int>(identity.axes.size()); }
  int columns() const { return first_number() + static_cast<int>(run_numbers().size()) + 1; }

  void prepare_insert() {
    std::string places = "?";
    for (int i = 1; i < columns(); ++i) places += ", ?";
    insert = std::make_unique<SqlStatement>(database, "INSERT OR IGNORE INTO runs VALUES(" + places + ")");
  }

  void put(const ResultRow& row) {
    EXPECT(row.varied.size() == identity.axes.size() && row.numbers.size() == run_numbers().size());
    int place = 0;
    insert->bind(place++, row.point);
    insert->bind(place++, row.run);
    for (const double value : row.varied) insert->bind(place++, value);
    insert->bind(place++, row.failure);
    insert->bind(place++, row.engine_seconds);
    for (const double number : row.numbers) insert->bind(place++, number);
    insert->bind(place++, record_of(row));
    insert->run();
  }
};

ResultFile::ResultFile(const std::filesystem::path& file, const SweepIdentity& identity, Opening opening) {
  const OpeningTurn turn(file);
  inside_ = std::make_unique<Inside>(file, Database::Access::write);
  Inside& in = *inside_;
  in.identity = identity;
  in.database.execute(
      fmt::format("PRAGMA journal_mode = {}; PRAGMA synchronous = NORMAL;", journal_for(file)));
  expect_sound(in.database, file);
  Transaction transaction(in.database);
  const std::map<std::string, std::string> held = about(in.database);
  if (!held.empty()) {
    if (const std::string other = difference(held, about(identity)); !other.empty())
      refuse(file, other, "choose another file");
    if (opening == Opening::fresh && SqlStatement(in.database, "SELECT 1 FROM runs").step())
      refuse(file, "holds results already", "go on with --resume, or choose another file");
  }
  in.database.execute(tables_for(identity));
  if (column_count(in.database) != in.columns())
    refuse(file, "has other columns than this version of the program writes", "choose another file");
  for (const auto& [name, value] : about(identity))
    SqlStatement(in.database, "INSERT OR IGNORE INTO about VALUES(?, ?)").bind(0, name).bind(1, value).run();
  transaction.commit();
  in.prepare_insert();
}

ResultFile::ResultFile(const std::filesystem::path& file) {
  keep_unchanged(file);
  if (!std::filesystem::exists(file))
    throw FileError(file.string() + ": is not there; name a file that `shakedown sweep` wrote");
  // a killed writer's journal may have to be rolled back
  inside_ = std::make_unique<Inside>(file, Database::Access::write);
  expect_sound(inside_->database, file);
  std::map<std::string, std::string> held = about(inside_->database);
  if (held["schema_version"] != schema_version)
    refuse(file, "holds no results of a sweep by this version of the program",
           "name a file that `shakedown sweep` wrote");
  inside_->identity = {held["engine"], held["base_digest"], held["base_setup"], axes_of(held["axes"])};
  if (column_count(inside_->database) != inside_->columns())
    refuse(file, "has other columns than this version of the program writes",
           "read it with the version that wrote it");
}

ResultFile::~ResultFile() = default;
ResultFile::ResultFile(ResultFile&&) noexcept = default;

const SweepIdentity& ResultFile::identity() const { return inside_->identity; }

void ResultFile::add(const ResultRow& row) { add(std::span(&row, 1)); }

void ResultFile::add(std::span<const ResultRow> rows) {
  const std::lock_guard lock(inside_->mutex);
  Transaction transaction(inside_->database);
  for (const ResultRow& row : rows) inside_->put(row);
  transaction.commit();
}

std::set<std::pair<std::string, int>> ResultFile::finished() const {
  const std::lock_guard lock(inside_->mutex);
  std::set<std::pair<std::string, int>> found;
  SqlStatement lines(inside_->database, "SELECT point, run FROM runs");
  while (lines.step()) found.emplace(lines.text(0), lines.whole(1));
  return found;
}

std::vector<ResultRow> ResultFile::rows() const {
  const std::lock_guard lock(inside_->mutex);
  std::vector<ResultRow> rows;
  SqlStatement lines(inside_->database, "SELECT * FROM runs ORDER BY point, run");
  while (lines.step()) {
    ResultRow row;
    int place = 0;
    row.point = lines.text(place++);
    row.run = lines.whole(place++);
    for (std::size_t i = 0; i < inside_->identity.axes.size(); ++i)
      row.varied.push_back(lines.number(place++));
    row.failure = lines.text(place++);
    row.engine_seconds = lines.number(place++);
    while (place + 1 < inside_->columns()) row.numbers.push_back(lines.number(place++));
    if (lines.text(place) != record_of(row)) refuse_damaged(inside_->file);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<std::string> ResultFile::begin_session(const std::string& program) {
  Transaction transaction(inside_->database);
  std::vector<std::string> others;
  {
    SqlStatement lines(inside_->database, "SELECT DISTINCT program FROM sessions WHERE program <> ?");
    lines.bind(0, program);
    while (lines.step()) others.push_back(lines.text(0));
  }
  SqlStatement(inside_->database, "INSERT INTO sessions(program) VALUES(?)").bind(0, program).run();
  transaction.commit();
  return others;
}

std::string results_digest(const std::vector<ResultRow>& rows) {
  std::vector<const ResultRow*> order;
  for (const ResultRow& row : rows) order.push_back(&row);
  std::sort(order.begin(), order.end(), [](const ResultRow* a, const ResultRow* b) {
    return std::tie(a->point, a->run) < std::tie(b->point, b->run);
  });
  std::uint64_t hash = fnv_start;
  const auto add = [&](std::string_view text) { hash = fnv1a(text, hash); };
  for (const ResultRow* row : order) {
    add(fmt::format("{} {} {}", row->point, row->run, row->failure.empty() ? "done" : "failed"));
    for (const double number : row->numbers) add(" " + write_number(number));
    add("\n");
  }
  return hexadecimal(hash);
}

std::vector<PointSummary> summaries_of(const std::vector<ResultRow>& rows) {
  std::map<std::vector<double>, std::vector<const ResultRow*>> points;
  for (const ResultRow& row : rows) points[row.varied].push_back(&row);
  std::vector<PointSummary> summaries;
  for (const auto& [varied, runs] : points) {
    PointSummary point{varied, static_cast<int>(runs.size()), 0, {}, {}};
    for (const ResultRow* run : runs) point.failures += run->failure.empty() ? 0 : 1;
    for (std::size_t n = 0; n < run_numbers().size(); ++n) {
      std::vector<double> values;
      for (const ResultRow* run : runs) values.push_back(run->numbers[n]);
      const Statistic statistic = statistic_of(values);
      point.mean.push_back(statistic.mean);
      point.sd.push_back(statistic.sd);
    }
    summaries.push_back(std::move(point));
  }
  return summaries;
}

std::string summary_csv(const SweepIdentity& identity, const std::vector<PointSummary>& points) {
  std::string text;
  for (const SweepAxis& axis : identity.axes) text += axis.column() + ",";
  text += "runs,failures";
  for (const RunNumber& number : run_numbers()) text += fmt::format(",{0},{0}_sd", number.name);
  text += "\n";
  for (const PointSummary& point : points) {
    std::vector<double> line = point.varied;
    line.insert(line.end(), {static_cast<double>(point.runs), static_cast<double>(point.failures)});
    for (std::size_t n = 0; n < point.mean.size(); ++n) line.insert(line.end(), {point.mean[n], point.sd[n]});
    text += csv_line(line);
  }
  return text;
}

ResultFile merge_results(const std::filesystem::path& into, const std::vector<std::filesystem::path>& files) {
  EXPECT(!files.empty());
  std::map<std::pair<std::string, int>, std::pair<ResultRow, std::filesystem::path>> all;
  std::map<std::string, std::string> common;
  SweepIdentity identity;
  const auto same = [](const ResultRow& a, const ResultRow& b) {
    return results_digest({a}) == results_digest({b});
  };
  const auto take = [&](const std::filesystem::path& file) {
    const ResultFile part(file);
    if (common.empty()) common = about(part.identity()), identity = part.identity();
    if (const std::string other = difference(about(part.identity()), common); !other.empty())
      refuse(file, other, "merge files of one sweep");
    for (const ResultRow& row : part.rows()) {
      const std::pair key(row.point, row.run);
      const auto [held, fresh] = all.try_emplace(key, row, file);
      if (!fresh && !same(held->second.first, row))
        refuse(
            file,
            fmt::format(
                "run {} of point {} differs from that in {} (another build of the program gives other chaos)",
                key.second, key.first, held->second.second.string()),
            "leave one of the files out");
    }
  };
  for (const std::filesystem::path& file : files) take(file);
  if (is_begun(into)) take(into);
  ResultFile merged(into, identity, ResultFile::Opening::merge);
  std::vector<ResultRow> rows;
  for (auto& [key, held] : all) rows.push_back(std::move(held.first));
  merged.add(rows);
  return merged;
}

}  // namespace shakedown
