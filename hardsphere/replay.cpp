// SPDX-License-Identifier: MIT
#include "replay.hpp"

#include <variant>

#include "event_loop.hpp"
#include "scripted_grains.hpp"

namespace shakedown {

namespace {

using ReplayedLoop = std::variant<EventLoop<ScriptedGrains, BoxMotion>, EventLoop<ScriptedGrains, DrivenBox>>;

ReplayedLoop replayed_loop(const Setup& setup, const State& state) {
  if (setup.domain == Domain::periodic)
    throw InputError({{{}, "domain.kind", "a periodic cell has no collision log", "run the setup again"}});
  const Physics physics = physics_of(setup);
  const ScriptedGrains grains(state);
  return is_driven(physics) ? ReplayedLoop(std::in_place_index<1>, state, physics, setup, grains)
                            : ReplayedLoop(std::in_place_index<0>, state, physics, setup, grains);
}

}  // namespace

struct Replay::Inside {
  ReplayedLoop loop;
  const CollisionLog* log;
  EventReader reader;
  std::int64_t interval;
  std::optional<LoggedEvent> next;

  void read() { next = reader.done() ? std::nullopt : std::optional(reader.next()); }
  void check_end() { check(log->digests.size() - 1); }
  void check(std::size_t digest) {
    const std::uint64_t here = std::visit([](const auto& l) { return l.digest(); }, loop);
    if (digest >= log->digests.size() || log->digests[digest] != here)
      throw FileError(
          "the collision log does not fit this build of the program (its arithmetic differs in the last "
          "digit, or the setup was "
          "changed); make the run again with --log");
  }
};

Replay::Replay(const Setup& setup, const CollisionLog& log)
    : inside_(new Inside{replayed_loop(setup, log.initial),
                         &log,
                         EventReader(log),
                         digest_interval(log.initial.size()),
                         {}}) {
  inside_->read();
}
Replay::~Replay() = default;
Replay::Replay(Replay&&) noexcept = default;

double Replay::next_time() const { return inside_->next ? inside_->next->time : never; }
double Replay::time() const {
  return std::visit([](const auto& loop) { return loop.time(); }, inside_->loop);
}
State Replay::state() const {
  return std::visit([](const auto& loop) { return loop.state(loop.time()); }, inside_->loop);
}

std::optional<LoggedEvent> Replay::step() {
  const std::optional<LoggedEvent> event = inside_->next;
  if (!event) return event;
  const std::int64_t executed = inside_->reader.entry();
  std::visit([&](auto& loop) { loop.execute(*event); }, inside_->loop);
  inside_->read();
  if (executed % inside_->interval == 0)
    inside_->check(static_cast<std::size_t>(executed / inside_->interval - 1));
  if (!inside_->next) inside_->check_end();
  return event;
}

void Replay::advance_to(double t) {
  EXPECT(t >= time());
  t = std::min(t, inside_->log->end_time);
  while (next_time() <= t) step();
  std::visit([&](auto& loop) { loop.wait_until(std::max(t, loop.time())); }, inside_->loop);
}

}  // namespace shakedown
