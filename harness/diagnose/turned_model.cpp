// SPDX-License-Identifier: MIT
#include "turned_model.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "candidates.hpp"
#include "errors.hpp"
#include "evidence.hpp"
#include "key_unit.hpp"
#include "linear_model.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"
#include "turned_ends.hpp"

namespace shakedown {

namespace {

double place_of_value(bool inverse, double value) { return inverse ? 1 / (value * value) : value; }

/// Returns the slope of a value by its place; a length's place is its inverse square.
double slope_by_place(const TurnedNumber& number, double value) {
  return number.inverse ? -0.5 * value * value * value : 1;
}

/// The means of all runs, m.
using Means = std::vector<Eigen::VectorXd>;

class Turning {
 public:
  Turning(const EnsembleFit& fit, const Setup& user, const Engine& engine, const TurnedOptions& options)
      : fit_(fit), user_(user), engine_(engine), options_(options) {
    workshop_.engine = &engine;
    workshop_.known = options.known;
    workshop_.execution = options.execution;
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
    workshop_.meter.ask_for = [end](std::int64_t) {
      if (std::chrono::steady_clock::now() > end) throw BudgetSpent("the time is up");
    };
  }

  TurnedModel run() {
    for (std::size_t k = 0; k < fit_.fit.values.size(); ++k) model_.numbers.push_back(number_of(k));
    simulate("", [&] { base_ = means_with([](Setup&) {}); });
    for (std::size_t k = 0; k < fit_.fit.values.size(); ++k) add_slope(k);
    for (const std::string& effect : options_.missing) simulate(effect, [&] { add_absence(effect); });
    for (std::size_t k = 0; k < fit_.fit.values.size(); ++k)
      if (model_.numbers[k].role == NumberRole::parameter)
        simulate(model_.numbers[k].key, [&] { add_bend(k); });
    for (const std::string& effect : options_.suspects) simulate(effect, [&] { add_suspect(effect); });
    add_pairs();
    add_as_given();
    set_ends(model_, fit_.fit.knobs);
    model_.square = squares_of(model_, fit_);
    return std::move(model_);
  }

 private:
  /// Makes a step; what cannot be simulated stays a straight line, or is left out where it had none.
  template <class Step>
  void simulate(const std::string& of, Step&& step) {
    try {
      if (of.empty() || !base_.empty()) step();
    } catch (const BudgetSpent&) {
      if (!of.empty()) model_.left_out.push_back(of);
    } catch (const PhysicsError&) {
      if (!of.empty()) model_.left_out.push_back(of);
    } catch (const InputError&) {
      if (!of.empty()) model_.left_out.push_back(of);
    }
  }

  TurnedNumber number_of(std::size_t k) const {
    const Knob& knob = fit_.fit.knobs[k];
    const FittedValue& value = fit_.fit.values[k];
    TurnedNumber number;
    number.key = value.key;
    const std::string effect(effect_of(value.key));
    const bool found = contains(options_.missing, effect);
    number.role = found ? NumberRole::effect : knob.exact ? NumberRole::camera : NumberRole::parameter;
    number.inverse = std::isinf(knob.absent);
    number.best = place_of_value(number.inverse, value.value);
    if (found) number.absent = number.inverse ? 0 : absence_of(knob);
    number.given = found ? number.absent : given_of(knob);
    const double width = std::abs(place_of_value(number.inverse, value.value + knob.width) - number.best);
    number.from = number.best - width, number.to = number.best + width;
    if (knob.exact) {
      // Arithmetic gives a straight line, as far as anybody would turn it.
      const double reach = 5 * std::max(knob.believed_error, knob.width);
      number.from = std::min(number.best, number.given) - reach;
      number.to = std::max(number.best, number.given) + reach;
    }
    return number;
  }

  double absence_of(const Knob& knob) const {
    if (knob.absent_key.empty()) return knob.absent;
    for (const FittedValue& value : fit_.fit.values)
      if (value.key == knob.absent_key) return value.value;
    return get_number(fit_.setup, knob.absent_key, options_.known);
  }

  /// Returns the number as given; of the camera that of the fit of the model as given, whose error is told.
  double given_of(const Knob& knob) const {
    if (!knob.exact) return get_number(user_, joined_keys(knob.key).front(), options_.known);
    for (const FittedValue& value : fit_.as_given.values)
      if (value.key == knob.key) return value.value;
    return knob.believed;
  }

