// SPDX-License-Identifier: MIT
// One target as a program of libFuzzer: FUZZ_TARGET is its name.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "expect.hpp"
#include "targets.hpp"

namespace shakedown {

/// Stands in for the program's own, which ends without a word to the fuzzer.
void report_bug(const char* condition, const char* file, int line) {
  std::fprintf(stderr, "%s:%d: expected %s\n", file, line, condition);
  std::abort();
}

}  // namespace shakedown

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const shakedown::FuzzTarget* const target = shakedown::find_fuzz_target(FUZZ_TARGET);
  target->read({reinterpret_cast<const char*>(data), size});
  return 0;
}
