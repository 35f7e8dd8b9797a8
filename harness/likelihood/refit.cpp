// SPDX-License-Identifier: MIT
#include "refit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "distributions.hpp"
#include "errors.hpp"
#include "fit_round.hpp"

namespace shakedown {

namespace {

/// How far (in boxes) the regression's slopes are trusted about simulations at one point, and the share of
/// chi2 that a step must promise to be worth simulations of its own at its end.
constexpr double nearby = 0.5, step_gain = 0.1;
/// Scatter from which on no other place along a valley mends a fit.
constexpr double beyond_a_valley = 2;

double root_mean_square(const std::vector<RunComparison>& runs, double RunComparison::*what) {
  double squares = 0;
  for (const RunComparison& run : runs) squares += run.*what * (run.*what);
  return runs.empty() ? 0 : std::sqrt(squares / static_cast<double>(runs.size()));
}

void set_value(const Knob& knob, double at, FittedValue& value) {
  value.value = at;
  value.low = std::max(knob.low, at - normal_95 * value.error);
  value.high = std::min(knob.high, at + normal_95 * value.error);
  value.at_bound = at <= knob.low || at >= knob.high;
}

void judge_at(const FitRound& round, std::size_t runs, const Eigen::VectorXd& z, Refit& result) {
  result.chi2 = round.objective().chi2(z);
  result.runs.clear();
  const Eigen::MatrixXd covariance = round.covariance_at(z, reach);
  for (std::size_t r = 0; r < runs; ++r) {
    result.runs.push_back(round.comparison(r, z));
    result.runs.back().validation = round.validation(result.runs.back(), r, z, covariance);
  }
  round.calibrate(z, result.chi2, result);
}

/// Sets the chi2 of all runs with what the knobs' values cost, by the covariances of `other` (null: the
/// round's own) and by the round's own.
void set_judged(const FitRound& round, std::size_t runs, const Eigen::VectorXd& z, const Refit* other,
                Refit& result) {
  const std::vector<JudgingRule> own = round.rules_of(nullptr), asked = round.rules_of(other);
  result.judged_chi2 = result.own_chi2 = result.disbelief = round.objective().disbelief(z);
  for (std::size_t r = 0; r < runs; ++r) {
    result.judged_chi2 += round.judged_chi2(r, z, asked[r]);
    result.own_chi2 += round.judged_chi2(r, z, own[r]);
  }
}

bool is_clearly_more(double scatter, double than) {
  constexpr double more = 0.3;  // codes of one physics differ by 0.1 to 0.33 (rules.hpp)
  return scatter > (1 + more) * than + more;
}

/// Tells whether the emulator promised much more than its solution keeps.
bool misled(const Refit& result) { return is_clearly_more(result.scatter, result.promised_scatter); }

/// Returns the knobs about z, straight, for there a line is enough.
std::vector<Knob> centred_at(const Eigen::VectorXd& z, std::vector<Knob> knobs) {
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    knobs[k].centre = knobs[k].at(z[static_cast<Eigen::Index>(k)]);
    knobs[k].curved = knobs[k].cubic = false;
  }
  return knobs;
}

std::vector<Emulator> simulated(std::vector<Knob> knobs, int count, int first_run,
                                const std::vector<MeasuredFeatures>& measured, const Workshop& workshop) {
  for (Knob& knob : knobs) knob.width = 0;
  return emulate(measured, knobs, count, first_run, workshop);
}

/// Holds simulations at one point, and the minimum that the regression's slopes find about their mean: the
/// regression itself, led by what it cannot follow, may miss the minimum near by.
struct Confirmed {
  std::vector<Knob> about;
  FitRound round;
  Eigen::VectorXd minimum;
  double chi2_here, chi2_there;

  Confirmed(const Eigen::VectorXd& z, int first_run, const FitRound& emulated,
            const std::vector<MeasuredFeatures>& measured, const Workshop& workshop,
            const RefitOptions& options)
      : about(centred_at(z, emulated.knobs())),
        round(measured, about,
              emulated.recentred(z, simulated(about, options.confirming, first_run, measured, workshop)),
              options),
        minimum(minimum_of(round.objective(), nearby, 1).z),
        chi2_here(round.objective().chi2(Eigen::VectorXd::Zero(z.size()))),
        chi2_there(round.objective().chi2(minimum)) {}
  Confirmed(const Confirmed&) = delete;  // the round refers to `about`
  Confirmed& operator=(const Confirmed&) = delete;

