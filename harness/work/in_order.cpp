// SPDX-License-Identifier: MIT
#include "in_order.hpp"

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace shakedown {

namespace {

class Line {
 public:
  Line(int count, int window, const std::function<std::function<void()>(int)>& work)
      : count_(count), window_(window), failed_(count), work_(work) {}

  void serve() {
    for (int number = take(); number < count_; number = take()) do_one(number);
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  int take() {
    std::unique_lock lock(mutex_);
    turn_changed_.wait(lock, [&] { return next_ >= count_ || failed_ < count_ || next_ < turn_ + window_; });
    return next_ >= count_ || failed_ < count_ ? count_ : next_++;
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
    waiting_.emplace(number, std::move(deliver));
    if (!delivering_) deliver_all(lock);
  }

  /// Delivers the result that is due, and those behind it that wait already.
  void deliver_all(std::unique_lock<std::mutex>& lock) {
    delivering_ = true;
    for (auto due = waiting_.begin(); due != waiting_.end() && due->first == turn_; due = waiting_.begin()) {
      const std::function<void()> deliver = std::move(due->second);
      waiting_.erase(due);
      if (turn_ < failed_ && deliver) {
        std::exception_ptr failure;
        lock.unlock();
        try {
          deliver();
        } catch (...) {
          failure = std::current_exception();
        }
        lock.lock();
        if (failure) note(turn_, failure);
      }
      ++turn_;
      turn_changed_.notify_all();
    }
    delivering_ = false;
  }

  void note(int number, const std::exception_ptr& failure) {
    if (number < failed_) {
      failed_ = number;
      failure_ = failure;
    }
    turn_changed_.notify_all();
  }

  const int count_, window_;
  int next_ = 0, turn_ = 0, failed_;
  bool delivering_ = false;
  std::map<int, std::function<void()>> waiting_;
  std::exception_ptr failure_;
  std::mutex mutex_;
  std::condition_variable turn_changed_;
  const std::function<std::function<void()>(int)>& work_;
};

}  // namespace

int threads_or_all(int threads) {
  return threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void serve_on_threads(int threads, const std::function<void()>& serve) {
  std::vector<std::jthread> helpers;
  for (int i = 1; i < threads; ++i) helpers.emplace_back(serve);
  serve();
}

void work_in_parallel_deliver_in_order(int count, int threads,
                                       const std::function<std::function<void()>(int)>& work) {
  // Runs of one batch differ tenfold in cost: with room for few results the quick ones would wait for the
  // slow ones.
  constexpr int results_a_thread = 16;
  const int all = threads_or_all(threads);
  Line line(count, all > 1 ? results_a_thread * all : 1, work);
  serve_on_threads(std::min(all, count), [&] { line.serve(); });
  line.rethrow();
}

}  // namespace shakedown
