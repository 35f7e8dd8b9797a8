// SPDX-License-Identifier: MIT
#include "emulator.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "errors.hpp"
#include "in_order.hpp"
#include "key_unit.hpp"
#include "random.hpp"
#include "setup_file.hpp"

namespace shakedown {

double Knob::at(double z) const { return std::clamp(centre + width * z, low, high); }

std::vector<MeasuredFeatures> features_of(const Measurement& measurement) {
  std::vector<MeasuredFeatures> measured;
  Eigen::Index features = 0;
  for (const Measurement::Run& run : measurement.runs) {
    const Observed observed = run.setup.grains.count > 0 ? Observed::all : Observed::box_only;
    MeasuredFeatures m{run.recorded.name, run.setup, plan_features(run, observed), {}};
    m.values = measured_features(m.plan, run);
    simulate_until(m.setup, m.plan.end);
    features += m.values.size();
    measured.push_back(std::move(m));
  }
  if (features == 0)
    throw InputError({{{measurement.file, 0, 0},
                       "run",
                       "holds no eight frames in a row of a motion (a clock in another unit, or too short?)",
                       "check column.time.unit and the frame rate"}});
  return measured;
}

Eigen::MatrixXd with_own(Eigen::MatrixXd covariance, const MeasuredFeatures& measured) {
  if (measured.own.cols() > 0) covariance += measured.own * measured.own.transpose();
  return covariance;
}

Eigen::VectorXd regression_terms(const std::vector<Knob>& knobs, const Eigen::VectorXd& z) {
  std::vector<double> terms{1.0};
  for (Eigen::Index k = 0; k < z.size(); ++k) terms.push_back(z[k]);
  for (std::size_t a = 0; a < knobs.size(); ++a)
    for (std::size_t b = a; b < knobs.size(); ++b)
      if (knobs[a].curved && knobs[b].curved)
        terms.push_back(z[static_cast<Eigen::Index>(a)] * z[static_cast<Eigen::Index>(b)]);
  for (std::size_t k = 0; k < knobs.size(); ++k)
    if (knobs[k].curved && knobs[k].cubic) terms.push_back(std::pow(z[static_cast<Eigen::Index>(k)], 3));
  return Eigen::Map<Eigen::VectorXd>(terms.data(), static_cast<Eigen::Index>(terms.size()));
}

Eigen::Index number_of_terms(const std::vector<Knob>& knobs) {
  return regression_terms(knobs, Eigen::VectorXd::Zero(std::ssize(knobs))).size();
}

void set_knob(Setup& setup, const Knob& knob, KnownEffects known) {
  for (const std::string& key : joined_keys(knob.key)) set_number(setup, key, knob.at(0), known);
}

Setup setup_at(const Setup& setup, const std::vector<Knob>& knobs, const Eigen::VectorXd& z,
               KnownEffects known) {
  Setup changed = setup;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    Knob moved = knobs[k];
    moved.centre = moved.at(z[static_cast<Eigen::Index>(k)]);
    set_knob(changed, moved, known);
  }
  return changed;
}

namespace {

/// Returns the scattered z of one simulation, after its values were kept within the bounds.
Eigen::VectorXd scatter(const std::vector<Knob>& knobs, std::uint64_t seed, int run, double sparse) {
  Random random(seed, static_cast<std::uint64_t>(run), Stream::other);
  Eigen::VectorXd z(static_cast<Eigen::Index>(knobs.size()));
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if (knobs[k].exact) {
      z[static_cast<Eigen::Index>(k)] = 0;
      continue;
    }
    const bool moved = random.uniform() < (knobs[k].curved ? 1.0 : sparse);
    const double drawn = 2 * random.uniform() - 1;
    const double value = moved ? knobs[k].at(drawn) : knobs[k].at(0);
    z[static_cast<Eigen::Index>(k)] = knobs[k].z_of(value);
  }
  return z;
}

/// Returns the share of the degrees of freedom that the coefficients leave, 0.05 at least: by its root
/// residuals are scaled up.
double share_left(const Eigen::MatrixXd& terms) {
  return std::max(static_cast<double>(terms.rows() - terms.cols()) / static_cast<double>(terms.rows()), 0.05);
}

/// Expects that no column is constant or the sum of others. A parameter with such a column has no slope to
/// tell: whoever asks for one has mixed up the columns, or scattered a knob that cannot move.
void expect_full_rank(const Eigen::MatrixXd& terms) {
  constexpr double rounding = 1e-9;  // of columns whose entries are of order one
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(terms);
  qr.setThreshold(rounding);
  EXPECT(qr.rank() == terms.cols());
}

