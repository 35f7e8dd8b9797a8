// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <string>
#include <vector>

#include "in_order.hpp"

using namespace shakedown;

TEST(InOrder, ServesOnSoManyThreadsAtOnce) {
  std::latch all(3);
  std::atomic<int> served = 0;
  serve_on_threads(3, [&] {
    all.arrive_and_wait();  // with fewer it would wait for ever
    ++served;
  });
  EXPECT_EQ(served, 3);
  serve_on_threads(0, [&] { ++served; });
  EXPECT_EQ(served, 4);
}

TEST(InOrder, DeliversAscendingWhateverTheThreads) {
  for (const int threads : {1, 2, 3, 8}) {
    std::vector<int> delivered;
    std::atomic<int> waiting{0}, most{0};
    work_in_parallel_deliver_in_order(200, threads, [&](int number) {
      volatile double sum = 0;  // uneven work
      for (int i = 0; i < (number * 7919 % 13) * 2000; ++i) sum = sum + i;
      const int now = ++waiting;
      for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
      }
      return [&, number] {
        --waiting;
        delivered.push_back(number);
      };
    });
    ASSERT_EQ(delivered.size(), 200u);
    for (int i = 0; i < 200; ++i) EXPECT_EQ(delivered[static_cast<std::size_t>(i)], i);
    EXPECT_LE(most, threads == 1 ? 1 : 16 * threads);
  }
}

TEST(InOrder, QuickOnesDoNotWaitForASlowOne) {
  std::latch enough(10);
  std::vector<int> delivered;
  work_in_parallel_deliver_in_order(40, 2, [&](int number) {
    if (number == 0)
      enough.wait();  // as slow as ten others
    else if (number <= 10)
      enough.count_down();
    return [&, number] { delivered.push_back(number); };
  });
  ASSERT_EQ(delivered.size(), 40u);
  EXPECT_TRUE(std::is_sorted(delivered.begin(), delivered.end()));
}

TEST(InOrder, ThrowsTheErrorOfTheLowestNumber) {
  for (const int threads : {1, 4}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<int> delivered;
      std::string thrown;
      try {
        work_in_parallel_deliver_in_order(100, threads, [&](int number) -> std::function<void()> {
          if (number == 23 || number == 24 || number == 26) throw std::runtime_error(std::to_string(number));
          return [&, number] { delivered.push_back(number); };
        });
      } catch (const std::runtime_error& error) {
        thrown = error.what();
      }
      EXPECT_EQ(thrown, "23");
      EXPECT_EQ(delivered.size(), 23u);
    }
  }
}

TEST(InOrder, AFailedDeliveryStopsTheRest) {
  int delivered = 0;
  EXPECT_THROW(work_in_parallel_deliver_in_order(100, 3,
                                                 [&](int number) {
                                                   return [&, number] {
                                                     if (number == 5) throw std::runtime_error("disk full");
                                                     ++delivered;
                                                   };
                                                 }),
               std::runtime_error);
  EXPECT_EQ(delivered, 5);
}

TEST(InOrder, NothingToDoIsDone) {
  work_in_parallel_deliver_in_order(0, 4, [](int) { return std::function<void()>(); });
  work_in_parallel_deliver_in_order(3, 4, [](int) { return std::function<void()>(); });
}
