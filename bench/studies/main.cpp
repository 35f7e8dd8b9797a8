// SPDX-License-Identifier: MIT
#include "program_place.hpp"
#include "study_commands.hpp"

int main(int count, char** words) {
  shakedown::become_faster_program(words);
  return shakedown::run_program(
      "shakedown", "Puts the method on trial, and the paper's statements.",
      [](CLI::App& program) {
        return std::vector{shakedown::add_paper_command(program), shakedown::add_blind_suite_command(program),
                           shakedown::add_ring_down_command(program), shakedown::add_signal_command(program)};
      },
      count, words);
}
