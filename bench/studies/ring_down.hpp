// SPDX-License-Identifier: MIT
// Puts the diagnosis on trial with empty boxes ringing down, as people record them: every real experiment
// with grains begins with one. They are drawn at random, measured by the laboratory, diagnosed, scored.
#pragma once
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "known_effects.hpp"
#include "trial.hpp"

namespace shakedown {

/// What spoils a recording beside a little white noise; `edges`: an encoder's, on no even clock.
enum class RingDownNoise { white, rounded, wandering, jittered, edges };
std::string_view name_of(RingDownNoise noise);

struct RingDown {
  int number = 0;
  Trial trial;
  std::vector<std::string> hidden;  ///< effects
  /// Of each hidden effect: its strength over its standard error when release, phase, origin, frequency and
  /// the other hidden strengths are unknown (Cramer and Rao), all runs together.
  std::vector<double> signals;
  RingDownNoise noise = RingDownNoise::white;
  double frames_a_period = 0;

  double weakest() const;  ///< signal; infinite with nothing hidden
};

/// Draws a damper without grains, 0.4 to 4 Hz, released from 10 to 200 mm, seen 8 to 60 periods long at 5 to
/// 1000 frames a second (eight a period at least) from somewhere in the motion on, with an origin that nobody
/// knows; none, one, two or three of the four laws of a ring-down (linear, dry and quadratic damping, a cubic
/// spring), in half the cases with one thing that rigs have beside them (a second swing, a spring stiffer to
/// one side, a tilted camera, a pendulum's sine), each with a signal of 4 and more; one in seven by the edges
/// of an encoder. `engine` computes the signals. A case depends on seed and number alone.
RingDown draw_ring_down(std::uint64_t seed, int number, const Engine& engine, KnownEffects known);

struct RingDownAnswer {
  std::string verdict;               ///< empty: no answer
  std::vector<std::string> missing;  ///< as the diagnosis says
  std::string stopped;               ///< why there is no answer
  bool not_finite = false;           ///< a number of the answer is none
  double seconds = 0;
  double left = std::numeric_limits<double>::quiet_NaN();  ///< by the final model, times noise and spread
  bool holds = false;                                      ///< says its judgement
};
/// Write and read an answer as a file keeps it, with the program that answered. `read_answer` throws
/// InputError for what is no answer of that program.
std::string answer_json(const RingDownAnswer& answer, const std::string& program);
RingDownAnswer read_answer(const std::filesystem::path& file, const std::string& program);

/// Diagnoses a case. An exception is kept as `stopped` of the answer; only Interrupted is thrown on.
RingDownAnswer answer_of(const RingDown& case_, const TrialTools& tools);

struct RingDownResult {
  RingDown drawn;
  RingDownAnswer answer;
  /// The physics named is the physics hidden; the camera's errors count for nothing, and look-alikes (a
  /// pendulum's sine and a cubic spring, a tilted camera and a spring stiffer to one side) for one another.
  bool right = false;
  bool invented = false;  ///< physics is named that is not hidden, or a force of no list
};
/// Judges an answer.
RingDownResult judged(RingDown drawn, RingDownAnswer answer, KnownEffects known);

/// Returns counts by what was hidden, by signal, by noise and by frames a period.
std::string ring_down_table(const std::vector<RingDownResult>& results);
/// Returns a line a case.
std::string ring_down_csv(const std::vector<RingDownResult>& results);

}  // namespace shakedown
