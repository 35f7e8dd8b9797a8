// SPDX-License-Identifier: MIT
#pragma once
#include <pybind11/numpy.h>

#include <vector>

namespace shakedown {

/// Copies values into a numpy array of its own, shape (n).
inline pybind11::array_t<double> array_of(const std::vector<double>& values) {
  return pybind11::array_t<double>(static_cast<pybind11::ssize_t>(values.size()), values.data());
}

}  // namespace shakedown
