// SPDX-License-Identifier: MIT
// Opens one case of a blind suite: what is hidden beside what the diagnosis says.
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "blind_case.hpp"
#include "trial.hpp"

namespace shakedown {

/// A 95 % interval, in the unit of the parameter's key.
struct FoundInterval {
  double low = 0, high = 0;
};

/// What may be missing, and how probable it is said to be.
struct WeighedAnswer {
  std::vector<std::string> effects;  ///< sorted, without what is no part of an answer; "unknown": of no list
  double probability = 0;
};

struct OfferedForce {
  std::map<std::string, double> constants;
  std::vector<std::string> forms;  ///< the formula and its look-alikes
};

struct OpenedCase {
  std::string name;
  BlindKind kind = BlindKind::null;
  double signal = 0;  ///< to noise, of what is hidden

  // what is hidden
  std::vector<std::string> ids;  ///< Hideable's
  std::vector<std::string> hidden;
  std::string twin;   ///< the other one of a pair of twins
  std::string setup;  ///< the truth, as a setup file
  std::map<std::string, double>
      strengths;  ///< truth of the keys that a diagnosis may fit, SI; of a vector key.x, and its size across
                  ///< the axis as both key.y and key.z: which way across, a square box cannot tell
  std::map<std::string, double> laboratory;  ///< parameters that are not what the diagnosis is told, SI

  // what the diagnosis says
  bool lost = false;  ///< nothing: it broke down
  std::string verdict = "no answer";
  std::vector<std::string> missing;
  std::vector<std::vector<std::string>> answers;  ///< hypotheses that hold 95 %, the named one among them
  std::vector<WeighedAnswer> hypotheses;          ///< each once, the most probable first
  std::set<std::string> look_alikes;  ///< of what is missing, as it says itself, with what is missing
  std::map<std::string, FoundInterval> found;  ///< fitted parameters with an interval
  std::optional<double> p_as_given, p_of_balance;
  std::optional<double> error_over_floor;  ///< of the box, at the last step of the ladder
  double seconds = 0;
  std::vector<OfferedForce> forces;
  std::optional<std::map<std::string, std::string>>
      naive;  ///< what simpler methods answer, if they were asked; empty: they broke down
  std::set<std::string> programs;  ///< that answered

  TrialJudgement judgement;
  std::optional<TrialJudgement>
      after_more;  ///< of a twin with the runs that decide, when it was asked with them

  bool exact() const { return judgement.named; }  ///< it names what is hidden, and nothing else
  /// Tells whether the first effect called missing is of the family of one that is hidden.
  bool first_suspects_family_is_right() const;
  /// Tells whether one of the answers is what is hidden: a tie that is told counts as right here.
  bool among_the_answers() const;
  /// Tells whether the answer is what is hidden, or says of it and at most two others that they cannot be
  /// told apart.
  bool right_or_tied() const;
  /// Returns the probability that the answer gives to what is hidden; 0 where it has none for it.
  double probability_of_truth() const;
  /// Tells whether the most probable answer is what is hidden. False where there is none.
  bool most_probable_is_right() const;
  /// Tells whether something that is not the camera's is called missing.
  bool names_physics() const;
};

/// Opens case `name` of the suite in `folder`, sealed with digest `seal` (FNV-1a). Throws FileError;
/// InputError when the sealed answer is not the one that was sealed, or a file is damaged.
OpenedCase open_case(const std::filesystem::path& folder, const std::string& name, const std::string& seal);

/// Hands the text of one of the suite's answers to `read`. Throws FileError; InputError when it is damaged.
void read_answer_file(const std::filesystem::path& file,
                      const std::function<void(const std::string& text)>& read);

}  // namespace shakedown
