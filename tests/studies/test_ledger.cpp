// SPDX-License-Identifier: MIT
#include "ledger.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "errors.hpp"
#include "scratch_folder.hpp"
#include "toml_document.hpp"

using namespace shakedown;

namespace {

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

constexpr const char* opened_once =
    "study,seed,program,drawn,answered,opened\n"
    "blind-suite,9000,a program,2026-11-01T10:00:00Z,2026-11-01T12:00:00Z,2026-11-01T12:01:00Z\n";

}  // namespace

TEST(Ledger, ASecondAnswerToAnOpenedSeedIsSeen) {
  const ScratchFolder folder;
  const auto file = folder / "ledger.csv";
  write(file, opened_once);
  SeedLedger ledger(file);
  const LedgerKey first{"blind-suite", 9000, "2026-11-01T10:00:00Z"};
  EXPECT_FALSE(ledger.seen(first));
  const LedgerKey again = ledger.begin("blind-suite", 9000, "another, later program");
  EXPECT_TRUE(ledger.seen(again));
  EXPECT_FALSE(ledger.seen(ledger.begin("blind-suite", 9001, "it")));
  EXPECT_FALSE(ledger.seen(ledger.begin("ring-downs", 9000, "it")));
  ledger.answered(again);
  ledger.opened(again);
  const SeedLedger read(file);
  EXPECT_TRUE(read.seen(again));
  EXPECT_FALSE(read.seen(first)) << "what was answered before anybody looked stays unseen";
}

TEST(Ledger, KeepsTheFirstTimesAndNothingWithoutAFile) {
  const ScratchFolder folder;
  const auto file = folder / "ledger.csv";
  write(file, opened_once);
  SeedLedger ledger(file);
  const LedgerKey first{"blind-suite", 9000, "2026-11-01T10:00:00Z"};
  ledger.answered(first);
  ledger.opened(first);
  EXPECT_EQ(read_text_file(file), opened_once);
  SeedLedger none{std::filesystem::path()};
  none.opened(none.begin("blind-suite", 1, "it"));
}

TEST(Ledger, RefusesWhatIsNone) {
  const ScratchFolder folder;
  write(folder / "other.csv", "t_s,x_box_m\n0,0\n");
  EXPECT_THROW(SeedLedger(folder / "other.csv"), InputError);
  write(folder / "broken.csv", "study,seed,program,drawn,answered,opened\nblind-suite,nine,,,,\n");
  EXPECT_THROW(SeedLedger(folder / "broken.csv"), InputError);
}

TEST(Ledger, ThatOfTheProjectKnowsWhatWasOpened) {
  const SeedLedger ledger(std::filesystem::path(PROJECT_ROOT) / "bench/studies/ledger.csv");
  for (const std::uint64_t seed : {2026, 4000, 5000, 8000, 8100, 8200, 9000, 9500})
    EXPECT_TRUE(ledger.seen({"blind-suite", seed, "drawn later"})) << seed;
  EXPECT_FALSE(ledger.seen({"blind-suite", 9001, "drawn later"}));
}
