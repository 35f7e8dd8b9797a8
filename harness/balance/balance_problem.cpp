// SPDX-License-Identifier: MIT
#include "balance_problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "camera.hpp"
#include "effect_strength.hpp"
#include "nuisance.hpp"
#include "setup_file.hpp"

namespace shakedown {

namespace {

/// Splits "camera_origin.origin of L040" into the key and the run whose own it is (empty: everyone's).
std::pair<std::string, std::string> key_and_run(const std::string& name) {
  constexpr std::string_view of = " of ";
  const std::size_t at = name.find(of);
  if (at == std::string::npos) return {name, ""};
  return {name.substr(0, at), name.substr(at + of.size())};
}

}  // namespace

namespace {

/// Returns the value within the bounds of its key, because a linear estimate may ask for more than there can
/// be.
double within_bounds(double value, const std::string& key, KnownEffects known) {
  const Parameter* parameter = known.find_parameter(key);
  return parameter == nullptr ? value : std::clamp(value, parameter->low, parameter->high);
}

}  // namespace

bool scales_all_lengths(KnownEffects known, const std::string& key) {
  const std::optional<CameraParameter> parameter = find_camera_parameter(known, key);
  if (!parameter || parameter->inverse_square) return false;
  const Recording sample{{0, 1, 2, 3, 4, 5}, {1, -3, 2, -1, 4, -2}, {2, -2, 3, 1, -1, -3}};
  const Recording change = derivative(sample, *parameter);
  const double share = change.x_box[0] / sample.x_box[0];
  constexpr double rounding = 1e-9;
  for (std::size_t i = 0; i < sample.time.size(); ++i)
    if (!(std::abs(change.x_box[i] - share * sample.x_box[i]) < rounding &&
          std::abs(change.x_com[i] - share * sample.x_com[i]) < rounding))
      return false;
  return share != 0;
}

Measurement read_with(const Measurement& measurement, const NuisanceValues& values, KnownEffects known) {
  Measurement read = measurement;
  for (const auto& [name, value] : values) {
    const auto [key, of_run] = key_and_run(name);
    for (Measurement::Run& run : read.runs)
      if (of_run.empty() || run.recorded.name == of_run)
        set_number(run.setup, key, within_bounds(get_number(run.setup, key, known) + value, key, known),
                   known);
  }
  return read;
}

BalanceProblem::BalanceProblem(const Measurement& measurement, KnownEffects known, NuisanceValues already,
                               const std::vector<std::string>& only)
    : measurement_(measurement), known_(known), already_(std::move(already)) {
  for (const Measurement::Run& run : measurement.runs) {
    runs_.push_back(momentum_run(run));
  }
  if (measurement.runs.empty()) return;
  const Setup& first = measurement.runs.front().setup;
  frequency_ = first.spring.frequency;
  seen_ = momentum_terms(first, known);
  const std::vector<std::string> exact = exactly_known(measurement, known);
  const auto possible = [&](const std::string& effect) {
    return std::find(exact.begin(), exact.end(), effect) == exact.end() &&
           (only.empty() || std::find(only.begin(), only.end(), effect) != only.end());
  };
  for (const MomentumTerm& term : seen_)
    if (term.kind == TermKind::refit || (possible(term.effect) && !scales_all_lengths(known, term.key())))
      terms_.push_back(term);
  for (const EffectRecord* record : known.oscillating())
    if (possible(std::string(record->name)) && !find_choice(first, record->name))
      typical_sine_ = search_of(*record).strengths.front().typical;
}

double BalanceProblem::noise() const {
  double noise = 0;
  for (const MomentumRun& run : runs_) noise = std::max(noise, run.box_noise.standard_deviation);
  return noise;
}

/// Returns the run with another setup. Most change no camera.
MomentumRun BalanceProblem::run_with(std::size_t run, Setup setup) const {
  const Measurement::Run& measured = measurement_.runs[run];
  const bool same_camera = physics_of(setup).camera == physics_of(measured.setup).camera;
  if (same_camera) return with_forces_of(setup, runs_[run]);
  return momentum_run({measured.recorded, measured.audit, std::move(setup)});
}

std::vector<ForceSamples> BalanceProblem::samples_of(const MomentumTerm& term, double strength) const {
  std::vector<ForceSamples> samples;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const Measurement::Run& run = measurement_.runs[r];
    if (runs_[r].time.size() == 0)
      samples.emplace_back();
    else if (term.kind == TermKind::refit)
      samples.push_back(spring_samples(runs_[r]));
    else
      samples.push_back(samples_of_change(
          runs_[r], run_with(r, with_strength(run.setup, term, strength, known_)), strength));
  }
  return samples;
}

