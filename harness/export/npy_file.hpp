// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

namespace shakedown {

/// Returns the bytes of a NumPy .npy file (format 1.0) of little-endian doubles in C order.
std::string npy(const std::vector<std::size_t>& shape, const std::vector<double>& values);

}  // namespace shakedown
