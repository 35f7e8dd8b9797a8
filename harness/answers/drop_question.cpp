// SPDX-License-Identifier: MIT
#include "drop_question.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "drop_tables.hpp"
#include "missing_numbers.hpp"
#include "quantity_option.hpp"

namespace shakedown {

namespace {

/// Returns the quantity of an option in SI, more than 0; `none` where the option is not given.
double quantity_of(const char* option, const std::string& text, const char* unit, double none) {
  const double value = quantity_option(option, text, unit, none);
  if (!text.empty() && !(value > 0))
    throw InputError({{{},
                       option,
                       "'" + text + "' must be more than 0",
                       fmt::format("write a number with its unit, e.g. {} \"1 {}\"", option, unit)}});
  return value;
}

/// Holds "2.5 m" or "2.5 m +- 5 mm", in m.
struct Height {
  double value = not_said, error = 0.01;
};
Height height_of(const std::string& text) {
  const std::size_t sign = text.find("+-");
  Height height;
  height.value = quantity_of("--height", text.substr(0, sign), "m", not_said);
  if (sign != std::string::npos)
    height.error = quantity_of("--height", text.substr(sign + 2), "m", height.error);
  return height;
}

DropReading reading_of(const DropQuestion& question, const Height& height) {
  DropReading reading;
  reading.as = question.as;
  reading.columns = question.columns;
  reading.unit = question.unit;
  reading.rate = quantity_of("--rate", question.rate, "Hz", 0);
  reading.gravity = quantity_of("--gravity", question.gravity, "m/s^2", 9.81);
  reading.height = height.value;
  return reading;
}

BounceOptions options_of(const DropQuestion& question, const Height& height, const ReadDrops& read) {
  BounceOptions options;
  options.gravity = quantity_of("--gravity", question.gravity, "m/s^2", 9.81);
  options.ball = {quantity_of("--mass", question.mass, "g", 0),
                  quantity_of("--diameter", question.diameter, "mm", 0)};
  if ((options.ball.mass > 0) != (options.ball.diameter > 0))
    throw InputError({{{},
                       options.ball.mass > 0 ? "--mass" : "--diameter",
                       "stands alone (the drag of the air needs size and mass)",
                       "give --mass and --diameter, or neither"}});
  options.height_error = height.error;
  options.reference = quantity_of("--reference", question.reference, "m/s", 0);
  options.timing.deviation = quantity_of("--timing", question.timing, "ms", not_said);
  for (const Drop& drop : read.drops)
    options.timing.resolution = std::max(options.timing.resolution, drop.resolution);
  return options;
}

std::string why_missing(const std::string& path) {
  if (path.find("height_m") != std::string::npos) return "not said";
  if (path.find("by_timing") != std::string::npos) return "no --timing was given";
  if (path.find("p_value") != std::string::npos) return "too few impacts to test a law";
  if (path.find("scatter") != std::string::npos || path.find("timing") != std::string::npos)
    return "what was measured speaks for no such spread";
  return "";
}

}  // namespace

BounceReading answer_of(const DropQuestion& question) {
  const Height height = height_of(question.height);
  const DropReading how = reading_of(question, height);
  ReadDrops read;
  for (const std::string& file : question.files) {
    ReadDrops one = read_drops(file, how);
    std::move(one.drops.begin(), one.drops.end(), std::back_inserter(read.drops));
    std::move(one.notes.begin(), one.notes.end(), std::back_inserter(read.notes));
    std::move(one.sounds.begin(), one.sounds.end(), std::back_inserter(read.sounds));
  }
  const BounceOptions options = options_of(question, height, read);
  return weigh_drops(std::move(read), options);
}

std::string drops_json(const BounceReading& reading) {
  nlohmann::ordered_json document = bounce_json(reading);
  explain_missing_numbers(document, why_missing);
  return document.dump(2) + "\n";
}

}  // namespace shakedown
