// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "errors.hpp"

namespace py = pybind11;

namespace shakedown {

namespace {

/// The types of the exceptions, which live as long as the interpreter.
struct ErrorTypes {
  py::object input, file, physics;
};
ErrorTypes& types() {
  static auto* const all = new ErrorTypes;
  return *all;
}

py::object new_type(py::module_& module, const char* name, PyObject* base, const char* words) {
  const std::string full = "shakedown." + std::string(name);
  const auto type =
      py::reinterpret_steal<py::object>(PyErr_NewExceptionWithDoc(full.c_str(), words, base, nullptr));
  module.attr(name) = type;
  return type;
}

/// Raises InputError with every mistake and its place, as the command line prints it.
void raise_input_error(const InputError& error) {
  py::list violations;
  for (const Violation& one : error.violations)
    violations.append(
        py::make_tuple(one.place.file, one.place.line, one.place.column, one.key, one.problem, one.remedy));
  const py::object value = types().input(error.what());
  value.attr("violations") = violations;
  PyErr_SetObject(types().input.ptr(), value.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    raise_input_error(error);
  } catch (const FileError& error) {
    PyErr_SetString(types().file.ptr(), error.what());
  } catch (const PhysicsError& error) {
    PyErr_SetString(types().physics.ptr(), error.what());
  } catch (const Interrupted& error) {
    PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
  }
}

}  // namespace

void bind_errors(py::module_& module) {
  types().input =
      new_type(module, "InputError", PyExc_ValueError,
               "What is wrong with a setup, a measurement or an argument: every mistake at once.\n\n"
               "violations: a list of (file, line, column, key, problem, remedy).");
  types().file = new_type(module, "FileError", PyExc_OSError, "A file that cannot be read or written.");
  types().physics = new_type(module, "PhysicsError", PyExc_RuntimeError,
                             "An engine cannot keep its promise (overlap, open ledger, endless collisions).");
  py::register_exception_translator(&translate);
}

}  // namespace shakedown
