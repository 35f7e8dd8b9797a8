// SPDX-License-Identifier: MIT
#include "lammps_formula.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

namespace shakedown {

namespace {

std::string number(double value) { return fmt::format("({})", value); }

/// Operators of two sides, by rising precedence; longer words before those that they begin with.
const std::array<std::vector<std::string_view>, 5> levels{
    {{"||"}, {"&&"}, {"<=", ">=", "==", "!=", "<", ">"}, {"+", "-"}, {"*", "/"}}};

class Translator {
 public:
  Translator(std::string_view text, const std::map<std::string, double>& constants, const LammpsNames& names)
      : text_(text), constants_(constants), names_(names) {}

  std::string whole() {
    std::string words = condition();
    if (!at_end()) refuse("'" + std::string(text_.substr(at_)) + "' has no words in LAMMPS");
    return words;
  }

 private:
  [[noreturn]] static void refuse(const std::string& problem) { throw LammpsFormulaProblem{problem}; }

  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  bool at_end() {
    skip();
    return at_ == text_.size();
  }
  bool take(std::string_view word) {
    skip();
    if (!text_.substr(at_).starts_with(word)) return false;
    at_ += word.size();
    return true;
  }
  void expect(std::string_view word) {
    if (!take(word)) refuse("'" + std::string(word) + "' is missing");
  }

  std::string condition() {
    const std::string asked = binary(0);
    if (!take("?")) return asked;
    const std::string yes = condition();
    expect(":");
    const std::string no = condition();
    return "((" + asked + "!=0)*" + yes + "+(" + asked + "==0)*" + no + ")";
  }

  /// Reads a chain of operators of one precedence, from the left.
  std::string binary(std::size_t level) {
    if (level == levels.size()) return sign();
    std::string left = binary(level + 1);
    while (true) {
      std::string_view found;
      for (const std::string_view word : levels[level])
        if (found.empty() && take(word)) found = word;
      if (found.empty()) return left;
      left = "(" + left + std::string(found) + binary(level + 1) + ")";
    }
  }

  /// Reads a sign, which binds less than a power.
  std::string sign() {
    if (take("-")) return "(-" + sign() + ")";
    if (take("+")) return sign();
    if (take("!")) refuse("'!' has no words in LAMMPS");
    return power();
  }

  /// Reads powers from the right: 2^3^2 is 2^(3^2).
  std::string power() {
    const std::string base = atom();
    return take("^") ? "(" + base + "^" + sign() + ")" : base;
  }

  std::string atom() {
    if (take("(")) {
      const std::string inside = condition();
      expect(")");
      return "(" + inside + ")";
    }
    const char first = at_end() ? ' ' : text_[at_];
    if (std::isdigit(static_cast<unsigned char>(first)) != 0 || first == '.') return literal();
    std::size_t end = at_;
    while (end < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[end])) != 0 || text_[end] == '_'))
      ++end;
    if (end == at_) refuse("'" + std::string(text_.substr(at_)) + "' has no words in LAMMPS");
    const std::string name(text_.substr(at_, end - at_));
    at_ = end;
    return take("(") ? call(name, arguments()) : named(name);
  }

  std::string literal() {
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc{}) refuse("'" + std::string(text_.substr(at_)) + "' is no number");
    at_ = static_cast<std::size_t>(end - text_.data());
    return number(value);
  }

  std::string named(const std::string& name) const {
    if (name == "x") return names_.x;
    if (name == "v") return names_.v;
    if (name == "t") return names_.t;
    if (name == "_pi") return number(std::numbers::pi);
    if (name == "_e") return number(std::numbers::e);
    const auto found = constants_.find(name);
    if (found == constants_.end()) refuse("'" + name + "' has no words in LAMMPS");
    return number(found->second);
  }

  std::vector<std::string> arguments() {
    std::vector<std::string> all{condition()};
    while (take(",")) all.push_back(condition());
    expect(")");
    return all;
  }

  static std::string smaller(const std::string& a, const std::string& b, const char* than) {
    return "((" + a + than + b + ")*" + a + "+(1-(" + a + than + b + "))*" + b + ")";
  }

  static std::string call(const std::string& name, const std::vector<std::string>& given) {
    const std::string& a = given.front();
    for (const std::string_view same :
         {"sin", "cos", "tan", "asin", "acos", "atan", "exp", "sqrt", "abs", "ln"})
      if (name == same) return name + "(" + a + ")";
    if (name == "log") return "ln(" + a + ")";  // as muParser has it
    if (name == "log10") return "log(" + a + ")";
    if (name == "log2") return "(ln(" + a + ")/" + number(std::numbers::ln2) + ")";
    if (name == "rint") return "round(" + a + ")";
    if (name == "sign") return "((" + a + ">0)-(" + a + "<0))";
    if (name == "sinh") return "((exp(" + a + ")-exp(-" + a + "))/2)";
    if (name == "cosh") return "((exp(" + a + ")+exp(-" + a + "))/2)";
    if (name == "tanh") return "(1-2/(exp(2*" + a + ")+1))";
    if (name == "atan2" && given.size() == 2) return "atan2(" + a + "," + given[1] + ")";
    std::string sum = a;
    for (std::size_t i = 1; i < given.size(); ++i) {
      if (name == "min") sum = smaller(sum, given[i], "<");
      if (name == "max") sum = smaller(sum, given[i], ">");
      if (name == "sum" || name == "avg") sum = "(" + sum + "+" + given[i] + ")";
    }
    if (name == "min" || name == "max" || name == "sum") return sum;
    if (name == "avg") return "(" + sum + "/" + std::to_string(given.size()) + ")";
    refuse("the function '" + name + "' has no words in LAMMPS");
  }

  std::string_view text_;
  const std::map<std::string, double>& constants_;
  const LammpsNames& names_;
  std::size_t at_ = 0;
};

}  // namespace

std::string lammps_formula(const std::string& formula, const std::map<std::string, double>& constants,
                           const LammpsNames& names) {
  return Translator(formula, constants, names).whole();
}

}  // namespace shakedown
