// SPDX-License-Identifier: MIT
// Puts diagnoses on trial by the hundred: cases are drawn, their answers written and closed, each case
// diagnosed without them, and only then are the answers opened and scored. A folder holds it all, so that an
// interrupted suite goes on where it stopped:
//   plan.json              what was asked for, and a digest of every sealed answer
//   strengths.json         signal to noise against strength of everything that can be hidden
//   sealed/case_0001.json  what is hidden
//   answers/case_0001.json what the diagnosis says, and which program's it is; of twins also
//                          case_0001_more.json, with the runs that decide
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "blind_case.hpp"
#include "share.hpp"

namespace shakedown {

struct BlindSuiteOptions {
  BlindCounts counts = full_counts;
  JobShare share{};    ///< which cases this process answers; the first of several draws, the others wait
  bool small = false;  ///< two short runs a case, strong signals
  std::vector<double> signals;  ///< signal to noise of what is hidden; empty: as designed
  std::string variant;          ///< a worse experiment, one of variant_names; empty: as designed
  std::uint64_t seed = 1;
  bool baselines = false;      ///< asks simpler methods as well (naive_answers.hpp), of singles and nulls
  std::string fault = "none";  ///< put into the diagnosis (faulty_parts.hpp)
  bool resume = false;         ///< go on in a folder that has a plan
  std::filesystem::path strengths;  ///< a table of an earlier suite instead of measuring one
  std::filesystem::path ledger;     ///< ledger.hpp; empty: none is kept
  std::function<void(const std::string& line)> told;  ///< of each thing done; may be empty
};

/// Draws, seals and diagnoses what has no answer yet. Several processes that share the folder each answer
/// their share; to them the folder's suite is what they go on with. Throws InputError for a folder that holds
/// another suite (or one without `resume`, or one whose cases are no longer drawn as they were sealed),
/// FileError, Interrupted (what is done is kept).
void run_blind_suite(const std::filesystem::path& folder, const Setup& believed, const TrialTools& tools,
                     const BlindSuiteOptions& options);

/// One line of the table.
struct BlindFigure {
  std::string what;   ///< "false alarms"
  std::string aim;    ///< "at most 3 %"
  std::string found;  ///< "0 of 60 (0 %, 95 %: 0 to 6 %)"
  enum class Verdict { met, missed, not_measured } verdict = Verdict::not_measured;
};

struct BlindScore {
  std::vector<BlindFigure> figures;
  std::vector<std::string> cases;  ///< a line a case: what was hidden, what was answered, right or wrong
  int answered = 0, planned = 0;   ///< of several processes the last one has them all
  bool seen = false;               ///< somebody had opened this seed before it was answered here (ledger.hpp)
  int lost = 0;                    ///< of the answered ones: no diagnosis, wrong in every figure
  std::map<std::string, int> programs;  ///< that answered, and how many cases each
};

/// Opens the answers, which the ledger is told. Throws FileError; InputError when a sealed answer is not what
/// it was when the suite began, or a file of the suite is damaged.
BlindScore score_blind_suite(const std::filesystem::path& folder, const TrialTools& tools,
                             const std::filesystem::path& ledger = {});

/// Tells whether every case that is sealed there has an answer.
bool all_answered(const std::filesystem::path& folder);

/// Return the score as text for a terminal, and as JSON.
std::string blind_score_text(const BlindScore& score);
std::string blind_score_json(const BlindScore& score);

}  // namespace shakedown
