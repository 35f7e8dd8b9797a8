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

/// The answer to a question, as Python gets it.
struct Answer {
  std::string document;          ///< JSON text
  std::string text;              ///< for people
  bool holds = true;             ///< the model holds, the engines agree: exit code 0 of the command
  std::optional<Setup> setup{};  ///< amended or fitted
  /// What the setup left out (paper_values.hpp); empty where the document says nothing of it.
  std::optional<std::vector<std::string>> taken_from_paper{};
  /// Makes the report; it may simulate, and stops when `stop` is set.
  std::function<Report(const std::atomic<bool>* stop)> report{};
};

// Each adds its classes and functions to the module; _core.pyi has their signatures.

/// Adds InputError, FileError and PhysicsError, and turns the program's exceptions into them.
void bind_errors(pybind11::module_& module);
/// Adds the class Setup, and `lend` for functions that formulas may use.
void bind_setup(pybind11::module_& module);
/// Adds the class Experiment, and `import_tables`.
void bind_experiment(pybind11::module_& module);
/// Adds the class Answer.
void bind_answer(pybind11::module_& module);
/// Adds `simulate` with its class Simulated, `crosscheck`, and the lists of engines and effects.
void bind_simulation(pybind11::module_& module);
/// Adds `compare`, `diagnose`, `fit` and `bounce` with the classes of their questions.
void bind_judgement(pybind11::module_& module);
/// Adds `hide` with the classes of its question and answer.
void bind_laboratory(pybind11::module_& module);

}  // namespace shakedown
