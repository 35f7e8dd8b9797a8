// SPDX-License-Identifier: MIT
// `fuzz_reads TARGET [libFuzzer's options] [FOUND] CORPUS`: libFuzzer on one reader. A refusal is fine; any
// other exception, and whatever a sanitizer sees, ends it with the bytes in a file.
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "targets.hpp"

namespace {

const shakedown::FuzzTarget* target = nullptr;
constexpr const char* chosen = "FUZZ_TARGET";  // programs that libFuzzer starts itself find the name there

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** words);
extern "C" int LLVMFuzzerInitialize(int* count, char*** words) {
  if (*count > 1 && (*words)[1][0] != '-')
    if ((target = shakedown::find_fuzz_target((*words)[1])) != nullptr) {
      ::setenv(chosen, (*words)[1], 1);
      (*words)[1] = (*words)[0];
      ++*words;
      --*count;
      return 0;
    }
  if (const char* name = std::getenv(chosen)) target = shakedown::find_fuzz_target(name);
  if (target != nullptr) return 0;
  std::cerr << "fuzz_reads: the first word names no reader; choose one of";
  for (const shakedown::FuzzTarget& one : shakedown::fuzz_targets()) std::cerr << ' ' << one.name;
  std::cerr << '\n';
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  target->read({reinterpret_cast<const char*>(bytes), size});
  return 0;
}
