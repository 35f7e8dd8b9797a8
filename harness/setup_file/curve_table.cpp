// SPDX-License-Identifier: MIT
#include "curve_table.hpp"

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <vector>

#include "errors.hpp"
#include "kept_files.hpp"
#include "quantity.hpp"
#include "text.hpp"

namespace shakedown {

namespace {

/// A curve through more points than this takes longer than the run that it acts in.
constexpr std::size_t most_points = 1000;

class TableReader {
 public:
  TableReader(const std::filesystem::path& file, std::string_view value)
      : file_(file.string()), value_(value) {}

  std::string formula() {
    keep_unchanged(file_);
    std::ifstream lines(file_);
    if (!lines) refuse(0, "cannot be read", "check the path and its permissions");
    for (std::string line; std::getline(lines, line);) {
      ++number_;
      const std::string_view bare = trimmed(line);
      if (!bare.empty() && bare.front() != '#') take(bare);
    }
    if (points_ < 2) refuse(0, "has fewer than two points", "give two lines of numbers or more");
    return formula_ + ")";
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& problem, const std::string& remedy) const {
    throw InputError({{{file_, line, line > 0 ? 1 : 0}, "", problem, remedy}});
  }

  void take(std::string_view line) {
    const std::size_t comma = line.find(',');
    if (comma == line.npos)
      refuse(number_, "has one column", "write a header such as x," + value_ + " and two numbers a line");
    const std::string_view rest = line.substr(comma + 1);
    const std::string_view first = trimmed(line.substr(0, comma)),
                           second = trimmed(rest.substr(0, rest.find(',')));
    formula_.empty() ? begin(first, second) : add(number_in(first), number_in(second));
  }

  void begin(std::string_view variable, std::string_view value) {
    if (variable.empty() || !std::isalpha(static_cast<unsigned char>(variable.front())) || !is_known(value))
      refuse(number_, "does not name its columns", "write the variable and " + value_ + ", e.g. x," + value_);
    formula_ = std::string(value == value_ ? "" : factor_of(value)) + "curve(" + std::string(variable);
  }

  /// Returns what the curve is multiplied by to be a force.
  static std::string_view factor_of(std::string_view value) {
    return value == "damping"     ? "-v*"
           : value == "stiffness" ? "-x*"
           : value == "friction"  ? "-tanh(v/0.001)*"
                                  : "";
  }

  bool is_known(std::string_view value) const {
    return value == value_ || (value_ == "force" && !factor_of(value).empty());
  }

  double number_in(std::string_view cell) const {
    double number = 0;
    std::stringstream text{std::string(cell)};
    text >> number;
    if (text.fail() || !text.eof() || !std::isfinite(number))
      refuse(number_, "holds " + printable(cell) + " (a number is expected)",
             "write numbers in SI, e.g. 0.012");
    return number;
  }

  void add(double place, double value) {
    if (points_ > 0 && !(place > last_))
      refuse(number_, "does not ascend (" + write_number(place) + " after " + write_number(last_) + ")",
             "sort the lines by the first column and leave out doubles");
    if (++points_ > most_points)
      refuse(number_, "has more than " + std::to_string(most_points) + " points", "thin it out");
    last_ = place;
    formula_ += ", " + write_number(place) + ", " + write_number(value);
  }

  std::string file_, value_, formula_;
  int number_ = 0;
  std::size_t points_ = 0;
  double last_ = 0;
};

}  // namespace

std::string curve_through_table(const std::filesystem::path& file, std::string_view value) {
  return TableReader(file, value).formula();
}

}  // namespace shakedown
