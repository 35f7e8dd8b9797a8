// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "arrays.hpp"
#include "bindings.hpp"
#include "effects.hpp"
#include "experiment_file.hpp"
#include "import_tables.hpp"

namespace py = pybind11;

namespace shakedown {

namespace {

py::dict run_of(const Experiment& experiment, std::size_t number) {
  const MeasuredRun& run = experiment.runs.at(number);
  py::dict found;
  found["name"] = run.name;
  found["box_length"] = run.box_length;
  found["frame_rate"] = run.frame_rate;
  found["time"] = array_of(run.time);
  found["box"] = array_of(run.x_box);
  found["centre"] = run.has_com() ? py::object(array_of(run.x_com)) : py::none();
  return found;
}

py::tuple imported(const std::vector<std::string>& files, const std::string& frame_rate,
                   const std::string& pixel, const std::string& origin,
                   const std::vector<std::string>& lengths) {
  const ImportedTables found = import_tables({files.begin(), files.end()}, std::filesystem::current_path(),
                                             ImportOptions{frame_rate, pixel, origin, lengths});
  return py::make_tuple(found.experiment, found.preview, found.open_questions);
}

}  // namespace

void bind_experiment(py::module_& module) {
  py::class_<Experiment>(module, "Experiment")
      .def_static("read", [](const std::string& file) { return read_experiment(file, all_effects()); })
      .def_static("parse", [](const std::string& text, const std::string& name,
                              const std::string& folder) { return parse_experiment(text, name, folder); })
      .def_readonly("title", &Experiment::title)
      .def_readonly("notes", &Experiment::notes)
      .def("count", [](const Experiment& experiment) { return experiment.runs.size(); })
      .def("run", &run_of)
      .def("digest", [](const Experiment& experiment) { return digest(experiment); });
  module.def("import_tables", &imported);
}

}  // namespace shakedown
