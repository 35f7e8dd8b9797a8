// SPDX-License-Identifier: MIT
#include "formula.hpp"

#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <mutex>
#include <utility>
#include <vector>

#include "suggestion.hpp"

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

void define_lent_functions(mu::Parser& parser) {
  LentFunctions& all = lent_functions();
  const std::lock_guard lock(all.mutex);
  for (auto& [name, function] : all.by_name) parser.DefineFunUserData(name, &call_lent, &function, false);
}

}  // namespace

struct Formula::Parser {
  std::string text;
  std::map<std::string, double> constants;
  double x = 0, v = 0, t = 0;
  mu::Parser parser{};

  Parser(const std::string& formula, const std::map<std::string, double>& named)
      : text(formula), constants(named) {
    parser.DefineVar("x", &x);
    parser.DefineVar("v", &v);
    parser.DefineVar("t", &t);
    for (const auto& [name, value] : constants) parser.DefineConst(name, value);
    define_lent_functions(parser);
    parser.SetExpr(text);
  }
};

namespace {

/// The identifiers that a formula may use, for "did you mean".
std::string suggestion_for(const std::string& word, const std::map<std::string, double>& constants) {
  std::vector<std::string_view> names{"x",    "v",     "t",    "sin",  "cos", "tan", "exp",
                                      "log",  "ln",    "sqrt", "abs",  "min", "max", "sign",
                                      "tanh", "atan2", "cosh", "sinh", "_pi"};
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
                          const std::map<std::string, double>& constants) {
  const std::size_t position = std::min(static_cast<std::size_t>(error.GetPos()), text.size()) + 1;
  if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN)
    return {"'" + error.GetToken() + "' is neither x, v, t, a constant nor a function" +
                suggestion_for(error.GetToken(), constants),
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

Formula::Formula(const std::string& text, const std::map<std::string, double>& constants) {
  for (const auto& [name, value] : constants)
    if (!is_name(name))
      throw FormulaProblem{
          "the constant '" + name +
              "' has a name that no formula can hold; take letters, digits and _, a letter first",
          0};
  for (const auto& [name, value] : constants)
    if (name == "x" || name == "v" || name == "t")
      throw FormulaProblem{"the constant '" + name + "' has the name of a variable", 0};
  if (text.find('=') != text.npos && text.find("==") == text.npos && text.find("<=") == text.npos &&
      text.find(">=") == text.npos && text.find("!=") == text.npos)
    throw FormulaProblem{"holds an assignment; write the force alone", text.find('=') + 1};
  try {
    parser_ = std::make_unique<Parser>(text, constants);
    int results = 0;
    parser_->parser.Eval(results);
    if (results != 1)
      throw FormulaProblem{
          "gives " + std::to_string(results) + " values, one is expected (the decimal sign is a point)", 0};
  } catch (const mu::ParserError& error) {
    throw problem_of(error, text, constants);
  }
}

Formula::Formula(const Formula& other)
    : parser_(std::make_unique<Parser>(other.parser_->text, other.parser_->constants)) {}
Formula& Formula::operator=(const Formula& other) {
  if (this != &other) parser_ = std::make_unique<Parser>(other.parser_->text, other.parser_->constants);
  return *this;
}
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;
Formula::~Formula() = default;

double Formula::operator()(double x, double v, double t) const {
  parser_->x = x;
  parser_->v = v;
  parser_->t = t;
  return parser_->parser.Eval();
}

bool Formula::uses(const std::string& variable) const {
  return parser_->parser.GetUsedVar().contains(variable);
}

}  // namespace shakedown
