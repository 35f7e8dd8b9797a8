// SPDX-License-Identifier: MIT
#include "promise.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "errors.hpp"

namespace shakedown {

namespace {

constexpr const char* remedy =
    "; check the units of lengths, masses, times and forces in the setup, make formulas of user_force "
    "smoother, "
    "or take --engine soft, which keeps its own book and says how well";

std::string digits(double number) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3g", number);
  return text.data();
}

[[noreturn]] void refuse(double time, const std::string& what) {
  throw PhysicsError("at t = " + digits(time) + " s " + what + remedy);
}

}  // namespace

void expect_kept(const Health& health, double time, double most_energy) {
  if (!std::isfinite(most_energy))
    refuse(time, "the energy of box and grains is not a finite number (numbers end at 1e308)");
  const double error = health.ledger_error;
  if (!(error <= most_ledger_error))
    refuse(time, "energy and losses do not balance: they are off by " + digits(error) + " of the energy (" +
                     digits(most_ledger_error) + " is the most that is let pass)");
  if (!(health.deepest_overlap <= most_overlap))
    refuse(time, "hard surfaces overlap by " + digits(health.deepest_overlap) + " m (" +
                     digits(most_overlap) + " m is the most that is let pass)");
}

}  // namespace shakedown