  bool worth_a_step() const { return chi2_there < (1 - step_gain) * chi2_here; }
  /// Returns the minimum, or the point itself where the minimum promises so much that simulations have to see
  /// it first.
  Eigen::VectorXd solution() const {
    return worth_a_step() ? Eigen::VectorXd::Zero(minimum.size()).eval() : minimum;
  }
  double chi2() const { return worth_a_step() ? chi2_here : chi2_there; }
};

/// Multiplies variances of the fit, where simulations have shown more scatter than its emulator promised.
void widen(double variance, Refit& result) {
  if (!(variance > 1)) return;
  result.covariance *= variance;
  result.least_known *= std::sqrt(variance);
  for (FittedValue& value : result.values) value.error *= std::sqrt(variance);
}

/// Judges the solution by simulations made there, which also move it (a step of Gauss and Newton).
void confirm(const FitRound& emulated, const std::vector<MeasuredFeatures>& measured,
             const Workshop& workshop, const RefitOptions& options, const Eigen::VectorXd& z, Refit& result) {
  result.promised_scatter = result.scatter;
  result.promised_chi2 = result.judged_chi2;
  const int first_run = options.first_run + 9000;
  const Confirmed first(z, first_run, emulated, measured, workshop, options);
  std::optional<Confirmed> second;
  if (first.worth_a_step())
    second.emplace(z + first.minimum, first_run + 250, emulated, measured, workshop, options);
  // What the slopes promised may not be there.
  const Confirmed& best = second && second->chi2() < first.chi2() ? *second : first;
  const Eigen::VectorXd solution = best.solution();
  judge_at(best.round, measured.size(), solution, result);
  widen(std::max(1.0, result.scatter) / std::max(1.0, result.promised_scatter), result);
  for (std::size_t k = 0; k < best.about.size(); ++k)
    set_value(best.about[k], best.about[k].at(solution[static_cast<Eigen::Index>(k)]), result.values[k]);
  result.covariances = best.round.covariances();
  result.for_means = best.round.for_means(options.model_error);
  result.at_solution = best.round.moved_to(solution);
  set_judged(best.round, measured.size(), solution, options.judged_by, result);
}

/// Returns the most that two codes differ by in any effect of these models.
double codes_differ_in(const std::vector<MeasuredFeatures>& measured) {
  double most = codes_differ;
  for (const MeasuredFeatures& run : measured)
    for (const EffectChoice& effect : run.setup.effects) most = std::max(most, effect.record->codes_differ);
  return most;
}

Refit result_at(const FitRound& round, const std::vector<MeasuredFeatures>& measured,
                const std::vector<Knob>& knobs, const Minimum& minimum, const Workshop& workshop,
                const RefitOptions& options) {
  Refit result;
  result.knobs = knobs;
  result.codes_differ = codes_differ_in(measured);
  judge_at(round, measured.size(), minimum.z, result);
  Eigen::MatrixXd covariance = round.covariance_at(minimum.z, reach) * std::max(1.0, result.scatter);
  const auto scattered =
      std::count_if(knobs.begin(), knobs.end(), [](const Knob& knob) { return !knob.exact; });
  if (scattered > 0) covariance += round.emulator_scatter(minimum.z);
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    FittedValue value{knobs[k].key, 0, 0, 0, std::sqrt(covariance(i, i)) * knobs[k].width, false};
    set_value(knobs[k], knobs[k].at(minimum.z[i]), value);
    result.values.push_back(value);
  }
  result.covariance = covariance;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    result.covariance.row(i) *= knobs[k].width;
    result.covariance.col(i) *= knobs[k].width;
  }
  result.least_known = Eigen::VectorXd::Zero(std::ssize(knobs));
  if (scattered > 0) {
    std::vector<Eigen::Index> open;
    for (std::size_t k = 0; k < knobs.size(); ++k)
      if (!knobs[k].exact) open.push_back(static_cast<Eigen::Index>(k));
    const Eigen::MatrixXd of_open = covariance(open, open);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(of_open);  // in units of the box
    const Eigen::Index least = scattered - 1;
    for (Eigen::Index k = 0; k < scattered; ++k)
      result.least_known[open[static_cast<std::size_t>(k)]] =
          axes.eigenvectors()(k, least) * std::sqrt(std::max(0.0, axes.eigenvalues()[least])) *
          knobs[static_cast<std::size_t>(open[static_cast<std::size_t>(k)])].width;
  }
  set_judged(round, measured.size(), minimum.z, options.judged_by, result);
  result.covariances = round.covariances();
  result.for_means = round.for_means(options.model_error);
  if (options.confirming > 0 && scattered > 0) try {
      confirm(round, measured, workshop, options, minimum.z, result);
    } catch (const BudgetSpent&) {  // the emulator's solution stands
    }
  // Lengths left out are fitted anew, which only the emulators can do.
  round.hold_out(result, round.rules_of(options.judged_by ? options.judged_by : &result));
  return result;
}

