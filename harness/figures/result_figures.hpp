// SPDX-License-Identifier: MIT
// Finds which figures the results of a command hold.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "figure.hpp"
#include "figure_request.hpp"

namespace shakedown {

/// Returns decay, residuals, ladder, energy, probabilities, restitution.
const std::vector<std::string>& figure_kinds();

/// Reads a file of results (diagnosis.json, compare's, ladder.json, summary.json, bounce's, report.json), or
/// the folder in which a command left them. Throws InputError where it is none of these, or holds no such
/// figure, with what it holds; FileError.
Figure figure_of_result(const std::filesystem::path& result, const FigureRequest& request);

}  // namespace shakedown
