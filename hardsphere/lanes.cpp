// SPDX-License-Identifier: MIT
#include "lanes.hpp"

#include <sys/mman.h>

namespace shakedown {

namespace {

constexpr std::size_t large_page = std::size_t{1} << 21;
std::align_val_t alignment(std::size_t bytes) {
  return std::align_val_t{bytes >= large_page ? large_page : 64};
}

}  // namespace

void* allocate_cache_lines(std::size_t bytes) {
  void* memory = ::operator new(bytes, alignment(bytes));
  if (bytes >= large_page) ::madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: refused, only speed is lost
  return memory;
}

void free_cache_lines(void* memory, std::size_t bytes) { ::operator delete(memory, alignment(bytes)); }

}  // namespace shakedown
