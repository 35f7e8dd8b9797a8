// SPDX-License-Identifier: MIT
#include "command.hpp"

int main(int count, char** words) {
  return shakedown::run_program("shakedown", "Puts models of a granular damper on trial.",
                                shakedown::add_commands, count, words);
}
