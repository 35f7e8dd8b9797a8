// SPDX-License-Identifier: MIT
#include "in_order.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace shakedown {

namespace {

class Line {
 public:
  Line(int count, const std::function<std::function<void()>(int)>& work)
      : count_(count), failed_(count), work_(work) {}

  void serve() {
    for (int number = take(); number < count_; number = take()) do_one(number);
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  int take() {
    const std::lock_guard lock(mutex_);
    return failed_ < count_ ? count_ : next_++;
  }

  void do_one(int number) {
    std::function<void()> deliver;
    std::exception_ptr failure;
    try {
      deliver = work_(number);
    } catch (...) {
      failure = std::current_exception();
    }
    std::unique_lock lock(mutex_);
    if (failure) note(number, failure);
    turn_changed_.wait(lock, [&] { return turn_ == number; });
    if (number < failed_ && deliver) {
      lock.unlock();  // nobody else can have this turn
      try {
        deliver();
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      if (failure) note(number, failure);
    }
    ++turn_;
    turn_changed_.notify_all();
  }

  void note(int number, const std::exception_ptr& failure) {
    if (number >= failed_) return;
    failed_ = number;
    failure_ = failure;
  }

  const int count_;
  int next_ = 0, turn_ = 0, failed_;
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable turn_changed_;
  const std::function<std::function<void()>(int)>& work_;
};

}  // namespace

int threads_or_all(int threads) {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void work_in_parallel_deliver_in_order(int count, int threads,
                                       const std::function<std::function<void()>(int)>& work) {
  Line line(count, work);
  {
    std::vector<std::jthread> helpers;
    for (int i = 1; i < std::min(threads_or_all(threads), count); ++i)
      helpers.emplace_back([&] { line.serve(); });
    line.serve();
  }
  line.rethrow();
}

}  // namespace shakedown
