// SPDX-License-Identifier: MIT
#include "number_table.hpp"

#include <gtest/gtest.h>

using namespace shakedown;

namespace {

std::string problem_of(std::string_view text, std::size_t columns) {
  try {
    number_table(text, ',', columns, 2);
  } catch (const TableProblem& problem) {
    return problem.text;
  }
  return "none";
}

TEST(NumberTable, HoldsEveryRow) {
  const NumberTable table = number_table("t,x\n0,1\n\n +1e-3 , -2.5 \r\n3,4", ',', 2, 2);
  EXPECT_EQ(table, (NumberTable{{0, 1}, {1e-3, -2.5}, {3, 4}}));
  EXPECT_TRUE(number_table("", ',', 2, 2).empty());
}

TEST(NumberTable, NamesThePlaceOfWhatIsNoNumber) {
  EXPECT_EQ(problem_of("t,x\n0,nan\n", 2), "line 2, column 2: 'nan' is no finite number");
  EXPECT_EQ(problem_of("t,x\n0,1\n1,inf\n", 2), "line 3, column 2: 'inf' is no finite number");
  EXPECT_EQ(problem_of("t,x\n0,1 mm\n", 2), "line 2, column 2: '1 mm' is no finite number");
  EXPECT_EQ(problem_of("t,x\n0,1,2\n", 2), "line 2: 3 columns where 2 are due");
  EXPECT_EQ(problem_of("t,x\n0,\n", 2), "line 2, column 2: '' is no finite number");
}

}  // namespace