/// Adds what is said of the one camera, or of each run's own.
void BalanceProblem::add_camera(std::vector<BalanceNuisance>& list) const {
  for (const CameraNuisance& camera : camera_nuisances(measurement_, known_)) {
    // A scale of all lengths scales the whole balance, and would take up whatever is there.
    if (scales_all_lengths(known_, camera.key)) continue;
    const auto term = std::find_if(seen_.begin(), seen_.end(),
                                   [&](const MomentumTerm& t) { return t.key() == camera.key; });
    if (term == seen_.end()) continue;
    const std::vector<ForceSamples> samples = samples_of(*term, term->typical);
    if (!camera.each_run) {
      list.push_back({camera.key, camera.unit, camera.deviation(), samples});
      continue;
    }
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      if (!(camera.deviation_of[r] > 0)) continue;
      std::vector<ForceSamples> of_run(runs_.size());
      of_run[r] = samples[r];
      list.push_back(
          {camera.key + " of " + runs_[r].name, camera.unit, camera.deviation_of[r], std::move(of_run)});
    }
  }
}

void BalanceProblem::add_weights(std::vector<BalanceNuisance>& list) const {
  for (const WeighedNuisance& weight : weighed_nuisances(measurement_)) {
    BalanceNuisance nuisance{
        weight.of_one_run ? weight.key + " of " + runs_[weight.runs.front()].name : weight.key, weight.unit,
        weight.deviation, std::vector<ForceSamples>(runs_.size())};
    for (const std::size_t r : weight.runs) {
      const Measurement::Run& run = measurement_.runs[r];
      Setup changed = run.setup;
      set_number(changed, weight.key, get_number(run.setup, weight.key, known_) + weight.deviation, known_);
      nuisance.samples[r] = samples_of_change(runs_[r], run_with(r, std::move(changed)), weight.deviation);
    }
    list.push_back(std::move(nuisance));
  }
}

std::vector<BalanceNuisance> BalanceProblem::nuisances() const {
  std::vector<BalanceNuisance> list;
  add_camera(list);
  add_weights(list);
  for (BalanceNuisance& nuisance : list)
    if (const auto found = already_.find(nuisance.name); found != already_.end())
      nuisance.already = found->second;
  // What leaves no trace in any run costs a row and tells nothing.
  std::erase_if(list, [](const BalanceNuisance& nuisance) {
    return std::all_of(nuisance.samples.begin(), nuisance.samples.end(), [](const ForceSamples& s) {
      return s.force.size() == 0 && s.momentum.size() == 0 && s.potential.size() == 0;
    });
  });
  return list;
}

SelectionProblem BalanceProblem::windows_of(double length, double hop) const {
  // Above 1.2/T a window averages a sine away to less than half.
  SelectionProblem p{
      MomentumProblem(runs_, length, hop), terms_, {}, &runs_, 1.2 / length, typical_sine_, {}};
  for (const MomentumTerm& term : terms_)
    p.terms.push_back({term.effect, term.never_negative, samples_of(term, term.typical), nullptr, {}});
  p.derive = [this](const MomentumTerm& term, double strength) { return samples_of(term, strength); };
  p.problem.set_plateau(measurement_.plateau, runs_.empty() ? 1 : runs_.front().plateau_gain);
  p.problem.set_nuisances(nuisances());
  if (const auto frequency = known_frequency(measurement_)) {
    // The spring's column is the relative change of its stiffness, as f^2.
    constexpr double exact = 1e-7;
    p.problem.set_spring(std::pow(frequency->value / frequency_, 2) - 1,
                         std::max(2 * frequency->error / frequency->value, exact));
  }
  return p;
}

}  // namespace shakedown
