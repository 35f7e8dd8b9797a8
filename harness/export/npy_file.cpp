// SPDX-License-Identifier: MIT
#include "npy_file.hpp"

#include <cstring>

#include "errors.hpp"

namespace shakedown {

std::string npy(const std::vector<std::size_t>& shape, const std::vector<double>& values) {
  std::size_t size = 1;
  std::string extents;
  for (const std::size_t extent : shape) {
    size *= extent;
    extents += std::to_string(extent) + ",";
  }
  EXPECT(size == values.size());
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" + extents + "), }";
  constexpr std::size_t before = 10;  // magic, version, length of the header
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  const std::size_t start = bytes.size();
  bytes.resize(start + 8 * values.size());
  if (!values.empty()) std::memcpy(bytes.data() + start, values.data(), 8 * values.size());
  return bytes;
}

}  // namespace shakedown
