// SPDX-License-Identifier: MIT
#include "faulty_parts.hpp"

#include <algorithm>

namespace shakedown {

namespace {

class MirroredRestitution : public Engine {
 public:
  MirroredRestitution(const Engine& engine, double believed) : engine_(engine), believed_(believed) {}

  std::string_view name() const override { return engine_.name(); }
  Capability can_model(const EffectRecord& effect) const override { return engine_.can_model(effect); }
  Trajectory run(const Setup& setup, const RunOptions& options) const override {
    Setup mirrored = setup;
    double& restitution = mirrored.restitution.grain_grain;
    restitution = std::clamp(2 * believed_ - restitution, 0.01, 1.0);
    return engine_.run(mirrored, options);
  }

 private:
  const Engine& engine_;
  double believed_;
};

void lose_the_centre(Experiment& experiment) {
  for (MeasuredRun& run : experiment.runs) run.x_com.clear();
}

std::vector<double> averaged(const std::vector<double>& positions) {
  constexpr std::size_t half = 12;  // 50 ms at 500 frames a second: landings are smeared, noise looks small
  std::vector<double> smooth = positions;
  for (std::size_t i = half; i + half < positions.size(); ++i) {
    double sum = 0;
    for (std::size_t j = i - half; j <= i + half; ++j) sum += positions[j];
    smooth[i] = sum / (2 * half + 1);
  }
  return smooth;
}

void smooth_the_tracks(Experiment& experiment) {
  for (MeasuredRun& run : experiment.runs) {
    run.x_box = averaged(run.x_box);
    run.x_com = averaged(run.x_com);
  }
}

}  // namespace

std::unique_ptr<Engine> with_mirrored_restitution(const Engine& engine, double believed) {
  return std::make_unique<MirroredRestitution>(engine, believed);
}

FaultyParts::FaultyParts(std::string_view fault, const Setup& believed, TrialTools& tools) {
  if (fault == "no-refit")
    tools.fixed = {"restitution.grain_grain", "restitution.grain_wall", "spring.frequency"};
  if (fault == "no-centre") tools.damage = lose_the_centre;
  if (fault == "smoothed") tools.damage = smooth_the_tracks;
  if (fault != "wrong-sign") return;
  engine_ = with_mirrored_restitution(*tools.model, believed.restitution.grain_grain);
  tools.model = engine_.get();
}

}  // namespace shakedown
