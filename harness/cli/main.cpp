// SPDX-License-Identifier: MIT
#include "command.hpp"
#include "program_place.hpp"

int main(int count, char** words) {
  shakedown::become_faster_program(words);
  return shakedown::run_program("shakedown", "Puts models of a granular damper on trial.",
                                shakedown::add_commands, count, words);
}