/// Returns the box for the next round: about the solution, as wide as what is still open, so that a long
/// valley is seen whole, but not wider than 0.6 of the first one: a regression over more than it can follow
/// takes its own misfit for chaos.
std::vector<Knob> next_box(std::vector<Knob> knobs, const Minimum& minimum, const Eigen::MatrixXd& covariance,
                           const std::vector<Knob>& first) {
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if (knobs[k].exact) continue;
    const auto i = static_cast<Eigen::Index>(k);
    const double z = minimum.z[i], open = 2 * std::sqrt(covariance(i, i));
    knobs[k].centre = knobs[k].at(z);
    // From the edge the next box is no narrower, or the solution would lie outside.
    // Shares of the box, assumptions.
    constexpr double edge = 0.8, narrowest = 0.25, widest = 1.5, of_the_first = 0.6;
    knobs[k].width = std::min(knobs[k].width * std::clamp(open, std::abs(z) < edge ? narrowest : 1.0, widest),
                              of_the_first * first[k].width);
  }
  return knobs;
}

/// Returns the first box, half as wide at each look.
std::vector<Knob> about_the_beginning(std::vector<Knob> first, int looks) {
  for (Knob& knob : first)
    if (!knob.exact) knob.width *= std::pow(0.5, looks + 1);
  return first;
}

/// Returns the box to look at next. Where the best solution so far is clearly worse than the beginning, about
/// that. Else about the solution: half as wide where the emulator was misled, or along the valley 1.5
/// standard errors to one side, then to the other. Empty where there is no need.
std::vector<Knob> next_look(const Refit& latest, const Refit& best, const std::vector<Knob>& first,
                            const std::vector<Knob>& last, const RefitOptions& options, int looks) {
  if (options.confirming > 0 && !last.empty() && looks < options.most_looks &&
      is_clearly_more(best.scatter, options.scatter_at_start))
    return about_the_beginning(first, looks);
  const bool nearer = misled(latest) && latest.promised_chi2 < options.look_again_below;
  const bool beside_it = best.p_value <= options.look_beside_below && best.scatter < beyond_a_valley;
  if (options.confirming == 0 || last.empty() || looks >= options.most_looks || !(nearer || beside_it))
    return {};
  std::vector<Knob> knobs = last;
  for (std::size_t k = 0; k < knobs.size(); ++k) {
    if (knobs[k].exact) continue;
    const double beside =
        nearer ? 0 : (looks % 2 == 0 ? 1.5 : -1.5) * best.least_known[static_cast<Eigen::Index>(k)];
    knobs[k].centre = std::clamp(best.values[k].value + beside, knobs[k].low, knobs[k].high);
    if (nearer) knobs[k].width *= 0.5;
  }
  return knobs;
}

/// Makes rounds about better and better places; `best` is kept up to date, so that it stands where
/// simulations are refused. Where there is one already, these are looks beside it.
Refit refit_by_rounds(const std::vector<MeasuredFeatures>& measured, std::vector<Knob> knobs,
                      const Workshop& workshop, const RefitOptions& options, std::optional<Refit>& best) {
  const std::vector<Knob> first = knobs;
  SimulationPool of_this_fit;
  Workshop pooling = workshop;
  if (pooling.pool == nullptr) pooling.pool = &of_this_fit;
  const bool nothing_to_scatter =
      std::all_of(knobs.begin(), knobs.end(), [](const Knob& knob) { return knob.exact; });
  int looks = 0;
  if (best) {
    knobs = next_look(*best, *best, first, knobs, options, looks++);
    if (knobs.empty()) return *best;
  }
  for (int number = best ? options.rounds : 1;; ++number) {
    const std::vector<Knob> here = knobs;
    // Rounds that only find the way, or look again where many were made, need fewer simulations than the one
    // that judges.
    const int count = nothing_to_scatter || (number >= options.rounds && !best)
                          ? options.count
                          : simulations_on_the_way(options.count);
    const FitRound round(
        measured, here, emulate(measured, here, count, options.first_run + 10000 * number, pooling), options);
    const Minimum minimum = minimum_of(round.objective(), reach, nothing_to_scatter ? 1 : 6);
    constexpr double outside = 1.05;  // of the box: an assumption
    bool left_the_box = false;
    for (std::size_t k = 0; k < knobs.size(); ++k) {
      const double z = minimum.z[static_cast<Eigen::Index>(k)];
      const bool inner = here[k].at(z) > here[k].low && here[k].at(z) < here[k].high;
      left_the_box = left_the_box || (std::abs(z) > outside && inner && !here[k].exact);
    }
    const bool last =
        nothing_to_scatter || number >= options.most_rounds || (number >= options.rounds && !left_the_box);
    if (!last) {
      knobs = next_box(here, minimum, round.covariance_at(minimum.z, reach), first);
      continue;
    }
    Refit result = result_at(round, measured, here, minimum, pooling, options);
    if (!best || result.scatter < best->scatter || std::isnan(best->scatter)) best = result;
    if (nothing_to_scatter) return *best;
    knobs = next_look(result, *best, first, here, options, looks++);
    if (knobs.empty()) return *best;
  }
}

}  // namespace

