// SPDX-License-Identifier: MIT
#include "weak_form.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace shakedown {

namespace {

void add_part(Eigen::ArrayXd& part, const Eigen::ArrayXd& added, double strength) {
  if (added.size() == 0) return;
  if (part.size() == 0) part = Eigen::ArrayXd::Zero(added.size());
  part += strength * added;
}

/// Returns the four measured frames next to the frame `place`, which is interpolated, as momentum_run fills
/// it.
Eigen::Vector4d neighbours(const std::vector<char>& filled, Eigen::Index place) {
  Eigen::Vector4d found;
  Eigen::Index at = place;
  for (int j = 1; j >= 0; --j) {
    do --at;
    while (at > 0 && filled[static_cast<std::size_t>(at)]);
    found[j] = static_cast<double>(at);
  }
  at = place;
  for (int j = 2; j < found.size(); ++j) {
    do ++at;
    while (at + 1 < static_cast<Eigen::Index>(filled.size()) && filled[static_cast<std::size_t>(at)]);
    found[j] = static_cast<double>(at);
  }
  return found;
}

/// Holds weights on a stretch of frames that begins at frame `first` of the run.
struct Stretch {
  Eigen::Index first = 0;
  Eigen::VectorXd weight;
};

/// Moves the weight of each interpolated frame to the measured ones that it was made of.
void move_to_measured(const std::vector<char>& filled, Stretch& stretch) {
  for (Eigen::Index i = 0; i < stretch.weight.size(); ++i) {
    if (!filled[static_cast<std::size_t>(stretch.first + i)] || stretch.weight[i] == 0) continue;
    const Eigen::Vector4d places = neighbours(filled, stretch.first + i);
    const Eigen::Vector4d share =
        cubic_weights(places, static_cast<double>(stretch.first + i)) * stretch.weight[i];
    stretch.weight[i] = 0;
    for (int j = 0; j < places.size(); ++j) {
      const Eigen::Index to = static_cast<Eigen::Index>(places[j]) - stretch.first;
      if (to >= 0 && to < stretch.weight.size()) stretch.weight[to] += share[j];
    }
  }
}

/// Returns R w for the noise's covariance matrix R.
Eigen::VectorXd coloured(const NoiseFound& noise, const Eigen::VectorXd& weight) {
  Eigen::VectorXd out = weight;
  for (int lag = 1; lag <= colour_lags; ++lag) {
    const double correlation = noise.correlation[static_cast<std::size_t>(lag - 1)];
    const Eigen::Index n = weight.size() - lag;
    if (correlation == 0 || n <= 0) continue;
    out.head(n) += correlation * weight.tail(n);
    out.tail(n) += correlation * weight.head(n);
  }
  return out * noise.standard_deviation * noise.standard_deviation;
}

/// Returns R w for the covariance matrix R of a wandering track, from where the stretch begins to `reach`
/// frames beyond its end: only windows that begin no earlier are laid over it.
Stretch wandered(const Wander& wander, double interval, const Stretch& stretch, Eigen::Index reach) {
  const double keep = std::exp(-interval / wander.time);
  const Eigen::Index inside = stretch.weight.size(), n = inside + reach;
  Eigen::VectorXd out(n);
  double sum = 0;
  for (Eigen::Index i = 0; i < inside; ++i) out[i] = sum = keep * sum + stretch.weight[i];
  for (Eigen::Index i = inside; i < n; ++i) out[i] = sum = keep * sum;
  sum = 0;
  for (Eigen::Index i = inside - 1; i >= 0; --i) {
    out[i] += sum;
    sum = keep * (sum + stretch.weight[i]);
  }
  return {stretch.first, out * wander.deviation * wander.deviation};
}

double overlap_product(const Stretch& a, const Eigen::VectorXd& b, Eigen::Index b_first) {
  const Eigen::Index begin = std::max(a.first, b_first);
  const Eigen::Index end = std::min(a.first + a.weight.size(), b_first + b.size());
  if (end <= begin) return 0;
  return a.weight.segment(begin - a.first, end - begin).dot(b.segment(begin - b_first, end - begin));
}

}  // namespace

void add_samples(ForceSamples& samples, const ForceSamples& added, double strength) {
  add_part(samples.force, added.force, strength);
  add_part(samples.force_dx, added.force_dx, strength);
  add_part(samples.force_dv, added.force_dv, strength);
  add_part(samples.potential, added.potential, strength);
  add_part(samples.potential_dx, added.potential_dx, strength);
  add_part(samples.momentum, added.momentum, strength);
  add_part(samples.inertia_box, added.inertia_box, strength);
  add_part(samples.inertia_com, added.inertia_com, strength);
  samples.plateau += strength * added.plateau;
  samples.stiffness += strength * added.stiffness;
}

