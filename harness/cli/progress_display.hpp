// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <functional>
#include <string>

namespace shakedown {

/// A bar on a terminal, one plain line at the first sign of progress otherwise; on standard error. The bar is
/// wiped when the display goes out of scope.
class ProgressDisplay {
 public:
  explicit ProgressDisplay(const std::string& what);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// fraction: 0 to 1.
  void show(double fraction);
  /// Changes what the bar says is being done; without a terminal the new stage gets a line with the time so
  /// far.
  void rename(const std::string& what);

 private:
  void announce();  ///< once, where the output is no terminal

  std::string what_;
  bool terminal_, announced_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

}  // namespace shakedown
