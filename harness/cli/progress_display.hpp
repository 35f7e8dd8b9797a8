// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace shakedown {

/// A bar on a terminal, plain lines otherwise; on standard error, whose failures change nothing. What is
/// being done is said at the first sign of progress, or after `patience` where there is none. Without a
/// terminal a line says after 10, 20, 40, ... s how much is done and how long the rest will take. The bar is
/// wiped when the display goes out of scope. Any thread may call it.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(const std::string& what,
                           std::chrono::milliseconds patience = std::chrono::seconds(1));
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Shows the fraction done, 0 to 1.
  void show(double fraction);
  /// Takes what is shown for the share of the limits that is used, so that nothing is said of how long the
  /// rest takes.
  void count_limits() { of_limits_ = true; }
  /// Changes what the bar says is being done; without a terminal the new stage gets a line with the time so
  /// far.
  void rename(const std::string& what);

 private:
  void announce();  ///< once
  /// Prints a line with the time so far and the share that is done.
  void tell_how_far();
  /// Runs in its own thread: announces after `patience`, then prints lines, each after twice the time.
  void wait(std::chrono::milliseconds patience);

  std::mutex mutex_;
  std::condition_variable ended_;
  bool over_ = false;
  std::string what_;
  bool terminal_, announced_ = false;
  std::atomic<bool> of_limits_ = false;
  double fraction_ = 0;
  std::chrono::steady_clock::time_point start_, last_;
  std::thread watch_;  // the last: it reads the others
};

}  // namespace shakedown
