// SPDX-License-Identifier: MIT
#include "force_formula.hpp"

#include <algorithm>
#include <cmath>

#include "distributions.hpp"
#include "term_prices.hpp"

namespace shakedown {

namespace {

constexpr double price_of_being_unlisted = 6;

double log_size(const SelectionProblem& p) { return std::log(static_cast<double>(p.problem.size())); }

double price_of(const SelectionProblem& p, const ForceShape& shape) {
  return (1 + static_cast<double>(shape.parameters.size())) * log_size(p) + price_of_a_term +
         price_of_being_unlisted;
}

struct BestShape {
  const ForceShape* shape = nullptr;
  ShapeValues values{};
  double gain = 0;
  double surplus = 0;
};

double scale_of(const ShapeParameter& parameter, const MotionScales& scales) {
  if (parameter.unit.empty()) return 1;
  if (parameter.unit == "s") return scales.duration;
  return parameter.scale_of == ShapeOf::velocity ? scales.velocity : scales.position;
}

/// Returns all combinations of the starting values.
std::vector<ShapeValues> starts_of(const ForceShape& shape, const MotionScales& scales) {
  std::vector<ShapeValues> starts{ShapeValues{}};
  for (std::size_t i = 0; i < shape.parameters.size(); ++i) {
    std::vector<ShapeValues> more;
    for (const ShapeValues& before : starts)
      for (const double value : shape.parameters[i].start) {
        more.push_back(before);
        more.back()[i] = value * scale_of(shape.parameters[i], scales);
      }
    starts = std::move(more);
  }
  return starts;
}

/// Tells whether the values lie no more than a little beyond the starting values: a very wide bump is a
/// polynomial in disguise, and a width cannot pass zero.
bool in_bounds(const ForceShape& shape, const ShapeValues& values, const MotionScales& scales) {
  // These are assumptions but for the speed: below six of its errors it has no sure sign.
  constexpr double beyond = 1.3, narrower = 1 / 3.0, wider = 1.5, sure = 6, narrowest = 0.005;
  for (std::size_t i = 0; i < shape.parameters.size(); ++i) {
    const ShapeParameter& parameter = shape.parameters[i];
    const auto [low, high] = std::minmax_element(parameter.start.begin(), parameter.start.end());
    const double scale = scale_of(parameter, scales), value = values[i];
    if (parameter.name == "q") continue;
    if (parameter.name == "v0" && value < sure * scales.velocity_noise) return false;
    if (*low <= 0 && (value < beyond * *low * scale || value > beyond * *high * scale)) return false;
    if (*low > 0 && (value < *low * scale * narrower || value > wider * *high * scale)) return false;
    if (*low < 0 && parameter.name == "w" && std::abs(value) < narrowest * scale) return false;
  }
  return true;
}

/// Climbs from a start by steps that shrink where no direction helps.
void climb(const ForceMap& map, const ForceShape& shape, ShapeValues& values, double& gain) {
  constexpr int most_rounds = 60, fewest_rounds = 10;  // cost: sixty halvings are below rounding
  constexpr double fine = 1e-5;                        // in units of the shape
  ShapeValues step{};
  for (std::size_t i = 0; i < shape.parameters.size(); ++i)
    step[i] = 0.2 * std::max(std::abs(values[i]), 0.2 * scale_of(shape.parameters[i], map.scales()));
  for (int round = 0; round < most_rounds; ++round) {
    bool moved = false;
    for (std::size_t i = 0; i < shape.parameters.size(); ++i)
      for (const double direction : {1.0, -1.0}) {
        ShapeValues trial = values;
        trial[i] += direction * step[i];
        if (!in_bounds(shape, trial, map.scales())) continue;
        const double now = map.gain(shape, trial);
        if (now > gain) values = trial, gain = now, moved = true;
      }
    if (!moved)
      for (double& s : step) s /= 2;
    if (round > fewest_rounds && *std::max_element(step.begin(), step.end()) < fine) break;
  }
}

BestShape best_of(const SelectionProblem& p, const ForceMap& map, const ForceShape& shape) {
  BestShape best{&shape};
  std::vector<std::pair<double, ShapeValues>> tried;
  for (const ShapeValues& values : starts_of(shape, map.scales()))
    if (in_bounds(shape, values, map.scales())) tried.push_back({map.gain(shape, values), values});
  std::stable_sort(tried.begin(), tried.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t i = 0; i < std::min<std::size_t>(3, tried.size()); ++i) {
    auto [gain, values] = tried[i];
    climb(map, shape, values, gain);
    if (gain > best.gain) best.gain = gain, best.values = values;
  }
  best.surplus = best.gain - price_of(p, shape);
  return best;
}

PreparedTerm prepared_from(const SelectionProblem& p, const ForceShape& shape, const ShapeValues& values) {
  PreparedTerm term;
  term.name = shape.formula;
  term.shape = &shape;
  term.shape_values = values;
  for (const MomentumRun& run : *p.runs)
    term.samples.push_back(run.time.size() ? shape_samples(shape, values, run) : ForceSamples{});
  return term;
}

Eigen::Index column_of(const Selection& selection, std::size_t which) {
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < which; ++i) column += selection.chosen[i].term < 0 ? 2 : 1;
  return column;
}

/// Returns the columns of the fit and, behind them, the derivatives by the shape parameters of one formula.
Eigen::MatrixXd tangent_columns(const SelectionProblem& p, const Selection& selection, std::size_t which) {
  const PreparedTerm& term = p.terms[static_cast<std::size_t>(selection.chosen[which].term)];
  const double strength = selection.fit.strength[column_of(selection, which)];
  Eigen::MatrixXd columns = columns_of(p, selection.chosen);
  const Eigen::Index first = columns.cols();
  columns.conservativeResize(Eigen::NoChange,
                             first + static_cast<Eigen::Index>(term.shape->parameters.size()));
  for (std::size_t i = 0; i < term.shape->parameters.size(); ++i) {
    const double step = 1e-3 * std::max(std::abs(term.shape_values[i]), 1e-3);
    ShapeValues high = term.shape_values, low = term.shape_values;
    high[i] += step, low[i] -= step;
    columns.col(first + static_cast<Eigen::Index>(i)) =
        strength *
        (p.problem.column(prepared_from(p, *term.shape, high)) -
         p.problem.column(prepared_from(p, *term.shape, low))) /
        (2 * step);
  }
  return columns;
}

/// Improves a formula's shape beside all other strengths by steps of Gauss and Newton; keeps only those that
/// lower the objective.
void sharpen(SelectionProblem& p, const MotionScales& scales, Selection& selection, std::size_t which) {
  const auto line = static_cast<std::size_t>(selection.chosen[which].term);
  const std::size_t count = p.terms[line].shape->parameters.size();
  if (count == 0) return;
  constexpr int most_iterations = 6;          // cost; it stops where nothing is gained
  constexpr double shortest_step = 1 / 16.0;  // of Gauss and Newton's
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Eigen::MatrixXd columns = tangent_columns(p, selection, which);
    const Regression tangent = regress(p.problem.impulse(), columns);
    const PreparedTerm before = p.terms[line];
    const Selection selection_before = selection;
    bool better = false;
    for (double damping = 1; damping >= shortest_step && !better; damping /= 4) {
      ShapeValues values = before.shape_values;
      for (std::size_t i = 0; i < count; ++i)
        values[i] += damping * tangent.strength[columns.cols() - static_cast<Eigen::Index>(count - i)];
      if (!in_bounds(*before.shape, values, scales)) continue;
      p.terms[line] = prepared_from(p, *before.shape, values);
      selection = fit_terms(p, selection.chosen);
      better = selection.objective < selection_before.objective - 1e-3;
    }
    if (better) continue;
    p.terms[line] = before;
    selection = fit_terms(p, selection_before.chosen);
    return;
  }
}

