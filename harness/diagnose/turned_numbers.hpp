// SPDX-License-Identifier: MIT
// Describes numbers of a model that a page can turn, and how curves follow.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "known_effects.hpp"
#include "last_fit.hpp"

namespace shakedown {

enum class NumberRole { parameter, effect, suspect, camera };
/// Returns its word in the page's data.
std::string_view name_of(NumberRole role);

/// Describes a number that can be turned. Its places are its values in SI; of a length, infinite without the
/// effect, 1/value^2.
struct TurnedNumber {
  std::string key;  ///< path in the setup; keys that move together joined by &
  NumberRole role = NumberRole::parameter;
  bool inverse = false;
  double given = 0, best = 0;
  double absent = std::numeric_limits<double>::quiet_NaN();  ///< of an effect
  double from = 0, to = 0;   ///< where simulations or arithmetic tell the answer
  double low = 0, high = 0;  ///< ends of what is offered
};

/// Gives the share of a column: (sum of weight x (place - best) over some numbers)^power. Power 0 is a hill
/// about the numbers as given: (1 - sum of (weight x (place - given))^2)^2, nothing where that sum is above
/// 1. Of power `product` it is the product of all weight x (place - best); a number may stand there twice.
struct TurnedTerm {
  static constexpr int product = -1;
  std::vector<std::pair<std::size_t, double>> weights;
  int power = 1;
};

/// Holds the numbers, and how the means of all runs follow them.
struct TurnedModel {
  std::vector<TurnedNumber> numbers;
  std::vector<TurnedTerm> terms;
  std::vector<Eigen::MatrixXd> columns;  ///< of each run, features x terms, m
  /// Of each run: chi2 is l' square l with l = (1, less the share of each term).
  std::vector<Eigen::MatrixXd> square;
  std::vector<std::string> left_out;  ///< what there was no time to simulate, in words

  /// Returns the share of each term with the numbers at these places.
  Eigen::VectorXd shares(const Eigen::VectorXd& place) const;
  /// Returns one place of every number, in their order: &TurnedNumber::best, or given, from, to ...
  Eigen::VectorXd places(double TurnedNumber::*which) const;
};

/// Returns the numbers of a box alone: spring, laws found, and the laws and numbers of the camera that may be
/// tried; its motion follows by integrating the equation. Empty where something acts that a page cannot
/// integrate (a formula).
std::vector<TurnedNumber> turned_numbers(const SwingFound& found, const Setup& user,
                                         const std::vector<std::string>& missing, KnownEffects known);

}  // namespace shakedown
