// SPDX-License-Identifier: MIT
#include "last_fit.hpp"

#include <algorithm>
#include <cmath>

#include "errors.hpp"
#include "key_unit.hpp"
#include "setup_file.hpp"
#include "swing_motion.hpp"

namespace shakedown {

namespace {

std::vector<FittedCurve> curves_of(const EnsembleFit& fit) {
  std::vector<FittedCurve> curves;
  for (std::size_t r = 0; r < fit.measured.size(); ++r) {
    const MeasuredFeatures& run = fit.measured[r];
    const RunComparison &last = fit.fit.runs[r], &given = fit.as_given.runs[r];
    for (const Observable of : {Observable::box, Observable::centre}) {
      FittedCurve curve{run.run, of == Observable::box ? "box" : "centre", {}, {}, {}, {}, {}};
      for (Eigen::Index f = 0; f < run.values.size(); ++f) {
        const Feature& feature = run.plan.features[static_cast<std::size_t>(f)];
        if (feature.observable != of) continue;
        curve.time.push_back(feature.time);
        curve.measured.push_back(run.values[f]);
        curve.model.push_back(run.values[f] - last.residual[f]);
        curve.as_given.push_back(run.values[f] - given.residual[f]);
        curve.spread.push_back(last.spread[f]);
      }
      if (!curve.time.empty()) curves.push_back(std::move(curve));
    }
  }
  return curves;
}

std::vector<FittedCurve> curves_of(const SwingFound& found, std::size_t most) {
  std::vector<FittedCurve> curves;
  for (std::size_t r = 0; r < found.runs.size(); ++r) {
    const WaveformRun& run = found.runs[r];
    FittedCurve curve{run.name, "box", {}, {}, {}, {}, {}};
    const std::size_t step = thinned_by(run.time.size(), most);
    for (std::size_t i = 0; i < run.time.size(); i += step) {
      curve.time.push_back(run.time[i]);
      curve.measured.push_back(run.x[i]);
      curve.model.push_back(run.x[i] - found.residual[r][static_cast<Eigen::Index>(i)]);
      curve.spread.push_back(run.white);
    }
    // As given the box starts at rest at the first frame, from where the setup says.
    std::vector<double> time{run.start_time()};
    time.insert(time.end(), curve.time.begin(), curve.time.end());
    const double from = run.setup.release.displacement;
    std::vector<double> given =
        swing_of(physics_of(run.setup), {from, 0}, time, 10 * std::max(std::abs(from), run.amplitude));
    if (given.empty())
      curve.as_given.assign(curve.time.size(), std::nan(""));
    else
      curve.as_given.assign(given.begin() + 1, given.end());
    curves.push_back(std::move(curve));
  }
  return curves;
}

/// Sets a number; one of the camera that the fit took beyond what a setup may say stays as the setup has it.
void put(Setup& setup, const std::string& key, double value, KnownEffects known) {
  try {
    set_number(setup, key, value, known);
  } catch (const InputError&) {
  }
}

}  // namespace

std::size_t thinned_by(std::size_t count, std::size_t most) { return count / (most + 1) + 1; }

std::vector<FittedCurve> curves_of(const LastFit& fit, std::size_t most) {
  if (fit.ensembles) return curves_of(*fit.ensembles);
  return fit.swing ? curves_of(*fit.swing, most) : std::vector<FittedCurve>{};
}

std::vector<Setup> setups_of(const LastFit& fit, const Setup& amended, KnownEffects known) {
  std::vector<Setup> setups;
  for (const Measurement::Run& run : fit.measurement.runs)
    setups.push_back(setup_of_run(amended, run.recorded, known));
  if (fit.ensembles)
    for (Setup& setup : setups)
      for (const FittedValue& value : fit.ensembles->fit.values)
        for (const std::string& key : joined_keys(value.key))
          if (std::find(fit.taken_back.begin(), fit.taken_back.end(), key) == fit.taken_back.end())
            put(setup, key, value.value, known);
  if (!fit.swing) return setups;
  const SwingFound& found = *fit.swing;
  std::size_t r = 0;
  for (std::size_t i = 0; i < setups.size() && r < found.runs.size(); ++i) {
    if (fit.measurement.runs[i].recorded.name != found.runs[r].name) continue;
    const Eigen::Index first = 3 * static_cast<Eigen::Index>(r);
    Setup& setup = setups[i] = with_laws(found.runs[r].setup, found.fit, known);
    setup.release.displacement = found.fit.value[first];
    put(setup, "initial_box_velocity.velocity", found.fit.value[first + 1], known);
    const std::string origin = known.key_of(&Camera::origin);
    put(setup, origin, get_number(setup, origin, known) + found.fit.value[first + 2], known);
    ++r;
  }
  return setups;
}

}  // namespace shakedown
