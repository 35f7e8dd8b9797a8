// SPDX-License-Identifier: MIT
// The calendar against a sorted multimap, under schedules that event-driven runs make and under such as they
// never should.
#include <gtest/gtest.h>

#include <map>

#include "calendar_queue.hpp"
#include "random.hpp"

using namespace shakedown;

namespace {

/// Both queues side by side; every look at the calendar is checked.
class BothQueues {
 public:
  explicit BothQueues(std::size_t grains) : calendar(grains), dates_(grains, never) {}

  void schedule(int i, double time) {
    double& date = dates_[static_cast<std::size_t>(i)];
    if (date < never)
      for (auto [entry, end] = sorted_.equal_range(date); entry != end; ++entry)
        if (entry->second == i) {
          sorted_.erase(entry);
          break;
        }
    date = time;
    if (time < never) sorted_.emplace(time, i);
    calendar.schedule(i, time);
  }

  /// The earliest grain; -1 when there is none.
  int check_next() {
    const CalendarQueue::Next next = calendar.next(std::array{7, 3}, [this](int grain, int days) {
      EXPECT_LT(dates_[static_cast<std::size_t>(grain)], never);
      ++told[days == 3];
    });
    if (sorted_.empty()) {
      EXPECT_EQ(next.grain, -1);
      EXPECT_EQ(next.time, never);
      return -1;
    }
    EXPECT_EQ(next.time, sorted_.begin()->first);  // of several grains with the same date any may come first
    EXPECT_EQ(dates_[static_cast<std::size_t>(next.grain)], next.time);
    EXPECT_EQ(calendar.time(next.grain), next.time);
    return next.grain;
  }

  std::size_t waiting() const { return sorted_.size(); }

  CalendarQueue calendar;
  std::array<int, 2> told{};  ///< how often of dates seven days ahead, and three

 private:
  std::vector<double> dates_;
  std::multimap<double, int> sorted_;
};

/// How long from now a new date lies.
using Wait = double (*)(Random&);
struct Schedule {
  const char* name;
  Wait wait;
};

constexpr std::array<Schedule, 7> schedules{{
    {"exponential", [](Random& random) { return -std::log(random.uniform()); }},
    {"clustered", [](Random& random) { return std::floor(4 * random.uniform()) + 1e-9 * random.uniform(); }},
    {"ten scales", [](Random& random) { return std::pow(10, 10 * random.uniform() - 8); }},
    {"often the same instant", [](Random& random) { return std::floor(3 * random.uniform()); }},
    {"half never", [](Random& random) { return random.uniform() < 0.5 ? never : random.uniform(); }},
    {"mostly never", [](Random& random) { return random.uniform() < 0.99 ? never : random.uniform(); }},
    {"a little in the past", [](Random& random) { return random.uniform() - 1e-3; }},
}};

/// Takes events as an event loop does: the earliest grain and sometimes a partner get new dates; now and then
/// the rate of everything changes, as in a damper whose layer lands.
void run(const Schedule& schedule, std::size_t grains, int steps, std::uint64_t seed) {
  Random random(seed, grains, Stream::other);
  const auto any_grain = [&] { return static_cast<int>(random.uniform() * static_cast<double>(grains)); };
  BothQueues queues(grains);
  double now = 0, scale = 1;
  for (std::size_t i = 0; i < grains; ++i) queues.schedule(static_cast<int>(i), schedule.wait(random));
  if (random.uniform() < 0.5) queues.calendar.plan(now, static_cast<double>(grains));
  for (int step = 0; step < steps && !::testing::Test::HasFailure(); ++step) {
    const int grain = queues.check_next();
    if (grain >= 0) now = std::max(now, queues.calendar.time(grain));
    if (random.uniform() < 2e-3) scale = std::pow(10, 6 * random.uniform() - 3);
    queues.schedule(grain >= 0 ? grain : any_grain(), now + scale * schedule.wait(random));
    if (random.uniform() < 0.7) queues.schedule(any_grain(), now + scale * schedule.wait(random));
  }
}

TEST(CalendarQueue, AgreesWithASortedMap) {
  for (const Schedule& schedule : schedules)
    for (const std::size_t grains : {1u, 2u, 37u, 1000u}) {
      SCOPED_TRACE(std::string(schedule.name) + ", grains " + std::to_string(grains));
      for (std::uint64_t seed = 0; seed < 5; ++seed) run(schedule, grains, 4000, seed);
    }
}

/// Of every date that was scheduled long before, unless another one hides it in its day.
TEST(CalendarQueue, TellsOfMostDatesAhead) {
  BothQueues queues(1000);
  Random random(6, 0, Stream::other);
  for (int i = 0; i < 1000; ++i) queues.schedule(i, random.uniform());
  queues.calendar.plan(0, 1000);
  for (int i = 0; i < 1000; ++i) queues.schedule(queues.check_next(), never);
  for (const int told : queues.told) {
    EXPECT_GT(told, 750);
    EXPECT_LE(told, 1000);
  }
}

TEST(CalendarQueue, EmptiesAndFillsAgain) {
  BothQueues queues(5);
  EXPECT_EQ(queues.check_next(), -1);
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 5; ++i) queues.schedule(i, round * 1e6 + i);
    for (int i = 0; i < 5; ++i) {
      EXPECT_EQ(queues.check_next(), i);
      queues.schedule(i, never);
    }
    EXPECT_EQ(queues.check_next(), -1);
  }
}

/// Seconds of a day, of a year and of a century: dates beyond the horizon must come back in order.
TEST(CalendarQueue, KeepsDatesFarAhead) {
  BothQueues queues(300);
  Random random(5, 0, Stream::other);
  for (int i = 0; i < 300; ++i) queues.schedule(i, std::pow(10, 20 * random.uniform()));
  queues.calendar.plan(0, 300);
  for (int i = 0; i < 300; ++i) queues.schedule(queues.check_next(), never);
  EXPECT_EQ(queues.waiting(), 0u);
}

}  // namespace
