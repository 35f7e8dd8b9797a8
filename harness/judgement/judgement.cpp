// SPDX-License-Identifier: MIT
#include "judgement.hpp"

#include <fmt/format.h>

namespace shakedown {

namespace {

bool is_made(const ModelTest& test) { return test.why_not.empty(); }

/// False for NaN too.
bool is_probability(double p) { return p >= 0 && p <= 1; }

std::string said_of(const ModelTest& test, std::string_view name) {
  if (!is_probability(test.p_value)) return fmt::format("the p-value of the {} could not be computed", name);
  return fmt::format("{} p = {:.2g}", name, test.p_value);
}

std::string times_of(double misfit) {
  return misfit > 0 ? fmt::format(" ({:.2g} times the misfit of the model's own runs)", misfit) : "";
}

void add(std::string& list, const std::string& text) { list += (list.empty() ? "" : ", ") + text; }

}  // namespace

ModelJudgement judgement_of(const ModelTest& features, const ModelTest& balance) {
  std::string against, doubts, in_favour;
  bool complete = true;
  if (is_made(balance)) {
    const std::string said = said_of(balance, "momentum balance");
    if (!is_probability(balance.p_value))
      complete = false, add(doubts, said);
    else
      add(balance.p_value <= balance_rejected ? against : in_favour, said);
  }
  if (is_made(features)) {
    const std::string said = said_of(features, "features");
    if (!is_probability(features.p_value))
      complete = false, add(doubts, said);
    else if (features.p_value > features_rejected)
      add(in_favour, said);
    else if (features.misfit < codes_differ)
      add(doubts, said + times_of(features.misfit) + ", and two codes of one physics differ by as much");
    else
      add(against, said + times_of(features.misfit));
  }
  if (!against.empty()) return {Standing::fails, complete, "rejected: " + against};
  if (!doubts.empty()) return {Standing::undecided, complete, "undecided: " + doubts};
  if (!in_favour.empty()) return {Standing::holds, complete, "holds: " + in_favour};
  return {Standing::undecided, complete,
          "undecided: nothing could be tested (" + features.why_not + "; " + balance.why_not + ")"};
}

std::string_view name_of(Standing standing) {
  switch (standing) {
    case Standing::holds: return "holds";
    case Standing::undecided: return "undecided";
    case Standing::fails: break;
  }
  return "fails";
}

}  // namespace shakedown
