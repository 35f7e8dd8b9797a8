// SPDX-License-Identifier: MIT
#include "momentum.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "force_formula.hpp"
#include "momentum_fit.hpp"
#include "momentum_selection.hpp"
#include "robust_statistics.hpp"

namespace shakedown {

namespace {

constexpr double price_of_the_unlisted = 10;

/// The noise is estimated from the frames: its variance has an error of about 2 %, which widens chi2 like so
/// many degrees fewer.
BalanceFit balance_of(double chi2, double degrees) {
  constexpr double of_variance = 0.02;
  if (!(degrees > 0)) return {chi2, degrees, 1};
  const double effective = 2 / (2 / degrees + of_variance * of_variance);
  return {chi2, degrees, chi_squared_tail(chi2 * effective / degrees, effective)};
}
BalanceFit balance_of(const Regression& fit) { return balance_of(fit.chi2, fit.degrees); }

/// chi2 of the rows of one run.
BalanceFit balance_of_run(const MomentumProblem& problem, std::size_t run, const Eigen::VectorXd& residual,
                          double fitted) {
  return balance_of(
      residual.segment(problem.begin(run), problem.rows(run)).squaredNorm(),
      static_cast<double>(problem.rows(run)) * (1 - fitted / static_cast<double>(problem.size())));
}

RunBalance run_as_given(const MomentumProblem& problem, std::size_t run) {
  RunBalance balance;
  balance.run = problem.run_name(run);
  balance.as_given = balance_of_run(problem, run, problem.impulse(), 0);
  if (problem.rows(run) == 0) return balance;  // the box of this run hardly moves
  const double weight = problem.form(run).weight();
  const Eigen::VectorXd deviation = problem.raw_deviation(run) / weight;
  const Eigen::VectorXd force = problem.raw_impulse(run) / weight;
  balance.missing_force_noise = deviation.mean();
  balance.missing_force = std::sqrt(
      std::max(0.0, (force.squaredNorm() - deviation.squaredNorm()) / static_cast<double>(force.size())));
  return balance;
}

/// Terms that could stand in for this one.
std::vector<std::string> look_alikes(const SelectionProblem& p, const Selection& selection,
                                     std::size_t which) {
  std::vector<std::string> names;
  std::vector<ChosenTerm> others = selection.chosen;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(which));
  const Eigen::MatrixXd columns = columns_of(p, others);
  const Regression without = regress(p.problem.impulse(), columns);
  const Eigen::MatrixXd basis = orthonormal_basis(columns);
  for (std::size_t term = 1; term < momentum_terms().size(); ++term) {
    if (std::any_of(selection.chosen.begin(), selection.chosen.end(),
                    [&](const ChosenTerm& c) { return c.term == static_cast<int>(term); }))
      continue;
    const Gain gain =
        gain_of(without.residual, basis, p.problem.column(p.terms[term]), p.terms[term].never_negative);
    if (gain.gain > 0 && without.chi2 - gain.gain < selection.fit.chi2 + as_good)
      names.push_back(p.terms[term].name);
  }
  return names;
}

FoundTerm sine_found(double frequency, double sine, double cosine, double error) {
  FoundTerm found{"oscillating_acceleration", "amplitude", "m/s^2"};
  found.value = std::hypot(sine, cosine);
  found.low = std::max(0.0, found.value - 1.96 * error);
  found.high = found.value + 1.96 * error;
  found.frequency = frequency;
  found.phase = std::atan2(cosine, sine);
  found.gain = found.value * found.value / (error * error);
  return found;
}

FoundTerm term_found(const SelectionProblem& p, const Selection& selection, std::size_t which,
                     Eigen::Index column) {
  const MomentumTerm& term = momentum_terms()[static_cast<std::size_t>(selection.chosen[which].term)];
  FoundTerm found{term.effect, term.parameter, term.unit, term.kind};
  const auto parameter = [&](double strength) {
    return term.parameter_of ? term.parameter_of(strength) : strength;
  };
  const double strength = selection.fit.strength[column], error = selection.fit.error[column];
  // When the balance is not closed the noise is not the whole error.
  const double wide = 1.96 * error * std::sqrt(std::max(1.0, selection.fit.chi2 / selection.fit.degrees));
  found.value = parameter(strength);
  std::tie(found.low, found.high) = std::minmax({parameter(strength - wide), parameter(strength + wide)});
  found.gain = strength * strength / (error * error);
  found.look_alikes = look_alikes(p, selection, which);
  return found;
}

std::vector<SingleTerm> ranking_of(const SelectionProblem& p, const Selection& refitted) {
  std::vector<SingleTerm> ranking;
  for (std::size_t term = 1; term < momentum_terms().size(); ++term) {
    const Gain gain = gain_of_term(p, refitted, static_cast<int>(term));
    ranking.push_back({p.terms[term].name, gain.gain, gain.strength, gain.error});
  }
  std::stable_sort(ranking.begin(), ranking.end(),
                   [](const SingleTerm& a, const SingleTerm& b) { return a.gain > b.gain; });
  return ranking;
}

int term_number(const std::string& effect) {
  const std::vector<MomentumTerm>& terms = momentum_terms();
  for (std::size_t i = 0; i < terms.size(); ++i)
    if (terms[i].effect == effect) return static_cast<int>(i);
  return -1;
}

/// A heavier box and a smaller x_com - x_box are the same to the balance. The packed layer lies at (1 -
/// b)(L/2 - h): its slope against L decides, and where it cannot, the mass stays, because a camera is checked
/// with a ruler.
void settle_mass_or_bias(SelectionProblem& p, const PlateauSlope& plateau, Selection& selection) {
  const int mass = term_number("blade_mass"), bias = term_number("camera_com_bias");
  for (std::size_t which = 1; which < selection.chosen.size(); ++which) {
    const int now = selection.chosen[which].term;
    if (now != mass && now != bias) continue;
    const int other = now == mass ? bias : mass;
    std::vector<ChosenTerm> swapped = selection.chosen;
    swapped[which] = {other, 0};
    const Selection with_other = fit_terms(p, swapped), with_now = fit_terms(p, selection.chosen);
    Eigen::Index column = 0;
    for (std::size_t i = 0; i < which; ++i) column += selection.chosen[i].term < 0 ? 2 : 1;
    const double strength = (now == bias ? with_now : with_other).fit.strength[column];
    const double mass_strength = (now == mass ? with_now : with_other).fit.strength[column];
    bool is_mass = mass_strength > 0 && std::abs(with_other.fit.chi2 - with_now.fit.chi2) < 4;
    if (mass_strength > 0 && std::isfinite(plateau.slope)) {
      const double as_bias = (plateau.slope - 0.5 / (1 + strength)) / plateau.error,
                   as_mass = (plateau.slope - 0.5) / plateau.error;
      if (std::abs(as_mass * as_mass - as_bias * as_bias) > 4)
        is_mass = as_mass * as_mass < as_bias * as_bias;
    }
    selection = fit_terms(p, is_mass == (now == mass) ? selection.chosen : swapped);
  }
}

bool has_dry_friction(const Selection& selection) {
  return std::any_of(selection.chosen.begin(), selection.chosen.end(), [](const ChosenTerm& c) {
    return c.term >= 0 && c.term < static_cast<int>(momentum_terms().size()) &&
           momentum_terms()[static_cast<std::size_t>(c.term)].effect == "clamp_dry_friction";
  });
}

void describe(const SelectionProblem& p, const Selection& selection, double frequency, MomentumAudit& audit) {
  audit.final_fit = balance_of(selection.fit);
  const double spring = selection.fit.strength[0], error = selection.fit.error[0];
  audit.frequency = frequency * std::sqrt(1 + spring);
  audit.frequency_low = frequency * std::sqrt(1 + spring - 1.96 * error);
  audit.frequency_high = frequency * std::sqrt(1 + spring + 1.96 * error);
  Eigen::Index column = 1;
  for (std::size_t which = 1; which < selection.chosen.size(); ++which) {
    const bool sine = selection.chosen[which].term < 0;
    const bool formula = selection.chosen[which].term >= static_cast<int>(momentum_terms().size());
    if (sine)
      audit.terms.push_back(sine_found(selection.chosen[which].frequency, selection.fit.strength[column],
                                       selection.fit.strength[column + 1],
                                       selection.fit.error.segment(column, 2).maxCoeff()));
    else if (!formula)
      audit.terms.push_back(term_found(p, selection, which, column));
    column += sine ? 2 : 1;
  }
  for (std::size_t run = 0; run < p.problem.runs(); ++run)
    for (RunBalance& balance : audit.runs)
      if (balance.run == p.problem.run_name(run))
        balance.final_fit =
            balance_of_run(p.problem, run, selection.fit.residual, static_cast<double>(column));
}

}  // namespace

