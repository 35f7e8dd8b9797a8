// SPDX-License-Identifier: MIT
#include "measurement.hpp"

#include <algorithm>

#include <cmath>
#include <map>

#include "errors.hpp"
#include "experiment.hpp"
#include "known_setup.hpp"
#include "nothing.hpp"
#include "setup_file.hpp"
#include "steady_forcing.hpp"

namespace shakedown {

namespace {

/// Returns the run's own keys of the grains, on which the layer's thickness depends: runs with others have a
/// plateau of their own.
std::string grains_of(const MeasuredRun& run) {
  std::string text;
  for (const Override& override : run.overrides)
    if (override.key.starts_with("grains.")) text += override.key + "=" + override.value + ";";
  return text;
}

PlateauSlope plateau_slope(const std::vector<Measurement::Run>& runs) {
  struct Sums {
    double weight = 0, length = 0, plateau = 0;
  };
  std::map<std::string, Sums> means;
  const auto each = [&](const auto& visit) {
    for (const Measurement::Run& run : runs)
      if (std::isfinite(run.audit.plateau) && std::isfinite(run.recorded.box_length))
        visit(means[grains_of(run.recorded)], 1 / (run.audit.plateau_error * run.audit.plateau_error),
              run.recorded.box_length, run.audit.plateau);
  };
  each([](Sums& mean, double weight, double length, double plateau) {
    mean.weight += weight, mean.length += weight * length, mean.plateau += weight * plateau;
  });
  double squares = 0, products = 0, spread = 0;
  each([&](const Sums& mean, double weight, double length, double plateau) {
    const double apart = length - mean.length / mean.weight;
    spread += apart * apart;
    squares += weight * apart * apart;
    products += weight * apart * (plateau - mean.plateau / mean.weight);
  });
  constexpr double least_apart = 1e-3;  // m, else it is one length
  if (!(spread > least_apart * least_apart)) return {nothing, nothing};
  return {products / squares, 1 / std::sqrt(squares)};
}

}  // namespace

std::vector<std::string> all_notes(const Measurement& measurement) {
  std::vector<std::string> notes = measurement.notes;
  notes.insert(notes.end(), measurement.warnings.begin(), measurement.warnings.end());
  return notes;
}

Setup setup_of_run(const Setup& setup, const MeasuredRun& run, KnownEffects known) {
  Setup of_run = with_overrides(setup, run.overrides, known);
  of_run.release.grains_measured_at = run.grains_measured_at.value_or(of_run.release.displacement);
  return of_run;
}

Measurement measurement_of(const Setup& setup, Experiment experiment, KnownEffects known) {
  experiment = with_known(std::move(experiment), known);
  const Setup measured = with_known(setup, experiment.known, known);
  std::vector<Setup> setups;
  for (const MeasuredRun& run : experiment.runs) setups.push_back(setup_of_run(measured, run, known));
  return measurement_of(setups, std::move(experiment));
}

void set_scales(Measurement::Run& run) {
  const double frequency = run.setup.spring.frequency, release = std::abs(run.setup.release.displacement);
  if (frequency > 0) run.period = 1 / frequency;
  if (release > 0) run.excursion = release;
}

Measurement measurement_of(const std::vector<Setup>& setups, Experiment experiment) {
  EXPECT(setups.size() == experiment.runs.size());
  Measurement measurement{std::move(experiment.title),
                          std::move(experiment.file),
                          std::move(experiment.notes),
                          {},
                          experiment.known,
                          {},
                          {}};
  measurement.sensor = experiment.sensor;
  std::vector<const MeasuredRun*> recorded;
  std::vector<RunAudit*> audits;
  for (std::size_t r = 0; r < setups.size(); ++r) {
    RunAudit audit = audit_run(experiment.runs[r]);
    measurement.runs.push_back(
        {std::move(experiment.runs[r]), std::move(audit), setups[r], is_shaken(setups[r])});
    set_scales(measurement.runs.back());
  }
  for (Measurement::Run& run : measurement.runs)
    recorded.push_back(&run.recorded), audits.push_back(&run.audit);
  pool_noise(recorded, audits);
  for (const RunAudit* audit : audits)
    for (std::string& warning : warnings_of(*audit)) measurement.warnings.push_back(std::move(warning));
  measurement.plateau = plateau_slope(measurement.runs);
  return measurement;
}

std::vector<KnownValue> known_of(const Measurement& measurement, const Measurement::Run& run) {
  Experiment of_all;
  of_all.known = measurement.known;
  return known_of(of_all, run.recorded);
}

Measurement with_setup(Measurement measurement, const Setup& changed, KnownEffects known) {
  for (Measurement::Run& run : measurement.runs) run.setup = setup_of_run(changed, run.recorded, known);
  return measurement;
}

Measurement up_to(Measurement measurement, double seconds) {
  for (Measurement::Run& run : measurement.runs) {
    std::vector<double>& time = run.recorded.time;
    const auto kept =
        static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), seconds) - time.begin());
    for (std::vector<double>* series :
         {&time, &run.recorded.x_box, &run.recorded.x_com, &run.audit.x_box, &run.audit.x_com})
      series->resize(std::min(series->size(), kept));
  }
  return measurement;
}

}  // namespace shakedown
