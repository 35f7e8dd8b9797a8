// SPDX-License-Identifier: MIT
// Formulas as LAMMPS reads them, held to what muParser makes of them.
#include "lammps_formula.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "child_program.hpp"
#include "formula.hpp"
#include "lammps.hpp"
#include "outside_errors.hpp"
#include "within.hpp"
#include "work_folder.hpp"

using namespace shakedown;

namespace {

const std::map<std::string, double> constants{{"c", 0.4}, {"x0", 0.045}, {"w", 0.012}, {"small", -2.5e-7}};

std::string translated(const std::string& formula) {
  return lammps_formula(formula, constants, {"v_x", "v_v", "v_t"});
}

TEST(LammpsFormula, HasBracketsAroundEverything) {
  EXPECT_EQ(translated("-x^2"), "(-(v_x^(2)))");
  EXPECT_EQ(translated("-c*v*abs(v)"), "(((-(0.4))*v_v)*abs(v_v))");
  EXPECT_EQ(translated("x - t - 1"), "((v_x-v_t)-(1))");
  EXPECT_EQ(translated("_pi"), "(3.141592653589793)");  // that of muParser ends after twelve digits
}

TEST(LammpsFormula, NamesWhatLammpsCannotBeTold) {
  for (const auto& [formula, words] : std::map<std::string, std::string>{{"atanh(x)", "'atanh' has no words"},
                                                                         {"x = 2", "'= 2' has no words"},
                                                                         {"!x", "'!'"},
                                                                         {"(x", "')'"}})
    try {
      translated(formula);
      ADD_FAILURE() << formula;
    } catch (const LammpsFormulaProblem& problem) {
      EXPECT_NE(problem.text.find(words), std::string::npos) << problem.text;
    }
}

/// Each with precedences, functions and numbers of its own.
const std::vector<std::string> formulas{
    "-x^2",
    "2^3^2 - 2^-1",
    "-2^2*x + 3-4-5",
    "x/w/c",
    "-c*v*exp(-((x-x0)/w)^2)",
    "-c*v*abs(v)",
    "x > x0 ? 1.5 : v < 0 ? 2 : 3",
    "x > 0 && v > 0 || t > 100",
    "x <= 0.1 || x != 0.1",
    "min(x, v, t) + max(x, v, t)",
    "sum(x, 1, 2) + avg(x, v)",
    "sign(x) + sign(v) + sign(0)",
    "tanh(1000*v) + tanh(x)",
    "sinh(x) + cosh(v)",
    "log(2) + ln(3) + log10(5) + log2(7)",
    "sin(2*t) + cos(_e) + tan(x)",
    "asin(x) + acos(x) + atan(x) + atan2(x, v)",
    "sqrt(t) + rint(1.3) + small*1e3 + .5",
    "-(-x) - -v",
    "x*-v + +t",
};

struct Point {
  double x, v, t;
};
constexpr std::array points{Point{0.1, -0.7, 0.25}, Point{-0.03, 0.4, 3.5}, Point{0.046, 1e-3, 0.011}};

/// What LAMMPS makes of every formula at a point.
std::vector<double> by_lammps(const Point& point) {
  const WorkFolder folder("");
  std::string script =
      "units si\natom_style sphere\nregion all block -1 1 -1 1 -1 1\ncreate_box 1 all\n"
      "pair_style zero 0.1\npair_coeff * *\n";
  script += fmt::format("variable x equal {}\nvariable v equal {}\nvariable t equal {}\n", point.x, point.v,
                        point.t);
  for (std::size_t i = 0; i < formulas.size(); ++i)
    script += fmt::format("variable f_{0} equal {1}\nprint \"$(v_f_{0}:%.17g)\" append values\n", i,
                          translated(formulas[i]));
  folder.write("in", script);
  ChildProgram child;
  child.words = {"lmp", "-in", "in"};
  child.folder = folder.path();
  child.output = folder / "output";
  child.error = folder / "error";
  EXPECT_EQ(run_child(child).exit_code, 0) << contents_of(folder / "output");
  std::istringstream text(contents_of(folder / "values"));
  std::vector<double> values;
  for (double value = 0; text >> value;) values.push_back(value);
  return values;
}

TEST_F(SlowWithLammps, ReadsFormulasAsMuParserDoes) {
  for (const Point& point : points) {
    const std::vector<double> values = by_lammps(point);
    ASSERT_EQ(values.size(), formulas.size());
    for (std::size_t i = 0; i < formulas.size(); ++i) {
      const double expected = Formula(formulas[i], constants)(point.x, point.v, point.t);
      WITHIN((values[i] - expected) / (1 + std::abs(expected)), 0, 1e-14, 8.9e-16) << formulas[i];
    }
  }
}

}  // namespace
