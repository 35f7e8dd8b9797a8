// SPDX-License-Identifier: MIT
#include "encounters.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace shakedown::apart {

namespace {

/// A solid sphere answers a push at its surface as a body of this part of its mass.
constexpr double surface_share = 2.0 / 7;

Vec3 velocity_of(const State& state, int body) {
  return body < 0 ? Vec3(state.v_box, 0, 0) : state.velocity[static_cast<std::size_t>(body)];
}
Vec3 spin_of(const State& state, int body) {
  return body < 0 ? Vec3(Vec3::Zero()) : state.spin[static_cast<std::size_t>(body)];
}

}  // namespace

Encounters::Encounters(const Model& model, const State& state, double step)
    : model_(model),
      step_(step),
      skin_(state.size() > 0 ? 0.4 * state.radius.front() : 0.0),
      wandered_(std::numeric_limits<double>::infinity()),
      walls_(6 * state.size()),
      random_(model.seed) {}

/// Looks at all pairs, seldom: a list is good until the two fastest grains could have met from beyond it.
void Encounters::list_pairs(const State& state) {
  if (2 * wandered_ < skin_) return;
  wandered_ = 0;
  std::vector<Pair> listed;
  auto old = pairs_.begin();
  const int grains = static_cast<int>(state.size());
  for (int i = 0; i < grains; ++i)
    for (int j = i + 1; j < grains; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const double range = state.radius[a] + state.radius[b] + model_.reach + skin_;
      if ((state.position[a] - state.position[b]).squaredNorm() > range * range) continue;
      while (old != pairs_.end() && std::pair(old->i, old->j) < std::pair(i, j)) ++old;
      const bool known = old != pairs_.end() && old->i == i && old->j == j;
      listed.push_back({i, j, known ? old->memory : Memory{}});
    }
  pairs_ = std::move(listed);
}

const std::vector<Push>& Encounters::forces(const State& state) {
  pushes_.clear();
  stored_.fill(0);
  list_pairs(state);
  for (Pair& pair : pairs_) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    const Vec3 apart = state.position[i] - state.position[j];
    // A well is entered and left within a step: two millimetres a step are 100 m/s.
    const double touch = state.radius[i] + state.radius[j], near = touch + model_.reach * 1.5 + skin_ / 4;
    const double squared = apart.squaredNorm();
    if (squared > near * near) {
      pair.memory = Memory{};
      continue;
    }
    const double distance = std::sqrt(squared),
                 reduced = state.mass[i] * state.mass[j] / (state.mass[i] + state.mass[j]);
    meet(state,
         {pair.i, pair.j, ContactClass::grain_grain, apart / distance, touch - distance, reduced,
          surface_share * reduced},
         pair.memory);
  }
  at_walls(state);
  return pushes_;
}

void Encounters::at_walls(const State& state) {
  for (std::size_t i = 0; i < state.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const double offset = state.position[i](axis) - (axis == 0 ? state.x_box : 0.0),
                   room = model_.half(axis) - state.radius[i];
      const double near = model_.reach * 1.5 + skin_ / 4;
      for (const int side : {-1, 1}) {
        Memory& memory = walls_[6 * i + static_cast<std::size_t>(2 * axis + (side > 0 ? 1 : 0))];
        const double overlap = side * offset - room;
        if (overlap < -near) {
          if (memory.pressed || memory.begun != 0) memory = Memory{};
          continue;
        }
        Vec3 normal = Vec3::Zero();
        normal(axis) = -side;
        const double m = state.mass[i];
        const bool moves = axis == 0 && !model_.held;
        meet(state,
             {static_cast<int>(i), -1, axis == 0 ? ContactClass::end_wall : ContactClass::side_wall, normal,
              overlap, moves ? m * model_.box_mass / (m + model_.box_mass) : m, surface_share * m},
             memory);
      }
    }
}

