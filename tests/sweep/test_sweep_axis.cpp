// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "effects.hpp"
#include "sweep_axis.hpp"

using namespace shakedown;

namespace {
std::string refusal(const std::vector<std::string>& texts) {
  try {
    parse_axes(texts, all_effects());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
void expect_refused(const std::vector<std::string>& texts, const std::string& words) {
  EXPECT_NE(refusal(texts).find(words), std::string::npos) << "'" << words << "' in: " << refusal(texts);
}
}  // namespace

TEST(SweepAxis, StepsAreTheDecimalNumbersOfASetupFile) {
  const SweepAxis axis = parse_axis("box.length=25mm:600mm:5mm", all_effects());
  ASSERT_EQ(axis.values.size(), 116u);
  EXPECT_EQ(axis.values[3], 0.040);  // bit for bit, although 25 + 3 x 5 in metres is not
  EXPECT_EQ(axis.values[22], 0.135);
  EXPECT_EQ(axis.values.back(), 0.600);
  EXPECT_EQ(axis.column(), "box_length_mm");
  EXPECT_DOUBLE_EQ(axis.shown(0.135), 135);
}

TEST(SweepAxis, AUnitAtTheEndHoldsForAll) {
  EXPECT_EQ(parse_axis("box.length=40:50:5 mm", all_effects()).values, (std::vector{0.040, 0.045, 0.050}));
  EXPECT_EQ(parse_axis("box.length=4cm,65mm", all_effects()).values, (std::vector{0.040, 0.065}));
}

TEST(SweepAxis, EffectsDownwardRangesAndEndsThatAreNotHit) {
  EXPECT_EQ(parse_axis("grain_friction.grain_wall=0.3:0:-0.1", all_effects()).values,
            (std::vector{0.3, 0.2, 0.1, 0.0}));
  EXPECT_EQ(parse_axis("constant_acceleration.acceleration.x=0:0.25:0.1 m/s^2", all_effects()).values,
            (std::vector{0.0, 0.1, 0.2}));
  EXPECT_EQ(parse_axis("constant_acceleration.acceleration.x=0,1m/s^2", all_effects()).column(),
            "constant_acceleration_acceleration_x_m_per_s2");
}

TEST(SweepAxis, WhatIsWrongIsSaidAllAtOnce) {
  expect_refused({"box.lenght=1mm:2mm:1mm"}, "did you mean box.length");
  expect_refused({"box.length=40:50:5"}, "give it in mm");
  expect_refused({"box.length=40mm:50g:5mm"}, "mass");
  expect_refused({"box.length=40mm:50mm"}, "2 parts");
  expect_refused({"box.length=40mm:50mm:-5mm"}, "never gets");
  expect_refused({"box.length=40mm:50mm:0mm"}, "never gets");
  expect_refused({"box.length=40mm,40mm"}, "twice");
  expect_refused({"box.length=nanmm:2mm:1mm"}, "box.length");
  expect_refused({"box.length"}, "no range");
  expect_refused({"release.packing=1,2"}, "number");
  expect_refused({"box.length=1mm,2mm", "box.length=3mm,4mm"}, "varied twice");
  expect_refused({"box.length=1mm,2mm", "grains.count=1,2", "spring.frequency=1,2Hz"},
                 "one or two dimensions");
  const std::string both = refusal({"box.lenght=1mm,2mm", "grains.cuont=1,2"});
  EXPECT_NE(both.find("lenght"), std::string::npos);
  EXPECT_NE(both.find("cuont"), std::string::npos);
}
