// SPDX-License-Identifier: MIT
// Holds as plain data what a reader of a page may turn: numbers of the model, and how every curve of every
// run follows.
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace shakedown {

/// Of "response" the curves are best + sum of shares x columns (harness/diagnose/turned_model.hpp), of
/// "swing" the page integrates the equation of motion from the values of the keys.
struct ReportKnobs {
  struct Number {
    std::string key, label, effect, role;  ///< role: "parameter", "effect", "suspect" or "camera"
    std::string unit;                      ///< in which people read it
    double factor = 1;                     ///< one of that unit in SI
    bool inverse = false;                  ///< its place is 1/value^2
    /// Places, SI.
    double given = 0, best = 0, absent = std::numeric_limits<double>::quiet_NaN();
    double from = 0, to = 0, low = 0, high = 0;
  };
  struct Term {
    std::vector<double> numbers, weights;  ///< index of each number that counts, and its weight
    double power = 1;
  };
  struct Curve {
    std::string name;                                   ///< "box" or "centre"
    std::vector<double> time;                           ///< s
    std::vector<double> measured, spread, best, given;  ///< mm
    std::vector<std::vector<double>> columns;           ///< mm, of each term
  };
  struct Run {
    std::string name;
    std::vector<Curve> curves;
    std::vector<std::vector<double>> square;  ///< chi2 is l' square l, l = (1, less the shares)
    /// Of a swing, SI: time, place, speed and origin where the fit begins, where the setup lets go, and the
    /// amplitude.
    double start = 0, place = 0, speed = 0, origin = 0, displacement = 0, amplitude = 0;
  };
  struct Value {
    std::string key;
    double value = 0;  ///< SI
  };
  struct Effect {
    std::string name, toml;  ///< toml: as a setup has it
  };
  std::string kind;  ///< "response", "swing"; empty: there is nothing to turn
  std::string note;  ///< what is to be known of it, a sentence
  std::vector<Number> numbers;
  std::vector<Term> terms;
  std::vector<Run> runs;
  std::vector<Value> values;    ///< of a swing: keys that are not turned
  std::vector<Effect> effects;  ///< that the numbers are of
};

/// Returns the knobs as the page reads them: JSON text, curves packed (packed_numbers.hpp).
std::string knobs_json(const ReportKnobs& knobs);

}  // namespace shakedown