void Encounters::meet(const State& state, const Meeting& meeting, Memory& memory) {
  const Vec3 relative = velocity_of(state, meeting.i) - velocity_of(state, meeting.j);
  const double rate = -relative.dot(meeting.normal);
  const auto kind = static_cast<std::size_t>(meeting.kind);
  memory.stored = 0;
  const double pressed = press(meeting, rate, memory), pulled = pull(meeting, rate, memory);
  const double radius = state.radius[static_cast<std::size_t>(meeting.i)];
  const double arm_i = radius - (meeting.j < 0 ? 1.0 : 0.5) * std::max(meeting.overlap, 0.0);
  const double arm_j =
      meeting.j < 0 ? 0.0
                    : state.radius[static_cast<std::size_t>(meeting.j)] - std::max(meeting.overlap, 0.0) / 2;
  Vec3 newton = (pressed - pulled) * meeting.normal;
  if (pressed > 0 && model_.friction[kind] > 0) {
    const Vec3 turning = arm_i * spin_of(state, meeting.i) + arm_j * spin_of(state, meeting.j);
    const Vec3 slip = relative + rate * meeting.normal - turning.cross(meeting.normal);
    newton += rub(meeting, slip, pressed, rate, memory);
  }
  stored_[kind] += memory.stored;
  if (pressed != 0 || pulled != 0)
    pushes_.push_back({meeting.i, meeting.j, meeting.kind, newton, meeting.normal, arm_i, arm_j});
}

void Encounters::begin(const Meeting& meeting, double rate, Memory& memory) {
  const auto kind = static_cast<std::size_t>(meeting.kind);
  const double speed = std::max(rate, 0.0);
  memory.pressed = true;
  memory.deepest = 0;
  memory.spring = LatchingSpring::of(model_.restitution[kind].at(speed, random_), meeting.reduced_mass,
                                     model_.contact_time);
  const double frequency = std::numbers::pi / model_.contact_time;
  memory.slip_stiffness = meeting.slip_mass * frequency * frequency;
  memory.stretch.setZero();
  ++touches_[kind];
}

/// Returns the normal force of the contact, N. An impact is over where its force is: what follows is another
/// one, with a restitution of its own, and its overlap counts from there. So a layer that is pressed loses in
/// each of its small impacts, as hard spheres do, and not in the first one alone.
double Encounters::press(const Meeting& meeting, double rate, Memory& memory) {
  deepest_ = std::max(deepest_, meeting.overlap);
  if (meeting.overlap <= 0) {
    memory.pressed = false;
    memory.begun = 0;
    return 0;
  }
  if (!memory.pressed) {
    memory.begun = std::min(memory.begun, meeting.overlap);
    if (rate <= 0) return 0;
    begin(meeting, rate, memory);
  }
  const double overlap = meeting.overlap - memory.begun;
  memory.deepest = std::max(memory.deepest, overlap);
  const double newton = memory.spring.force(overlap, memory.deepest);
  if (newton == 0 && rate < 0) {
    memory.pressed = false;
    memory.begun = meeting.overlap;
  }
  memory.stored += memory.spring.stored(newton);
  return newton;
}

/// Returns the mean attraction over the step, N: the change of the well's energy over that of the gap. A step
/// that crosses the edge takes its share.
double Encounters::pull(const Meeting& meeting, double rate, Memory& memory) const {
  const double strength = meeting.j < 0 ? model_.pull_of_walls : model_.pull;
  if (!(strength > 0)) return 0;
  const double gap = -meeting.overlap, half = std::abs(rate) * step_ / 2;
  memory.stored -= strength * std::max(0.0, model_.reach - gap);
  if (half == 0) return gap <= model_.reach ? strength : 0.0;
  const double inside = std::min(gap + half, model_.reach) - std::min(gap - half, model_.reach);
  return strength * inside / (2 * half);
}

Vec3 Encounters::rub(const Meeting& meeting, const Vec3& slip, double press, double rate,
                     Memory& memory) const {
  // In the first step the slip has lasted since the touch only.
  const double overlap = meeting.overlap - memory.begun;
  const bool first = memory.stretch.isZero(0);
  const double time = first && rate > 0 ? std::min(step_, overlap / rate) : step_;
  memory.stretch -= memory.stretch.dot(meeting.normal) * meeting.normal;
  memory.stretch += time * slip;
  const double most = model_.friction[static_cast<std::size_t>(meeting.kind)] * press,
               wanted = memory.slip_stiffness * memory.stretch.norm();
  if (wanted > most) memory.stretch *= most / wanted;
  memory.stored += memory.slip_stiffness * memory.stretch.squaredNorm() / 2;
  return -memory.slip_stiffness * memory.stretch;
}

}  // namespace shakedown::apart
