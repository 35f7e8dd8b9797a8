// SPDX-License-Identifier: MIT
// The same drops in many tables.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "drop_sequences.hpp"
#include "drop_tables.hpp"
#include "errors.hpp"
#include "random.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

/// Intervals of a ball of restitution e, s.
std::vector<double> flights(double first, double e, int count) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i, first *= e) all.push_back(first);
  return all;
}

const std::vector<std::vector<double>> three{flights(0.8, 0.85, 7), flights(0.6, 0.85, 7),
                                             flights(0.7, 0.85, 7)};

void expect_three(const std::string& table, Tolerance within = {2e-6, 6.7e-7},
                  const DropReading& reading = {}) {
  const ReadDrops read = drops_of_table(parse_table(table, "drops.csv"), reading);
  ASSERT_EQ(read.drops.size(), 3u) << table << read.notes.front();
  for (std::size_t d = 0; d < 3; ++d) {
    ASSERT_EQ(read.drops[d].interval.size(), 7u) << table << read.notes.front();
    for (std::size_t i = 0; i < 7; ++i) WITHIN(read.drops[d].interval[i], three[d][i], within) << table;
  }
}

std::string comma(std::string text) {
  for (char& c : text) c = c == '.' ? ',' : c;
  return text;
}

/// Instants from a start.
std::vector<double> instants(const std::vector<double>& intervals, double start) {
  std::vector<double> all{start};
  for (const double one : intervals) all.push_back(all.back() + one);
  return all;
}

std::string long_table(double unit, const char* header, bool with_labels) {
  std::string text = std::string(header) + (*header ? "\n" : "");
  for (std::size_t d = 0; d < 3; ++d)
    for (std::size_t i = 0; i < 7; ++i)
      text += with_labels ? fmt::format("{},{},{:.6f}\n", d + 1, i + 1, three[d][i] / unit)
                          : fmt::format("{:.6f}\n", three[d][i] / unit);
  return text;
}

}  // namespace

TEST(DropTables, LongWithLabels) {
  expect_three(long_table(1, "throw,bounce,interval_s", true));
  expect_three(long_table(1e-3, "Wurf,Aufprall,Flugzeit [ms]", true));
  expect_three(long_table(1e-3, "lancio,rimbalzo,dt", true));
  expect_three(long_table(1, "", true));
}

TEST(DropTables, OneColumnAlone) {
  expect_three(long_table(1, "", false));
  expect_three(long_table(1e-3, "", false));
  expect_three(long_table(1, "T", false));
}

TEST(DropTables, SideBySide) {
  std::string text = "n;Wurf 1 (s);Wurf 2 (s);Wurf 3 (s)\n";
  for (std::size_t i = 0; i < 7; ++i)
    text += comma(fmt::format("{};{:.6f};{:.6f};{:.6f}\n", i + 1, three[0][i], three[1][i], three[2][i]));
  expect_three(text);
}

TEST(DropTables, InRows) {
  std::string text = "height_cm,T1,T2,T3,T4,T5,T6,T7\n", bare;
  for (std::size_t d = 0; d < 3; ++d) {
    std::string row;
    for (std::size_t i = 0; i < 7; ++i) row += fmt::format("{}{:.6f}", i > 0 ? "," : "", three[d][i]);
    text += fmt::format("{},{}\n", 40 + 10 * d, row);
    bare += row + "\n";
  }
  expect_three(text);
  expect_three(bare);
}

TEST(DropTables, Instants) {
  std::string text = "drop,t_s\n", wide = "a,b,c\n", rows;
  const std::vector<std::vector<double>> t{instants(three[0], 1.2), instants(three[1], 0.7),
                                           instants(three[2], 2.2)};
  for (std::size_t d = 0; d < 3; ++d)
    for (const double one : t[d]) text += fmt::format("{},{:.6f}\n", d + 1, one);
  for (std::size_t i = 0; i < 8; ++i)
    wide += fmt::format("{:.6f},{:.6f},{:.6f}\n", t[0][i], t[1][i], t[2][i]);
  expect_three(text);
  expect_three(wide);
  // One clock that runs on through pauses between the drops.
  std::string running = "temps (s)\n";
  double start = 0;
  for (std::size_t d = 0; d < 3; ++d, start += 9)
    for (const double one : t[d]) running += fmt::format("{:.6f}\n", start + one);
  expect_three(running);
}