Emulator regress(Eigen::MatrixXd terms, const Eigen::MatrixXd& features) {
  expect_full_rank(terms);
  Emulator emulator;
  const Eigen::MatrixXd normal = terms.transpose() * terms;
  emulator.inverse_normal = normal.ldlt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
  emulator.coefficients = emulator.inverse_normal * (terms.transpose() * features);
  emulator.residuals = (features - terms * emulator.coefficients) / std::sqrt(share_left(terms));
  emulator.terms = std::move(terms);
  return emulator;
}

/// Runs the setup; where the grains collapse so that the engine gives up, runs it from another microstate, up
/// to three times more.
Trajectory run_surely(const Setup& setup, int run, const Workshop& workshop) {
  constexpr int tries = 4, far_away = 100000000;
  for (int attempt = 0;; ++attempt) {
    RunOptions options;
    options.run = run + attempt * far_away;
    options.stop = workshop.execution.stop;
    // A run whose grains stall takes minutes: the limits hold within it too.
    constexpr int reports_between = 20;  // of some 200 a run: asking costs as much as a hundred impacts
    int reports = 0;
    options.progress = [&](double) {
      if (++reports % reports_between == 0) workshop.ask(0);
    };
    try {
      Trajectory trajectory = workshop.engine->run(setup, options);
      if (trajectory.interrupted) throw Interrupted("interrupted");
      return trajectory;
    } catch (const PhysicsError&) {
      if (attempt + 1 == tries) throw;
    }
  }
}

/// Holds the measured runs of one setup (repeats). They share simulations, as long as the longest of them
/// needs.
struct Group {
  std::vector<std::size_t> members;
  Setup setup;
  std::uint64_t stream = 0;  ///< of random numbers: its place among the groups
};

std::vector<Group> groups_of(const std::vector<MeasuredFeatures>& measured) {
  std::vector<Group> groups;
  std::map<std::string, std::size_t> place;
  for (std::size_t m = 0; m < measured.size(); ++m) {
    Setup key = measured[m].setup;
    key.run.duration = 1;
    const auto [found, fresh] = place.emplace(digest(key), groups.size());
    if (fresh) groups.push_back({{}, measured[m].setup, groups.size()});
    Group& group = groups[found->second];
    group.members.push_back(m);
    group.setup.run.duration = std::max(group.setup.run.duration, measured[m].setup.run.duration);
  }
  return groups;
}

bool is_point(const std::vector<Knob>& knobs) {
  return std::all_of(knobs.begin(), knobs.end(),
                     [](const Knob& knob) { return knob.width == 0 || knob.exact; });
}

/// Returns the places of the knobs that simulations are scattered over; none where all stand at a point.
std::vector<Eigen::Index> scattered_places(const std::vector<Knob>& knobs) {
  std::vector<Eigen::Index> places;
  if (is_point(knobs)) return places;
  for (std::size_t k = 0; k < knobs.size(); ++k)
    if (!knobs[k].exact) places.push_back(static_cast<Eigen::Index>(k));
  return places;
}

/// Returns what the exact knobs at z do to a run's features, m.
Eigen::VectorXd by_exact_knobs(const MeasuredFeatures& measured, const std::vector<Knob>& knobs,
                               const Eigen::VectorXd& z) {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(measured.values.size());
  for (std::size_t k = 0; k < knobs.size(); ++k)
    if (knobs[k].exact)
      change += z[static_cast<Eigen::Index>(k)] * knobs[k].width * measured.by_camera.at(knobs[k].key);
  return change;
}

/// Returns the regression with a term for each exact knob among those of the scattered ones.
Emulator with_exact(const Emulator& e, const MeasuredFeatures& measured, const std::vector<Knob>& knobs) {
  const bool has_slopes = e.coefficients.rows() > 1;  // a point's regression has none
  std::vector<Eigen::Index> exact, regressed{0};
  Eigen::Index term = 1;
  for (const Knob& knob : knobs) {
    if (knob.exact)
      exact.push_back(term++);
    else if (has_slopes)
      regressed.push_back(term++);
  }
  while (std::ssize(regressed) < e.coefficients.rows()) regressed.push_back(term++);
  Emulator full{Eigen::MatrixXd::Zero(term, e.coefficients.cols()), e.residuals,
                Eigen::MatrixXd::Zero(e.terms.rows(), term), Eigen::MatrixXd::Zero(term, term), exact};
  full.coefficients(regressed, Eigen::all) = e.coefficients;
  full.terms(Eigen::all, regressed) = e.terms;
  full.inverse_normal(regressed, regressed) = e.inverse_normal;
  auto place = exact.begin();
  for (const Knob& knob : knobs)
    if (knob.exact)
      full.coefficients.row(*place++) = knob.width * measured.by_camera.at(knob.key).transpose();
  return full;
}

