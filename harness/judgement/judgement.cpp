// SPDX-License-Identifier: MIT
#include "judgement.hpp"

#include <fmt/format.h>

#include <cmath>

namespace shakedown {

namespace {

bool is_made(const ModelTest& test) { return test.why_not.empty(); }

/// Tells whether it lies between 0 and 1; false for NaN too.
bool is_probability(double p) { return p >= 0 && p <= 1; }

std::string said_of(const ModelTest& test, std::string_view name) {
  if (!is_probability(test.p_value)) return fmt::format("the p-value of the {} could not be computed", name);
  return fmt::format("{} p = {:.2g}", name, test.p_value);
}

std::string times_of(double misfit) {
  return misfit > 0 ? fmt::format(" ({:.2g} times the misfit of the model's own runs)", misfit) : "";
}

void add(std::string& list, const std::string& text) { list += (list.empty() ? "" : ", ") + text; }

/// Says what the worst difference is that a model which holds cannot have; empty where there is none.
std::string too_much(const std::vector<Difference>& left) {
  const Difference* worst = nullptr;
  for (const Difference& one : left)
    if (times_floor(one) > most_left && (worst == nullptr || times_floor(one) > times_floor(*worst)))
      worst = &one;
  if (worst != nullptr)
    return fmt::format("{} of the {} remain, {:.2g} times noise and spread", words_of(*worst), worst->of,
                       times_floor(*worst));
  for (const Difference& one : left)
    if (has_risen(one))
      return fmt::format("the error of the {} rose from {:.3g} mm as given to {:.3g} mm", one.of,
                         one.as_given * 1e3, one.error * 1e3);
  return "";
}

}  // namespace

double times_floor(const Difference& difference) { return difference.error / difference.floor; }

bool has_risen(const Difference& d) { return d.error > std::hypot(d.as_given, d.floor); }

std::string words_of(const Difference& d) {
  if (std::isinf(d.error)) return "a motion without bounds, so all";
  std::string words = fmt::format("{:.2g} mm", d.error * 1e3);
  if (d.amplitude > 0) words += fmt::format(" ({:.2g} % of the amplitude)", 100 * d.error / d.amplitude);
  return words + (d.looks_like.empty() ? "" : ", " + d.looks_like + ",");
}

ModelJudgement judgement_of(const ModelTest& features, const ModelTest& balance,
                            const std::vector<Difference>& left) {
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
    else if (features.misfit < features.undecided_below)
      add(doubts, said + times_of(features.misfit) + ", and two codes of one physics differ by as much");
    else
      add(against, said + times_of(features.misfit));
  }
  if (const std::string remains = too_much(left); !remains.empty()) add(against, remains);
  if (!against.empty()) return {Standing::fails, complete, "rejected: " + against};
  if (!is_made(features) && !is_made(balance) && !left.empty() && times_floor(left.front()) >= 0)
    add(in_favour, fmt::format("the {} is left {:.2g} times noise and spread", left.front().of,
                               times_floor(left.front())));
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
