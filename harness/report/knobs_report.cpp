// SPDX-License-Identifier: MIT
#include "knobs_report.hpp"

#include <algorithm>
#include <cmath>

#include "answer_sections.hpp"
#include "effects.hpp"
#include "errors.hpp"
#include "key_unit.hpp"
#include "known_effects.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

ReportKnobs::Number number_of(const TurnedNumber& turned) {
  ReportKnobs::Number number;
  const ReadUnit read = read_unit(turned.key);
  number.key = turned.key, number.label = words_of_key(turned.key);
  if (find_setup_key(joined_keys(turned.key).front()) == nullptr) number.effect = effect_of(turned.key);
  number.role = name_of(turned.role);
  number.unit = read.unit, number.factor = read.factor, number.inverse = turned.inverse;
  number.given = turned.given, number.best = turned.best, number.absent = turned.absent;
  number.from = turned.from, number.to = turned.to, number.low = turned.low, number.high = turned.high;
  return number;
}

/// Returns each effect that a number is of, with all its numbers, as `setup` or the defaults have them.
std::vector<EffectChoice> choices_of(const std::vector<TurnedNumber>& numbers, Setup setup) {
  std::vector<EffectChoice> choices;
  for (const TurnedNumber& number : numbers) {
    const std::string key = joined_keys(number.key).front(), effect(effect_of(key));
    if (find_setup_key(key) != nullptr) continue;
    const auto same = [&](const EffectChoice& choice) { return choice.record->name == effect; };
    if (std::any_of(choices.begin(), choices.end(), same)) continue;
    try {
      if (find_choice(setup, effect) == nullptr) set_number(setup, key, number.high, all_effects());
    } catch (const InputError&) {
      continue;  // beyond its bounds: the lines of the setup are told as remarks
    }
    if (const EffectChoice* choice = find_choice(setup, effect)) choices.push_back(*choice);
  }
  return choices;
}

std::vector<double> values_in_mm(const std::vector<double>& metres) {
  std::vector<double> mm = metres;
  for (double& value : mm) value *= 1e3;
  return mm;
}

/// Returns the runs with their curves in the order of curves_of().
std::vector<ReportKnobs::Run> runs_of(const LastFit& fit) {
  std::vector<ReportKnobs::Run> runs;
  for (const FittedCurve& curve : curves_of(fit)) {
    if (runs.empty() || runs.back().name != curve.run) runs.push_back({}), runs.back().name = curve.run;
    runs.back().curves.push_back({curve.observable,
                                  curve.time,
                                  values_in_mm(curve.measured),
                                  values_in_mm(curve.spread),
                                  values_in_mm(curve.model),
                                  values_in_mm(curve.as_given),
                                  {}});
  }
  return runs;
}

ReportKnobs beginning(const std::vector<TurnedNumber>& numbers, const LastFit& fit, const Setup& amended) {
  ReportKnobs knobs;
  for (const TurnedNumber& number : numbers) knobs.numbers.push_back(number_of(number));
  for (const EffectChoice& choice : choices_of(numbers, amended))
    knobs.effects.push_back({std::string(choice.record->name), write_effect(choice)});
  knobs.runs = runs_of(fit);
  return knobs;
}

std::vector<std::vector<double>> rows_of(const Eigen::MatrixXd& matrix) {
  std::vector<std::vector<double>> rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Eigen::RowVectorXd row = matrix.row(i);
    rows.emplace_back(row.data(), row.data() + row.size());
  }
  return rows;
}

/// Adds to each curve of the run its rows of the columns, mm.
void add_columns(const MeasuredFeatures& measured, const Eigen::MatrixXd& columns, ReportKnobs::Run& run) {
  for (ReportKnobs::Curve& curve : run.curves) {
    curve.columns.resize(static_cast<std::size_t>(columns.cols()));
    for (Eigen::Index f = 0; f < columns.rows(); ++f) {
      const Observable of = measured.plan.features[static_cast<std::size_t>(f)].observable;
      if ((curve.name == "box") != (of == Observable::box)) continue;
      for (std::size_t j = 0; j < curve.columns.size(); ++j)
        curve.columns[j].push_back(1e3 * columns(f, static_cast<Eigen::Index>(j)));
    }
  }
}

void add_numbers_of(const EffectChoice& choice, std::vector<ReportKnobs::Value>& values) {
  for (const auto& [name, value] : choice.values) {
    const std::string key = std::string(choice.record->name) + "." + std::string(name);
    if (const double* number = std::get_if<double>(&value)) values.push_back({key, *number});
    if (const Vec3* vector = std::get_if<Vec3>(&value)) values.push_back({key + ".x", vector->x()});
  }
}

std::string joined_words(const std::vector<std::string>& keys) {
  std::string all;
  for (const std::string& key : keys) all += (all.empty() ? "" : ", ") + words_of_key(key);
  return all;
}

}  // namespace

ReportKnobs knobs_of(const TurnedModel& model, const LastFit& fit, const Setup& amended) {
  ReportKnobs knobs = beginning(model.numbers, fit, amended);
  knobs.kind = "response";
  knobs.note =
      "Curves follow from simulations: at the best values, with each effect taken out, and with each number "
      "moved. A pale stripe shows how far "
      "they reach; beyond it the curve is a guess and turns grey. Two parameters moved at once were "
      "simulated "
      "where there was time; all else is taken to add up.";
  if (!model.left_out.empty())
    knobs.note += " Not simulated for want of time: " + joined_words(model.left_out) + ".";
  for (const TurnedTerm& term : model.terms) {
    ReportKnobs::Term one;
    one.power = term.power;
    for (const auto& [k, weight] : term.weights)
      one.numbers.push_back(static_cast<double>(k)), one.weights.push_back(weight);
    knobs.terms.push_back(std::move(one));
  }
  for (std::size_t r = 0; r < knobs.runs.size(); ++r) {
    if (!model.columns.empty()) add_columns(fit.ensembles->measured[r], model.columns[r], knobs.runs[r]);
    knobs.runs[r].square = rows_of(model.square[r]);
  }
  return knobs;
}

ReportKnobs knobs_of(const std::vector<TurnedNumber>& numbers, const LastFit& fit, const Setup& amended) {
  if (numbers.empty()) return {};
  const SwingFound& found = *fit.swing;
  const Setup best = with_laws(found.runs.front().setup, found.fit, all_effects());
  ReportKnobs knobs = beginning(numbers, fit, amended);
  knobs.kind = "swing";
  knobs.note =
      "The page integrates the equation of motion itself, so that every place of the knobs is as exact as "
      "any other.";
  knobs.values = {{"box.mass", best.box.mass}, {"spring.frequency", best.spring.frequency}};
  for (const EffectChoice& choice : choices_of(numbers, best)) add_numbers_of(choice, knobs.values);
  for (const EffectChoice& choice : best.effects) add_numbers_of(choice, knobs.values);
  for (std::size_t r = 0; r < knobs.runs.size(); ++r) {
    ReportKnobs::Run& run = knobs.runs[r];
    const auto first = 3 * static_cast<Eigen::Index>(r);
    run.start = found.runs[r].start_time();
    run.place = found.fit.value[first], run.speed = found.fit.value[first + 1],
    run.origin = found.fit.value[first + 2];
    run.displacement = found.runs[r].setup.release.displacement, run.amplitude = found.runs[r].amplitude;
  }
  return knobs;
}

}  // namespace shakedown
