// SPDX-License-Identifier: MIT
#include "hideable.hpp"

#include <cmath>

#include "effects.hpp"
#include "hidden_case.hpp"
#include "key_unit.hpp"
#include "setup_keys.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

constexpr const char* origin = "blind suite";

/// Returns "constant_acceleration.z"; for an effect with one strength its name.
std::string id_of(const EffectRecord& record, const SearchedStrength& strength, std::size_t ways) {
  const std::string name(record.name);
  return ways == 1 ? name : name + strength.parameters.substr(strength.parameters.rfind('.'));
}

std::vector<Hideable> effects_of_the_list() {
  std::vector<Hideable> list;
  for (const EffectRecord* record : all_effects()) {
    const Search search = search_of(*record);
    if (!search.not_searched.empty() || !record->needs.empty()) continue;
    for (SearchedStrength strength : search.strengths) {
      const Parameter& parameter = parameter_of(*record, strength);
      strength.low = parameter.low, strength.high = parameter.high;
      const double times = strength.strongest / strength.typical;
      list.push_back({.id = id_of(*record, strength, search.strengths.size()),
                      .effect = record,
                      .strength = strength,
                      .strongest = strength.inverse ? 1 / times : times});
    }
  }
  return list;
}

struct Force {
  const char *id, *formula, *constants;
  double typical;
  const char* unit;
  bool of_the_dictionary = false, takes_table = false;
};

/// Formula of a force that is straight between its heights, which stand 30 mm apart from -90 to 90 mm.
constexpr const char* table_of_seven =
    "c*(a0*max(0,1-abs(x/w+3))+a1*max(0,1-abs(x/w+2))+a2*max(0,1-abs(x/w+1))+a3*max(0,1-abs(x/w))"
    "+a4*max(0,1-abs(x/w-1))+a5*max(0,1-abs(x/w-2))+a6*max(0,1-abs(x/w-3)))";

std::vector<Hideable> forces_of_no_list() {
  static constexpr double strongest = 50;
  static constexpr Force forces[] = {
      // Forms that a diagnosis offers.
      {"force:eddy brake", "-c*v*exp(-((x-x0)/w)^2)", "x0 = \"45 mm\", w = \"12 mm\"", 0.2, "N s/m", true},
      {"force:thickening", "-c*v*x^2", "", 10, "N s/m^3", true},
      {"force:cubic drag", "-c*v^3", "", 0.1, "N s^3/m^3", true},
      {"force:lopsided spring", "-c*x^2", "", 5, "N/m^2", true},
      {"force:soft stop", "-c*max(x-x0,0)", "x0 = \"60 mm\"", 5, "N/m", true},
      {"force:fading push", "c*exp(-t/tau)", "tau = \"2 s\"", 0.1, "N", true},
      {"force:rubbing spot", "-c*v/sqrt(v^2+v0^2)/(1+((x-x0)/w)^4)",
       "x0 = \"45 mm\", w = \"12 mm\", v0 = \"10 mm/s\"", 0.05, "N", true},
      {"force:hysteresis", "-c*abs(x)*v/sqrt(v^2+v0^2)", "v0 = \"10 mm/s\"", 1, "N/m", true},
      // Forms of no dictionary: a brake between two places, a stop that loses energy, a saw tooth, knocks,
      // drag at positive x alone, a spring that the speed softens, a table drawn at random.
      {"force:brake between", "-c*v*(x>x0)*(x<x1)", "x0 = \"20 mm\", x1 = \"50 mm\"", 0.2, "N s/m"},
      {"force:lossy stop", "-c*max(x-x0,0)*(1+v/v0)", "x0 = \"60 mm\", v0 = \"200 mm/s\"", 5, "N/m"},
      {"force:saw tooth", "c*(t/T-rint(t/T))", "T = \"1.7 s\"", 0.1, "N"},
      {"force:knocks", "c*exp(-((t-T*rint(t/T))/w)^2)", "T = \"1.3 s\", w = \"30 ms\"", 0.2, "N"},
      {"force:drag on one side", "-c*v*abs(v)*(x>0)", "", 0.05, "N s^2/m^2"},
      {"force:softened by the speed", "c*x*v^2", "", 1, "N s^2/m^3"},
      {"force:table", table_of_seven, "w = \"30 mm\"", 0.05, "N", false, true},
  };
  std::vector<Hideable> list;
  for (const Force& force : forces)
    list.push_back({.id = force.id,
                    .effect = &formula_effect(),
                    .strongest = strongest,
                    .formula = force.formula,
                    .constants = force.constants,
                    .typical_constant = force.typical,
                    .unit = force.unit,
                    .of_the_dictionary = force.of_the_dictionary,
                    .takes_table = force.takes_table});
  return list;
}

std::string key_of_kind(const EffectRecord& record, ParameterKind kind) {
  for (const Parameter& parameter : record.parameters)
    if (parameter.kind == kind) return std::string(record.name) + "." + std::string(parameter.name);
  EXPECT(false && "a formula without that parameter");
  return "";
}

std::vector<Override> force_at(const Hideable& force, double strength, const DrawnTone& tone) {
  std::string more = force.constants.empty() ? "" : ", " + std::string(force.constants);
  for (std::size_t i = 0; force.takes_table && i < tone.table.size(); ++i)
    more += ", a" + std::to_string(i) + " = " + toml_of(tone.table[i], "");
  const std::string value = toml_of(force.typical_constant * strength, force.unit);
  return {{key_of_kind(*force.effect, ParameterKind::text), toml_string(force.formula), origin},
          {key_of_kind(*force.effect, ParameterKind::constants), "{c = " + value + more + "}", origin}};
}

}  // namespace

const std::vector<Hideable>& hideable_effects() {
  static const std::vector<Hideable> effects = effects_of_the_list();
  return effects;
}

const std::vector<Hideable>& hideable_forces() {
  static const std::vector<Hideable> forces = forces_of_no_list();
  return forces;
}

const Hideable* find_hideable(std::string_view id) {
  for (const std::vector<Hideable>* list : {&hideable_effects(), &hideable_forces()})
    for (const Hideable& hideable : *list)
      if (hideable.id == id) return &hideable;
  return nullptr;
}

std::vector<Override> at_strength(const Hideable& hideable, double strength, const Setup& setup,
                                  const DrawnTone& tone) {
  if (!hideable.formula.empty()) return force_at(hideable, strength, tone);
  const double typical = hideable.strength.typical;
  const double level = hideable.strength.inverse ? typical / strength : typical * strength;
  std::vector<Override> overrides = overrides_of_strength(*hideable.effect, hideable.strength, level, setup);
  if (const auto& harmonic = hideable.effect->search.harmonic) {
    const std::string name = std::string(hideable.effect->name) + ".";
    overrides.push_back({name + std::string(harmonic->frequency), toml_of(tone.frequency, "Hz"), origin});
    overrides.push_back({name + std::string(harmonic->phase), toml_of(tone.phase, "rad"), origin});
  }
  return overrides;
}

Setup changed(const Setup& setup, const std::vector<Override>& overrides, KnownEffects known) {
  return parse_setup(write_setup(setup), "setup", known, overrides);
}

}  // namespace shakedown
