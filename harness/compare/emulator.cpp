// SPDX-License-Identifier: MIT
#include "emulator.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "errors.hpp"
#include "in_order.hpp"
#include "random.hpp"
#include "setup_file.hpp"

namespace shakedown {

double Knob::at(double z) const { return std::clamp(centre + width * z, low, high); }

std::vector<MeasuredFeatures> features_of(const Experiment& experiment, const Audit& audit, const std::vector<Setup>& setups) {
  std::vector<MeasuredFeatures> measured;
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    MeasuredFeatures m{experiment.runs[r].name, setups[r], plan_features(experiment.runs[r], audit.runs[r]), {}};
    m.values = measured_features(m.plan, audit.runs[r], experiment.runs[r]);
    m.setup.run.duration = std::max(0.5, m.plan.end + 0.05);
    m.setup.run.sample_rate = 500;
    measured.push_back(std::move(m));
  }
  return measured;
}

Eigen::VectorXd regression_terms(const std::vector<Knob>& knobs, const Eigen::VectorXd& z) {
  std::vector<double> terms{1.0};
  for (Eigen::Index k = 0; k < z.size(); ++k) terms.push_back(z[k]);
  for (std::size_t a = 0; a < knobs.size(); ++a)
    for (std::size_t b = a; b < knobs.size(); ++b)
      if (knobs[a].curved && knobs[b].curved) terms.push_back(z[static_cast<Eigen::Index>(a)] * z[static_cast<Eigen::Index>(b)]);
  return Eigen::Map<Eigen::VectorXd>(terms.data(), static_cast<Eigen::Index>(terms.size()));
}

void set_knob(Setup& setup, const Knob& knob, std::span<const EffectRecord* const> known) {
  std::stringstream keys(knob.key);
  for (std::string key; std::getline(keys, key, '&');) set_number(setup, key, knob.at(0), known);
}

Setup setup_at(const Setup& setup, const std::vector<Knob>& knobs, const Eigen::VectorXd& z, std::span<const EffectRecord* const> known) {
  Setup changed = setup;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    Knob moved = knobs[k];
    moved.centre = moved.at(z[static_cast<Eigen::Index>(k)]);
    set_knob(changed, moved, known);
  }
  return changed;
}

namespace {

/// Scattered values of one simulation, the actual ones after bounds.
Eigen::VectorXd scatter(const std::vector<Knob>& knobs, std::uint64_t seed, int run, double sparse) {
  Random random(seed, static_cast<std::uint64_t>(run), Stream::other);
  Eigen::VectorXd z(static_cast<Eigen::Index>(knobs.size()));
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    const bool moved = random.uniform() < (knobs[k].curved ? 1.0 : sparse);
    const double drawn = 2 * random.uniform() - 1;
    const double value = moved ? knobs[k].at(drawn) : knobs[k].at(0);
    z[static_cast<Eigen::Index>(k)] = knobs[k].z_of(value);
  }
  return z;
}

Emulator regress(const Eigen::MatrixXd& terms, const Eigen::MatrixXd& features) {
  Emulator emulator;
  const Eigen::MatrixXd normal = terms.transpose() * terms;
  emulator.inverse_normal = normal.ldlt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
  emulator.coefficients = emulator.inverse_normal * (terms.transpose() * features);
  emulator.residuals = features - terms * emulator.coefficients;
  const double left = static_cast<double>(terms.rows() - terms.cols()) / static_cast<double>(terms.rows());
  emulator.residuals /= std::sqrt(std::max(left, 0.05));
  return emulator;
}

/// A run, or, where the grains collapse so that the engine gives up, the same setup from another microstate.
Trajectory run_surely(const Setup& setup, int run, const Workshop& workshop) {
  constexpr int tries = 4, far_away = 100000000;
  for (int attempt = 0;; ++attempt) {
    RunOptions options;
    options.run = run + attempt * far_away;
    options.stop = workshop.stop;
    try {
      Trajectory trajectory = workshop.engine->run(setup, options);
      if (trajectory.interrupted) throw Interrupted("interrupted");
      return trajectory;
    } catch (const PhysicsError&) {
      if (attempt + 1 == tries) throw;
    }
  }
}

}  // namespace

std::vector<Emulator> emulate(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs, int count, int first_run,
                              const Workshop& workshop, double sparse) {
  // Runs of the same setup (repeats) share simulations as long as the longest of them needs.
  std::vector<std::vector<std::size_t>> groups;
  std::vector<Setup> setups;
  std::map<std::string, std::size_t> place;
  for (std::size_t m = 0; m < measured.size(); ++m) {
    Setup key = measured[m].setup;
    key.run.duration = 1;
    const auto [found, fresh] = place.emplace(digest(key), groups.size());
    if (fresh) {
      groups.emplace_back();
      setups.push_back(measured[m].setup);
    }
    groups[found->second].push_back(m);
    double& duration = setups[found->second].run.duration;
    duration = std::max(duration, measured[m].setup.run.duration);
  }
  std::vector<Eigen::MatrixXd> features, terms(groups.size());
  for (const MeasuredFeatures& m : measured) features.emplace_back(count, m.values.size());
  const auto n_terms = regression_terms(knobs, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(knobs.size()))).size();
  for (Eigen::MatrixXd& t : terms) t.resize(count, n_terms);
  const int groups_count = static_cast<int>(groups.size());
  // The longest runs are begun first: groups in turn, so that the last ones are spread over all.
  work_in_parallel_deliver_in_order(count * groups_count, threads_or_all(workshop.threads), [&](int job) -> std::function<void()> {
    const int row = job / groups_count;
    const auto g = static_cast<std::size_t>(job % groups_count);
    if (workshop.stop && *workshop.stop) throw Interrupted("interrupted");
    const int run = first_run + row;
    const Eigen::VectorXd z = scatter(knobs, setups[g].run.seed + 7919 * g, run, sparse);
    Setup setup = setup_at(setups[g], knobs, z, workshop.known);
    setup.run.seed += 104729 * g;
    const Trajectory trajectory = run_surely(setup, run, workshop);
    const Recording recording = recorded_by(physics_of(setup).camera, trajectory);
    terms[g].row(row) = regression_terms(knobs, z).transpose();
    for (const std::size_t m : groups[g]) features[m].row(row) = simulated_features(measured[m].plan, recording).transpose();
    return [&] {
      if (workshop.runs) ++*workshop.runs;
      if (workshop.done) workshop.done(1);
    };
  });
  std::vector<Emulator> emulators(measured.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const std::size_t m : groups[g]) emulators[m] = regress(terms[g], features[m]);
  return emulators;
}

}  // namespace shakedown
