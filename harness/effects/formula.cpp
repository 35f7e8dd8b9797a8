// SPDX-License-Identifier: MIT
#include "formula.hpp"

#include <muParser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <mutex>
#include <utility>

#include "errors.hpp"
#include "expect.hpp"
#include "interpolation.hpp"
#include "suggestion.hpp"
#include "text.hpp"

namespace shakedown {

namespace {

/// Functions stay where they are: parsers point at them.
struct LentFunctions {
  std::mutex mutex;
  std::map<std::string, LentFunction> by_name;
};

LentFunctions& lent_functions() {
  static LentFunctions all;
  return all;
}

double call_lent(void* function, double x, double v, double t) {
  return (*static_cast<const LentFunction*>(function))(x, v, t);
}

/// Computes curve(x, x1, y1, x2, y2, ...) for muParser.
double curve(const double* arguments, int count) {
  if (count < 5 || count % 2 == 0)
    throw mu::ParserError("curve takes x and then two points or more: curve(x, x1, y1, x2, y2)");
  const auto points = static_cast<std::size_t>(count - 1) / 2;
  static thread_local std::vector<double> x, y;  // a curve is asked at each impact, or each step
  x.resize(points), y.resize(points);
  for (std::size_t i = 0; i < points; ++i) {
    x[i] = arguments[1 + 2 * i], y[i] = arguments[2 + 2 * i];
    if (i > 0 && !(x[i] > x[i - 1])) throw mu::ParserError("the points of a curve must ascend in x");
  }
  return monotone_cubic(x, y, arguments[0]);
}

void define_lent_functions(mu::Parser& parser) {
  LentFunctions& all = lent_functions();
  const std::lock_guard lock(all.mutex);
  for (auto& [name, function] : all.by_name) parser.DefineFunUserData(name, &call_lent, &function, false);
}

}  // namespace

struct Formula::Parser {
  std::string text;
  std::map<std::string, double> constants;
  std::vector<std::string> variables;
  std::array<double, 3> values{};
  mu::Parser parser{};

  Parser(const std::string& formula, const std::map<std::string, double>& named,
         const std::vector<std::string>& of)
      : text(formula), constants(named), variables(of) {
    EXPECT(variables.size() <= values.size());
    for (std::size_t i = 0; i < variables.size(); ++i) parser.DefineVar(variables[i], &values[i]);
    for (const auto& [name, value] : constants) parser.DefineConst(name, value);
    parser.DefineFun("curve", &curve);
    define_lent_functions(parser);
    parser.SetExpr(text);
  }

  /// Makes another parser of the same formula: muParser's own copies would read the variables of this one.
  std::unique_ptr<Parser> again() const { return std::make_unique<Parser>(text, constants, variables); }
};

namespace {

/// Returns "did you mean ...?" from the identifiers that a formula may use.
std::string suggestion_for(const std::string& word, const std::map<std::string, double>& constants,
                           const std::vector<std::string>& variables) {
  std::vector<std::string_view> names{"sin", "cos",  "tan",  "exp",   "log",  "ln",   "sqrt", "abs",  "min",
                                      "max", "sign", "tanh", "atan2", "cosh", "sinh", "_pi",  "curve"};
  names.insert(names.end(), variables.begin(), variables.end());
  for (const auto& [name, value] : constants) names.emplace_back(name);
  const std::string_view near = nearest(word, names);
  return near.empty() ? "" : "; did you mean " + std::string(near) + "?";
}

bool is_name(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !name.empty() && letter(name.front()) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || (c >= '0' && c <= '9'); });
}

FormulaProblem problem_of(const mu::ParserError& error, const std::string& text,
                          const std::map<std::string, double>& constants,
                          const std::vector<std::string>& variables) {
  const std::size_t position = std::min(static_cast<std::size_t>(error.GetPos()), text.size()) + 1;
  if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
    return {"'" + error.GetToken() + "' is neither " + joined(variables) + ", a constant nor a function" +
                suggestion_for(error.GetToken(), constants, variables),
            position};
  std::string message = error.GetMsg();
  while (!message.empty() && message.back() == '.') message.pop_back();
  if (!message.empty())
    message.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(message.front())));
  return {message, position};
}

}  // namespace

void lend_function(const std::string& name, LentFunction function) {
  if (!is_name(name))
    throw FormulaProblem{
        "no formula can hold a function of the name '" + name + "'; take letters, digits and _", 0};
  LentFunctions& all = lent_functions();
  const std::lock_guard lock(all.mutex);
  if (!all.by_name.try_emplace(name, std::move(function)).second)
    throw FormulaProblem{"the function '" + name + "' is lent already", 0};
}

const std::vector<std::string>& variables_of_a_force() {
  static const std::vector<std::string> names{"x", "v", "t"};
  return names;
}

Formula::Formula(const std::string& text, const std::map<std::string, double>& constants,
                 const std::vector<std::string>& variables) {
  for (const auto& [name, value] : constants)
    if (!is_name(name))
      throw FormulaProblem{
          "the constant '" + name +
              "' has a name that no formula can hold; take letters, digits and _, a letter first",
          0};
  for (const auto& [name, value] : constants)
    if (std::find(variables.begin(), variables.end(), name) != variables.end())
      throw FormulaProblem{"the constant '" + name + "' has the name of a variable", 0};
  if (text.find('=') != text.npos && text.find("==") == text.npos && text.find("<=") == text.npos &&
      text.find(">=") == text.npos && text.find("!=") == text.npos)
    throw FormulaProblem{"holds an assignment; write the formula alone", text.find('=') + 1};
  try {
    parser_ = std::make_unique<Parser>(text, constants, variables);
    int results = 0;
    parser_->parser.Eval(results);
    if (results != 1)
      throw FormulaProblem{
          "gives " + std::to_string(results) + " values, one is expected (the decimal sign is a point)", 0};
  } catch (const mu::ParserError& error) {
    throw problem_of(error, text, constants, variables);
  }
}

Formula::Formula(const Formula& other) : parser_(other.parser_->again()) {}
Formula& Formula::operator=(const Formula& other) {
  if (this != &other) parser_ = other.parser_->again();
  return *this;
}
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;
Formula::~Formula() = default;

double Formula::operator()(double first, double second, double third) const {
  parser_->values = {first, second, third};
  try {
    return parser_->parser.Eval();
  } catch (const mu::ParserError& error) {
    throw PhysicsError("\"" + parser_->text + "\": " +
                       problem_of(error, parser_->text, parser_->constants, parser_->variables).problem);
  }
}

bool Formula::uses(const std::string& variable) const {
  return parser_->parser.GetUsedVar().contains(variable);
}

}  // namespace shakedown
