// SPDX-License-Identifier: MIT
// shakedown bounce: from drops of a ball to the law of restitution.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bounce_answer.hpp"
#include "bounce_report.hpp"
#include "command.hpp"
#include "json_output.hpp"
#include "kept_files.hpp"
#include "missing_numbers.hpp"
#include "output_file.hpp"
#include "quantity_option.hpp"
#include "report_output.hpp"

namespace shakedown {

namespace {

struct BounceArguments {
  std::vector<std::string> files, columns;
  std::string as, unit, rate, mass, diameter, height, timing, gravity, reference;
  std::string known, contact = "grain_wall";
  JsonOutput json;
  ReportOutput report;
};

/// A quantity of an option in SI, more than 0; `none` where the option is not given.
double quantity_of(const char* option, const std::string& text, const char* unit, double none) {
  const double value = quantity_option(option, text, unit, none);
  if (!text.empty() && !(value > 0))
    throw InputError({{{},
                       option,
                       "'" + text + "' must be more than 0",
                       fmt::format("write a number with its unit, e.g. {} \"1 {}\"", option, unit)}});
  return value;
}

/// "2.5 m" or "2.5 m +- 5 mm".
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

DropReading reading_of(const BounceArguments& arguments, const Height& height) {
  DropReading reading;
  reading.as = arguments.as;
  reading.columns = arguments.columns;
  reading.unit = arguments.unit;
  reading.rate = quantity_of("--rate", arguments.rate, "Hz", 0);
  reading.gravity = quantity_of("--gravity", arguments.gravity, "m/s^2", 9.81);
  reading.height = height.value;
  return reading;
}

BounceOptions options_of(const BounceArguments& arguments, const Height& height, const ReadDrops& read) {
  BounceOptions options;
  options.gravity = quantity_of("--gravity", arguments.gravity, "m/s^2", 9.81);
  options.ball = {quantity_of("--mass", arguments.mass, "g", 0),
                  quantity_of("--diameter", arguments.diameter, "mm", 0)};
  if ((options.ball.mass > 0) != (options.ball.diameter > 0))
    throw InputError({{{},
                       options.ball.mass > 0 ? "--mass" : "--diameter",
                       "stands alone (the drag of the air needs size and mass)",
                       "give --mass and --diameter, or neither"}});
  options.height_error = height.error;
  options.reference = quantity_of("--reference", arguments.reference, "m/s", 0);
  options.timing.deviation = quantity_of("--timing", arguments.timing, "ms", not_said);
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

int bounce(const BounceArguments& arguments) {
  if (arguments.contact != "grain_wall" && arguments.contact != "grain_grain")
    throw InputError(
        {{{}, "--contact", "'" + arguments.contact + "' is no contact", "grain_wall or grain_grain"}});
  const Height height = height_of(arguments.height);
  const DropReading how = reading_of(arguments, height);
  for (const std::string& file : arguments.files) keep_unchanged(file);
  arguments.json.check();
  arguments.report.check();
  if (!arguments.known.empty()) expect_writable(arguments.known);
  ReadDrops read;
  for (const std::string& file : arguments.files) {
    ReadDrops one = read_drops(file, how);
    std::move(one.drops.begin(), one.drops.end(), std::back_inserter(read.drops));
    std::move(one.notes.begin(), one.notes.end(), std::back_inserter(read.notes));
    std::move(one.sounds.begin(), one.sounds.end(), std::back_inserter(read.sounds));
  }
  const BounceOptions options = options_of(arguments, height, read);
  const BounceReading reading = weigh_drops(std::move(read), options);
  fmt::print(arguments.json.for_people(), "{}", bounce_text(reading));
  if (!arguments.known.empty()) {
    write_file(arguments.known, known_lines(reading, arguments.contact));
    fmt::print(arguments.json.for_people(), "wrote {}\n", arguments.known);
  }
  if (arguments.report.wanted(""))
    fmt::print(arguments.json.for_people(), "{}", arguments.report.write(report_of(reading), ""));
  nlohmann::ordered_json document = bounce_json(reading);
  explain_missing_numbers(document, why_missing);
  arguments.json.write(document.dump(2) + "\n");
  return reading.answer.holds() ? exit_done : exit_model_rejected;
}

void add_reading_options(CLI::App& command, BounceArguments& arguments) {
  command
      .add_option("--as", arguments.as,
                  "intervals between impacts, instants of impacts, track (clock and height) or sound")
      ->type_name("KIND")
      ->check(CLI::IsMember({"intervals", "instants", "track", "sound"}));
  command.add_option("--column", arguments.columns, "header of a column with times; may be repeated")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  command.add_option("--unit", arguments.unit, "unit of the times: s, ms, us")->type_name("UNIT");
  command
      .add_option("--rate", arguments.rate, "times are counts (frames, samples) of this clock, \"240 Hz\"")
      ->type_name("RATE");
  command
      .add_option("--timing", arguments.timing,
                  "standard deviation of an instant where it is known, \"0.1 ms\"")
      ->type_name("TIME");
}

void add_physics_options(CLI::App& command, BounceArguments& arguments) {
  command.add_option("--mass", arguments.mass, "of the ball, for the drag of the air, \"2.7 g\"")
      ->type_name("MASS");
  command.add_option("--diameter", arguments.diameter, "of the ball, \"40 mm\"")->type_name("LENGTH");
  command
      .add_option(
          "--height", arguments.height,
          "of the fall onto the first impact, of every drop, \"2.5 m +- 5 mm\" (+- 10 mm unless said)")
      ->type_name("LENGTH");
  command.add_option("--gravity", arguments.gravity, "9.81 m/s^2 unless said")->type_name("ACCELERATION");
  command
      .add_option("--reference", arguments.reference,
                  "speed at which the restitution of a law is told; the middle of those measured unless said")
      ->type_name("SPEED");
}

}  // namespace

Command add_bounce_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("bounce", "from drops of a ball to the law of restitution");
  const auto arguments = std::make_shared<BounceArguments>();
  command
      .add_option(
          "files", arguments->files,
          "tables of intervals or instants of impacts, tracks of a falling ball, sounds (WAV, FLAC, OGG)")
      ->required();
  add_reading_options(command, *arguments);
  add_physics_options(command, *arguments);
  command
      .add_option("--known", arguments->known, "write the lines for [known] of an experiment, and the law")
      ->type_name("FILE");
  command.add_option("--contact", arguments->contact, "what the lines are of: grain_wall or grain_grain")
      ->type_name("NAME")
      ->capture_default_str();
  add_report_option(command, arguments->report);
  add_json_option(command, arguments->json);
  command.footer(
      "Without --mass and --diameter the restitutions hold what the air takes, and air of an unknown drag "
      "is\n"
      "one of the hypotheses. Exit code 0: the most probable law holds. 1: it does not, or it is none of the "
      "list.");
  return {&command, [arguments] { return bounce(*arguments); }};
}

}  // namespace shakedown
