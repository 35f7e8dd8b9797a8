// SPDX-License-Identifier: MIT
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>

#include "arrays.hpp"
#include "bindings.hpp"
#include "catalogue.hpp"
#include "crosscheck_file.hpp"
#include "crosscheck_report.hpp"
#include "effect_asked.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "ensemble.hpp"
#include "in_order.hpp"
#include "paper_values.hpp"
#include "readable_summary.hpp"
#include "released.hpp"
#include "run_report.hpp"
#include "summary_file.hpp"

namespace py = pybind11;

namespace shakedown {

namespace {

/// Runs with their motion, and what a page of them needs.
struct Simulated {
  Answer answer;
  std::shared_ptr<const Ensemble> ensemble;
};

Simulated simulated(const Setup& setup, const std::string& name, const std::string& engine_name, int runs,
                    int threads, const py::object& listener) {
  const std::unique_ptr<Engine> engine = engine_named(engine_name);
  refuse_what_is_not_modelled(*engine, setup);
  const auto curves = std::make_shared<RunCurves>();
  const auto work = [&](ToldProgress& told, const std::atomic<bool>* stop) {
    EnsembleOptions options;
    options.runs = runs;
    options.execution = {threads, stop};
    options.keep_samples = true;
    // One run alone is shown in motion, which takes its log.
    options.log_collisions = runs == 1 && engine_name == "hard" && setup.domain != Domain::periodic;
    options.progress = [&](double fraction) { told.tell("running", fraction); };
    options.each = [&](int, const Trajectory& motion, const Observables&) { curves->add(motion); };
    return std::make_shared<const Ensemble>(run_ensemble(*engine, setup, options));
  };
  const std::shared_ptr<const Ensemble> ensemble = released(listener, work);
  const auto report = [=](const std::atomic<bool>*) { return curves->report(*ensemble, setup, name); };
  return {
      {summary_json(*ensemble, setup), readable_summary(*ensemble, setup), true, setup, std::nullopt, report},
      ensemble};
}

/// Returns the sampled motion of one run; shapes (T), the losses (3, T).
py::dict motion_of(const Simulated& simulated, std::size_t number) {
  const Trajectory& run = simulated.ensemble->runs.at(number).trajectory;
  py::dict motion;
  motion["time"] = array_of(run.time);
  motion["box"] = array_of(run.x_box);
  motion["box_velocity"] = array_of(run.v_box);
  motion["centre"] = array_of(run.x_com);
  motion["energy"] = array_of(run.total_energy);
  py::array_t<double> loss({run.loss.size(), run.time.size()});
  for (std::size_t kind = 0; kind < run.loss.size(); ++kind)
    std::copy(run.loss[kind].begin(), run.loss[kind].end(),
              loss.mutable_data(static_cast<py::ssize_t>(kind), 0));
  motion["loss"] = loss;
  return motion;
}

/// Returns numbers read off one run; times and values of the peaks have shape (P), crossings (C).
py::dict observed(const Simulated& simulated, std::size_t number) {
  const Observables& run = simulated.ensemble->runs.at(number).observables;
  std::vector<double> times, values;
  for (const Peak& peak : run.peaks) times.push_back(peak.time), values.push_back(peak.position);
  py::dict found;
  found["peak_time"] = array_of(times);
  found["peak"] = array_of(values);
  found["zero_crossings"] = array_of(run.zero_crossings);
  found["frequency"] = run.frequency;
  found["slope"] = run.slope;
  found["first_small_peak"] = run.first_small_peak;
  return found;
}

Answer crosschecked(const Setup& setup, const std::string& name, const std::vector<std::string>& engines,
                    int runs, int threads, const py::object& listener) {
  const auto work = [&](ToldProgress& told, const std::atomic<bool>* stop) {
    CrosscheckOptions options;
    options.engines = engines;
    options.runs = runs;
    options.execution = {threads_or_all(threads), stop};
    options.progress = [&](double fraction) { told.tell("running each engine", fraction); };
    return std::vector<Crosscheck>{crosscheck(name, setup, options)};
  };
  const std::vector<Crosscheck> found = released(listener, work);
  const auto report = [=](const std::atomic<bool>*) { return report_of(found, setup); };
  return {crosscheck_json(found),
          readable_crosscheck(found.front()),
          !found.front().any(Agreement::differ),
          setup,
          taken_from_paper(setup),
          report};
}

std::string effects_document(const std::string& name) {
  if (name.empty()) return effects_json(all_effects());
  const EffectRecord* const one[] = {&effect_asked(name)};
  return effects_json(one);
}

std::string effects_text(const std::string& name) {
  return name.empty() ? list_effects(all_effects()) : describe_effect(effect_asked(name));
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<Simulated>(module, "Simulated")
      .def_readonly("answer", &Simulated::answer)
      .def("count", [](const Simulated& all) { return all.ensemble->runs.size(); })
      .def("motion", &motion_of)
      .def("observed", &observed);
  module.def("simulate", &simulated);
  module.def("crosscheck", &crosschecked);
  module.def("engine_names", &engine_names);
  module.def("effects_document", &effects_document);
  module.def("effects_text", &effects_text);
}

}  // namespace shakedown
