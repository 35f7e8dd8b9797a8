// SPDX-License-Identifier: MIT
#include "text.hpp"

#include <gtest/gtest.h>

using namespace shakedown;

TEST(Text, TrimmedJoinedQuotedAndInMillimetres) {
  EXPECT_EQ(trimmed(" \t40 mm\r\n"), "40 mm");
  EXPECT_EQ(trimmed(" \n"), "");
  EXPECT_EQ(trimmed("\xEF\xBB\xBF a"), "a");
  EXPECT_EQ(joined({}), "");
  EXPECT_EQ(joined({"", "b"}), ", b");
  EXPECT_EQ(joined({"a", "b", "c"}, " + "), "a + b + c");
  EXPECT_EQ(csv_cell("a \"b\", c"), "\"a \"\"b\"\", c\"");
  EXPECT_EQ(millimetres(0.0401234), "40.1 mm");
  EXPECT_EQ(millimetres(2e-6), "0.002 mm");
}
