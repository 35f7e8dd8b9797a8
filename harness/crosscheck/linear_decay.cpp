// SPDX-License-Identifier: MIT
#include "linear_decay.hpp"

#include <fmt/format.h>

#include <cmath>

#include "decay.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

constexpr double duration = 9;  // s: the last peak before 8 s is complete when its half period is over

Interval interval_around(const Statistic& found) {
  const double half = 4 * found.sd * std::sqrt(1.0 / fewest_runs + 1.0 / found.n);
  return {found.mean - half, found.mean + half};
}

DecayCheck linearity(const DecayMeasurement& measured) {
  const double ratio = measured.rms_ratio.mean;
  return {measured.engine,
          measured.length,
          "linearity",
          ratio < largest_rms_ratio,
          ratio,
          Interval{0, largest_rms_ratio},
          fmt::format(
              "rms about a straight line / rms about an exponential, first {} peaks ({:.3f} down to 10 mm)",
              regime_peaks, measured.whole_rms_ratio.mean)};
}

DecayCheck against(const DecayMeasurement& measured, const char* name, const Statistic& found,
                   const Interval* allowed) {
  DecayCheck check{measured.engine, measured.length, name, false, 1e3 * found.mean, std::nullopt, ""};
  if (allowed == nullptr) {
    check.remark = "there is no baseline; measure one with --update";
    return check;
  }
  check.passed = allowed->contains(found.mean);
  check.allowed = Interval{1e3 * allowed->low, 1e3 * allowed->high};
  check.remark = fmt::format("+- {:.3f} ({} runs)", 1e3 * found.sd / std::sqrt(found.n), found.n);
  return check;
}

/// Says whether the decay is straight: a curvature that is not zero is a finding, not a failure.
std::string curvature_finding(const Statistic& curvature) {
  const double error = curvature.sd / std::sqrt(curvature.n);
  if (!(std::abs(curvature.mean) > 3 * error)) return ", no curvature beyond 3 standard errors";
  return fmt::format(", {:.0f} standard errors from straight: the decay {}", std::abs(curvature.mean) / error,
                     curvature.mean > 0 ? "slows down" : "speeds up");
}

}  // namespace

DecayBaseline baseline_of(const DecayMeasurement& measured, const std::string& version,
                          const std::string& commit) {
  return {measured.engine,
          measured.length,
          interval_around(measured.slope),
          interval_around(measured.curvature),
          measured.slope,
          measured.curvature,
          measured.seed,
          version,
          commit};
}

std::vector<DecayCheck> checks_of(const DecayMeasurement& measured, const DecayBaseline* baseline) {
  const bool known = baseline != nullptr;
  std::vector<DecayCheck> checks{
      linearity(measured), against(measured, "slope", measured.slope, known ? &baseline->slope : nullptr),
      against(measured, "curvature", measured.curvature, known ? &baseline->curvature : nullptr)};
  checks[2].remark += curvature_finding(measured.curvature);
  return checks;
}

DecayMeasurement measure_decay(const Engine& engine, double length, std::uint64_t seed,
                               const EnsembleOptions& options) {
  Setup setup;
  setup.box.length = length;
  setup.run.duration = duration;
  setup.run.seed = seed;
  if (std::vector<Violation> found = violations_of(setup); !found.empty()) throw InputError(std::move(found));
  const Ensemble ensemble = run_ensemble(engine, setup, options);
  if (ensemble.interrupted) throw Interrupted("not every run had finished, nothing was kept");
  const auto over = [&](auto of_decay) {
    return ensemble.over_runs([&](const RunResult& run) { return of_decay(run.observables.decay); });
  };
  return {std::string(engine.name()),
          length,
          seed,
          ensemble.over_runs([](const RunResult& run) {
            std::vector<Peak> peaks = peaks_of_the_decay(run.observables.peaks, run.observables.small_peak);
            if (peaks.size() > regime_peaks) peaks.resize(regime_peaks);
            const Decay decay = decay_through(peaks);
            return decay.linear.rms / decay.exponential.rms;
          }),
          over([](const Decay& decay) { return decay.linear.slope; }),
          over([](const Decay& decay) { return decay.curvature; }),
          over([](const Decay& decay) { return decay.linear.rms / decay.exponential.rms; })};
}

std::string readable(const DecayCheck& check) {
  const std::string unit = check.name == "slope" ? " mm/s" : check.name == "curvature" ? " mm/s^2" : "";
  const std::string allowed =
      check.allowed ? fmt::format("[{:.3f}, {:.3f}]", check.allowed->low, check.allowed->high) : "-";
  return fmt::format("{}  {:<7}L = {:>5.1f} mm  {:<10}{:>9.3f}{} in {}  {}", check.passed ? "ok  " : "FAIL",
                     check.engine, 1e3 * check.length, check.name, check.value, unit, allowed, check.remark);
}

}  // namespace shakedown
