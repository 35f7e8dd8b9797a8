// SPDX-License-Identifier: MIT
// Holds the comparison error of a model and what it is uncertain by, as ASME V&V 20 (Standard for
// Verification and Validation in Computational Fluid Dynamics and Heat Transfer, 2009) has it: E = S - D,
// simulation less data, and u_val^2 = u_num^2 + u_input^2 + u_D^2. The model's own error lies within E +-
// u_val.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "judgement.hpp"

namespace shakedown {

/// Holds the comparison of one observable of one run: root mean squares over what of it is compared, standard
/// uncertainties, m.
struct Validation {
  std::string run, observable;  ///< observable: "box" or "centre"
  double error = 0;             ///< E
  double numerical = 0;  ///< u_num: scatter of the simulations from run to run, two codes of one physics
  double input = 0;      ///< u_input: parameters (fitted or known), release and clock of the run
  double data = 0;       ///< u_D: noise of the camera

  double uncertainty() const;  ///< u_val
  /// Returns what E is beyond u_val, sqrt(E^2 - u_val^2): error of the model; 0 where E is no more than
  /// u_val, NaN where one of the two is not finite.
  double model_error() const;
};

/// Returns the rows as differences that a judgement asks about: the table and the judgement never say
/// different things, because a row beyond most_left u_val is one that no model which holds has.
std::vector<Difference> differences_of(const std::vector<Validation>& rows);

/// Returns the table for a terminal, mm; empty without rows.
std::string validation_text(const std::vector<Validation>& rows);

/// Returns the same as JSON: an array of objects, mm.
nlohmann::ordered_json validation_json(const std::vector<Validation>& rows);

}  // namespace shakedown
