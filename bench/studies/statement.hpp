// SPDX-License-Identifier: MIT
// Judges a statement of the paper by what we find for it.
#pragma once
#include <string>
#include <vector>

#include "statistic.hpp"

namespace shakedown {

enum class Judgement { holds, fails, cannot_tell };
std::string_view name_of(Judgement judgement);  ///< "holds", "fails", "cannot be told"

/// A number with its 95 % interval.
struct Finding {
  std::string what;  ///< "L = 40 mm, hard"
  double value = 0, low = 0, high = 0;
  std::string unit;
};

struct Statement {
  std::string name;   ///< short and fixed
  std::string text;   ///< what the paper says
  std::string paper;  ///< the paper's number
  std::string rule;   ///< when we say that it holds
  std::vector<Finding> findings{};
  Judgement judgement = Judgement::cannot_tell;
  std::string remark{};  ///< where the paper is wrong or imprecise
};

/// Returns the mean over runs with the interval of the mean (Student); without an interval (NaN) from fewer
/// than two.
Finding finding_of(std::string what, const Statistic& statistic, std::string unit, double factor = 1);

/// Returns a number that has no spread.
Finding exact(std::string what, double value, std::string unit);

/// Holds when the whole interval lies within, fails when none of it does. NaN bounds: the value alone is
/// judged.
Judgement judge(const Finding& finding, double low, double high);

/// Fails when one fails, holds when all hold.
Judgement all_of(const std::vector<Judgement>& judgements);

}  // namespace shakedown
