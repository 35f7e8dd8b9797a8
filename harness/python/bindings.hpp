// SPDX-License-Identifier: MIT
// The parts of the compiled module shakedown._core. What Python's users see is made of them in
// shakedown/*.py.
#pragma once
#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "report.hpp"
#include "setup.hpp"

namespace shakedown {

/// What a question comes to.
struct Answer {
  std::string document;          ///< JSON text
  std::string text;              ///< for people
  bool holds = true;             ///< the model holds, the engines agree: exit code 0 of the command
  std::optional<Setup> setup{};  ///< amended or fitted
  /// What the setup left out (paper_values.hpp); empty where the document says nothing of it.
  std::optional<std::vector<std::string>> taken_from_paper{};
  std::function<Report(const std::atomic<bool>* stop)> report{};
};

void bind_errors(pybind11::module_& module);
void bind_setup(pybind11::module_& module);
void bind_experiment(pybind11::module_& module);
void bind_answer(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_judgement(pybind11::module_& module);
void bind_laboratory(pybind11::module_& module);

}  // namespace shakedown
