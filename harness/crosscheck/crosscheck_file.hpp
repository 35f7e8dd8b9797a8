// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

#include "crosscheck.hpp"

namespace shakedown {

/// Returns the results for people: what each engine made of the setup, then the verdicts, then the limit.
std::string readable_crosscheck(const Crosscheck& crosscheck);

/// Returns {schema_version, program, crosschecks: [{setup, engines, comparisons, limit}]}; null: there is no
/// such number.
std::string crosscheck_json(const std::vector<Crosscheck>& crosschecks);

/// Returns a line a setup, engine and number: setup,engine,number,mean,sd,n (units in the number's name).
std::string crosscheck_numbers_csv(const std::vector<Crosscheck>& crosschecks);

/// Returns a line a setup, pair of engines and number:
/// setup,first,second,number,difference,standard_error,low,high,margin,verdict.
std::string crosscheck_verdicts_csv(const std::vector<Crosscheck>& crosschecks);

/// Returns a line a setup, number and contact time (0: extrapolated; empty: the hard engine):
/// setup,number,contact_time_ms,mean,standard_error.
std::string crosscheck_limit_csv(const std::vector<Crosscheck>& crosschecks);

}  // namespace shakedown
