// SPDX-License-Identifier: MIT
// shakedown theory: the paper's closed-form estimates for a setup, and the friction-damped oscillator fitted
// to a run.
#include "theory.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command.hpp"
#include "engines.hpp"
#include "ensemble.hpp"
#include "ensemble_options.hpp"
#include "friction_oscillator.hpp"
#include "interruption.hpp"
#include "json_output.hpp"
#include "output_file.hpp"
#include "progress_display.hpp"
#include "series_file.hpp"
#include "setup_arguments.hpp"

namespace shakedown {

namespace {

struct TheoryArguments {
  SetupArguments setup;
  JsonOutput json;
  std::string engine = "hard", curve;
};

/// The friction-damped oscillator that one run of the setup suggests.
struct Friction {
  FrictionOscillator oscillator;
  double third_peak = 0;      ///< m, of the run
  double rms_difference = 0;  ///< m, between the two motions of the box over the whole run
};

Friction friction_of(const Theory& theory, const Setup& setup, const RunResult& run) {
  Friction friction;
  const double release = std::abs(setup.release.displacement);
  friction.third_peak = run.observables.peaks[2].position;
  friction.oscillator = {theory.stiffness, theory.total_mass,
                         std::max(0.0, effective_friction(theory.stiffness, release, friction.third_peak)),
                         release};
  double squares = 0;
  const double side = setup.release.displacement < 0 ? -1 : 1;
  for (std::size_t i = 0; i < run.trajectory.time.size(); ++i)
    squares +=
        std::pow(run.trajectory.x_box[i] - side * friction.oscillator.position_at(run.trajectory.time[i]), 2);
  friction.rms_difference = std::sqrt(squares / static_cast<double>(run.trajectory.time.size()));
  return friction;
}

/// Reads it off a run; nothing when the run has fewer than three peaks.
std::optional<Friction> friction_from_a_run(const TheoryArguments& arguments, const Theory& theory,
                                            const Setup& setup) {
  const std::unique_ptr<Engine> engine = engine_named(arguments.engine);
  EnsembleOptions options;
  options.keep_samples = true;
  options.execution.stop = catch_interruption();
  ProgressDisplay display(
      fmt::format("{}: a run of {:g} s for its third peak", arguments.setup.file, setup.run.duration));
  options.progress = [&](double fraction) { display.show(fraction); };
  const Ensemble ensemble = run_ensemble(*engine, setup, options);
  if (ensemble.interrupted) throw Interrupted("the run had not finished");
  if (ensemble.runs[0].observables.peaks.size() < 3) return std::nullopt;
  return friction_of(theory, setup, ensemble.runs[0]);
}

std::string curve_csv(const FrictionOscillator& oscillator, const Setup& setup) {
  std::string text = "t_s,x_box_m,v_box_m_per_s\n";
  const double side = setup.release.displacement < 0 ? -1 : 1;
  const auto samples = static_cast<long>(setup.run.duration * setup.run.sample_rate * (1 + 1e-12));
  for (long k = 0; k <= samples; ++k) {
    const double time = static_cast<double>(k) / setup.run.sample_rate;
    text += csv_line({time, side * oscillator.position_at(time), side * oscillator.velocity_at(time)});
  }
  return text;
}

std::string json_of_theory(const Theory& theory, const std::optional<Friction>& friction,
                           const std::string& engine) {
  nlohmann::ordered_json json{{"schema_version", 1},
                              {"spring",
                               {{"beam_stiffness_N_per_m", theory.beam_stiffness},
                                {"beam_frequency_hz", theory.beam_frequency},
                                {"stiffness_N_per_m", theory.stiffness},
                                {"frequency_hz", theory.frequency}}},
                              {"total_mass_kg", theory.total_mass},
                              {"loaded_frequency_hz", theory.loaded_frequency},
                              {"layer_thickness_m", theory.layer_thickness},
                              {"top_speed_m_per_s", theory.top_speed},
                              {"t_g_peak_s", theory.time_to_peak},
                              {"t_g_box_s", theory.time_through_box},
                              {"f_t_g_peak", theory.phase_to_peak},
                              {"f_t_g_box", theory.phase_through_box},
                              {"landing", to_string(theory.landing)},
                              {"optimal_length_m", theory.optimal_length},
                              {"friction", nullptr}};
  if (friction)
    json["friction"] = {{"engine", engine},
                        {"third_peak_mm", 1e3 * friction->third_peak},
                        {"effective_friction_N", friction->oscillator.friction},
                        {"deceleration_m_per_s2", friction->oscillator.friction / theory.total_mass},
                        {"peak_drop_mm", 2e3 * friction->oscillator.friction / theory.stiffness},
                        {"stops_after_s", friction->oscillator.friction > 0
                                              ? nlohmann::ordered_json(friction->oscillator.last_extremum() *
                                                                       friction->oscillator.half_period())
                                              : nlohmann::ordered_json(nullptr)},
                        {"rms_difference_mm", 1e3 * friction->rms_difference}};
  return json.dump(2) + "\n";
}

std::string readable_theory(const Theory& theory, const std::optional<Friction>& friction,
                            const std::string& engine) {
  const auto line = [](std::string_view name, const std::string& value) {
    return fmt::format("  {:<44}{}\n", name, value);
  };
  std::string text =
      "Paper's estimates; its omega is the frequency f of the empty box\n" +
      line("k of the blade, E w h^3/(4 l^3)",
           fmt::format("{:.3f} N/m  (empty box {:.4f} Hz)", theory.beam_stiffness, theory.beam_frequency)) +
      line("k used, M (2 pi f)^2",
           fmt::format("{:.3f} N/m  (empty box {:.4f} Hz)", theory.stiffness, theory.frequency)) +
      line("f_loaded = f sqrt(M/(M + N m))", fmt::format("{:.4f} Hz", theory.loaded_frequency)) +
      line("thickness of the packed layer", fmt::format("{:.1f} mm", 1e3 * theory.layer_thickness)) +
      line("t_g,peak: layer reaches the wall's far peak",
           fmt::format("{:.4f} s, f t = {:.4f}", theory.time_to_peak, theory.phase_to_peak)) +
      line("t_g,Box: layer crosses the box",
           fmt::format("{:.4f} s, f t = {:.4f}", theory.time_through_box, theory.phase_through_box)) +
      line("first landing on the", to_string(theory.landing)) +
      line("L_opt = pi Delta0 sqrt(M/(M + N m)) + layer",
           fmt::format("{:.1f} mm", 1e3 * theory.optimal_length));
  if (!friction) return text + line("effective friction", "- (the run has fewer than three peaks)");
  return text +
         fmt::format("Friction-damped oscillator through the third peak of a run (engine {})\n", engine) +
         line("third peak", fmt::format("{:.2f} mm", 1e3 * friction->third_peak)) +
         line("mu M_tot = k (Delta0 - |x_3|)/6",
              fmt::format("{:.4f} N  (mu = {:.4f} m/s^2)", friction->oscillator.friction,
                          friction->oscillator.friction / theory.total_mass)) +
         line("drop of the peak per half period",
              fmt::format("{:.3f} mm", 2e3 * friction->oscillator.friction / theory.stiffness)) +
         line("rms difference of x_box over the run",
              fmt::format("{:.2f} mm", 1e3 * friction->rms_difference));
}

int print_theory(const TheoryArguments& arguments) {
  const Setup setup = arguments.setup.read();
  const Theory theory = theory_of(setup);
  arguments.json.check();
  if (!arguments.curve.empty()) expect_writable(arguments.curve);
  const std::optional<Friction> friction = friction_from_a_run(arguments, theory, setup);
  if (!arguments.curve.empty()) {
    if (!friction)
      throw InputError(
          {{setup.places.contains("run.duration") ? setup.places.at("run.duration") : SourcePlace{},
            "run.duration", "there is no curve (the run has fewer than three peaks)", "run longer"}});
    write_file(arguments.curve, curve_csv(friction->oscillator, setup));
  }
  const PaperValues taken(setup);
  taken.print(arguments.json.for_people());
  fmt::print(arguments.json.for_people(), "{}", readable_theory(theory, friction, arguments.engine));
  arguments.json.write(taken.added_to(json_of_theory(theory, friction, arguments.engine)));
  return exit_done;
}

}  // namespace

Command add_theory_command(CLI::App& program) {
  CLI::App& command =
      *program.add_subcommand("theory", "closed-form estimates, and the friction-damped oscillator of a run");
  const auto arguments = std::make_shared<TheoryArguments>();
  add_setup_arguments(command, arguments->setup);
  command.add_option("--engine", arguments->engine, "engine of the run whose third peak is used")
      ->type_name("NAME")
      ->capture_default_str();
  add_keep_option(command);
  command
      .add_option("--out", arguments->curve,
                  "write the friction-damped oscillator as t_s,x_box_m,v_box_m_per_s")
      ->type_name("FILE");
  add_json_option(command, arguments->json);
  return {&command, [arguments] { return print_theory(*arguments); }};
}

}  // namespace shakedown