ForceFormula described(const SelectionProblem& p, const Selection& selection, std::size_t which) {
  const PreparedTerm& term = p.terms[static_cast<std::size_t>(selection.chosen[which].term)];
  const Eigen::MatrixXd columns = tangent_columns(p, selection, which);
  const Regression tangent = regress(p.problem.impulse(), columns);
  const double wide = normal_95 * std::sqrt(std::max(1.0, selection.fit.chi2 / selection.fit.degrees));
  ForceFormula formula{term.shape->formula, term.shape->sentence, {}, 0, {}};
  const Eigen::Index own = column_of(selection, which);
  const double strength = selection.fit.strength[own], error = tangent.error[own];
  formula.constants.push_back({term.shape->strength, term.shape->strength_unit, strength,
                               strength - wide * error, strength + wide * error});
  for (std::size_t i = 0; i < term.shape->parameters.size(); ++i) {
    const ShapeParameter& parameter = term.shape->parameters[i];
    const double e =
        tangent.error[columns.cols() - static_cast<Eigen::Index>(term.shape->parameters.size() - i)];
    formula.constants.push_back({parameter.name, parameter.unit, term.shape_values[i],
                                 term.shape_values[i] - wide * e, term.shape_values[i] + wide * e});
  }
  return formula;
}

/// Fills in the formula's gain, and the families that would take its place.
void find_look_alikes(const SelectionProblem& p, ForceMap& map, const Selection& selection, std::size_t which,
                      ForceFormula& formula) {
  std::vector<ChosenTerm> others = selection.chosen;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(which));
  const Eigen::MatrixXd columns = columns_of(p, others);
  const Regression without = regress(p.problem.impulse(), columns);
  formula.gain = without.chi2 - selection.fit.chi2;
  map.project_out(without.residual, orthonormal_basis(columns));
  for (const ForceShape& shape : force_shapes())
    if (shape.formula != formula.formula && best_of(p, map, shape).gain > formula.gain - as_good)
      formula.look_alikes.push_back(shape.formula);
}

