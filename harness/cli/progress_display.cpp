// SPDX-License-Identifier: MIT
#include "progress_display.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

namespace shakedown {

namespace {
constexpr auto between_updates = std::chrono::milliseconds(100);
constexpr int width = 30;
}  // namespace

ProgressDisplay::ProgressDisplay(const std::string& what)
    : what_(what),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      last_(start_) {}

ProgressDisplay::~ProgressDisplay() {
  if (terminal_) std::fputs("\r\033[K", stderr);
}

void ProgressDisplay::rename(const std::string& what) {
  if (what == what_) return;
  announce();
  what_ = what;
  if (!terminal_)
    fmt::print(stderr, "{:6.1f} s  {}\n",
               std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(), what_);
}

void ProgressDisplay::announce() {
  if (!terminal_ && !announced_) fmt::print(stderr, "{}\n", what_), std::fflush(stderr);
  announced_ = true;
}

void ProgressDisplay::show(double fraction) {
  announce();
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now - last_ < between_updates) return;
  last_ = now;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const double spent = std::chrono::duration<double>(now - start_).count();
  const int filled = static_cast<int>(width * fraction);
  fmt::print(stderr, "\r\033[K{} [{}{}] {:.0f} %", what_, std::string(static_cast<std::size_t>(filled), '='),
             std::string(static_cast<std::size_t>(width - filled), ' '), 100 * fraction);
  if (fraction > 0.02) fmt::print(stderr, ", {:.0f} s left", spent * (1 - fraction) / fraction);
  std::fflush(stderr);
}

}  // namespace shakedown
