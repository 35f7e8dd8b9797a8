// SPDX-License-Identifier: MIT
#include "next_experiment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "feature_covariance.hpp"
#include "quantity.hpp"
#include "refit_options.hpp"

namespace shakedown {

namespace {

/// Returns what a camera would make of the setup, with its plan, from one run of the model.
MeasuredFeatures seen(Setup setup, double noise_box, double noise_centre, const Workshop& workshop) {
  RunOptions options;
  options.stop = workshop.execution.stop;
  setup.run.sample_rate = usual_frame_rate;
  const Trajectory trajectory = workshop.engine->run(setup, options);
  if (trajectory.interrupted) throw Interrupted("interrupted");
  const Recording recording = recorded_by(physics_of(setup).camera, trajectory);
  MeasuredRun run;
  run.name = "next experiment";
  run.box_length = setup.box.length;
  run.frame_rate = usual_frame_rate;
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
  Measurement::Run measured{std::move(run), std::move(found), setup};
  set_scales(measured);
  MeasuredFeatures m{measured.recorded.name, setup, plan_features(measured), {}};
  m.values = measured_features(m.plan, measured);
  simulate_until(m.setup, m.plan.end);
  return m;
}

/// Returns the distance of the means in standard errors (Mahalanobis), in the covariance of a measurement of
/// `model` whose parameters are known to `covariance` (in units of the knobs' widths). What the error of the
/// two means adds to its square is known, and taken off.
double distance(const Emulator& model, const Emulator& rival, const FeaturePlan& plan,
                const Eigen::MatrixXd& covariance, double model_error) {
  const Eigen::MatrixXd open = model.coefficients.middleRows(1, covariance.rows());
  const Eigen::LLT<Eigen::MatrixXd> root(covariance_for_means(model.residuals, plan, model_error) +
                                         open.transpose() * covariance * open);
  const Eigen::VectorXd apart =
      root.matrixL().solve((rival.coefficients.row(0) - model.coefficients.row(0)).transpose());
  const auto noise = [&](const Emulator& of) {
    const Eigen::MatrixXd chaos = root.matrixL().solve(of.residuals.transpose());
    return of.inverse_normal(0, 0) * chaos.squaredNorm() / static_cast<double>(of.residuals.rows());
  };
  return std::sqrt(std::max(0.0, apart.squaredNorm() - noise(model) - noise(rival)));
}

}  // namespace

std::string Design::words() const {
  return "N = " + std::to_string(grains) + ", L = " + write_quantity(length, "mm") + ", release " +
         write_quantity(release, "mm");
}

std::vector<Design> possible_designs(const Setup& setup, const std::vector<MeasuredFeatures>& measured) {
  const int grains = setup.grains.count;
  const double length = setup.box.length, release = setup.release.displacement;
  std::vector<Design> designs{{grains, 0.040, release},      {grains, 0.104, release},
                              {grains / 2, 0.040, release},  {grains * 8 / 5, 0.065, release},
                              {grains, length, release / 2}, {0, length, release}};
  constexpr double same = 1e-3;  // m
  std::erase_if(designs, [&](const Design& design) {
    return std::any_of(measured.begin(), measured.end(), [&](const MeasuredFeatures& m) {
      return m.setup.grains.count == design.grains && std::abs(m.setup.box.length - design.length) < same &&
             std::abs(m.setup.release.displacement - design.release) < same;
    });
  });
  return designs;
}

Setup in_design(Setup setup, const Design& design) {
  setup.grains.count = design.grains;
  setup.box.length = design.length;
  setup.release.displacement = design.release;
  return setup;
}

FittedModel fitted_model(Setup setup, const Refit& fit) {
  // The camera of a new experiment is its own: what is known of this one's is left out.
  FittedModel model{std::move(setup), {}, {}};
  std::vector<Eigen::Index> kept;
  for (std::size_t k = 0; k < fit.knobs.size(); ++k) {
    if (fit.knobs[k].exact) continue;
    kept.push_back(static_cast<Eigen::Index>(k));
    model.knobs.push_back(fit.knobs[k]);
    model.knobs.back().centre = fit.values[k].value;
  }
  model.covariance = fit.covariance(kept, kept);
  return model;
}

std::vector<Advice> advise(const std::vector<Design>& designs, const FittedModel& found, const Setup& rival,
                           const AdviceTrial& trial, const Workshop& workshop) {
  std::vector<Knob> knobs = found.knobs;
  Eigen::VectorXd per_width(static_cast<Eigen::Index>(knobs.size()));
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    knobs[k].curved = false;
    knobs[k].width = std::max(2 * std::sqrt(found.covariance(i, i)), 1e-12);
    per_width[i] = 1 / knobs[k].width;
  }
  const Eigen::MatrixXd covariance = per_width.asDiagonal() * found.covariance * per_width.asDiagonal();
  std::vector<Advice> list;
  for (const Design& design : designs) {
    try {
      const MeasuredFeatures m =
          seen(in_design(found.setup, design), trial.noise_box, trial.noise_centre, workshop);
      MeasuredFeatures other = m;
      other.setup = in_design(rival, design);
      other.setup.run = m.setup.run;
      const int first = trial.first_run + 5000 * static_cast<int>(list.size());
      const std::vector<Emulator> model = emulate({m}, knobs, trial.count, first, workshop),
                                  imitation = emulate({other}, {}, trial.count, first + 2500, workshop);
      list.push_back({design.words(), distance(model.front(), imitation.front(), m.plan, covariance,
                                               RefitOptions{}.model_error * std::abs(design.release))});
    } catch (const InputError&) {    // the grains do not fit into the box: no such design
    } catch (const PhysicsError&) {  // nor one that the engine cannot run
    }
  }
  std::stable_sort(list.begin(), list.end(),
                   [](const Advice& a, const Advice& b) { return a.sigmas > b.sigmas; });
  return list;
}

}  // namespace shakedown
