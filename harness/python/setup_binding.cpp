// SPDX-License-Identifier: MIT
#include <pybind11/stl.h>

#include <filesystem>

#include "bindings.hpp"
#include "effects.hpp"
#include "formula.hpp"
#include "paper_values.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"

namespace py = pybind11;

namespace shakedown {

namespace {

std::vector<Override> overrides_of(const std::vector<std::string>& texts) {
  std::vector<Override> overrides;
  for (const std::string& text : texts) overrides.push_back(parse_override(text, "set"));
  return overrides;
}

std::vector<std::string> effect_names(const Setup& setup) {
  std::vector<std::string> names;
  for (const EffectChoice& effect : setup.effects) names.emplace_back(effect.record->name);
  return names;
}

/// Returns the values that a setup took from the paper; a measurement says how long its boxes are.
std::vector<std::string> from_paper(const Setup& setup, bool measured) {
  constexpr std::string_view length[] = {"box.length"};
  return taken_from_paper(
      setup, measured ? std::span<const std::string_view>(length) : std::span<const std::string_view>());
}

/// Lends `function`, which lives as long as the process, to formulas as name(x, v, t): engines call it from
/// threads of their own, each with Python's lock.
void lend(const std::string& name, const py::function& function) {
  const py::handle kept = py::function(function).release();
  lend_function(name, [kept, name](double x, double v, double t) {
    const py::gil_scoped_acquire lock;
    try {
      return kept(x, v, t).cast<double>();
    } catch (const std::exception& wrong) {  // of Python, or no number
      throw PhysicsError("the force " + name + " of Python fails at x = " + write_number(x) + " m, v = " +
                         write_number(v) + " m/s, t = " + write_number(t) + " s: " + wrong.what());
    }
  });
}

}  // namespace

void bind_setup(py::module_& module) {
  module.def("lend", &lend);
  py::class_<Setup>(module, "Setup")
      .def_static("read",
                  [](const std::string& file, const std::vector<std::string>& set) {
                    return read_setup(file, all_effects(), overrides_of(set));
                  })
      .def_static("parse",
                  [](const std::string& text, const std::string& name, const std::vector<std::string>& set) {
                    return parse_setup(text, name, all_effects(), overrides_of(set),
                                       std::filesystem::current_path());
                  })
      .def("changed",
           [](const Setup& setup, const std::vector<std::string>& set) {
             return with_overrides(setup, overrides_of(set), all_effects());
           })
      .def("toml", &write_setup)
      .def("digest", [](const Setup& setup) { return digest(setup); })
      .def("number",
           [](const Setup& setup, const std::string& key) { return get_number(setup, key, all_effects()); })
      .def("effects", &effect_names)
      .def("taken_from_paper", &from_paper);
}

}  // namespace shakedown
