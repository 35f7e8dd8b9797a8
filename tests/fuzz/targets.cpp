// SPDX-License-Identifier: MIT
#include "targets.hpp"

#include <algorithm>
#include <array>

#include "errors.hpp"
#include "target_reads.hpp"

namespace shakedown {

namespace {

/// The most that one refusal may say: a hundred violations, each of a few lines.
constexpr std::size_t longest_refusal = 100000;

void expect_short(const std::exception& refusal) {
  EXPECT(std::string_view(refusal.what()).size() < longest_refusal);
}

template <void (*work)(std::string_view)>
void refusing(std::string_view bytes) {
  try {
    work(bytes);
  } catch (const InputError& refusal) {
    expect_short(refusal);
  } catch (const FileError& refusal) {
    expect_short(refusal);
  }
}

constexpr std::array targets{
    FuzzTarget{"setup", refusing<read_as_setup>},     FuzzTarget{"experiment", refusing<read_as_experiment>},
    FuzzTarget{"film", refusing<read_as_film>},       FuzzTarget{"table", refusing<read_as_table>},
    FuzzTarget{"drops", refusing<read_as_drops>},     FuzzTarget{"formula", refusing<read_as_formula>},
    FuzzTarget{"grains", refusing<read_as_grains>},   FuzzTarget{"log", refusing<read_as_log>},
    FuzzTarget{"journal", refusing<read_as_journal>}, FuzzTarget{"results", refusing<read_as_results>},
    FuzzTarget{"report", refusing<read_as_report>},   FuzzTarget{"baselines", refusing<read_as_baselines>},
    FuzzTarget{"sound", refusing<read_as_sound>},     FuzzTarget{"words", refusing<read_as_words>},
    FuzzTarget{"curve", refusing<read_as_curve>}};

}  // namespace

std::span<const FuzzTarget> fuzz_targets() { return targets; }

const FuzzTarget* find_fuzz_target(std::string_view name) {
  const auto found = std::ranges::find(targets, name, &FuzzTarget::name);
  return found == targets.end() ? nullptr : &*found;
}

}  // namespace shakedown
