// SPDX-License-Identifier: MIT
// shakedown bounce: from drops of a ball to the law of restitution.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "bounce_answer.hpp"
#include "bounce_report.hpp"
#include "command.hpp"
#include "drop_question.hpp"
#include "json_output.hpp"
#include "kept_files.hpp"
#include "output_file.hpp"
#include "report_output.hpp"

namespace shakedown {

namespace {

struct BounceArguments {
  DropQuestion question;
  std::string known, contact = "grain_wall";
  JsonOutput json;
  ReportOutput report;
};

int bounce(const BounceArguments& arguments) {
  if (arguments.contact != "grain_wall" && arguments.contact != "grain_grain")
    throw InputError(
        {{{}, "--contact", "'" + arguments.contact + "' is no contact", "grain_wall or grain_grain"}});
  for (const std::string& file : arguments.question.files) keep_unchanged(file);
  arguments.json.check();
  arguments.report.check();
  if (!arguments.known.empty()) expect_writable(arguments.known);
  const BounceReading reading = answer_of(arguments.question);
  fmt::print(arguments.json.for_people(), "{}", bounce_text(reading));
  if (!arguments.known.empty()) {
    write_file(arguments.known, known_lines(reading, arguments.contact));
    fmt::print(arguments.json.for_people(), "wrote {}\n", arguments.known);
  }
  if (arguments.report.wanted(""))
    fmt::print(arguments.json.for_people(), "{}", arguments.report.write(report_of(reading), ""));
  arguments.json.write(drops_json(reading));
  return reading.answer.holds() ? exit_done : exit_model_rejected;
}

void add_reading_options(CLI::App& command, BounceArguments& arguments) {
  command
      .add_option("--as", arguments.question.as,
                  "intervals between impacts, instants of impacts, track (clock and height) or sound")
      ->type_name("KIND")
      ->check(CLI::IsMember({"intervals", "instants", "track", "sound"}));
  command
      .add_option("--column", arguments.question.columns, "header of a column with times; may be repeated")
      ->type_name("NAME")
      ->expected(1)
      ->take_all();
  command.add_option("--unit", arguments.question.unit, "unit of the times: s, ms, us")->type_name("UNIT");
  command
      .add_option("--rate", arguments.question.rate,
                  "times are counts (frames, samples) of this clock, \"240 Hz\"")
      ->type_name("RATE");
  command
      .add_option("--timing", arguments.question.timing,
                  "standard deviation of an instant where it is known, \"0.1 ms\"")
      ->type_name("TIME");
}

void add_physics_options(CLI::App& command, BounceArguments& arguments) {
  command.add_option("--mass", arguments.question.mass, "of the ball, for the drag of the air, \"2.7 g\"")
      ->type_name("MASS");
  command.add_option("--diameter", arguments.question.diameter, "of the ball, \"40 mm\"")
      ->type_name("LENGTH");
  command
      .add_option(
          "--height", arguments.question.height,
          "of the fall onto the first impact, of every drop, \"2.5 m +- 5 mm\" (+- 10 mm unless said)")
      ->type_name("LENGTH");
  command.add_option("--gravity", arguments.question.gravity, "9.81 m/s^2 unless said")
      ->type_name("ACCELERATION");
  command
      .add_option("--reference", arguments.question.reference,
                  "speed at which the restitution of a law is told; the middle of those measured unless said")
      ->type_name("SPEED");
}

}  // namespace

Command add_bounce_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("bounce", "from drops of a ball to the law of restitution");
  const auto arguments = std::make_shared<BounceArguments>();
  command
      .add_option(
          "files", arguments->question.files,
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
