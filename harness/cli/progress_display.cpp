// SPDX-License-Identifier: MIT
#include "progress_display.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace shakedown {

namespace {

constexpr auto between_updates = std::chrono::milliseconds(100);
constexpr int width = 30;
constexpr auto first_line = std::chrono::seconds(10);

std::string rest(double spent, double fraction) {
  const double seconds = spent * (1 - fraction) / fraction;
  if (seconds < 120) return fmt::format("{:.0f} s left", seconds);
  return seconds < 7200 ? fmt::format("{:.0f} min left", seconds / 60)
                        : fmt::format("{:.3g} h left", seconds / 3600);
}

/// Prints a text on standard error; a full disk behind it takes away the text, not the result.
void tell(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace

ProgressDisplay::ProgressDisplay(const std::string& what, std::chrono::milliseconds patience)
    : what_(what),
      terminal_(::isatty(STDERR_FILENO) == 1),
      start_(std::chrono::steady_clock::now()),
      last_(start_),
      watch_([this, patience] { wait(patience); }) {}

ProgressDisplay::~ProgressDisplay() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  ended_.notify_one();
  watch_.join();
  if (terminal_) tell("\r\033[K");
}

void ProgressDisplay::wait(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  const auto over = [this] { return over_; };
  if (ended_.wait_for(lock, patience, over)) return;
  announce();
  if (terminal_) return;
  for (auto line = start_ + first_line; !ended_.wait_until(lock, line, over); line += line - start_)
    tell_how_far();
}

void ProgressDisplay::tell_how_far() {
  const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  tell(fmt::format("{:6.0f} s  {}: {}\n", spent, what_,
                   of_limits_      ? fmt::format("{:.3g} % of the limits used", 100 * fraction_)
                   : fraction_ > 0 ? fmt::format("{:.3g} % done, {}", 100 * fraction_, rest(spent, fraction_))
                                   : "still in its first steps"));
}

void ProgressDisplay::rename(const std::string& what) {
  const std::lock_guard lock(mutex_);
  if (what == what_) return;
  announce();
  what_ = what;
  if (!terminal_)
    tell(fmt::format("{:6.1f} s  {}\n",
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(),
                     what_));
}

void ProgressDisplay::announce() {
  if (!announced_) tell(terminal_ ? "\r\033[K" + what_ : what_ + "\n");
  announced_ = true;
}

void ProgressDisplay::show(double fraction) {
  const std::lock_guard lock(mutex_);
  announce();
  fraction = fraction_ = std::clamp(fraction, 0.0, 1.0);
  const auto now = std::chrono::steady_clock::now();
  if (!terminal_ || now - last_ < between_updates) return;
  last_ = now;
  const double spent = std::chrono::duration<double>(now - start_).count();
  const auto filled = static_cast<std::size_t>(width * fraction);
  std::string text = fmt::format("\r\033[K{} [{}{}] {:.0f} %", what_, std::string(filled, '='),
                                 std::string(width - filled, ' '), 100 * fraction);
  if (of_limits_)
    text += " of the limits";
  else if (fraction > 0.02)
    text += ", " + rest(spent, fraction);
  tell(text);
}

}  // namespace shakedown
