// SPDX-License-Identifier: MIT
#include "waveform_residuals.hpp"

#include <algorithm>
#include <cmath>

#include "camera.hpp"
#include "in_order.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"
#include "swing_motion.hpp"

namespace shakedown {

namespace {

double as_parameter(const MomentumTerm& term, double strength) {
  const double whole = term.present + strength;
  if (!term.inverse) return whole;
  return whole > 0 ? std::max(term.least, 1 / std::sqrt(whole)) : term.most;
}

/// Sets a number of an effect that the setup has, whatever its bounds: a search may pass through what cannot
/// be.
void put(const std::string& key, double value, Setup& setup) {
  const std::size_t dot = key.find('.');
  const std::string_view effect = std::string_view(key).substr(0, dot);
  const std::string_view parameter = std::string_view(key).substr(dot + 1);
  const std::size_t component = parameter.find('.');
  for (EffectChoice& choice : setup.effects) {
    if (choice.record->name != effect) continue;
    ParameterValue& place = choice.values.find(parameter.substr(0, component))->second;
    if (component == std::string_view::npos)
      place = value;
    else
      std::get<Vec3>(place)[parameter.back() - 'x'] = value;
    return;
  }
}

}  // namespace

Eigen::Index count_of(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws) {
  Eigen::Index count = 3 * std::ssize(runs) + 1;
  for (const WaveformLaw& law : laws) count += law.width();
  return count;
}

Setup prepared(Setup setup, const std::vector<WaveformLaw>& laws, KnownEffects known) {
  for (const WaveformLaw& law : laws) {
    for (const std::string& key : law.keys) set_number(setup, key, law.term.parameter_at(0), known);
    if (law.keys.empty()) setup = with_strength(std::move(setup), law.term, law.term.typical, known);
  }
  return setup;
}

namespace {

/// Sets the keys of one law, which the setup has, from its values.
void put(const WaveformLaw& law, const double* value, Setup& setup) {
  for (const std::string& key : law.keys) {
    if (find_setup_key(key) != nullptr)
      set_number(setup, key, law.term.parameter_at(value[0]), {});
    else
      put(key, as_parameter(law.term, value[0]), setup);
  }
  if (!law.keys.empty()) return;
  if (!law.is_mode) return put(law.term.key(), as_parameter(law.term, value[0]), setup);
  put(law.term.key(), std::hypot(value[0], value[1]), setup);
  put(law.phase_key, std::atan2(value[1], value[0]), setup);
  put(law.frequency_key, value[2], setup);
  if (!law.rate_key.empty()) put(law.rate_key, value[3], setup);
}

}  // namespace

void put(Eigen::Index runs, const std::vector<WaveformLaw>& laws, const Eigen::VectorXd& value,
         Setup& setup) {
  setup.spring.frequency = value[3 * runs];
  Eigen::Index next = 3 * runs + 1;
  for (const WaveformLaw& law : laws) {
    put(law, value.data() + next, setup);
    next += law.width();
  }
}

Residuals::Residuals(const std::vector<WaveformRun>& runs, const std::vector<WaveformLaw>& laws,
                     const WaveformOptions& options)
    : runs_(runs), laws_(laws), options_(options) {
  for (const WaveformRun& run : runs) {
    const double end = run.time.front() + options.until;
    used_.push_back(std::upper_bound(run.time.begin(), run.time.end(), end) - run.time.begin());
    frames_ += used_.back();
  }
  inputs_ = count_of(runs, laws);
  for (const WaveformRun& run : runs) setups_.push_back(prepared(run.setup, laws, options.known));
}

namespace {
/// Step of the scaled numbers for a derivative.
constexpr double small_step = 1e-4;
}  // namespace

int Residuals::df(const Eigen::VectorXd& scaled, Eigen::MatrixXd& slope) const {
  Eigen::VectorXd here(values());
  at(value_of(scaled), here);
  work_in_parallel_deliver_in_order(static_cast<int>(inputs_), options_.threads,
                                    [&](int k) -> std::function<void()> {
                                      if (scale_[k] == 0) {
                                        slope.col(k).setZero();
                                        return [] {};
                                      }
                                      Eigen::VectorXd moved = scaled;
                                      moved[k] += small_step;
                                      const Eigen::Index run = k < 3 * std::ssize(runs_) ? k / 3 : -1;
                                      Eigen::VectorXd there = here;
                                      at(value_of(moved), there, run);
                                      slope.col(k) = (there - here) / small_step;
                                      return [] {};
                                    });
  return 0;
}

bool Residuals::at(const Eigen::VectorXd& value, Eigen::VectorXd& out, Eigen::Index only) const {
  Eigen::Index row = 0;
  bool possible = true;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const Eigen::Index n = used_[r];
    if (only < 0 || only == static_cast<Eigen::Index>(r)) possible &= of_run(r, value, out.segment(row, n));
    row += n;
  }
  if (believes() > 0)
    out[row] = (value[3 * std::ssize(runs_)] - options_.believed_frequency) / options_.believed_error;
  return possible;
}

