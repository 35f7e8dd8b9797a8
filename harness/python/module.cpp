// SPDX-License-Identifier: MIT
#include "bindings.hpp"
#include "provenance.hpp"

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of shakedown; import shakedown instead.";
  module.attr("version_line") = shakedown::version_line();
  shakedown::bind_errors(module);
  shakedown::bind_setup(module);
  shakedown::bind_experiment(module);
  shakedown::bind_answer(module);
  shakedown::bind_simulation(module);
  shakedown::bind_judgement(module);
  shakedown::bind_laboratory(module);
}
