// SPDX-License-Identifier: MIT
#include "next_experiment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "audit.hpp"
#include "feature_covariance.hpp"
#include "quantity.hpp"

namespace shakedown {

namespace {

/// What a camera would make of the design: its plan, from one run of the model.
MeasuredFeatures seen(const Design& design, double noise_box, double noise_centre, const Workshop& workshop) {
  RunOptions options;
  options.stop = workshop.stop;
  Setup setup = design.setup;
  setup.run.sample_rate = 500;
  const Trajectory trajectory = workshop.engine->run(setup, options);
  if (trajectory.interrupted) throw Interrupted("interrupted");
  const Recording recording = recorded_by(physics_of(setup).camera, trajectory);
  MeasuredRun run;
  run.name = design.words;
  run.box_length = setup.box.length;
  run.frame_rate = 500;
  run.time = recording.time;
  run.x_box = recording.x_box;
  if (setup.grains.count > 0) run.x_com = recording.x_com;
  RunAudit found;
  found.run = run.name;
  found.frame_interval = 1 / run.frame_rate;
  found.box.standard_deviation = noise_box;
  found.com.standard_deviation = noise_centre;
  found.x_box = run.x_box;
  found.x_com = run.x_com;
  MeasuredFeatures m{run.name, setup, plan_features(run, found), {}};
  m.values = measured_features(m.plan, found, run);
  m.setup.run.duration = std::max(0.5, m.plan.end + 0.05);
  return m;
}

/// Length of the found effect's signature, in standard errors, outside what the other columns can imitate.
double standing_out(const Emulator& emulator, const FeaturePlan& plan, Eigen::Index others,
                    const Eigen::VectorXd& strengths) {
  const Eigen::LLT<Eigen::MatrixXd> root(feature_covariance(emulator.residuals, plan, 0));
  const Eigen::MatrixXd free = root.matrixL().solve(emulator.coefficients.middleRows(1, others).transpose());
  const Eigen::VectorXd effect = root.matrixL().solve(
      emulator.coefficients.middleRows(1 + others, strengths.size()).transpose() * strengths);
  const Eigen::VectorXd left =
      effect - free * (free.transpose() * free).ldlt().solve(free.transpose() * effect);
  // The emulator's noise makes a signature of its own, whose square is known.
  const double noise = strengths.squaredNorm() * emulator.inverse_normal(1 + others, 1 + others) *
                       static_cast<double>(effect.size());
  return std::sqrt(std::max(0.0, left.squaredNorm() - noise));
}

}  // namespace

std::vector<Design> possible_designs(const Setup& setup) {
  std::vector<Design> designs;
  const auto add = [&](int grains, double length, double release) {
    Setup changed = setup;
    changed.grains.count = grains;
    changed.box.length = length;
    changed.release.displacement = release;
    designs.push_back({"N = " + std::to_string(grains) + ", L = " + write_quantity(length, "mm") +
                           ", release " + write_quantity(release, "mm"),
                       changed});
  };
  const int grains = setup.grains.count;
  const double release = setup.release.displacement;
  add(grains, 0.040, release);
  add(grains, 0.104, release);
  add(grains / 2, 0.040, release);
  add(grains * 8 / 5, 0.065, release);
  return designs;
}

std::vector<Advice> advise(const std::vector<Design>& designs, const std::vector<Knob>& parameters,
                           const std::vector<Knob>& found, const Candidate& rival, double noise_box,
                           double noise_centre, const Workshop& workshop, int count, int first_run) {
  std::vector<Knob> knobs = parameters;
  for (Knob& knob : knobs) knob.width = std::min(knob.width, 0.05);
  knobs.insert(knobs.end(), rival.fitted_knobs().begin(), rival.fitted_knobs().end());
  const auto others = static_cast<Eigen::Index>(knobs.size());
  Eigen::VectorXd strengths(static_cast<Eigen::Index>(found.size()));
  for (std::size_t k = 0; k < found.size(); ++k) {
    Knob knob = found[k];
    // scattered about the fitted strength, which is two widths
    knob.width = std::max(0.5 * std::abs(knob.centre), 1e-9);
    strengths[static_cast<Eigen::Index>(k)] = 2;
    knobs.push_back(knob);
  }
  for (Knob& knob : knobs) knob.curved = false;
  std::vector<Advice> list;
  for (std::size_t d = 0; d < designs.size(); ++d) {
    Design design = designs[d];
    design.setup = prepared(design.setup, rival, workshop.known);
    try {
      const MeasuredFeatures m = seen(design, noise_box, noise_centre, workshop);
      const std::vector<Emulator> emulators =
          emulate({m}, knobs, count, first_run + static_cast<int>(d) * 5000, workshop);
      list.push_back({design.words, standing_out(emulators.front(), m.plan, others, strengths)});
    } catch (const InputError&) {  // the grains do not fit into the box: no such design
    }
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Advice& a, const Advice& b) { return a.sigmas > b.sigmas; });
  return list;
}

}  // namespace shakedown