/// Names what simulations must share to be comparable: the setup but for the knobs' values, which knobs, and
/// what is read off.
std::string model_name(const Group& group, const std::vector<MeasuredFeatures>& measured,
                       const std::vector<Knob>& knobs, const Workshop& workshop) {
  Setup canonical = group.setup;
  canonical.run.duration = 1;
  std::string name;
  for (Knob knob : knobs) {
    knob.centre = (knob.low + knob.high) / 2;
    set_knob(canonical, knob, workshop.known);
    name += knob.key + ' ';
  }
  for (const std::size_t m : group.members)
    name += measured[m].run + ' ' + std::to_string(measured[m].values.size()) + ' ';
  return name + digest(canonical);
}

/// Returns the z of a pooled run; empty where it lies outside of 1.25 times the box.
std::optional<Eigen::VectorXd> place_in_box(const PooledRun& run, const std::vector<Knob>& knobs) {
  constexpr double edge = 1.25;
  Eigen::VectorXd z(run.values.size());
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    z[k] = knobs[static_cast<std::size_t>(k)].z_of(run.values[k]);
    if (std::abs(z[k]) > edge) return std::nullopt;
  }
  return z;
}

/// Puts an exact knob into the setup of a run. Where it has a width its column moves the features from where
/// the run was measured, with a number of the run's own where it has one; without a width the run is
/// simulated at the knob's value, moved as far from its own number as the knob is from what is believed of
/// all. A run whose column is zero knows its own number exactly.
void set_exact_knob(Setup& setup, const Knob& knob, const MeasuredFeatures& measured, KnownEffects known) {
  if (knob.width > 0) return;
  const auto column = measured.by_camera.find(knob.key);
  if (column != measured.by_camera.end() && column->second.isZero(0)) return;
  const double own = get_number(setup, knob.key, known);
  set_number(setup, knob.key, own == knob.believed ? knob.centre : own + (knob.centre - knob.believed),
             known);
}

struct Simulated {
  Eigen::VectorXd z;
  std::vector<Eigen::VectorXd> features;  // of each member
};

Simulated simulate(const Group& group, const std::vector<MeasuredFeatures>& measured,
                   const std::vector<Knob>& knobs, int run, double sparse, const Workshop& workshop) {
  Simulated simulated{scatter(knobs, group.setup.run.seed + 7919 * group.stream, run, sparse), {}};
  Setup setup = group.setup;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if (knobs[k].exact) {
      set_exact_knob(setup, knobs[k], measured[group.members.front()], workshop.known);
      continue;
    }
    Knob moved = knobs[k];
    moved.centre = moved.at(simulated.z[static_cast<Eigen::Index>(k)]);
    set_knob(setup, moved, workshop.known);
  }
  setup.run.seed += 104729 * group.stream;
  std::vector<ReadOff> read;
  for (const std::size_t m : group.members) read.push_back({measured[m].run, &measured[m].plan});
  simulated.features = workshop.store.find_or_simulate({setup, run, workshop.engine->name()}, read, [&] {
    return recorded_by(physics_of(setup).camera, run_surely(setup, run, workshop));
  });
  return simulated;
}

/// Adds what the pool has of this model in the box, and gives the pool what is new.
void exchange(std::vector<Simulated>& simulated, const std::string& model, const std::vector<Knob>& knobs,
              SimulationPool& pool) {
  std::vector<PooledRun>& pooled = pool[model];
  const std::size_t fresh = simulated.size(), before = is_point(knobs) ? 0 : pooled.size();
  for (std::size_t i = 0; i < before; ++i)
    if (const auto z = place_in_box(pooled[i], knobs)) simulated.push_back({*z, pooled[i].features});
  for (std::size_t i = 0; i < fresh; ++i) {
    Eigen::VectorXd values(simulated[i].z.size());
    for (Eigen::Index k = 0; k < values.size(); ++k)
      values[k] = knobs[static_cast<std::size_t>(k)].at(simulated[i].z[k]);
    pooled.push_back({values, simulated[i].features});
  }
}

}  // namespace