MomentumAudit audit_momentum(const std::vector<MomentumRun>& runs, const PlateauSlope& plateau,
                             double frequency, const MomentumOptions& options) {
  MomentumAudit audit;
  SelectionProblem p = selection_problem(runs, frequency, options);
  audit.possible = p.problem.size() > 20;
  if (!audit.possible) {
    audit.why_not = "no run has both the box's and the grains' position over more than a few periods";
    return audit;
  }
  // A box that sticks obeys no sgn v: judge it only where it moves by 30 standard deviations of the camera's
  // noise.
  const auto only_moving = [&] {
    double noise = 0;
    for (const MomentumRun& run : runs) noise = std::max(noise, run.box_noise.standard_deviation);
    SelectionProblem moving = p;
    moving.problem.keep_moving(30 * noise);
    if (moving.problem.size() <= 20) return;
    p = std::move(moving);
    audit.only_moving = true;
  };
  if (std::any_of(runs.begin(), runs.end(), [](const MomentumRun& run) { return run.dry_friction; }))
    only_moving();
  for (std::size_t run = 0; run < p.problem.runs(); ++run) audit.runs.push_back(run_as_given(p.problem, run));
  audit.as_given = balance_of(regress(p.problem.impulse(), Eigen::MatrixXd(p.problem.size(), 0)));
  const Selection refitted = fit_terms(p, {{0, 0}});
  audit.refitted = balance_of(refitted.fit);
  audit.ranking = ranking_of(p, refitted);

  Selection selection = select_terms(p, options);
  const SingleTerm& first = audit.ranking.front();
  if (!audit.only_moving &&
      (has_dry_friction(selection) || (first.effect == "clamp_dry_friction" && first.gain > 20))) {
    only_moving();
    if (audit.only_moving) selection = select_terms(p, options);
  }
  settle_mass_or_bias(p, plateau, selection);
  MomentumOptions shorter = options;
  shorter.window_periods /= 3;
  SelectionProblem fast = selection_problem(runs, frequency, shorter);
  const std::optional<FastSine> sine =
      find_fast_sine(fast, selection.chosen, p.highest_frequency, options.highest_frequency);
  if (sine) {
    selection.chosen.push_back({-1, sine->frequency});
    // What the longer windows chose in place of the sine they cannot see is no longer needed.
    Selection all = fit_terms(fast, selection.chosen);
    while (drop_needless(fast, all)) {
    }
    std::erase_if(all.chosen,
                  [&](const ChosenTerm& c) { return c.term < 0 && c.frequency == sine->frequency; });
    all.chosen.push_back({-1, sine->frequency});  // last, whatever the order
    selection = fit_terms(p, all.chosen);
  }
  if (options.formulas &&
      (selection.chosen.size() > 1 || balance_of(selection.fit).p_value < options.accept_p)) {
    // Known terms have the advantage: a formula must be better by more than the price of its parameters.
    FormulaFit formulas = fit_formulas(p, options);
    audit.unlisted =
        !formulas.formulas.empty() && formulas.cost < cost_of(p, selection) - price_of_the_unlisted;
    if (audit.unlisted) {
      audit.formulas = std::move(formulas.formulas);
      p = std::move(formulas.problem);
      selection = std::move(formulas.selection);
    }
    if (audit.unlisted || balance_of(selection.fit).p_value < options.accept_p)
      audit.curves = std::move(formulas.curves);
  }
  describe(p, selection, frequency, audit);
  if (sine && !audit.unlisted)
    audit.terms.back() =
        sine_found(sine->frequency, sine->sine, sine->cosine, sine->error);  // better seen there
  if (!audit.unlisted && !audit.terms.empty()) {
    const auto alike = formulas_like_known_terms(p, selection);
    for (std::size_t i = 0; i < audit.terms.size(); ++i)
      audit.terms[i].look_alikes.insert(audit.terms[i].look_alikes.end(), alike[i + 1].begin(),
                                        alike[i + 1].end());
  }
  audit.unexplained = audit.final_fit.p_value <= balance_rejected;
  return audit;
}

MomentumAudit audit_momentum(const Experiment& experiment, const Audit& audit,
                             const std::vector<Setup>& setups, const MomentumOptions& options) {
  EXPECT(setups.size() == experiment.runs.size() && audit.runs.size() == experiment.runs.size());
  std::vector<MomentumRun> runs;
  bool one_release = true;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    runs.push_back(momentum_run(audit.runs[i], experiment.runs[i], setups[i]));
    one_release = one_release && runs[i].displacement == runs[0].displacement;
    runs[i].displacement = runs[0].displacement;  // of one spring
  }
  MomentumAudit found =
      audit_momentum(runs, audit.plateau, setups.empty() ? 1.0 : setups.front().spring.frequency, options);
  if (!one_release) found.reference_displacement = std::abs(runs[0].displacement);
  return found;
}

}  // namespace shakedown