TEST(DropTables, CountsOfAClock) {
  std::string text = "drop,sample\n";
  for (std::size_t d = 0; d < 3; ++d)
    for (const double one : instants(three[d], 1)) text += fmt::format("{},{:.0f}\n", d + 1, one * 48000);
  DropReading reading;
  reading.rate = 48000;
  expect_three(text, {2.2e-5, 1.5e-5}, reading);  // the sample
}

TEST(DropTables, OneColumnOfDecimalCommas) {
  const auto count = [](const std::string& text) {
    return drops_of_table(parse_bounce_table(text, "a.csv"), {}).drops.at(0).interval.size();
  };
  EXPECT_EQ(count("Zeit in s\n0,800\n0,640\n0,512\n0,410\n0,328\n"), 5u);
  EXPECT_EQ(count("0,75\n0,60\n0,48\n0,38\n"), 4u);
  EXPECT_EQ(count("1,754\n2,603\n3,483\n4,386\n"), 4u);  // a counter and milliseconds
}

TEST(DropTables, RowsBehindWords) {
  const ReadDrops read = drops_of_table(parse_table("ball,surface,trial,dt1,dt2,dt3,dt4\n"
                                                    "golf,wood,1,0.75,0.60,0.48,0.38\n"
                                                    "golf,wood,2,0.74,0.59,0.47,0.38\n"
                                                    "golf,tile,1,0.60,0.48,0.38,0.31\n",
                                                    "a.csv"),
                                        {});
  ASSERT_EQ(read.drops.size(), 3u);
  EXPECT_EQ(read.drops[2].name, "ball golf, surface tile, trial 1");
  EXPECT_EQ(read.drops[2].interval.size(), 4u);
}

TEST(DropTables, ANoisyTrackGivesImpacts) {
  const std::vector<double> t = instants(flights(0.7, 0.8, 6), 0.35);
  for (const double rate : {60.0, 240.0, 1000.0}) {
    std::string text = "t (s);y (m)\n";
    Random random(5, 1, Stream::camera);
    for (int f = 0; f < static_cast<int>(2.6 * rate); ++f) {
      const double now = f / rate;
      double height = now < t[0] ? 9.81 / 2 * (t[0] * t[0] - now * now) : 0;
      for (std::size_t i = 0; i + 1 < t.size(); ++i)
        if (now >= t[i] && now < t[i + 1]) height = 9.81 / 2 * (now - t[i]) * (t[i + 1] - now);
      text += fmt::format("{:.5f};{:.5f}\n", now, height + 1e-3 * random.normal());
    }
    const ReadDrops read = drops_of_table(parse_table(text, "track.csv"), {});
    ASSERT_EQ(read.drops.size(), 1u) << rate;
    ASSERT_GE(read.drops[0].interval.size(), 5u) << rate;
    for (std::size_t i = 1; i < 5; ++i)
      WITHIN(read.drops[0].interval[i], t[i] - t[i - 1], 1.5e-3, 3.2e-4) << rate << " " << i;
  }
}

TEST(DropTables, AFallFromRestIsNoFlight) {
  const std::vector<double> with_fall{0.452, 0.768, 0.653, 0.555, 0.472};
  const std::vector<Drop> drops = drops_of_intervals(with_fall, "");
  ASSERT_EQ(drops.size(), 1u);
  EXPECT_DOUBLE_EQ(drops[0].fall, 0.452);
  EXPECT_EQ(drops[0].interval.size(), 4u);
}

TEST(DropTables, AMissedImpactDoesNotBeginADrop) {
  std::vector<double> x = flights(0.8, 0.85, 8);
  x[3] += x[4];
  x.erase(x.begin() + 4);
  EXPECT_EQ(drops_of_intervals(x, "").size(), 1u);
  EXPECT_EQ(drops_of_instants(instants(x, 3), "").size(), 1u);
}

