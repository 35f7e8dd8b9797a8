// SPDX-License-Identifier: MIT
#include "equivalence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "distributions.hpp"
#include "within.hpp"

using namespace shakedown;

TEST(Equivalence, WelchsIntervalByHand) {
  // a + b = 0.02 + 0.08 = 0.1, degrees of freedom 0.01 / (0.0004/4 + 0.0064/9) = 12.3288
  const Equivalence found = equivalence_of({1.0, std::sqrt(0.1), 5}, {0.7, std::sqrt(0.8), 10}, 5);
  WITHIN(found.standard_error, std::sqrt(0.1), 1e-15, 7.1e-17);
  WITHIN((found.high - found.low) / 2, student_95(0.01 / (0.0001 + 0.0064 / 9)) * std::sqrt(0.1), 9e-15,
         4.5e-16);
  WITHIN(found.difference, 0.3, 1e-15, 6.7e-17);
}

TEST(Equivalence, CloseMeansAndLittleSpreadAreEquivalent) {
  const Equivalence found = equivalence_of({-8.14, 0.05, 8}, {-8.16, 0.05, 8}, 0.10);
  EXPECT_EQ(found.verdict, Agreement::equivalent);
  EXPECT_EQ(in_words(found), "equivalent");
}

TEST(Equivalence, ASignificantButSmallDifferenceIsEquivalent) {
  EXPECT_EQ(equivalence_of({1.0, 0.001, 100}, {1.01, 0.001, 100}, 0.10).verdict, Agreement::equivalent);
}

TEST(Equivalence, FarMeansDiffer) {
  const Equivalence found = equivalence_of({-8.14, 0.05, 8}, {-7.5, 0.05, 8}, 0.10);
  EXPECT_EQ(found.verdict, Agreement::differ);
  EXPECT_EQ(in_words(found), "differ by 25.6 standard errors");
}

TEST(Equivalence, TooFewOrTooScatteredCannotTell) {
  EXPECT_EQ(equivalence_of({1, 0, 1}, {1, 0, 1}, 0.1).verdict, Agreement::cannot_tell);
  EXPECT_EQ(equivalence_of(Statistic{}, {1, 0.1, 8}, 0.1).verdict, Agreement::cannot_tell);
  // No significant difference, yet no equivalence either.
  const Equivalence found = equivalence_of({1, 0.5, 4}, {1, 0.5, 4}, 0.1);
  EXPECT_EQ(found.verdict, Agreement::cannot_tell);
  EXPECT_GT(found.runs_needed, 100);
  EXPECT_NE(in_words(found).find("more runs (about"), std::string::npos);
}

TEST(Equivalence, WithoutSpreadTheIntervalIsAPoint) {
  EXPECT_EQ(equivalence_of({1, 0, 3}, {1, 0, 3}, 0.1).verdict, Agreement::equivalent);
  EXPECT_EQ(equivalence_of({1, 0, 3}, {2, 0, 3}, 0.1).verdict, Agreement::differ);
}

TEST(Equivalence, WhatNeitherHasIsNotJudged) {
  EXPECT_EQ(equivalence_of(Statistic{}, Statistic{}, 0.1).verdict, Agreement::no_number);
}
