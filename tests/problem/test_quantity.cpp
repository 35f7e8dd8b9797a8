// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "quantity.hpp"
#include "random.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

double si_of(std::string_view text) {
  const auto parsed = parse_quantity(text);
  const auto* quantity = std::get_if<Quantity>(&parsed);
  EXPECT_NE(quantity, nullptr) << text << ": " << (quantity ? "" : std::get<std::string>(parsed));
  return quantity ? quantity->si : NAN;
}

Dimension dimension_of(std::string_view text) {
  const auto parsed = parse_unit(text);
  EXPECT_TRUE(std::holds_alternative<Unit>(parsed)) << text;
  return std::holds_alternative<Unit>(parsed) ? std::get<Unit>(parsed).dimension : Dimension{99, 99, 99};
}

std::string reason_for(std::string_view text) {
  const auto parsed = parse_quantity(text);
  return std::holds_alternative<std::string>(parsed) ? std::get<std::string>(parsed) : "none";
}

}  // namespace

TEST(Quantity, DecimalUnitsGiveTheNearestDouble) {
  EXPECT_EQ(si_of("107.5 mm"), 0.1075);
  EXPECT_EQ(si_of("434 g"), 0.434);
  EXPECT_EQ(si_of("4.04 g"), 4.04e-3);
  EXPECT_EQ(si_of("0.3 ms"), 3e-4);
  EXPECT_EQ(si_of("206 GPa"), 2.06e11);
  EXPECT_EQ(si_of("65mm"), 0.065);
  EXPECT_EQ(si_of("+1e-3mm"), 1e-6);
  EXPECT_EQ(si_of("5 %"), 0.05);
  EXPECT_EQ(si_of("3 \u00b5m"), 3e-6);
  EXPECT_EQ(si_of("3 \u03bcm"), 3e-6);
  EXPECT_EQ(si_of("-0.5"), -0.5);
}

TEST(Quantity, ProductsQuotientsAndPowers) {
  EXPECT_EQ(si_of("0.05 N s/m"), 0.05);
  EXPECT_EQ(si_of("0.05 N*s/m"), 0.05);
  EXPECT_EQ(si_of("0.05 N\u00b7s/m"), 0.05);
  EXPECT_EQ(si_of("50 mN s m^-1"), 0.05);
  EXPECT_EQ(si_of("7 g/m/s"), 7e-3);
  EXPECT_EQ(si_of("7 kg/(m s)"), 7);
  EXPECT_EQ(si_of("9.8 m/s\u00b2"), 9.8);
  EXPECT_EQ(si_of("2 /s"), 2);
  WITHIN(si_of("180 deg"), std::numbers::pi, 1e-15, 7e-16);
  EXPECT_EQ(si_of("2 min"), 120);
  WITHIN(si_of("1e-3 g0"), 9.80665e-3, 1e-17, 2.2e-18);
  EXPECT_EQ(dimension_of("N s/m"), (Dimension{0, 1, -1}));
  EXPECT_EQ(dimension_of("N s^2/m^2"), (Dimension{-1, 1, 0}));
  EXPECT_EQ(dimension_of("kg/s"), dimension_of("N s/m"));
  EXPECT_EQ(dimension_of("J/m"), dimension_of("N"));
  EXPECT_EQ(dimension_of(""), Dimension{});
}

TEST(Quantity, SaysWhyThereIsNone) {
  EXPECT_EQ(reason_for("mm"), "does not begin with a number");
  EXPECT_EQ(reason_for(""), "does not begin with a number");
  EXPECT_EQ(reason_for("nan mm"), "is not a finite number");
  EXPECT_EQ(reason_for("inf"), "is not a finite number");
  EXPECT_EQ(reason_for("1e400 mm"), "is not a finite number");
  EXPECT_EQ(reason_for("1,5 mm"), "has a comma in the number (the decimal sign is a point)");
  EXPECT_EQ(reason_for("3 furlong"), "has the unknown unit 'furlong'");
  EXPECT_EQ(reason_for("3 m/"), "has no unit where one is expected");
  EXPECT_EQ(reason_for("3 m^x"), "needs a whole exponent from -9 to 9 after ^");
  EXPECT_EQ(reason_for("3 kg/(m s"), "has an open bracket");
  EXPECT_EQ(reason_for("3 m)"), "does not end after a unit");
}

TEST(Quantity, WritesTheShortestTextThatReadsBack) {
  EXPECT_EQ(write_quantity(0.04, "m"), "0.04 m");
  EXPECT_EQ(write_quantity(0.04, "mm"), "40 mm");
  EXPECT_EQ(write_quantity(0.1075, "mm"), "107.5 mm");
  EXPECT_EQ(write_quantity(0, "mm"), "0 mm");
  EXPECT_EQ(write_quantity(-1e-9, "m"), "-1e-9 m");
  EXPECT_EQ(write_quantity(2.06e11, "GPa"), "206 GPa");
  EXPECT_EQ(write_quantity(0.75, ""), "0.75");
  EXPECT_EQ(write_number(1e300), "1e300");
  EXPECT_EQ(write_number(123456), "123456");
}

TEST(Quantity, EveryDoubleReadsBackInEveryUnit) {
  Random random(1, 0, Stream::other);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::ldexp(random.uniform() - 0.5, static_cast<int>(random.bits() % 200) - 100);
    for (const char* unit : {"", "m", "mm", "g", "GPa", "N s^2/m^2", "deg", "min", "g0"})
      ASSERT_EQ(si_of(write_quantity(value, unit)), value) << write_quantity(value, unit);
  }
}

TEST(Quantity, NamesDimensions) {
  EXPECT_EQ(describe(Dimension{1, 0, 0}), "a length (m)");
  EXPECT_EQ(describe(Dimension{2, 1, -1}), "kg m^2/s");
  EXPECT_EQ(describe(Dimension{-3, 1, 0}), "kg/m^3");
}
