// SPDX-License-Identifier: MIT
#include "expect.hpp"

#include <cstdio>
#include <cstdlib>

namespace shakedown {

void report_bug(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "shakedown: this is a bug of the program, please report it: %s:%d: expected %s\n",
               file, line, condition);
  std::_Exit(70);  // the exit code of a bug, as README says; nothing more is touched
}

}  // namespace shakedown
