// SPDX-License-Identifier: MIT
// shakedown plot: a figure for a paper from results.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <string>

#include "command.hpp"
#include "drawing.hpp"
#include "drawn_figure.hpp"
#include "errors.hpp"
#include "output_file.hpp"
#include "result_figures.hpp"

namespace shakedown {

namespace {

struct PlotArguments {
  std::string result, out, width = "column";
  FigureRequest request;
};

int plot(const PlotArguments& arguments) {
  std::string ending = std::filesystem::path(arguments.out).extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  if (ending != ".svg" && ending != ".pdf")
    throw InputError({{{"--out", 0, 0},
                       "",
                       fmt::format("'{}' ends neither in .svg nor in .pdf", arguments.out),
                       "the ending says which is written"}});
  const Figure figure = figure_of_result(arguments.result, arguments.request);
  const Drawing drawing = drawn(figure, arguments.width == "page" ? Width::page : Width::column);
  write_file(arguments.out, ending == ".svg" ? svg_of(drawing) : pdf_of(drawing));
  fmt::print("wrote {} ({:.0f} x {:.0f} mm)\n", arguments.out, drawing.width / points_per_mm,
             drawing.height / points_per_mm);
  return exit_done;
}

}  // namespace

Command add_plot_command(CLI::App& program) {
  CLI::App& command = *program.add_subcommand("plot", "a figure for a paper, SVG or PDF, from results");
  const auto arguments = std::make_shared<PlotArguments>();
  command
      .add_option(
          "RESULT", arguments->result,
          "what a command wrote with --json (diagnosis.json, compare's, ladder's, bounce's, summary.json, "
          "report.json), or its folder")
      ->required()
      ->type_name("FILE");
  command
      .add_option("--kind", arguments->request.kind,
                  "what is drawn; default: the first that the result holds")
      ->type_name("KIND")
      ->check(CLI::IsMember(figure_kinds()));
  command.add_option("--out", arguments->out, "the figure; its ending says which format")
      ->type_name("FILE.svg|FILE.pdf")
      ->required();
  command.add_option("--width", arguments->width, "of a journal with two columns: 85 mm or 180 mm")
      ->type_name("WIDTH")
      ->check(CLI::IsMember({"column", "page"}))
      ->capture_default_str();
  command.add_option("--run", arguments->request.run, "of several runs this one only")->type_name("NAME");
  command
      .add_option("--of", arguments->request.observable, "of decay and residuals: box or the grains' centre")
      ->type_name("WHAT")
      ->check(CLI::IsMember({"box", "centre"}))
      ->capture_default_str();
  return {&command, [arguments] { return plot(*arguments); }};
}

}  // namespace shakedown
