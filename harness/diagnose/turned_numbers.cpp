// SPDX-License-Identifier: MIT
// Makes the numbers of a page, and what they do, without any simulation.
#include "turned_numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "key_unit.hpp"
#include "known_effects.hpp"
#include "setup_file.hpp"
#include "waveform_search.hpp"

namespace shakedown {

std::string_view name_of(NumberRole role) {
  switch (role) {
    case NumberRole::parameter: return "parameter";
    case NumberRole::effect: return "effect";
    case NumberRole::suspect: return "suspect";
    case NumberRole::camera: break;
  }
  return "camera";
}

Eigen::VectorXd TurnedModel::places(double TurnedNumber::*which) const {
  Eigen::VectorXd place(std::ssize(numbers));
  for (std::size_t k = 0; k < numbers.size(); ++k) place[static_cast<Eigen::Index>(k)] = numbers[k].*which;
  return place;
}

Eigen::VectorXd TurnedModel::shares(const Eigen::VectorXd& place) const {
  Eigen::VectorXd all(std::ssize(terms));
  for (std::size_t j = 0; j < terms.size(); ++j) {
    double sum = 0, squares = 0, factors = 1;
    for (const auto& [k, weight] : terms[j].weights) {
      const double moved = weight * (place[static_cast<Eigen::Index>(k)] - numbers[k].best);
      sum += moved, factors *= moved;
      squares += std::pow(weight * (place[static_cast<Eigen::Index>(k)] - numbers[k].given), 2);
    }
    all[static_cast<Eigen::Index>(j)] = terms[j].power == TurnedTerm::product ? factors
                                        : terms[j].power > 0                  ? std::pow(sum, terms[j].power)
                                                             : std::pow(std::max(0.0, 1 - squares), 2);
  }
  return all;
}

namespace {

bool is_turned(const EffectRecord* record) {
  return record != nullptr && (record->on_page.integrated || record->on_page.reach > 0);
}

TurnedNumber offered(const std::string& key, NumberRole role, double given, double best, double reach) {
  TurnedNumber number;
  number.key = key, number.role = role, number.given = given, number.best = best;
  number.low = std::min(given, best) - reach, number.high = std::max(given, best) + reach;
  return number;
}

class NumbersOfSwing {
 public:
  NumbersOfSwing(const SwingFound& found, const Setup& user, const std::vector<std::string>& missing,
                 KnownEffects known)
      : found_(found),
        user_(user),
        missing_(missing),
        known_(known),
        best_(with_laws(found.runs.front().setup, found.fit, known)) {}

  std::vector<TurnedNumber> run() {
    for (const EffectChoice& choice : best_.effects)
      if (!is_turned(choice.record)) return {};
    add_spring();
    for (const WaveformLaw& law : found_.fit.laws) add_law(law);
    for (const WaveformLaw& law : waveform_laws(found_.runs.front().setup, known_))
      if (!law.is_mode && !has(law.term.key()) && is_turned(known_.find(law.term.effect))) add_suspect(law);
    add_camera();
    // The equation is integrated, so that there is no place where the answer is not known.
    for (TurnedNumber& number : numbers_) number.from = number.low, number.to = number.high;
    return std::move(numbers_);
  }

 private:
  bool has(const std::string& key) const {
    return std::any_of(numbers_.begin(), numbers_.end(), [&](const TurnedNumber& n) { return n.key == key; });
  }

  void add_camera() {
    for (const EffectRecord* record : known_) {
      const std::optional<CameraParameter> parameter = camera_parameter_of(*record);
      if (!parameter || !is_turned(record) || has(parameter->path)) continue;
      const double at = get_number(best_, parameter->path, known_);
      numbers_.push_back(offered(parameter->path, NumberRole::camera, at, at, record->on_page.reach));
    }
  }

  void add_spring() {
    const double given = user_.spring.frequency, best = found_.fit.frequency();
    numbers_.push_back(offered("spring.frequency", NumberRole::parameter, given, best,
                               std::max(0.01 * best, 0.3 * std::abs(given - best))));
  }

  void add_law(const WaveformLaw& law) {
    const bool found = std::find(missing_.begin(), missing_.end(), law.term.effect) != missing_.end();
    const NumberRole role = found ? NumberRole::effect : NumberRole::parameter;
    const std::string key = law.term.key();
    const bool inverse = law.term.inverse && !law.is_mode;
    const auto place = [&](double value) { return inverse ? 1 / (value * value) : value; };
    const double best = place(get_number(best_, key, known_)), none = 0;
    const bool given = find_choice(user_, law.term.effect) != nullptr;
    TurnedNumber number =
        offered(key, role, given ? place(get_number(user_, key, known_)) : none, best, 1.5 * std::abs(best));
    number.inverse = inverse, number.absent = none;
    if (law.is_mode || law.term.never_negative || inverse) number.low = std::max(number.low, none);
    numbers_.push_back(number);
    if (!law.is_mode) return;
    for (const std::string& other : {law.frequency_key, law.rate_key, law.phase_key})
      if (!other.empty()) {
        const double at = get_number(best_, other, known_);
        TurnedNumber more =
            offered(other, role, at, at, other == law.phase_key ? 3.2 : 0.5 * std::abs(at) + 0.01);
        if (other != law.phase_key) more.low = std::max(0.0, more.low);
        numbers_.push_back(more);
      }
  }

  void add_suspect(const WaveformLaw& law) {
    const double reach = 3 * law.term.typical;
    TurnedNumber number = offered(law.term.key(), NumberRole::suspect, 0, 0, reach);
    number.inverse = law.term.inverse, number.absent = 0;
    if (law.term.never_negative || number.inverse) number.low = 0;
    numbers_.push_back(number);
  }

  const SwingFound& found_;
  const Setup& user_;
  const std::vector<std::string>& missing_;
  KnownEffects known_;
  Setup best_;
  std::vector<TurnedNumber> numbers_;
};

}  // namespace

std::vector<TurnedNumber> turned_numbers(const SwingFound& found, const Setup& user,
                                         const std::vector<std::string>& missing, KnownEffects known) {
  if (found.runs.empty()) return {};
  return NumbersOfSwing(found, user, missing, known).run();
}

}  // namespace shakedown
