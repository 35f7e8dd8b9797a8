// SPDX-License-Identifier: MIT
// A user's formula in x, v, t and named constants. The one place that opens muParser.
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace shakedown {

/// Why a formula cannot be used.
struct FormulaProblem {
  std::string problem;
  std::size_t position = 0;  ///< from 1 within the formula; 0: the formula as a whole
};

/// A copy has a parser of its own, so copies may work in different threads; one Formula serves one thread.
class Formula {
 public:
  /// Throws FormulaProblem.
  Formula(const std::string& text, const std::map<std::string, double>& constants);
  Formula(const Formula& other);
  Formula& operator=(const Formula& other);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// x in m, v in m/s, t in s.
  double operator()(double x, double v, double t) const;
  /// True when the formula contains this variable ("x", "v" or "t").
  bool uses(const std::string& variable) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace shakedown