  std::vector<MeasuredFeatures> at_best() const {
    std::vector<MeasuredFeatures> runs = fit_.measured;
    for (MeasuredFeatures& run : runs)
      for (std::size_t k = 0; k < fit_.fit.values.size(); ++k) {
        Knob knob = fit_.fit.knobs[k];
        knob.centre = fit_.fit.values[k].value;
        if (!knob.exact) set_knob(run.setup, knob, options_.known);
      }
    return runs;
  }

  /// Takes the same microstates every time, so that what chaos does is taken off until it has grown.
  Means means_of(const std::vector<MeasuredFeatures>& runs) const {
    Means means;
    for (const Emulator& e : emulate(runs, {}, options_.count, options_.first_run, workshop_))
      means.push_back(e.coefficients.row(0).transpose());
    return means;
  }
  Means means_with(const std::function<void(Setup&)>& change) const {
    std::vector<MeasuredFeatures> runs = at_best();
    for (MeasuredFeatures& run : runs) change(run.setup);
    return means_of(runs);
  }
  Means change_with(const std::function<void(Setup&)>& change) const {
    Means means = means_with(change);
    for (std::size_t r = 0; r < means.size(); ++r) means[r] -= base_[r];
    return means;
  }

  void add(TurnedTerm term, const Means& column) {
    model_.terms.push_back(std::move(term));
    if (model_.columns.empty()) model_.columns.resize(fit_.measured.size());
    for (std::size_t r = 0; r < column.size(); ++r) {
      Eigen::MatrixXd& columns = model_.columns[r];
      columns.conservativeResize(column[r].size(), std::ssize(model_.terms));
      columns.rightCols(1) = column[r];
    }
  }

  /// Returns the slope by the number's place; empty where the fit made none.
  Means slope_of(std::size_t k) const {
    const Knob& knob = fit_.fit.knobs[k];
    const double by_place = slope_by_place(model_.numbers[k], fit_.fit.values[k].value);
    Means slope;
    for (std::size_t r = 0; r < fit_.measured.size(); ++r) {
      if (knob.exact)
        slope.push_back(by_place * fit_.measured[r].by_camera.at(knob.key));
      else if (!fit_.fit.at_solution.empty())
        slope.push_back(
            fit_.fit.at_solution[r].coefficients.row(1 + static_cast<Eigen::Index>(k)).transpose() *
            (by_place / knob.width));
    }
    return slope;
  }
  void add_slope(std::size_t k) {
    if (const Means slope = slope_of(k); !slope.empty()) add({{{k, 1.0}}, 1}, slope);
  }

  /// Returns what the terms so far make with the numbers at these places.
  Means told_at(const Eigen::VectorXd& place) const {
    Means told;
    const Eigen::VectorXd shares = model_.shares(place);
    for (std::size_t r = 0; r < fit_.measured.size(); ++r)
      told.push_back(model_.columns.empty() ? Eigen::VectorXd::Zero(fit_.measured[r].values.size()).eval()
                                            : (model_.columns[r] * shares).eval());
    return told;
  }

  /// Adds a parabola through what was found at `place` along the way there from the best: what the other
  /// terms say there already is taken off. `among`: numbers that count.
  void add_parabola_to(const Eigen::VectorXd& place, const Means& change,
                       const std::vector<std::size_t>& among) {
    TurnedTerm term{{}, 2};
    double square = 0;
    for (const std::size_t k : among) square += std::pow(scaled(k, place), 2);
    if (!(square > 0)) return;
    for (const std::size_t k : among) {
      const double moved = place[static_cast<Eigen::Index>(k)] - model_.numbers[k].best;
      if (moved != 0) term.weights.push_back({k, std::pow(scaled(k, place), 2) / moved / square});
    }
    Means column = change;
    const Means told = told_at(place);
    for (std::size_t r = 0; r < column.size(); ++r) column[r] -= told[r];
    add(std::move(term), column);
  }
  /// Returns the way of one number to a place, so that numbers of different units count alike.
  double scaled(std::size_t k, const Eigen::VectorXd& place) const {
    const TurnedNumber& number = model_.numbers[k];
    const double reach = std::max(number.to - number.best, number.best - number.from);
    return reach > 0 ? (place[static_cast<Eigen::Index>(k)] - number.best) / reach : 0;
  }

