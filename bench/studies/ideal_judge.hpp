// SPDX-License-Identifier: MIT
// A judge who knows how each effect moves box and grains and how they scatter: what a diagnosis could reach
// on the same cases.
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "blind_suite.hpp"

namespace shakedown {

/// Returns the mean over `draws` experiments of -ln of the probability that the judge gives to the truth, at
/// least one in a thousand as log_score() has it. `products`: s_i'C^-1 s_j of the signatures at typical
/// strength; the truth is signature `hidden` times `strength`, or nothing. The judge takes it that nothing is
/// missing with one half, else each effect is as likely, with a strength of either sign after Cauchy of scale
/// 1 (typical), and that signatures grow in proportion to the strength.
double ideal_log_score(const std::vector<std::vector<double>>& products, std::optional<std::size_t> hidden,
                       double strength, int draws, std::uint64_t seed);

/// Returns its mean log score beside that of the answers, on the cases of the suite in `folder` with nothing
/// or one effect hidden in the plain damper. Measures the signatures once and keeps them in signatures.json
/// (some minutes of a core for the full design). Throws what score_blind_suite() throws, Interrupted.
std::vector<BlindFigure> ideal_judge(const std::filesystem::path& folder, const Setup& believed,
                                     const TrialTools& tools);

}  // namespace shakedown