/// Returns the formulas without shape parameters that would take a known term's place.
std::vector<std::string> plain_formulas_like(const SelectionProblem& p, ForceMap& map,
                                             const Selection& selection, std::size_t which) {
  std::vector<ChosenTerm> others = selection.chosen;
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(which));
  const Eigen::MatrixXd columns = columns_of(p, others);
  const Regression without = regress(p.problem.impulse(), columns);
  map.project_out(without.residual, orthonormal_basis(columns));
  std::vector<std::string> found;
  for (const ForceShape& shape : force_shapes())
    if (shape.parameters.empty() && without.chi2 - map.gain(shape, {}) < selection.fit.chi2 + as_good)
      found.push_back(shape.formula);
  return found;
}

bool has_formula(const SelectionProblem& p, const Selection& selection) {
  return std::any_of(selection.chosen.begin(), selection.chosen.end(), [&](const ChosenTerm& c) {
    return c.term >= 0 && p.terms[static_cast<std::size_t>(c.term)].shape;
  });
}

BestShape best_shape(const SelectionProblem& p, const ForceMap& map) {
  BestShape best;
  best.surplus = -1e300;
  for (const ForceShape& shape : force_shapes())
    if (const BestShape one = best_of(p, map, shape); one.surplus > best.surplus) best = one;
  return best;
}

/// Makes one step of the selection; returns false when nothing is worth its price.
bool add_best(SelectionProblem& p, ForceMap& map, Selection& selection) {
  const Eigen::MatrixXd basis = orthonormal_basis(columns_of(p, selection.chosen));
  map.project_out(selection.fit.residual, basis);
  const BestShape shape = best_shape(p, map);
  const std::optional<KnownCandidate> known = best_known(p, selection);
  std::vector<ChosenTerm> chosen = selection.chosen;
  if (known && known->surplus >= shape.surplus) {
    if (known->surplus <= 0) return false;
    chosen.push_back(known->term);
    selection = fit_terms(p, chosen);
    return true;
  }
  if (shape.surplus <= 0) return false;
  p.terms.push_back(prepared_from(p, *shape.shape, shape.values));
  chosen.push_back({static_cast<int>(p.terms.size()) - 1, 0});
  selection = fit_terms(p, chosen);
  sharpen(p, map.scales(), selection, selection.chosen.size() - 1);
  return true;
}

}  // namespace

double cost_of(const SelectionProblem& p, const Selection& selection) {
  double cost = selection.objective;
  for (std::size_t i = 1; i < selection.chosen.size(); ++i) {
    const int term = selection.chosen[i].term;
    const ForceShape* shape = term < 0 ? nullptr : p.terms[static_cast<std::size_t>(term)].shape;
    cost += shape ? price_of(p, *shape) : (term < 0 ? 3 : 1) * log_size(p) + price_of_a_term;
  }
  return cost;
}

std::vector<std::vector<std::string>> formulas_like_known_terms(const SelectionProblem& p,
                                                                const Selection& selection) {
  ForceMap map(p.problem, *p.runs);
  std::vector<std::vector<std::string>> found(selection.chosen.size());
  for (std::size_t which = 1; which < selection.chosen.size(); ++which)
    if (selection.chosen[which].term >= 0) found[which] = plain_formulas_like(p, map, selection, which);
  return found;
}

FormulaFit fit_formulas(SelectionProblem problem) {
  FormulaFit fit{{}, std::move(problem), {}, {}, 0};
  SelectionProblem& p = fit.problem;
  Selection selection = fit_terms(p, {{0, 0}});
  ForceMap map(p.problem, *p.runs);
  map.project_out(selection.fit.residual, orthonormal_basis(columns_of(p, selection.chosen)));
  for (int kind = 0; kind < shape_kinds; ++kind) fit.curves.push_back(map.curve(static_cast<ShapeOf>(kind)));
  std::stable_sort(fit.curves.begin(), fit.curves.end(),
                   [](const ForceCurve& a, const ForceCurve& b) { return a.gain > b.gain; });
  constexpr int most_steps = 4;
  for (int step = 0; step < most_steps && add_best(p, map, selection); ++step) {
    drop_needless(p, selection);
    map = ForceMap(p.problem, *p.runs);  // whitened by the noise that the fitted forces let in
  }
  for (std::size_t which = 1; which < selection.chosen.size() && has_formula(p, selection); ++which) {
    const int term = selection.chosen[which].term;
    if (term < 0 || !p.terms[static_cast<std::size_t>(term)].shape) continue;
    sharpen(p, map.scales(), selection, which);
    fit.formulas.push_back(described(p, selection, which));
    find_look_alikes(p, map, selection, which, fit.formulas.back());
  }
  fit.cost = cost_of(p, selection);
  fit.selection = std::move(selection);
  return fit;
}

}  // namespace shakedown
