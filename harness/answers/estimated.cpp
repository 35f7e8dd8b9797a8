// SPDX-License-Identifier: MIT
#include "estimated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "ensemble.hpp"
#include "errors.hpp"
#include "series_file.hpp"

namespace shakedown {

namespace {

FrictionOfRun friction_of(const Theory& theory, const Setup& setup, const RunResult& run) {
  FrictionOfRun friction;
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

}  // namespace

std::optional<FrictionOfRun> friction_of_run(const Theory& theory, const Setup& setup, const Engine& engine,
                                             const std::atomic<bool>* stop,
                                             const std::function<void(double fraction)>& progress) {
  EnsembleOptions options;
  options.keep_samples = true;
  options.execution.stop = stop;
  options.progress = progress;
  const Ensemble ensemble = run_ensemble(engine, setup, options);
  if (ensemble.interrupted) throw Interrupted("the run had not finished");
  if (ensemble.runs[0].observables.peaks.size() < 3) return std::nullopt;
  return friction_of(theory, setup, ensemble.runs[0]);
}

std::string friction_csv(const FrictionOscillator& oscillator, const Setup& setup) {
  std::string text = "t_s,x_box_m,v_box_m_per_s\n";
  const double side = setup.release.displacement < 0 ? -1 : 1;
  const auto samples = static_cast<long>(setup.run.duration * setup.run.sample_rate * (1 + 1e-12));
  for (long k = 0; k <= samples; ++k) {
    const double time = static_cast<double>(k) / setup.run.sample_rate;
    text += csv_line({time, side * oscillator.position_at(time), side * oscillator.velocity_at(time)});
  }
  return text;
}

std::string estimated_text(const Estimated& estimated) {
  const auto& [theory, friction, engine] = estimated;
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

std::string estimated_json(const Estimated& estimated) {
  const auto& [theory, friction, engine] = estimated;
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

}  // namespace shakedown
