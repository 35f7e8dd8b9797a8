// SPDX-License-Identifier: MIT
// A shaker, a motor or a hand that moves the far end of the spring, as it was recorded.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "physics.hpp"

namespace shakedown::effect {

namespace {

/// The base as it was recorded: between its places the cubic of their four neighbours, beyond them at rest.
class BaseMotion {
 public:
  explicit BaseMotion(const std::string& samples) : problem_(read(samples)) {}

  const std::string& problem() const { return problem_; }

  /// Returns the place of the base at time t (s of the recording), m.
  double at(double t) const {
    if (t <= time_.front()) return place_.front();
    if (t >= time_.back()) return place_.back();
    const auto after =
        static_cast<std::size_t>(std::upper_bound(time_.begin(), time_.end(), t) - time_.begin());
    const std::size_t i = after - 1;
    const double h = time_[after] - time_[i], u = (t - time_[i]) / h, w = 1 - u;
    return w * w * (1 + 2 * u) * place_[i] + u * u * (3 - 2 * u) * place_[after] +
           h * u * w * (w * speed(i) - u * speed(after));
  }

 private:
  /// Reads "time place, time place, ..." and returns what is wrong with it; empty: nothing.
  std::string read(const std::string& samples) {
    const char *at = samples.data(), *end = at + samples.size();
    while (at != end) {
      if (*at == ' ' || *at == ',') {
        ++at;
        continue;
      }
      double value = 0;
      const auto [next, error] = std::from_chars(at, end, value);
      if (error != std::errc() || !std::isfinite(value)) return "holds something that is no number";
      (time_.size() == place_.size() ? time_ : place_).push_back(value);
      at = next;
    }
    if (time_.size() != place_.size()) return "has a time without a place";
    if (time_.size() < 2) return "holds fewer than two places";
    const bool forwards =
        std::adjacent_find(time_.begin(), time_.end(), std::greater_equal<>()) == time_.end();
    return forwards ? "" : "has a clock that does not run forwards";
  }
  /// Returns the speed of the parabola through a place and its neighbours, m/s; 0 at the ends.
  double speed(std::size_t i) const {
    if (i == 0 || i + 1 == time_.size()) return 0;
    const double before = time_[i] - time_[i - 1], after = time_[i + 1] - time_[i];
    return ((place_[i] - place_[i - 1]) / before * after + (place_[i + 1] - place_[i]) / after * before) /
           (before + after);
  }

  std::vector<double> time_, place_;
  std::string problem_;
};

/// Returns the motion that a text says, and keeps the last sixteen: a fit asks for the same one thousands of
/// times, and reading it costs more than a period of the box.
std::shared_ptr<const BaseMotion> motion_of(const std::string& samples) {
  static std::mutex one_at_a_time;
  static std::vector<std::pair<std::string, std::shared_ptr<const BaseMotion>>> read;
  constexpr std::size_t most_kept = 16;
  const std::lock_guard lock(one_at_a_time);
  for (const auto& [text, motion] : read)
    if (text == samples) return motion;
  if (read.size() == most_kept) read.erase(read.begin());
  read.emplace_back(samples, std::make_shared<const BaseMotion>(samples));
  return read.back().second;
}

std::vector<ParameterProblem> check_samples(const EffectChoice& choice) {
  const std::string problem = motion_of(choice.text("samples"))->problem();
  if (problem.empty()) return {};
  return {
      {"samples", problem, "write times in s and places in m in turn, e.g. \"0 0 0.02 1.5e-4 0.04 3e-4\""}};
}

/// Adds what the spring does more because its far end is not at zero.
void apply_base_motion(const EffectChoice& choice, int index, Physics& physics) {
  const std::shared_ptr<const BaseMotion> motion = motion_of(choice.text("samples"));
  const double start = choice.number("start"), stiffness = physics.stiffness, cubic = physics.spring_cubic;
  const auto spring = [=](double stretch) { return -stiffness * stretch * (1 + cubic * stretch * stretch); };
  physics.box.free.push_back(
      {[=](double x, double, double t) { return spring(x - motion->at(t + start)) - spring(x); }, index});
}

}  // namespace

extern const EffectRecord base_motion{
    .name = "base_motion",
    .label = "recorded motion of the spring's base",
    .acts_on = ActsOn::box,
    .sentence = "The far end of the spring moves as it was recorded: a driven damper.",
    .formula = "the spring pulls by x - b(t) instead of x",
    .source = "J. P. Den Hartog, Mechanical Vibrations (4th ed., 1956), section 2.6, motion of the support",
    .limits =
        "Damping and friction act against the laboratory, as of air or water, not against the base. Between "
        "samples b is a cubic (twenty samples a period: 2e-4 of its amplitude); before the first and after "
        "the "
        "last it rests.",
    .parameters = {{.name = "samples",
                    .kind = ParameterKind::text,
                    .default_value = std::string("0 0 1 0"),
                    .required = true,
                    .sentence =
                        "Times in s and places in m in turn; an experiment file fills them in from the "
                        "column base_position.",
                    .example = "\"0 0 0.25 1e-3 0.5 0 0.75 -1e-3 1 0\""},
                   {.name = "start",
                    .unit = "s",
                    .default_value = 0.0,
                    .low = -1e6,
                    .high = 1e6,
                    .sentence = "What the clock of the samples shows at release."}},
    .engines = {{"hard",
                 {Fidelity::to_stated_error,
                  "motion dense to 1e-13 of the release displacement where b is smooth"}},
                {"soft",
                 {Fidelity::to_stated_error, "second order in the time step; the ledger closes to 1e-9"}}},
    .search = {.not_searched = "It is recorded, not looked for."},
    .nuisance = true,
    .apply = &apply_base_motion,
    .applied_last = true,
    .check = &check_samples};

}  // namespace shakedown::effect
