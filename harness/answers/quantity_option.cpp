// SPDX-License-Identifier: MIT
#include "quantity_option.hpp"

#include <fmt/format.h>

#include "errors.hpp"
#include "quantity.hpp"

namespace shakedown {

double quantity_option(const char* option, const std::string& text, std::string_view unit, double otherwise,
                       std::string_view example) {
  if (text.empty()) return otherwise;
  const auto refuse = [&](const std::string& problem) {
    throw InputError(
        {{{},
          option,
          "'" + text + "' " + problem,
          fmt::format("write a number with its unit, e.g. {} \"{} {}\"", option, example, unit)}});
  };
  const ValueOrReason<Quantity> read = parse_quantity(text);
  if (const std::string* reason = std::get_if<std::string>(&read)) refuse(*reason);
  const Quantity& quantity = std::get<Quantity>(read);
  const Dimension dimension = std::get<Unit>(parse_unit(unit)).dimension;
  if (quantity.dimension != dimension)
    refuse("is " + describe(quantity.dimension) + ", not " + describe(dimension));
  return quantity.si;
}

}  // namespace shakedown