// Parabolas of heights near the largest number cross at no instant.
TEST(DropTables, ATrackOfHeightsTooLargeIsRefused) {
  const auto track = [](double unit) {
    std::string text = "t,y\n";
    for (int i = 0; i < 120; ++i) {
      double since = i / 60.0 - std::sqrt(2 / 9.81), up = 0;
      if (since >= 0)
        for (up = 0.8 * std::sqrt(2 * 9.81); since > 2 * up / 9.81; up *= 0.8) since -= 2 * up / 9.81;
      const double height =
          since < 0 ? 1 - 9.81 * std::pow(i / 60.0, 2) / 2 : up * since - 9.81 * since * since / 2;
      text += fmt::format("{},{}\n", i / 60.0, unit * height);
    }
    return text;
  };
  DropReading reading;
  reading.as = "track";
  reading.columns = {"t", "y"};
  EXPECT_EQ(drops_of_table(parse_table(track(1), "a.csv"), reading).drops.size(), 1u);
  EXPECT_THROW(drops_of_table(parse_table(track(1e308), "a.csv"), reading), InputError);
}

TEST(DropTables, SaysWhatIsWrong) {
  const auto message = [](const char* text, const DropReading& reading = {}) -> std::string {
    try {
      drops_of_table(parse_table(text, "a.csv"), reading);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message("x,y\n1,5\n2,7\n3,4\n").find("a.csv"), std::string::npos);
  DropReading reading;
  reading.columns = {"dt"};
  EXPECT_NE(message("x,y\n1,5\n2,7\n3,4\n", reading).find("the columns are: x, y"), std::string::npos);
  reading = {};
  reading.unit = "kg";
  EXPECT_NE(message("0.8\n0.6\n0.45\n0.33\n", reading).find("--unit"), std::string::npos);
  std::string wide = "0.8";
  for (int i = 0; i < 20000; ++i) wide += ",0.5";
  EXPECT_NE(message((wide + "\n").c_str()).find("20001 columns"), std::string::npos);
}

TEST(DropTables, ATrackWithoutClockOrWithoutHeightsIsRefused) {
  DropReading reading;
  reading.as = "track";
  reading.columns = {"t", "y"};
  for (const auto& [step, height] :
       {std::pair{0.0, 1.0}, std::pair{1e-300, 1.0}, std::pair{-0.01, 1.0}, std::pair{0.01, 1e308}}) {
    std::string text = "t,y\n";
    for (int i = 0; i < 80; ++i)
      text += fmt::format("{},{}\n", i * step, height * (i % 3 == 0 ? -1 : 1) * (1 + i % 20));
    EXPECT_THROW(drops_of_table(parse_table(text, "a.csv"), reading), InputError) << step << ' ' << height;
  }
}

TEST(DropTables, ATrackGivesImpacts) {
  // y down in pixels, 120 frames a second, 2 mm a pixel
  const std::vector<double> t = instants(flights(0.7, 0.8, 6), 0.35);
  std::string text = "frame,x_px,y_px\n";
  for (int f = 0; f < 420; ++f) {
    const double now = f / 120.0;
    double height = 0;
    if (now < t[0]) height = 9.81 / 2 * (t[0] * t[0] - now * now);
    for (std::size_t i = 0; i + 1 < t.size(); ++i)
      if (now >= t[i] && now < t[i + 1]) height = 9.81 / 2 * (now - t[i]) * (t[i + 1] - now);
    text += fmt::format("{},{},{:.2f}\n", f, 320 + f / 10, 700 - height / 0.002);
  }
  DropReading reading;
  reading.rate = 120;
  const ReadDrops read = drops_of_table(parse_table(text, "track.csv"), reading);
  ASSERT_EQ(read.drops.size(), 1u);
  const Drop& drop = read.drops[0];
  EXPECT_EQ(drop.impact.front(), 0);
  WITHIN(drop.interval[0], 0.7, 8e-7, 4.3e-8);
  for (std::size_t i = 1; i < 5; ++i) WITHIN(drop.interval[i], t[i] - t[i - 1], 1.5e-5, 7.8e-7) << i;
}