void set_errors(RunComparison& run, const FeaturePlan& plan, const Eigen::VectorXd& left) {
  std::array<double, 2> squares{}, spread{}, count{};
  for (Eigen::Index f = 0; f < run.residual.size(); ++f) {
    const auto observable = static_cast<std::size_t>(plan.features[static_cast<std::size_t>(f)].observable);
    squares[observable] += left[f] * left[f];
    spread[observable] += run.spread[f] * run.spread[f];
    ++count[observable];
  }
  const auto root = [&](double sum, std::size_t which) {
    return count[which] > 0 ? std::sqrt(sum / count[which]) : 0.0;
  };
  run.error_box = root(squares[0], 0), run.error_centre = root(squares[1], 1);
  run.floor_box = root(spread[0], 0), run.floor_centre = root(spread[1], 1);
}

std::vector<Validation> Refit::validation() const {
  std::vector<Validation> rows;
  for (const RunComparison& run : runs) rows.insert(rows.end(), run.validation.begin(), run.validation.end());
  return rows;
}

std::vector<Difference> differences_of(const std::vector<RunComparison>& runs) {
  const auto of_all = [&](double RunComparison::*member) { return root_mean_square(runs, member); };
  std::vector<Difference> list{{"box", of_all(&RunComparison::error_box), of_all(&RunComparison::floor_box)}};
  if (const double floor = of_all(&RunComparison::floor_centre); floor > 0)
    list.push_back({"grains' centre", of_all(&RunComparison::error_centre), floor});
  for (const RunComparison& run : runs)
    for (Difference& row : differences_of(run.validation)) list.push_back(std::move(row));
  return list;
}

double Refit::error_box() const { return root_mean_square(runs, &RunComparison::error_box); }
double Refit::error_centre() const { return root_mean_square(runs, &RunComparison::error_centre); }
double Refit::floor_box() const { return root_mean_square(runs, &RunComparison::floor_box); }
double Refit::floor_centre() const { return root_mean_square(runs, &RunComparison::floor_centre); }

Refit refit(const std::vector<MeasuredFeatures>& measured, std::vector<Knob> knobs, const Workshop& workshop,
            const RefitOptions& options) {
  std::optional<Refit> best;
  try {
    return refit_by_rounds(measured, std::move(knobs), workshop, options, best);
  } catch (const BudgetSpent&) {
    if (!best) throw;
    return *best;
  }
}

Refit look_beside(const Refit& fit, const std::vector<MeasuredFeatures>& measured, const Workshop& workshop,
                  const RefitOptions& options) {
  std::optional<Refit> best = fit;
  try {
    return refit_by_rounds(measured, fit.knobs, workshop, options, best);
  } catch (const BudgetSpent&) {
    return *best;
  }
}

Refit compare_at(const std::vector<MeasuredFeatures>& measured, const std::vector<Knob>& knobs,
                 const Workshop& workshop, const RefitOptions& options) {
  std::vector<MeasuredFeatures> fixed = measured;
  for (MeasuredFeatures& m : fixed)
    m.setup = setup_at(m.setup, knobs, Eigen::VectorXd::Zero(static_cast<Eigen::Index>(knobs.size())),
                       workshop.known);
  return refit(fixed, {}, workshop, options);
}

}  // namespace shakedown
