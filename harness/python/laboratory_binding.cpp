// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <filesystem>

#include "bindings.hpp"
#include "effects.hpp"
#include "hidden_case.hpp"
#include "hidden_question.hpp"
#include "released.hpp"

namespace py = pybind11;

namespace shakedown {

namespace {

/// Measurements with something hidden in them.
struct Hidden {
  HiddenQuestion question;
  Trial trial;
  Experiment experiment;
};

Hidden hidden_in(const Setup& setup, HiddenQuestion question, const py::object& listener) {
  question.setup_with = [setup](std::span<const Override> changes) {
    return with_overrides(setup, changes, all_effects());
  };
  Trial trial = trial_of(question);
  Experiment experiment = released(listener, [&](ToldProgress& told, const std::atomic<bool>* stop) {
    return measured(question, trial, stop, [&](double fraction) { told.tell("measuring", fraction); });
  });
  return {std::move(question), std::move(trial), std::move(experiment)};
}

std::string truth_of(const Hidden& hidden) {
  return truth_json(hidden.trial.hidden, hidden.trial.recording, hidden.question.engine,
                    hidden.question.seed);
}

void write(const Hidden& hidden, const std::string& folder, const std::string& truth) {
  std::filesystem::create_directories(folder);
  write_case(folder, truth, hidden.question, hidden.trial, hidden.experiment);
}

}  // namespace

void bind_laboratory(py::module_& module) {
  py::class_<HiddenQuestion>(module, "HiddenQuestion")
      .def(py::init<>())
      .def_readwrite("engine", &HiddenQuestion::engine)
      .def_readwrite("lengths", &HiddenQuestion::lengths)
      .def_readwrite("duration", &HiddenQuestion::duration)
      .def_readwrite("title", &HiddenQuestion::title)
      .def_readwrite("effects", &HiddenQuestion::effects)
      .def_readwrite("parameters", &HiddenQuestion::parameters)
      .def_readwrite("camera", &HiddenQuestion::camera)
      .def_readwrite("runs", &HiddenQuestion::runs)
      .def_readwrite("known", &HiddenQuestion::known)
      .def_readwrite("seed", &HiddenQuestion::seed)
      .def_readwrite("threads", &HiddenQuestion::threads);
  py::class_<Hidden>(module, "Hidden")
      .def_readonly("experiment", &Hidden::experiment)
      .def_property_readonly("believed", [](const Hidden& hidden) { return hidden.trial.hidden.believed; })
      .def("truth", &truth_of)
      .def("write", &write);
  module.def("hide", &hidden_in);
}

}  // namespace shakedown
