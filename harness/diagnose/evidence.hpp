// SPDX-License-Identifier: MIT
// Turns how much each effect would explain into how probable it is: the table of hypotheses of a diagnosis.
// All are pure functions of what was measured.
#pragma once
#include <string>
#include <vector>

namespace shakedown {

/// Tells whether the list has this name.
bool contains(const std::vector<std::string>& list, const std::string& name);

/// Holds a set of effects that may be missing beside what the model has; empty: nothing is.
struct Hypothesis {
  std::vector<std::string> effects;
  double log_odds = 0;     ///< ln of its probability over that of nothing
  double probability = 0;  ///< among the hypotheses of one table
};

/// Says what one effect would explain.
struct StrengthSeen {
  double gain = 0;         ///< fall of chi2
  double value = 0;        ///< strength, from its absence, SI
  double error = 0;        ///< standard error
  double typical = 1;      ///< scale of the prior (Cauchy) of the strength
  bool one_sided = false;  ///< it cannot be negative
  double odds = 1;         ///< how likely beside a usual effect
};

/// Returns ln odds of the effect over nothing: the likelihood's maximum, the share of the prior that it
/// leaves (Laplace), and the prior of one effect among `candidates`. Input that is not finite, or has a sign
/// that it cannot have, gives -infinity.
double log_odds_of(const StrengthSeen& seen, double candidates);

/// Returns ln odds of an effect of which nothing was looked at: the prior of one among `candidates`, `odds`
/// times as likely as a usual one.
double prior_log_odds(double odds, double candidates);

/// Fills in the probabilities and sorts, most probable first.
void weigh(std::vector<Hypothesis>& table);

/// Stands in a hypothesis for physics that no list has.
constexpr const char* unlisted_effect = "unknown";

/// Returns the probability that something in no list is missing from a model of this p-value: prior
/// rules::something_else, and the most that a p-value can say against a model (Sellke, Bayarri and Berger
/// 2001, Am. Stat. 55: -e p ln p). A p-value that is no number leaves the prior.
double probability_of_something_else(double p_value);

/// Returns the table with so much probability given to something in no list, the rest kept in proportion;
/// `beside`: effects that stay missing together with it.
std::vector<Hypothesis> with_something_else(std::vector<Hypothesis> table, double probability,
                                            std::vector<std::string> beside = {});

/// Names effects that there was no time for.
struct LeftOutEffects {
  std::vector<std::string> not_looked_at;  ///< they stand in the table at their prior
  std::vector<std::string> not_fitted;     ///< they stand in it with what their signature says
  /// Effects that were looked at beside less than was found in the end, `found`: sets of all that was found
  /// and one of these stand in the table at their prior.
  std::vector<std::string> not_beside{}, found{};
};

/// Returns the same, where some effects were left out. A p-value is of a model without them. It speaks for
/// what was not looked at as it does for something in no list, so that hypotheses with one of these are
/// raised by as much. It says nothing against a hypothesis with an effect that was weighed and not fitted:
/// beside that, something in no list is as probable as before.
std::vector<Hypothesis> with_something_else_or(const LeftOutEffects& left_out, std::vector<Hypothesis> table,
                                               double probability, std::vector<std::string> beside = {});

/// Returns the first hypotheses that together hold rules::answer_set; `table` is weighed.
std::vector<Hypothesis> answer_set(const std::vector<Hypothesis>& table);

/// Joins each hypothesis of one table with each of an independent one; equal sets become one.
std::vector<Hypothesis> combined(const std::vector<Hypothesis>& a, const std::vector<Hypothesis>& b);

/// Returns the table after an effect of it was taken back, because a model with the others does not need it:
/// each set with it gives its probability to the set without it but for what `log_odds` of the effect beside
/// the others leave; equal sets become one.
std::vector<Hypothesis> taken_back(const std::vector<Hypothesis>& table, const std::string& effect,
                                   double log_odds);

/// Returns the probability that anything is missing; `table` is weighed.
double probability_of_something(const std::vector<Hypothesis>& table);

/// Returns the effects that stand in some hypothesis of the set and not in the first: it may be they besides
/// or instead.
std::vector<std::string> ties_of(const std::vector<Hypothesis>& set);

/// Says in which ways the hypotheses with one of these effects have what is `found`.
struct TieKind {
  bool beside = false;   ///< all of it
  bool instead = false;  ///< a part of it at most
};
/// Returns this for the hypotheses of `set` that have one of `ties`.
TieKind kind_of(const std::vector<std::string>& ties, const std::vector<std::string>& found,
                const std::vector<Hypothesis>& set);

}  // namespace shakedown