WeakForm::WeakForm(const MomentumRun& run, double length, double hop) : run_(&run) {
  const Eigen::Index half = std::max<Eigen::Index>(4, std::lround(length / (2 * run.interval)));
  const Eigen::Index step = std::max<Eigen::Index>(1, std::lround(hop / run.interval));
  frames_ = 2 * half + 1;
  const Eigen::ArrayXd u = Eigen::ArrayXd::LinSpaced(frames_, -1, 1);
  const Eigen::ArrayXd w = 1 - u.square();
  const double half_length = static_cast<double>(half) * run.interval;
  phi_ = w.pow(5) * run.interval;
  slope_ = -10 * u * w.pow(4) / half_length * run.interval;
  curvature_ = (-10 * w.pow(4) + 80 * u.square() * w.pow(3)) / (half_length * half_length) * run.interval;

  const Eigen::Index n = run.time.size(), margin = smoothing_half_width(run.interval);
  Eigen::Index last_unusable = -margin - 1;
  std::vector<Eigen::Index> next_unusable(static_cast<std::size_t>(n) + 1, n + margin + 1);
  for (Eigen::Index i = n - 1; i >= 0; --i)
    next_unusable[static_cast<std::size_t>(i)] =
        run.usable[static_cast<std::size_t>(i)] ? next_unusable[static_cast<std::size_t>(i + 1)] : i;
  std::vector<double> excursions;
  for (Eigen::Index i = 0, start = 0; start + frames_ <= n; ++start) {
    for (; i < start; ++i)
      if (!run.usable[static_cast<std::size_t>(i)]) last_unusable = i;
    if (start % step != 0 || start - last_unusable <= margin ||
        next_unusable[static_cast<std::size_t>(start)] < start + frames_ + margin)
      continue;
    first_.push_back(start);
    const auto x = run.x_smooth.segment(start, frames_);
    excursions.push_back((x.maxCoeff() - x.minCoeff()) / 2);
  }
  excursion_ = Eigen::Map<Eigen::ArrayXd>(excursions.data(), static_cast<Eigen::Index>(excursions.size()));
}

double WeakForm::centre(Eigen::Index window) const {
  return run_->time[first_[static_cast<std::size_t>(window)] + frames_ / 2];
}

double WeakForm::weight() const { return phi_.sum(); }

void WeakForm::keep(const std::vector<char>& flags) {
  Eigen::Index kept = 0;
  for (std::size_t w = 0; w < first_.size(); ++w) {
    if (!flags[w]) continue;
    first_[static_cast<std::size_t>(kept)] = first_[w];
    excursion_[kept++] = excursion_[static_cast<Eigen::Index>(w)];
  }
  first_.resize(static_cast<std::size_t>(kept));
  excursion_.conservativeResize(kept);
}

Eigen::VectorXd WeakForm::impulse() const {
  const MomentumRun& r = *run_;
  const Eigen::ArrayXd momentum = r.box_mass * r.x_box + r.grain_mass * r.x_com;
  const Eigen::ArrayXd force = r.stiffness * r.x_box - r.model_force;
  Eigen::VectorXd out(windows());
  for (Eigen::Index w = 0; w < windows(); ++w) {
    const Eigen::Index at = first_[static_cast<std::size_t>(w)];
    out[w] = (curvature_ * momentum.segment(at, frames_)).sum() + (phi_ * force.segment(at, frames_)).sum();
    if (r.viscous != 0) out[w] -= r.viscous * (slope_ * r.x_box.segment(at, frames_)).sum();
  }
  return out;
}

Eigen::VectorXd WeakForm::column(const ForceSamples& samples) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(windows());
  for (Eigen::Index w = 0; w < windows(); ++w) {
    const Eigen::Index at = first_[static_cast<std::size_t>(w)];
    if (samples.force.size()) out[w] += (phi_ * samples.force.segment(at, frames_)).sum();
    if (samples.potential.size()) out[w] += (slope_ * samples.potential.segment(at, frames_)).sum();
    if (samples.momentum.size()) out[w] -= (curvature_ * samples.momentum.segment(at, frames_)).sum();
  }
  return out;
}

Eigen::MatrixXd WeakForm::node_columns(const Eigen::ArrayXd& place, const Eigen::ArrayXd& factor,
                                       Eigen::Index nodes, bool is_potential) const {
  const Eigen::ArrayXd& weight = is_potential ? slope_ : phi_;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(windows(), nodes);
  for (Eigen::Index w = 0; w < windows(); ++w) {
    const Eigen::Index at = first_[static_cast<std::size_t>(w)];
    for (Eigen::Index i = 0; i < frames_; ++i) {
      const auto node = static_cast<Eigen::Index>(place[at + i]);
      const double share = place[at + i] - static_cast<double>(node), value = weight[i] * factor[at + i];
      out(w, node) += (1 - share) * value;
      out(w, node + 1) += share * value;
    }
  }
  return out;
}