Eigen::MatrixXd Emulator::coefficients_without(Eigen::Index block, Eigen::Index blocks) const {
  std::vector<Eigen::Index> regressed;
  for (Eigen::Index term = 0; term < terms.cols(); ++term)
    if (std::find(exact.begin(), exact.end(), term) == exact.end()) regressed.push_back(term);
  const Eigen::MatrixXd design = terms(Eigen::all, regressed), inverse = inverse_normal(regressed, regressed);
  const Eigen::Index rows = (terms.rows() - block + blocks - 1) / blocks;
  const auto left_out = Eigen::seqN(block, rows, blocks);
  const Eigen::MatrixXd x = design(left_out, Eigen::all);
  const Eigen::MatrixXd wrong = residuals(left_out, Eigen::all) * std::sqrt(share_left(design));
  const Eigen::MatrixXd normal =
      inverse.ldlt().solve(Eigen::MatrixXd::Identity(design.cols(), design.cols())) - x.transpose() * x;
  Eigen::MatrixXd without = coefficients;
  without(regressed, Eigen::all) -= normal.ldlt().solve(x.transpose() * wrong);
  return without;
}

namespace {

std::vector<Knob> at_places(const std::vector<Eigen::Index>& places, const std::vector<Knob>& knobs) {
  std::vector<Knob> there;
  for (const Eigen::Index place : places) there.push_back(knobs[static_cast<std::size_t>(place)]);
  return there;
}

/// Returns the fewest simulations that a regression over these knobs can do with: a fifth of them is left to
/// tell the spread (an assumption).
int fewest_simulations(const std::vector<Knob>& knobs) {
  return static_cast<int>((5 * number_of_terms(at_places(scattered_places(knobs), knobs)) + 3) / 4);
}

}  // namespace

std::vector<Emulator> emulate(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
                              int wanted, int first_run, const Workshop& workshop, double sparse) {
  const int count = std::max(wanted, fewest_simulations(knobs));
  const std::vector<Group> groups = groups_of(measured);
  std::vector<std::vector<Simulated>> simulated(groups.size(),
                                                std::vector<Simulated>(static_cast<std::size_t>(count)));
  const int groups_count = static_cast<int>(groups.size());
  workshop.ask(static_cast<std::int64_t>(count) * groups_count);
  // The longest runs are begun first: groups in turn, so that the last ones are spread over all.
  work_in_parallel_deliver_in_order(count * groups_count, threads_or_all(workshop.execution.threads),
                                    [&](int job) -> std::function<void()> {
                                      const int row = job / groups_count;
                                      const auto g = static_cast<std::size_t>(job % groups_count);
                                      workshop.ask(0);
                                      simulated[g][static_cast<std::size_t>(row)] = simulate(
                                          groups[g], measured, knobs, first_run + row, sparse, workshop);
                                      return [&] { workshop.finished(1); };
                                    });
  std::vector<Emulator> emulators(measured.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (workshop.pool)
      exchange(simulated[g], model_name(groups[g], measured, knobs, workshop), knobs, *workshop.pool);
    const auto rows = static_cast<Eigen::Index>(simulated[g].size());
    const std::vector<Eigen::Index> places = scattered_places(knobs);
    const std::vector<Knob> varied = at_places(places, knobs);
    Eigen::MatrixXd terms(rows, number_of_terms(varied));
    for (Eigen::Index i = 0; i < rows; ++i)
      terms.row(i) =
          regression_terms(varied, simulated[g][static_cast<std::size_t>(i)].z(places)).transpose();
    for (std::size_t k = 0; k < groups[g].members.size(); ++k) {
      const std::size_t m = groups[g].members[k];
      Eigen::MatrixXd features(rows, measured[m].values.size());
      for (Eigen::Index i = 0; i < rows; ++i)
        features.row(i) = (simulated[g][static_cast<std::size_t>(i)].features[k] -
                           by_exact_knobs(measured[m], knobs, simulated[g][static_cast<std::size_t>(i)].z))
                              .transpose();
      emulators[m] = regress(terms, features);
      if (std::any_of(knobs.begin(), knobs.end(),
                      [](const Knob& knob) { return knob.exact && knob.width > 0; }))
        emulators[m] = with_exact(emulators[m], measured[m], knobs);
    }
  }
  return emulators;
}

}  // namespace shakedown