void Residuals::start_from(const Eigen::VectorXd& start) {
  start_ = start;
  scale_ = Eigen::VectorXd::Zero(inputs_);
  const Eigen::Index shared = 3 * std::ssize(runs_);
  double longest = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const double a = runs_[r].amplitude;
    scale_.segment(3 * static_cast<Eigen::Index>(r), 3) << a, a * two_pi * start[shared], a;
    const auto last = static_cast<std::size_t>(std::max<Eigen::Index>(1, used_[r])) - 1;
    longest = std::max(longest, runs_[r].time[last] - runs_[r].time.front());
  }
  if (options_.free_frequency) scale_[shared] = 1 / (two_pi * std::max(longest, 1 / start[shared]));
  Eigen::VectorXd here(values());
  at(start, here);
  Eigen::Index next = shared + 1;
  for (const WaveformLaw& law : laws_)
    for (Eigen::Index i = 0; i < law.width(); ++i, ++next)
      scale_[next] = scale_of_number(next, law.is_mode && i >= 2 ? 1e-3 / longest : 1e-3 * law.term.typical,
                                     start, here);
}

double Residuals::scale_of_number(Eigen::Index number, double step, const Eigen::VectorXd& start,
                                  const Eigen::VectorXd& here) const {
  Eigen::VectorXd moved = start, there(values());
  moved[number] += step;
  at(moved, there);
  const double change = (there - here).norm();
  return change > 0 ? std::min(step * root_of_sum_of_squares() / change, 1e6 * step) : 0;
}

Eigen::VectorXd Residuals::slope_of_last_law(const Eigen::VectorXd& value,
                                             const Eigen::VectorXd& here) const {
  const Eigen::Index last = value.size() - 1;
  const double scale = scale_of_number(last, 1e-3 * laws_.back().term.typical, value, here);
  Eigen::VectorXd moved = value, there(values());
  moved[last] += small_step * scale;
  at(moved, there);
  return scale > 0 ? Eigen::VectorXd((there - here) / small_step) : Eigen::VectorXd::Zero(values());
}

double Residuals::root_of_sum_of_squares() const {
  double sum = 0;
  for (std::size_t r = 0; r < runs_.size(); ++r)
    sum += static_cast<double>(used_[r]) * std::pow(runs_[r].amplitude / runs_[r].noise, 2) / 4;
  return std::sqrt(sum);
}

bool Residuals::of_run(std::size_t r, const Eigen::VectorXd& value, Eigen::Ref<Eigen::VectorXd> out) const {
  const WaveformRun& run = runs_[r];
  const Eigen::Index first = 3 * static_cast<Eigen::Index>(r);
  std::vector<double> time{run.start_time()};
  time.insert(time.end(), run.time.begin(), run.time.begin() + used_[r]);
  constexpr double too_far = 10;  // amplitudes: the box has run away
  const double frequency = value[3 * std::ssize(runs_)];
  std::vector<double> x;
  Physics physics;
  if (frequency > 0) {
    Setup setup = setups_[r];
    put(std::ssize(runs_), laws_, value, setup);
    physics = physics_of(setup);
    x = swing_of(physics, {value[first], value[first + 1]}, time, too_far * run.amplitude);
  }
  if (x.empty()) {
    out.setConstant(too_far * run.amplitude / run.noise);
    return false;
  }
  if (!(physics.camera == Camera{})) x = seen_through(physics.camera, {time, std::move(x), {}}).x_box;
  for (Eigen::Index i = 0; i < used_[r]; ++i)
    out[i] = (run.x[static_cast<std::size_t>(i)] - value[first + 2] - x[static_cast<std::size_t>(i) + 1]) /
             run.noise;
  return out.allFinite();
}

}  // namespace shakedown
