// SPDX-License-Identifier: MIT
// Runs the same setup through several engines and tells what each makes of it and where they agree.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "ensemble.hpp"
#include "equivalence.hpp"
#include "execution.hpp"
#include "setup.hpp"

namespace shakedown {

/// A number of a run, as it is compared and reported.
struct CrosscheckNumber {
  enum class Judged { no, slope, frequency, share };  ///< by which margin

  const char* key;    ///< "slope_mm_per_s"
  const char* label;  ///< for people
  const char* unit;   ///< in which it is reported; the number itself is SI
  double per_si;      ///< that unit's number for 1 in SI
  Judged judged;
  double (*of)(const RunResult& run);
};

/// Returns all numbers that are compared, in the order of every report.
std::span<const CrosscheckNumber> crosscheck_numbers();

/// Largest difference of two engines that counts as none.
struct Margins {
  std::optional<double> slope;  ///< m/s; empty: by length of the box, see slope_margin
  double frequency = 0.003;     ///< Hz
  double share = 0.01;          ///< of the initial energy, each class of contact
};

/// Returns the margin of the slope, m/s: 0.10, 0.5, 0.6, 0.8 mm/s for a box of 40, 65, 85, 104 mm, the
/// paper's; 3 % of the slope for others.
double slope_margin(const Margins& margins, double box_length, double slope);

/// What one engine made of a setup.
struct EngineResult {
  std::string engine;
  int runs = 0;
  std::vector<Statistic> numbers;  ///< in the order of crosscheck_numbers, SI
  std::vector<Statistic> peaks;    ///< m, signed; only those that every run has
};

struct Comparison {
  std::string first, second;  ///< engines
  const CrosscheckNumber* number = nullptr;
  Equivalence found;  ///< first - second, SI
};

/// The soft engine towards contact time 0: a straight line through the means, weighted by their errors.
struct ContactTimeLimit {
  std::vector<double> contact_times;  ///< s
  std::vector<EngineResult> results;  ///< one a contact time
  struct Value {
    const CrosscheckNumber* number = nullptr;
    double at_zero = 0, error = 0;  ///< SI, one standard error; NaN when a mean or an error is missing
    double chi_squared = 0;         ///< of the line, results.size() - 2 degrees of freedom
    Statistic hard;                 ///< of the hard engine, for comparison
    /// Returns (at_zero - hard) in units of both standard errors; NaN when there is no such number.
    double deviation() const;
  };
  std::vector<Value> values;  ///< of the judged numbers
};

struct CrosscheckOptions {
  std::vector<std::string> engines{"hard", "soft"};
  Margins margins;
  std::vector<double> contact_times;  ///< s, for the limit; empty: no limit
  int runs = 8;
  Execution execution{.threads = 1};
  std::function<void(double fraction)> progress;
};

struct Crosscheck {
  std::string name;  ///< of the setup
  double duration = 0;
  std::vector<EngineResult> engines;
  std::vector<Comparison> comparisons;  ///< of every pair, numbers that neither has left out
  std::optional<ContactTimeLimit> limit;

  /// Tells whether some comparison found this.
  bool any(Agreement verdict) const;
};

/// Runs and compares the engines. Throws InputError for what an engine does not model or a name that is none,
/// what engines throw, and Interrupted.
Crosscheck crosscheck(const std::string& name, const Setup& setup, const CrosscheckOptions& options);

/// A weighted straight line through (x, y +- error): value and standard error at x = 0, and chi^2.
struct LineAtZero {
  double value, error, chi_squared;
};
/// Fits the line. `errors`: standard deviations of y, above 0; at least two points, at two different x.
LineAtZero line_at_zero(std::span<const double> x, std::span<const double> y, std::span<const double> errors);

}  // namespace shakedown