Eigen::MatrixXd WeakForm::harmonic(double frequency) const {
  // phi is even, so Int phi cos(w (t - centre)) is all there is: each window is a rotation of it.
  const double angular = 2 * std::numbers::pi * frequency;
  const Eigen::ArrayXd offset = Eigen::ArrayXd::LinSpaced(frames_, -static_cast<double>(frames_ / 2),
                                                          static_cast<double>(frames_ / 2)) *
                                run_->interval;
  const double transform = (phi_ * (angular * offset).cos()).sum();
  Eigen::MatrixXd out(windows(), 2);
  for (Eigen::Index w = 0; w < windows(); ++w)
    out.row(w) << transform * std::sin(angular * centre(w)), transform * std::cos(angular * centre(w));
  return out;
}

Eigen::MatrixXd WeakForm::covariance(const ForceSamples& fitted, const Wander& wander) const {
  const MomentumRun& r = *run_;
  const bool has_grains = r.grain_mass > 0;
  const Eigen::Index half = smoothing_half_width(r.interval), margin = half + 4, n = r.time.size();
  const LocalCubic cubic = local_cubic(static_cast<int>(half));
  const double com_mass = r.grain_mass * r.com_gain, box_mass = r.box_mass + r.grain_mass * (1 - r.com_gain);
  std::vector<Stretch> box(first_.size()), com(first_.size());
  for (std::size_t w = 0; w < first_.size(); ++w) {
    const Eigen::Index at = first_[w];
    Eigen::ArrayXd direct = box_mass * curvature_ + r.stiffness * phi_ - r.viscous * slope_;  // on x_box
    Eigen::ArrayXd on_com = com_mass * curvature_;
    direct -= phi_ * r.model_force_dx.segment(at, frames_);
    if (fitted.force_dx.size()) direct -= phi_ * fitted.force_dx.segment(at, frames_);
    if (fitted.potential_dx.size()) direct -= slope_ * fitted.potential_dx.segment(at, frames_);
    Eigen::ArrayXd through_v = phi_ * r.model_force_dv.segment(at, frames_);  // on smoothed v_box
    if (fitted.force_dv.size()) add_part(through_v, phi_ * fitted.force_dv.segment(at, frames_), 1);
    if (fitted.inertia_box.size()) direct += curvature_ * fitted.inertia_box.segment(at, frames_);
    if (fitted.inertia_com.size()) on_com += curvature_ * fitted.inertia_com.segment(at, frames_);
    const Eigen::Index begin = std::max<Eigen::Index>(0, at - margin),
                       end = std::min(n, at + frames_ + margin);
    box[w] = {begin, Eigen::VectorXd::Zero(end - begin)};
    com[w] = box[w];
    box[w].weight.segment(at - begin, frames_) = direct.matrix();
    com[w].weight.segment(at - begin, frames_) = on_com.matrix();
    if ((through_v != 0).any())
      for (Eigen::Index i = 0; i < frames_; ++i)
        for (Eigen::Index j = -half; j <= half; ++j) {
          const Eigen::Index to = at + i + j - begin;
          if (to >= 0 && to < end - begin)
            box[w].weight[to] -= cubic.slope[j + half] / r.interval * through_v[i];
        }
    move_to_measured(r.box_filled, box[w]);
    move_to_measured(r.com_filled, com[w]);
  }
  // Cut where exp(-8) of the track's covariance is left, so that the matrix stays positive.
  const Eigen::Index reach =
      wander.deviation > 0 ? static_cast<Eigen::Index>(std::lround(8 * wander.time / r.interval)) : 0;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(windows(), windows());
  for (std::size_t w = 0; w < first_.size(); ++w) {
    const Stretch box_side{box[w].first, coloured(r.box_noise, box[w].weight)};
    const Stretch com_side{com[w].first, coloured(r.com_noise, com[w].weight)};
    Stretch box_wander, com_wander;
    if (reach > 0) box_wander = wandered(wander, r.interval, box[w], reach);
    if (reach > 0 && has_grains) com_wander = wandered(wander, r.interval, com[w], reach);
    for (std::size_t o = w; o < first_.size() && first_[o] < first_[w] + frames_ + 2 * margin + reach; ++o) {
      double sum = overlap_product(box[o], box_side.weight, box_side.first);
      if (has_grains) sum += overlap_product(com[o], com_side.weight, com_side.first);
      if (reach > 0) sum += overlap_product(box[o], box_wander.weight, box_wander.first);
      if (reach > 0 && has_grains) sum += overlap_product(com[o], com_wander.weight, com_wander.first);
      out(static_cast<Eigen::Index>(w), static_cast<Eigen::Index>(o)) = sum;
      out(static_cast<Eigen::Index>(o), static_cast<Eigen::Index>(w)) = sum;
    }
  }
  return out;
}

}  // namespace shakedown
