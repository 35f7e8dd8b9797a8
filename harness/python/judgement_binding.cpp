// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <memory>

#include "bindings.hpp"
#include "bounce_report.hpp"
#include "compared.hpp"
#include "diagnosed.hpp"
#include "drop_question.hpp"
#include "effects.hpp"
#include "engines.hpp"
#include "experiment.hpp"
#include "fitted.hpp"
#include "looked_at.hpp"
#include "paper_values.hpp"
#include "released.hpp"

namespace py = pybind11;

namespace shakedown {

namespace {

/// A setup with what the experiment knows put in, and the measurement that goes with it.
struct Question {
  Setup setup;
  Measurement measurement;
  std::vector<std::string> taken_from_paper;
};

std::shared_ptr<const Question> question_of(Setup setup, const Experiment& experiment) {
  const Experiment looked = looked_at(experiment, setup);
  Measurement measurement = measurement_of(setup, looked, all_effects());
  constexpr std::string_view measured[] = {"box.length"};  // each run says how long its box is
  std::vector<std::string> taken = taken_from_paper(setup, measured);
  return std::make_shared<const Question>(
      Question{std::move(setup), std::move(measurement), std::move(taken)});
}

std::shared_ptr<const Engine> shared_engine(const std::string& name) { return engine_named(name); }

Answer compared(const Setup& setup, const Experiment& experiment, const std::string& engine_name, int runs,
                int threads, const py::object& listener) {
  const std::shared_ptr<const Question> asked = question_of(setup, experiment);
  const std::shared_ptr<const Engine> engine = shared_engine(engine_name);
  const auto work = [&](ToldProgress& told, const std::atomic<bool>* stop) {
    const CompareOptions options{
        runs, {threads, stop}, [&](double fraction) { told.tell("comparing", fraction); }};
    return std::make_shared<const Compared>(
        compared_with(asked->setup, asked->measurement, *engine, options));
  };
  const std::shared_ptr<const Compared> found = released(listener, work);
  const auto report = [=](const std::atomic<bool>* stop) {
    return report_of(*found, asked->setup, *engine, {threads, stop});
  };
  return {compared_json(*found), compared_text(*found),   found->judgement.holds(),
          asked->setup,          asked->taken_from_paper, report};
}

struct DiagnosisAsked {
  std::vector<std::string> effects, fixed;
  std::int64_t budget = 0;
  double seconds = 300;
  int threads = 0;
};

Answer diagnosed(const Setup& setup, const Experiment& experiment, const DiagnosisAsked& how,
                 const py::object& listener) {
  const std::shared_ptr<const Question> asked = question_of(setup, experiment);
  check_diagnosed_names(how.effects, how.fixed);
  const std::shared_ptr<const Engine> engine = shared_engine("hard");
  const auto work = [&](ToldProgress& told, const std::atomic<bool>* stop) {
    DiagnoseOptions options = usual_diagnose_options();
    options.effects = how.effects;
    options.fixed = how.fixed;
    options.budget = how.budget > 0 ? how.budget : usual_budget(asked->measurement);
    options.seconds = how.seconds;
    options.execution = {how.threads, stop};
    options.progress = [&](const std::string& stage, double fraction) { told.tell(stage, fraction); };
    return std::make_shared<const Diagnosis>(diagnose(asked->setup, asked->measurement, *engine, options));
  };
  const std::shared_ptr<const Diagnosis> found = released(listener, work);
  const int threads = how.threads;
  const auto report = [=](const std::atomic<bool>* stop) {
    return report_of(*found, asked->measurement, asked->setup, {{threads, stop}, 0});
  };
  return {diagnosis_json(*found),
          diagnosis_text(*found),
          found->verdict == Verdict::adequate && found->judgement.holds(),
          found->amended,
          asked->taken_from_paper,
          report};
}

struct FitAsked {
  std::string free, restitution_curve, friction_curve;  ///< as on the command line
  std::vector<std::string> on;                          ///< names of runs; none: all
  int runs = 160, threads = 0;
};

Answer fitted(const Setup& setup, const Experiment& experiment, const FitAsked& how,
              const py::object& listener) {
  const std::shared_ptr<const Question> asked = question_of(setup, experiment);
  const std::shared_ptr<const Engine> engine = shared_engine("hard");
  const FitQuestion question{how.free, how.restitution_curve, how.friction_curve};
  check(question, asked->setup);  // throws before long work
  const auto work = [&](ToldProgress& told, const std::atomic<bool>* stop) {
    FitOptions options = usual_fit_options();
    options.on = how.on;
    options.count = how.runs;
    options.execution = {how.threads, stop};
    const double about = 12.0 * how.runs;  // rounds; more when the start is far off
    options.progress = [&](const std::string& stage, std::int64_t done) {
      told.tell(stage, std::min(0.99, static_cast<double>(done) / about));
    };
    return std::make_shared<const Fit>(
        fitted_and_judged(asked->setup, asked->measurement, question, *engine, options));
  };
  const std::shared_ptr<const Fit> found = released(listener, work);
  const int threads = how.threads;
  const auto report = [=](const std::atomic<bool>* stop) {
    return report_of(*found, asked->setup, asked->measurement, *engine, {threads, stop});
  };
  return {fit_json(*found), fit_text(*found),        found->judgement.holds(),
          found->fitted,    asked->taken_from_paper, report};
}

Answer bounced(const DropQuestion& question) {
  const auto found = std::make_shared<const BounceReading>(
      released(py::none(), [&](ToldProgress&, const std::atomic<bool>*) { return answer_of(question); }));
  const auto report = [=](const std::atomic<bool>*) { return report_of(*found); };
  return {drops_json(*found), bounce_text(*found), found->answer.holds(), std::nullopt, std::nullopt, report};
}

}  // namespace

void bind_judgement(py::module_& module) {
  module.def("compare", &compared);
  py::class_<DiagnosisAsked>(module, "DiagnosisAsked")
      .def(py::init<std::vector<std::string>, std::vector<std::string>, std::int64_t, double, int>());
  module.def("diagnose", &diagnosed);
  py::class_<FitAsked>(module, "FitAsked")
      .def(py::init<std::string, std::string, std::string, std::vector<std::string>, int, int>());
  module.def("fit", &fitted);
  py::class_<DropQuestion>(module, "DropQuestion")
      .def(py::init<>())
      .def_readwrite("files", &DropQuestion::files)
      .def_readwrite("columns", &DropQuestion::columns)
      .def_readwrite("recorded_as", &DropQuestion::as)
      .def_readwrite("unit", &DropQuestion::unit)
      .def_readwrite("rate", &DropQuestion::rate)
      .def_readwrite("mass", &DropQuestion::mass)
      .def_readwrite("diameter", &DropQuestion::diameter)
      .def_readwrite("height", &DropQuestion::height)
      .def_readwrite("timing", &DropQuestion::timing)
      .def_readwrite("gravity", &DropQuestion::gravity)
      .def_readwrite("reference", &DropQuestion::reference);
  module.def("bounce", &bounced);
}

}  // namespace shakedown
