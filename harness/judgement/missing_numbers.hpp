// SPDX-License-Identifier: MIT
// Explains missing numbers. JSON knows no NaN: a number that could not be computed becomes null, and the
// document says why.
#pragma once
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace shakedown {

/// Returns why the number at this path ("/ladder/0/p_value") could not be computed; empty: not known.
using ReasonOfPath = std::function<std::string(const std::string& path)>;

/// Turns every NaN and infinity of the document into null and adds "not_computed": an object of the paths and
/// the reasons, if there is any.
void explain_missing_numbers(nlohmann::ordered_json& document, const ReasonOfPath& reason_of = {});

}  // namespace shakedown
