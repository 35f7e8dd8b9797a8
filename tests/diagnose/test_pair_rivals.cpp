// SPDX-License-Identifier: MIT
// Two effects at once, screened and fitted, by hand.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "pair_rivals.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

constexpr double known = 30;  // effects

/// Candidates a, b and c with one knob each, and rivals that were screened with this ln evidence.
struct Screened {
  std::vector<Candidate> candidates;
  std::vector<Rival> rivals;

  explicit Screened(const std::vector<double>& log_evidence, double nothing_gained = 0) {
    for (std::size_t c = 0; c < log_evidence.size(); ++c) {
      candidates.emplace_back();
      candidates.back().effect = std::string(1, static_cast<char>('a' + c));
      Knob knob;
      knob.width = 1, knob.high = 10;
      candidates.back().knobs = {knob};
    }
    for (std::size_t c = 0; c < log_evidence.size(); ++c) {
      Rival rival{&candidates[c], {}};
      rival.screened.candidate = c;
      rival.screened.log_evidence = log_evidence[c];
      rival.screened.weighed = true;
      rival.nothing_gained = nothing_gained;
      rivals.push_back(rival);
    }
  }
};

}  // namespace

TEST(PairRival, IsAskedForWhereItsSignaturesSayMoreThanAnySingleOne) {
  const Screened screened({100, 40, 5});
  const std::vector<PairRival> pairs =
      pairs_beyond(screened.rivals, {{0, 1, 0.5, 2, 200}, {0, 2, 0.5, 1, 101}}, screened.candidates, known);
  ASSERT_EQ(pairs.size(), 1u);  // the second does not pay for its prior
  EXPECT_EQ(pairs[0].effects(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(pairs[0].first.screened.value, 0.5);
  EXPECT_EQ(pairs[0].second.screened.value, 2);
  WITHIN(pairs[0].log_odds, 200 + 2 * prior_log_odds(1, known), 8e-13, 4.3e-14);
  EXPECT_TRUE(is_far_beyond(pairs[0], screened.rivals));  // by 100, where signatures err by 10
}

TEST(PairRival, IsNoneOfTwoLawsOfOneFriction) {
  Screened screened({100, 40});
  screened.rivals[0].screened.look_alikes = {"b"};
  EXPECT_TRUE(pairs_beyond(screened.rivals, {{0, 1, 0.5, 2, 200}}, screened.candidates, known).empty());
}

TEST(PairRival, ThatIsBetterByWhatSignaturesErrWaitsForASingleOne) {
  const Screened screened({1000, 40});
  const std::vector<PairRival> pairs =
      pairs_beyond(screened.rivals, {{0, 1, 0.5, 2, 1080}}, screened.candidates, known);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_FALSE(is_far_beyond(pairs[0], screened.rivals));
}

TEST(PairRival, ThatWasFittedIsWeighedByTheLikelihoodOfBoth) {
  const Screened screened({100, 40}, 500);
  PairRival pair{screened.rivals[0], screened.rivals[1], 300, -200};
  for (Rival* one : {&pair.first, &pair.second}) one->screened.seen = {0, 1, 0.1, 1, true, 1};
  pair.first.log_ratio = 500;
  pair.second.log_ratio = 530;  // of the fit of both
  weigh_pair(pair, known);
  EXPECT_EQ(pair.log_odds, -200);  // it was not fitted
  pair.fitted = true;
  weigh_pair(pair, known);
  StrengthSeen seen = pair.first.screened.seen;
  const double first = log_odds_of(seen, known);
  seen.gain = 2 * 30;
  EXPECT_DOUBLE_EQ(pair.log_odds, first + log_odds_of(seen, known));
}

// Where restitutions imitate both, nothing elsewhere looks better than either about what was believed.
TEST(PairRival, IsWeighedBesideNothingWhereItWasFitted) {
  const Screened screened({100, 40}, 500);
  const std::vector<PairRival> pairs =
      pairs_beyond(screened.rivals, {{0, 1, 0.5, 2, 300}}, screened.candidates, known);
  ASSERT_EQ(pairs.size(), 1u);
  WITHIN(pairs[0].log_odds, 300 - 500 + 2 * prior_log_odds(1, known), 1e-12, 5e-14);
}
