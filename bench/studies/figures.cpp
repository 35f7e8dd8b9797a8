// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>

#include "friction_oscillator.hpp"
#include "least_squares.hpp"
#include "paper.hpp"
#include "theory.hpp"

namespace shakedown {

namespace {

std::vector<double> scaled(std::vector<double> values, double factor) {
  for (double& value : values) value *= factor;
  return values;
}

std::string millimetres(const DamperRuns& runs) { return fmt::format("{:g}", 1e3 * runs.setup.box.length); }

FrictionOscillator friction_damped(const DamperRuns& runs) {
  const Theory theory = theory_of(runs.setup);
  return {theory.stiffness, theory.total_mass, std::max(0.0, runs.over(&RunReading::friction).mean),
          runs.setup.release.displacement};
}

Curve friction_position(const DamperRuns& runs) {
  Curve curve{"friction-damped", runs.first.time, {}, true};
  const FrictionOscillator oscillator = friction_damped(runs);
  for (const double time : curve.x) curve.y.push_back(1e3 * oscillator.position_at(time));
  return curve;
}

/// Draws Figs. comp1 - comp4: positions of box and grains.
Chart positions(const DamperRuns& hard, const DamperRuns& soft, int number) {
  Chart chart{fmt::format("comp{}_L{}", number, millimetres(hard)),
              "Box and centre of the grains, L = " + millimetres(hard) + " mm",
              {}};
  chart.panels.push_back({"t, s",
                          "x_box, mm",
                          {{"hard, one run", hard.first.time, scaled(hard.first.x_box, 1e3)},
                           {"hard, mean", hard.first.time, scaled(hard.mean_x_box, 1e3)},
                           {"soft, mean", soft.first.time, scaled(soft.mean_x_box, 1e3)},
                           friction_position(hard)}});
  chart.panels.push_back({"t, s",
                          "x_com, mm",
                          {{"hard, one run", hard.first.time, scaled(hard.first.x_com, 1e3)},
                           {"hard, mean", hard.first.time, scaled(hard.mean_x_com, 1e3)},
                           {"soft, mean", soft.first.time, scaled(soft.mean_x_com, 1e3)}}});
  return chart;
}

/// Draws Fig. EnergyLoss.
Chart energy_loss(const DamperRuns& hard, const DamperRuns& soft) {
  Panel panel{"t, s", "energy lost, mJ", {}};
  constexpr std::array<const char*, 3> names{"P-P", "P-E", "P-S"};
  for (std::size_t c = 0; c < 3; ++c)
    panel.curves.push_back(
        {std::string(names[c]) + ", hard", hard.first.time, scaled(hard.first.loss[c], 1e3)});
  for (std::size_t c = 0; c < 3; ++c)
    panel.curves.push_back(
        {std::string(names[c]) + ", soft", soft.first.time, scaled(soft.first.loss[c], 1e3), true});
  return {
      "EnergyLoss", "Cumulative energy loss by class of contact, L = " + millimetres(hard) + " mm", {panel}};
}

std::vector<double> derivative(const std::vector<double>& time, const std::vector<double>& x) {
  std::vector<double> v(x.size(), std::nan(""));
  for (std::size_t i = 1; i + 1 < x.size(); ++i) v[i] = (x[i + 1] - x[i - 1]) / (time[i + 1] - time[i - 1]);
  return v;
}

/// Draws Fig. optimised: the first seconds at 311 mm.
Chart optimised(const DamperRuns& hard) {
  const auto until = static_cast<std::size_t>(8 * hard.setup.run.sample_rate);
  const auto head = [&](std::vector<double> values) {
    values.resize(std::min(values.size(), until));
    return values;
  };
  const std::vector<double> time = head(hard.first.time);
  Curve friction = friction_position(hard), friction_velocity{"friction-damped", time, {}, true};
  friction.x = head(friction.x), friction.y = head(friction.y);
  for (const double t : time) friction_velocity.y.push_back(friction_damped(hard).velocity_at(t));
  return {"optimised",
          "Position and velocity at L = 311 mm, one run of the hard engine",
          {{"t, s",
            "x, mm",
            {{"box", time, scaled(head(hard.first.x_box), 1e3)},
             {"grains", time, scaled(head(hard.first.x_com), 1e3)},
             friction}},
           {"t, s",
            "v, m/s",
            {{"box", time, head(hard.first.v_box)},
             {"grains", time, head(derivative(hard.first.time, hard.first.x_com))},
             friction_velocity}}}};
}

/// Draws Fig. optimalLSweep. Points where some run had not lost as much in 60 s stand apart, at the mean of
/// the others.
Chart length_sweep(const PaperRuns& runs) {
  Panel panel{"L, mm", "time to lose the share, s", {}};
  Curve censored{"some runs not within 60 s", {}, {}, false, true};
  constexpr std::array<const char*, 4> names{"50 %", "75 %", "90 %", "95 %"};
  for (std::size_t f = 0; f < names.size(); ++f) {
    Curve curve{names[f], {}, {}};
    for (const LengthPoint& point : runs.lengths.points) {
      curve.x.push_back(1e3 * point.length);
      curve.y.push_back(point.seconds[f].mean);
      if (point.censored[f] == 0) continue;
      censored.x.push_back(1e3 * point.length);
      censored.y.push_back(point.seconds[f].n > 0 ? point.seconds[f].mean : 60);
    }
    panel.curves.push_back(std::move(curve));
  }
  if (!censored.x.empty()) panel.curves.push_back(std::move(censored));
  const double optimum = 1e3 * theory_of(runs.hard[0].setup).optimal_length;
  panel.verticals.push_back({optimum, fmt::format("L_opt = {:.0f} mm", optimum)});
  Panel near = panel;  // the flat part, which the shortest boxes hide
  near.y_label = "the same above 100 mm, s";
  for (Curve& curve : near.curves)
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      if (curve.x[i] < 100) curve.y[i] = std::nan("");
  return {"optimalLSweep",
          "Time to lose a share of the energy against the length of the box, hard engine",
          {panel, near}};
}

/// Draws Fig. energies, with the linear fit until half of the smallest amplitude counted is reached.
Chart energies(const PaperRuns& runs) {
  Panel panel{"t, s", "sqrt(E), sqrt(mJ)", {}};
  for (const DamperRuns& r : runs.hard) {
    panel.curves.push_back(
        {"L = " + millimetres(r) + " mm", r.first.time, scaled(r.mean_root_energy, std::sqrt(1e3))});
    if (r.setup.box.length > 0.2) continue;
    const double end = r.over([](const RunReading& run) { return run.seen.first_small_peak; }).mean;
    const auto count = static_cast<Eigen::Index>(end * r.setup.run.sample_rate);
    Eigen::MatrixXd columns(count, 2);
    Eigen::VectorXd root(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      columns.row(i) << 1, r.first.time[static_cast<std::size_t>(i)];
      root[i] = std::sqrt(1e3) * r.mean_root_energy[static_cast<std::size_t>(i)];
    }
    const LeastSquares line = least_squares(columns, root);
    panel.curves.push_back({"line, " + millimetres(r) + " mm",
                            {0, end},
                            {line.coefficients[0], line.coefficients[0] + line.coefficients[1] * end},
                            true});
  }
  return {"energies", "Square root of the total energy, mean over runs, hard engine", {panel}};
}

Chart puzzle_chart(const Puzzle& puzzle) {
  Curve value{"fitted to L = 40 mm", {}, {}}, low{"95 % interval, low", {}, {}, true},
      high{"95 % interval, high", {}, {}, true}, paper{"the paper's fit", {}, {}, true};
  for (const PuzzlePoint& point : puzzle.points) {
    const FittedParameter& p = point.one.parameters.front();
    for (Curve* curve : {&value, &low, &high, &paper}) curve->x.push_back(point.friction);
    value.y.push_back(p.value), low.y.push_back(p.low), high.y.push_back(p.high), paper.y.push_back(0.75);
  }
  Chart chart{"puzzle",
              "Grains of restitution 0.95 with friction, fitted without friction",
              {{"friction in the laboratory", "fitted grain-grain restitution", {value, low, high, paper}}}};
  Panel errors{"run left out (1: 65, 2: 85, 3: 104 mm)", "error of x_box, mm", {}};
  for (const PuzzleModel& model : puzzle.models) {
    Curve curve{model.name, {}, {}};
    for (std::size_t i = 0; i < model.error.size(); ++i)
      curve.x.push_back(static_cast<double>(i + 1)), curve.y.push_back(1e3 * model.error[i]);
    errors.curves.push_back(std::move(curve));
  }
  chart.panels.push_back(std::move(errors));
  return chart;
}

}  // namespace

std::vector<Chart> charts_of(const PaperRuns& runs) {
  std::vector<Chart> charts;
  for (std::size_t i = 0; i < 4; ++i)
    charts.push_back(positions(runs.hard[i], runs.soft[i], static_cast<int>(i) + 1));
  charts.push_back(energy_loss(runs.hard[0], runs.soft[0]));
  charts.push_back(optimised(runs.hard[4]));
  charts.push_back(length_sweep(runs));
  charts.push_back(energies(runs));
  charts.push_back(puzzle_chart(runs.puzzle));
  return charts;
}

}  // namespace shakedown
