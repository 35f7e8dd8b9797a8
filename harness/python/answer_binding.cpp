// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "released.hpp"

namespace py = pybind11;

namespace shakedown {

namespace {

/// Makes the page, which may need simulations of its own.
std::string page_of(const Answer& answer) {
  return released(py::none(), [&](ToldProgress&, const std::atomic<bool>* stop) {
    return report_html(answer.report(stop));
  });
}

}  // namespace

void bind_answer(py::module_& module) {
  py::class_<Answer>(module, "Answer")
      .def_readonly("document", &Answer::document)
      .def_readonly("text", &Answer::text)
      .def_readonly("holds", &Answer::holds)
      .def_readonly("setup", &Answer::setup)
      .def_readonly("taken_from_paper", &Answer::taken_from_paper)
      .def("page", &page_of);
}

}  // namespace shakedown
