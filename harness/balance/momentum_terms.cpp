// SPDX-License-Identifier: MIT
#include "momentum_terms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "effect_strength.hpp"
#include "physics.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

/// Returns (a - b) / by; empty where nothing differs, so that what an effect does not touch costs nothing.
Eigen::ArrayXd difference(const Eigen::ArrayXd& a, const Eigen::ArrayXd& b, double by) {
  Eigen::ArrayXd d = (a - b) / by;
  return (d != 0).any() ? d : Eigen::ArrayXd();
}

Eigen::ArrayXd constant_unless_zero(Eigen::Index frames, double value) {
  return value == 0 ? Eigen::ArrayXd() : Eigen::ArrayXd::Constant(frames, value);
}

double as_strength(double parameter, bool inverse) {
  return inverse ? 1 / (parameter * parameter) : parameter;
}

/// Fixes a length whose default stands for the release displacement (of a cubic spring's coefficient) to the
/// first run's: it would be another one in every run that has its own. Such a length is known by doing
/// nothing when it is set to that displacement.
void fix_scale_of_release(const EffectRecord& record, const Setup& setup, KnownEffects known,
                          MomentumTerm& term) {
  const double release = std::abs(setup.release.displacement);
  if (release == 0) return;
  const double there = physics_of(with_strength(setup, term, term.typical, known)).spring_cubic;
  if (there == physics_of(setup).spring_cubic) return;
  for (const Parameter& parameter : record.parameters) {
    if (release < parameter.low || release > parameter.high || parameter.unit != "m" ||
        parameter.kind != ParameterKind::number)
      continue;
    MomentumTerm fixed = term;
    fixed.besides.emplace_back(std::string(record.name) + "." + std::string(parameter.name), release);
    if (physics_of(with_strength(setup, fixed, term.typical, known)).spring_cubic == there) term = fixed;
  }
}

MomentumTerm term_of(const EffectRecord& record, const Search& search, const SearchedStrength& searched,
                     const Setup& setup, KnownEffects known) {
  MomentumTerm term;
  term.effect = record.name;
  term.parameter = searched.parameters;
  term.unit = record.find(term.parameter.substr(0, term.parameter.find('.')))->unit;
  term.kind = record.acts_on == ActsOn::camera ? TermKind::camera : TermKind::physics;
  term.inverse = searched.inverse;
  const bool there = find_choice(setup, record.name) != nullptr;
  term.present = there ? as_strength(get_number(setup, term.key(), known), term.inverse) : 0;
  term.never_negative = (searched.low >= 0 || term.inverse) && !there;
  term.typical = as_strength(searched.typical, term.inverse);
  term.least = searched.low, term.most = searched.high;
  term.odds = search.odds;
  if (!there)
    for (const auto& [parameter, value] : search.besides)
      term.besides.emplace_back(std::string(record.name) + "." + std::string(parameter), value);
  if (!there) fix_scale_of_release(record, setup, known, term);
  const auto dry = [](const Setup& of) {
    const BoxForces box = physics_of(of).box;
    return box.dry_friction.sum() > 0 || !box.dahl.empty();
  };
  term.dry = !dry(setup) && dry(with_strength(setup, term, term.typical, known));
  return term;
}

/// Adds the term, or one for each value of its shape where the setup does not say it; of what acts on the box
/// none has more than one shape.
void add_shapes(const EffectRecord& record, const Search& search, const MomentumTerm& term,
                std::vector<MomentumTerm>& terms) {
  const std::string key =
      search.shapes.empty() ? "" : std::string(record.name) + "." + std::string(search.shapes[0].parameter);
  const auto is_shape = [&](const auto& beside) { return beside.first == key; };
  if (std::none_of(term.besides.begin(), term.besides.end(), is_shape)) return terms.push_back(term);
  for (const double value : search.shapes[0].values) {
    terms.push_back(term);
    MomentumTerm& shaped = terms.back();
    shaped.shape = key;
    shaped.odds = term.odds / static_cast<double>(search.shapes[0].values.size());
    std::find_if(shaped.besides.begin(), shaped.besides.end(), is_shape)->second = value;
  }
}

}  // namespace

double MomentumTerm::parameter_at(double strength) const {
  const double whole = present + strength;
  if (inverse) return whole > 0 ? std::clamp(1 / std::sqrt(whole), least, most) : most;
  return std::clamp(whole, least, most);
}

bool MomentumTerm::possible(double strength) const {
  const double whole = present + strength;
  if (inverse) return whole > 0 && 1 / std::sqrt(whole) >= least;
  return whole >= least && whole <= most;
}

Setup with_strength(Setup setup, const MomentumTerm& term, double strength, KnownEffects known) {
  for (const auto& [key, value] : term.besides) set_number(setup, key, value, known);
  set_number(setup, term.key(), term.parameter_at(strength), known);
  return setup;
}

std::vector<MomentumTerm> momentum_terms(const Setup& setup, KnownEffects known, bool of_waveform) {
  std::vector<MomentumTerm> terms(1);
  terms[0].effect = terms[0].parameter = "spring.frequency";
  terms[0].kind = TermKind::refit;
  for (const EffectRecord* record : known) {
    const Search search = search_of(*record);
    // A sine is searched by its frequency.
    const bool asked = of_waveform && search.in_waveform;
    if (record->nuisance || (!asked && (search.harmonic || !search.not_searched.empty()))) continue;
    for (const SearchedStrength& searched : search.strengths) {
      // What moves several parameters at once, or replaces a key of the setup, lies inside the contacts.
      if (searched.parameters.find('&') != std::string_view::npos || !searched.absent_key.empty()) continue;
      add_shapes(*record, search, term_of(*record, search, searched, setup, known), terms);
    }
  }
  return terms;
}

ForceSamples samples_of_change(const MomentumRun& a, const MomentumRun& b, double by) {
  const Eigen::Index n = a.time.size();
  ForceSamples s;
  if (n == 0) return s;
  s.momentum = difference(b.box_mass * b.x_box + b.grain_mass * b.x_com,
                          a.box_mass * a.x_box + a.grain_mass * a.x_com, by);
  s.force = difference(a.stiffness * a.x_box - a.model_force, b.stiffness * b.x_box - b.model_force, by);
  s.force_dx = difference(b.model_force_dx - b.stiffness, a.model_force_dx - a.stiffness, by);
  s.force_dv = difference(b.model_force_dv, a.model_force_dv, by);
  s.potential = difference(b.viscous * b.x_box, a.viscous * a.x_box, by);
  s.potential_dx = constant_unless_zero(n, (b.viscous - a.viscous) / by);
  const auto on_box = [](const MomentumRun& run) {
    return run.box_mass + run.grain_mass * (1 - run.com_gain);
  };
  s.inertia_box = constant_unless_zero(n, (on_box(b) - on_box(a)) / by);
  s.inertia_com = constant_unless_zero(n, (b.grain_mass * b.com_gain - a.grain_mass * a.com_gain) / by);
  s.plateau = (b.plateau_gain - a.plateau_gain) / (2 * by);
  return s;
}

ForceSamples spring_samples(const MomentumRun& run) {
  ForceSamples s;
  s.force = -run.stiffness * run.x_box;
  s.stiffness = 1;
  s.force_dx = Eigen::ArrayXd::Constant(run.time.size(), -run.stiffness);
  return s;
}

}  // namespace shakedown