  void add_absence(const std::string& effect) {
    std::vector<std::size_t> own;
    Eigen::VectorXd place = model_.places(&TurnedNumber::best);
    bool arithmetic = true;
    for (std::size_t k = 0; k < fit_.fit.values.size(); ++k)
      if (effect_of(model_.numbers[k].key) == effect) {
        own.push_back(k);
        place[static_cast<Eigen::Index>(k)] = model_.numbers[k].absent;
        arithmetic = arithmetic && fit_.fit.knobs[k].exact;
      }
    if (own.empty() || arithmetic) return;
    const Means change = change_with([&](Setup& setup) {
      std::erase_if(setup.effects, [&](const EffectChoice& choice) { return choice.record->name == effect; });
    });
    if (fit_.fit.at_solution.empty() && own.size() == 1)
      add({{{own.front(),
             1 / (place[static_cast<Eigen::Index>(own.front())] - model_.numbers[own.front()].best)}},
           1},
          change);
    else
      add_parabola_to(place, change, own);
    for (const std::size_t k : own) {
      TurnedNumber& number = model_.numbers[k];
      number.from = std::min(number.from, number.absent), number.to = std::max(number.to, number.absent);
    }
  }

  /// Returns how far a parameter is simulated on both sides.
  double reach_of(std::size_t k) const {
    const TurnedNumber& number = model_.numbers[k];
    const auto [low, high] = bounds_of(number);
    const double room = std::min(number.best - low, high - number.best);
    if (number.key == "spring.frequency") {
      double end = 0;
      for (const MeasuredFeatures& run : fit_.measured) end = std::max(end, run.plan.end);
      constexpr double turned = 0.8;  // rad at the end: a cubic follows a sine so far to a hundredth
      return std::min(room, turned / (2 * std::numbers::pi * std::max(1.0, end)));
    }
    const double whole = number.key.starts_with("restitution") ? 1 : std::abs(number.best);
    constexpr double least = 0.03, most = 0.15;  // of the whole
    const double wanted =
        std::max({least * whole, 3 * fit_.fit.values[k].error, std::abs(number.given - number.best)});
    return std::min({room, wanted, most * whole});
  }

  Means change_at(const std::vector<std::pair<std::size_t, double>>& places) const {
    return change_with([&](Setup& setup) {
      for (const auto& [k, place] : places) {
        Knob knob = fit_.fit.knobs[k];
        knob.centre = place;
        set_knob(setup, knob, options_.known);
      }
    });
  }

  /// Adds pairs, restitutions first: they stand for each other most. What there is no time for adds up.
  void add_pairs() {
    std::vector<std::size_t> bent = bent_;
    std::stable_partition(bent.begin(), bent.end(),
                          [&](std::size_t k) { return model_.numbers[k].key.starts_with("restitution"); });
    const std::vector<std::string> left_out = model_.left_out;
    for (std::size_t j = 1; j < bent.size(); ++j)
      for (std::size_t i = 0; i < j; ++i) simulate("pair", [&] { add_pair(bent[i], bent[j]); });
    model_.left_out = left_out;
  }

  /// Adds what two numbers make at the four corners of their reach beyond what each makes alone: their
  /// product and the products of third order.
  void add_pair(std::size_t i, std::size_t j) {
    const TurnedNumber &a = model_.numbers[i], &b = model_.numbers[j];
    const double by_a = 1 / (a.to - a.best), by_b = 1 / (b.to - b.best);
    Means both, first_twice, second_twice;
    for (const int s : {-1, 1})
      for (const int t : {-1, 1}) {
        Eigen::VectorXd place = model_.places(&TurnedNumber::best);
        const double at_a = a.best + s / by_a, at_b = b.best + t / by_b;
        place[static_cast<Eigen::Index>(i)] = at_a, place[static_cast<Eigen::Index>(j)] = at_b;
        const Means change = change_at({{i, at_a}, {j, at_b}}), told = told_at(place);
        both.resize(change.size()), first_twice.resize(change.size()), second_twice.resize(change.size());
        for (std::size_t r = 0; r < change.size(); ++r) {
          const Eigen::VectorXd beyond = (change[r] - told[r]) / 4;
          for (const auto& [sum, sign] : {std::pair{&both, s * t}, {&first_twice, t}, {&second_twice, s}}) {
            if ((*sum)[r].size() == 0) (*sum)[r].setZero(beyond.size());
            (*sum)[r] += sign * beyond;
          }
        }
      }
    add({{{i, by_a}, {j, by_b}}, TurnedTerm::product}, both);
    add({{{i, by_a}, {i, by_a}, {j, by_b}}, TurnedTerm::product}, first_twice);
    add({{{i, by_a}, {j, by_b}, {j, by_b}}, TurnedTerm::product}, second_twice);
  }

