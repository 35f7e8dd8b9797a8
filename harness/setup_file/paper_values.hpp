// SPDX-License-Identifier: MIT
// A key that a setup leaves out has the value of the paper's damper. For any other damper that is a mistake
// nobody sees, so whatever comes of such a setup says which values it took.
#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "setup.hpp"

namespace shakedown {

/// Returns "grains.mass = 4.04 g" for each key that says what the damper is (masses, lengths, frequency,
/// restitutions, release), matters in this setup, and is given neither in it nor `elsewhere` (box.length,
/// where each measured run has its own).
std::vector<std::string> taken_from_paper(const Setup& setup,
                                          std::span<const std::string_view> elsewhere = {});

/// Throws InputError naming each of them with what to write instead; `file` stands for the setup in the
/// message.
void refuse_paper_values(const Setup& setup, const std::string& file,
                         std::span<const std::string_view> elsewhere = {});

/// Returns "taken from the paper: grains.mass = 4.04 g, ...\n"; empty when there is none.
std::string line_of_paper_values(const std::vector<std::string>& taken);

}  // namespace shakedown
