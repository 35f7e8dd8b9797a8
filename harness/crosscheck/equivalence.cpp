// SPDX-License-Identifier: MIT
#include "equivalence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "distributions.hpp"
#include "errors.hpp"

namespace shakedown {

namespace {

/// Returns the degrees of freedom by Welch and Satterthwaite; `first` and `second` are the squared standard
/// errors of the means.
double welch_degrees_of_freedom(double first, int first_n, double second, int second_n) {
  const double sum = first + second;
  return sum * sum / (first * first / (first_n - 1) + second * second / (second_n - 1));
}

Agreement verdict_of(const Equivalence& found) {
  if (found.low >= -found.margin && found.high <= found.margin) return Agreement::equivalent;
  if (found.low > found.margin || found.high < -found.margin) return Agreement::differ;
  return Agreement::cannot_tell;
}

}  // namespace

const char* to_string(Agreement verdict) {
  switch (verdict) {
    case Agreement::equivalent: return "equivalent";
    case Agreement::differ: return "differ";
    case Agreement::cannot_tell: return "cannot tell";
    case Agreement::no_number: return "no such number";
  }
  EXPECT(false && "a verdict");
  return "";
}

Equivalence equivalence_of(const Statistic& first, const Statistic& second, double margin) {
  EXPECT(margin >= 0);
  Equivalence found;
  found.margin = margin;
  if (first.n == 0 && second.n == 0) return found;
  found.verdict = Agreement::cannot_tell;
  found.difference = first.mean - second.mean;
  if (first.n < 2 || second.n < 2) return found;
  const double a = first.sd * first.sd / first.n, b = second.sd * second.sd / second.n;
  found.standard_error = std::sqrt(a + b);
  double half = 0;
  if (a + b > 0)
    half = found.standard_error *
           student_95(std::clamp(welch_degrees_of_freedom(a, first.n, b, second.n), 1.0, 1e6));
  found.low = found.difference - half;
  found.high = found.difference + half;
  found.verdict = verdict_of(found);
  const double room = std::abs(margin - std::abs(found.difference));
  if (found.verdict == Agreement::cannot_tell && room > 0)
    found.runs_needed = std::ceil(std::min(first.n, second.n) * std::pow(half / room, 2));
  return found;
}

std::string in_words(const Equivalence& found) {
  switch (found.verdict) {
    case Agreement::differ:
      if (found.standard_error > 0)
        return fmt::format("differ by {:.1f} standard errors",
                           std::abs(found.difference) / found.standard_error);
      return "differ (no spread over the runs)";
    case Agreement::cannot_tell:
      if (found.runs_needed > 0 && found.runs_needed < 1e5)
        return fmt::format("cannot tell: more runs (about {:.0f})", found.runs_needed);
      return "cannot tell: more runs";
    default: return to_string(found.verdict);
  }
}

}  // namespace shakedown
