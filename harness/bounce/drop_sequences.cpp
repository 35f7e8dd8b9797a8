// SPDX-License-Identifier: MIT
#include "drop_sequences.hpp"

#include <algorithm>
#include <cmath>

namespace shakedown {

namespace {

// An interval that is longer than the one before by this ratio begins another drop.
constexpr double grows = 1.15;
/// A drop from the same height begins with about the same interval again.
constexpr double again = 0.75;
/// After an interval that holds two flights the next is e^2/(1 + e) of it, less than this.
constexpr double after_two = 0.62;

double ratio_at(const std::vector<double>& x, std::size_t i) {
  return i > 0 && i < x.size() ? x[i] / x[i - 1] : not_said;
}

/// Tells whether interval i is the second part of one in two: their sum follows the interval before as the
/// next follows their sum.
bool is_second_part(const std::vector<double>& x, std::size_t i) {
  if (i < 2 || i + 1 >= x.size()) return false;
  const double whole = x[i - 1] + x[i];
  const double before = whole / x[i - 2], after = x[i + 1] / whole;
  return before < 1.02 && before > 0.4 && std::abs(after / before - 1) < 0.15;
}

bool is_two_flights(const std::vector<double>& x, std::size_t i) {
  if (ratio_at(x, i) > 2.05) return false;
  if (i + 1 >= x.size()) return true;
  return ratio_at(x, i + 1) < after_two && x[i + 1] < x[i - 1];
}

bool begins_drop(const std::vector<double>& x, std::size_t i, bool labelled) {
  if (labelled && x[i] < again * x[0]) return false;
  return ratio_at(x, i) > grows && !is_two_flights(x, i) && !is_second_part(x, i);
}

/// Tells whether the first interval is a fall from rest, which lasts half as long as a flight from the same
/// speed: the first ratio is 2 e, the rest e.
bool begins_with_fall(const std::vector<double>& x) {
  if (x.size() < 3) return false;
  const double first = x[1] / x[0], second = x[2] / x[1];
  return first > 1.0 && first < 2.0 && second < 1.0 && std::abs(first / (2 * second) - 1) < 0.2;
}

void number(std::vector<Drop>& drops, const std::string& name) {
  for (std::size_t i = 0; i < drops.size(); ++i) {
    drops[i].name = name;
    if (drops.size() > 1) drops[i].name += (name.empty() ? "drop " : ", drop ") + std::to_string(i + 1);
  }
}

Drop drop_from(std::vector<double> interval) {
  Drop drop;
  const bool fell = begins_with_fall(interval);
  if (fell) {
    drop.fall = interval.front();
    interval.erase(interval.begin());
  }
  for (std::size_t i = 0; i < interval.size(); ++i) drop.impact.push_back(static_cast<int>(i) + 1);
  drop.interval = std::move(interval);
  return drop;
}

}  // namespace

std::vector<Drop> drops_of_intervals(const std::vector<double>& interval, const std::string& name,
                                     bool labelled) {
  std::vector<Drop> drops;
  std::vector<double> run;
  const auto end = [&](std::size_t count) {
    if (count > 0)
      drops.push_back(drop_from({run.begin(), run.begin() + static_cast<std::ptrdiff_t>(count)}));
    run.erase(run.begin(), run.begin() + static_cast<std::ptrdiff_t>(count));
  };
  for (std::size_t k = 0; k <= interval.size(); ++k) {
    const bool is_number = k < interval.size() && std::isfinite(interval[k]) && interval[k] > 0;
    if (is_number) run.push_back(interval[k]);
    if (is_number && k + 1 < interval.size()) continue;
    for (std::size_t i = 1; i < run.size();) {  // a run without gaps
      const bool fell = i == 1 && begins_with_fall(run);
      if (fell || !begins_drop(run, i, labelled)) {
        ++i;
        continue;
      }
      end(i);
      i = 1;
    }
    end(run.size());
  }
  std::erase_if(drops, [](const Drop& drop) { return drop.interval.empty(); });
  number(drops, name);
  return drops;
}

std::vector<Drop> drops_of_instants(const std::vector<double>& instant, const std::string& name,
                                    bool labelled) {
  std::vector<Drop> drops;
  std::vector<double> interval;
  const auto end = [&] {
    if (!interval.empty()) drops.push_back(drop_from(interval));
    interval.clear();
  };
  double last = not_said;
  std::vector<double> finite;
  for (const double t : instant)
    if (std::isfinite(t)) finite.push_back(t);
  for (std::size_t i = 0; i < finite.size(); ++i) {
    const double gap = finite[i] - last;
    last = finite[i];
    if (i == 0 || gap == 0) continue;
    if (gap < 0) {  // the clock began anew
      end();
      continue;
    }
    std::vector<double> with = interval;
    with.push_back(gap);
    const std::size_t at = with.size() - 1;
    if (i + 1 < finite.size() && finite[i + 1] > finite[i]) with.push_back(finite[i + 1] - finite[i]);
    if (i + 2 < finite.size() && with.size() == at + 2 && finite[i + 2] > finite[i + 1])
      with.push_back(finite[i + 2] - finite[i + 1]);
    const bool fell = at == 1 && begins_with_fall(with);
    if (at > 0 && !fell && begins_drop(with, at, labelled))
      end();  // a pause
    else
      interval.push_back(gap);
  }
  end();
  number(drops, name);
  return drops;
}

}  // namespace shakedown
