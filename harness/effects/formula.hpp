// SPDX-License-Identifier: MIT
// A user's formula in a few variables and named constants. The one place that opens muParser.
#pragma once
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace shakedown {

/// Why a formula cannot be used.
struct FormulaProblem {
  std::string problem;
  std::size_t position = 0;  ///< from 1 within the formula; 0: the formula as a whole
};

/// A function that the program at hand lends to formulas, of Python say; from x in m, v in m/s and t in s. It
/// is called from any thread.
using LentFunction = std::function<double(double x, double v, double t)>;

/// Lets each formula of this process hold name(x, v, t) from now on. A name is lent once; throws
/// FormulaProblem.
void lend_function(const std::string& name, LentFunction function);

/// Returns the variables of a force: position in m, velocity in m/s, time in s.
const std::vector<std::string>& variables_of_a_force();

/// Beside muParser's functions there is curve(x, x1, y1, x2, y2, ...): monotone_cubic() through points whose
/// x ascend. A copy has a parser of its own, so copies may work in different threads; one Formula serves one
/// thread.
class Formula {
 public:
  /// `variables`: at most three names. Throws FormulaProblem.
  Formula(const std::string& text, const std::map<std::string, double>& constants,
          const std::vector<std::string>& variables = variables_of_a_force());
  Formula(const Formula& other);
  Formula& operator=(const Formula& other);
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;
  ~Formula();

  /// Returns the value at these variables in their order, SI; of a force x in m, v in m/s, t in s. Throws
  /// PhysicsError where the points of a curve do not ascend.
  double operator()(double first, double second, double third = 0) const;
  /// Tells whether the formula contains this variable.
  bool uses(const std::string& variable) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace shakedown
