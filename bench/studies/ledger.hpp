// SPDX-License-Identifier: MIT
// Keeps which seeds were drawn, answered and opened, by which program: a figure counts as unseen only where
// nobody had opened the seed before it was answered. The ledger is a table (CSV) that the studies write
// themselves.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace shakedown {

/// One suite. Times: UTC, "2026-11-23T19:20:31Z"; empty: not yet.
struct LedgerLine {
  std::string study;
  std::uint64_t seed = 0;
  std::string program, drawn, answered, opened;
};

/// A suite in the ledger; the time at which it was drawn tells two suites of one seed apart.
struct LedgerKey {
  std::string study;
  std::uint64_t seed = 0;
  std::string drawn;
};

class SeedLedger {
 public:
  /// Reads what is there; throws InputError for what is no ledger. An empty path keeps nothing.
  explicit SeedLedger(std::filesystem::path file);

  /// Adds a suite that is drawn now and writes the file.
  LedgerKey begin(const std::string& study, std::uint64_t seed, const std::string& program);
  /// Note that all its cases are answered, and that its answers are opened; the first time counts. They write
  /// the file. A suite that the ledger does not know is added.
  void answered(const LedgerKey& key);
  void opened(const LedgerKey& key);
  /// Tells whether another suite of this study and seed had been opened before this one was answered.
  bool seen(const LedgerKey& key) const;

 private:
  /// Returns the line of this key, which is added where there is none.
  LedgerLine& line(const LedgerKey& key);
  /// Writes the file, if there is one. Throws FileError.
  void write() const;

  std::filesystem::path file_;
  std::vector<LedgerLine> lines_;
};

}  // namespace shakedown