  void add_bend(std::size_t k) {
    TurnedNumber& number = model_.numbers[k];
    const double reach = reach_of(k);
    constexpr double a_bend = 1e-4;  // of the number: nothing bends within less
    if (!(reach > a_bend * std::abs(number.best))) return;
    Means side[2];
    for (const int sign : {-1, 1}) side[sign > 0] = change_at({{k, number.best + sign * reach}});
    const Means slope = slope_of(k);
    Means odd, even;
    for (std::size_t r = 0; r < side[0].size(); ++r) {
      odd.push_back((side[1][r] - side[0][r]) / 2);
      even.push_back((side[1][r] + side[0][r]) / 2);
      if (!slope.empty()) odd[r] -= reach * slope[r];
    }
    add({{{k, 1 / reach}}, slope.empty() ? 1 : 3}, odd);
    add({{{k, 1 / reach}}, 2}, even);
    number.from = number.best - reach, number.to = number.best + reach;
    bent_.push_back(k);
  }

  void add_suspect(const std::string& effect) {
    Setup at_fit = at_best().front().setup;
    const std::vector<Candidate> candidates = candidates_for(at_fit, {effect}, options_.known, engine_);
    if (candidates.empty()) return;
    const Candidate& candidate = candidates.front();
    Knob knob = candidate.fitted_knobs().front();
    const auto same = [&](const TurnedNumber& number) { return number.key == knob.key; };
    if (std::any_of(model_.numbers.begin(), model_.numbers.end(), same) || candidate.levels.empty()) return;
    TurnedNumber number;
    number.key = knob.key, number.role = NumberRole::suspect, number.inverse = std::isinf(knob.absent);
    const double none = number.inverse ? 0 : absence_of(knob);
    number.given = number.best = number.absent = none;
    knob.centre = knob.exact ? none + knob.width : candidate.levels[candidate.levels.size() / 2].value;
    const double there = place_of_value(number.inverse, knob.centre);
    Means change;
    if (knob.exact) {
      for (const MeasuredFeatures& run : fit_.measured)
        change.push_back((knob.centre - none) * run.by_camera.at(knob.key));
    } else {
      std::vector<MeasuredFeatures> runs = at_best();
      if (candidate.slow || candidate.dear) runs = kicked_rarely(std::move(runs));
      for (MeasuredFeatures& run : runs) {
        run.setup = prepared(run.setup, candidate, options_.known);
        set_knob(run.setup, knob, options_.known);
      }
      change = means_of(runs);
      for (std::size_t r = 0; r < change.size(); ++r) change[r] -= base_[r];
    }
    const bool two_sided = !number.inverse && knob.low < none && !candidate.prior.one_sided;
    const double other = two_sided ? 2 * none - there : none;
    number.from = std::min(there, other), number.to = std::max(there, other);
    if (!number.inverse)
      number.from = std::max(number.from, knob.low), number.to = std::min(number.to, knob.high);
    model_.numbers.push_back(number);
    add({{{model_.numbers.size() - 1, 1 / (there - none)}}, 1}, change);
  }

  void add_as_given() {
    const Eigen::VectorXd place = model_.places(&TurnedNumber::given);
    Means change;
    for (std::size_t r = 0; r < fit_.measured.size(); ++r)
      if (fit_.as_given.runs.size() <= r ||
          fit_.as_given.runs[r].residual.size() != fit_.measured[r].values.size())
        return;
    for (std::size_t r = 0; r < fit_.measured.size(); ++r)
      change.push_back(fit_.fit.runs[r].residual - fit_.as_given.runs[r].residual);
    // What the terms miss there (numbers moved together do not add up) is told about that place alone.
    double square = 0;
    for (std::size_t k = 0; k < model_.numbers.size(); ++k) square += std::pow(scaled(k, place), 2);
    if (!(square > 0)) return;
    TurnedTerm hill{{}, 0};
    for (std::size_t k = 0; k < model_.numbers.size(); ++k) {
      const TurnedNumber& number = model_.numbers[k];
      const double reach = std::max(number.to - number.best, number.best - number.from);
      if (reach > 0) hill.weights.push_back({k, 1 / (reach * std::sqrt(square))});
    }
    const Means told = told_at(place);
    for (std::size_t r = 0; r < change.size(); ++r) change[r] -= told[r];
    add(std::move(hill), change);
  }

  const EnsembleFit& fit_;
  const Setup& user_;
  const Engine& engine_;
  const TurnedOptions& options_;
  Workshop workshop_;
  Means base_;                     ///< of fresh simulations at the best
  std::vector<std::size_t> bent_;  ///< parameters that were simulated on both sides
  TurnedModel model_;
};

}  // namespace

TurnedModel turned_model(const EnsembleFit& fit, const Setup& user, const Engine& engine,
                         const TurnedOptions& options) {
  return Turning(fit, user, engine, options).run();
}

}  // namespace shakedown
