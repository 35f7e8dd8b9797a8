// SPDX-License-Identifier: MIT
#include "ring_down.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "effect_strength.hpp"
#include "errors.hpp"
#include "json_file.hpp"
#include "known_effects.hpp"
#include "random.hpp"
#include "ring_down_signal.hpp"

namespace shakedown {

namespace {

constexpr double least_signal = 4;  // what is weaker nobody can be asked for

/// The numbers of a damper by which a law's strength is measured.
struct Scale {
  double mass, angular_frequency, release;  ///< kg, 1/s, m
};

/// A law of a ring-down, with its strength on a scale of the oscillation.
struct Law {
  std::string_view key;
  double low, high;  ///< of the strength, drawn log-uniform
  bool either_sign;
  double (*per_unit)(const Scale&);
  double most = 1e300;  ///< of the value
};

constexpr std::array<Law, 4> laws{{
    // damping ratio c / (2 M omega)
    {"blade_viscous_damping.damping", 1e-3, 0.05, false,
     [](const Scale& s) { return 2 * s.mass * s.angular_frequency; }},
    // friction over the spring's force at release
    {"clamp_dry_friction.force", 1e-3, 0.03, false,
     [](const Scale& s) { return s.mass * s.angular_frequency * s.angular_frequency * s.release; }},
    // force over M a^2 / release: the share of the amplitude lost in a period is 16/3 of it
    {"blade_quadratic_drag.drag", 2e-3, 0.1, false, [](const Scale& s) { return s.mass / s.release; }},
    // change of the stiffness force at release
    {"spring_cubic.coefficient", 3e-3, 0.2, true, [](const Scale&) { return 1.0; }},
}};

/// What rigs have beside the four laws.
constexpr std::array<Law, 4> of_rigs{{
    // acceleration over that of the release
    {"second_mode.amplitude", 3e-3, 0.1, false,
     [](const Scale& s) { return s.angular_frequency * s.angular_frequency * s.release; }},
    // change of the stiffness force at release (its reference is 0.1 m)
    {"spring_quadratic.coefficient", 3e-3, 0.1, true, [](const Scale& s) { return 0.1 / s.release; }, 0.45},
    // error of the release's place (its reach is 0.2 m)
    {"camera_tilt.tilt", 2e-3, 0.05, true, [](const Scale& s) { return 0.2 / s.release; }, 0.27},
    // length over release: the inverse of the angle
    {"pendulum.length", 0.7, 8, false, [](const Scale& s) { return s.release; }},
}};
constexpr std::size_t a_pendulum = 3;
constexpr unsigned a_cubic_spring = 1u << 3;

/// Which laws a case hides, in turn: nothing twice, each alone twice, all pairs, all triples.
constexpr std::array<unsigned, 20> laws_in_turn{0, 1, 2, 4, 8, 3,  5, 6,  9,  10,
                                                0, 1, 2, 4, 8, 12, 7, 11, 13, 14};

double between(Random& random, double low, double high) { return low + (high - low) * random.uniform(); }
double log_between(Random& random, double low, double high) {
  return std::exp(between(random, std::log(low), std::log(high)));
}

/// Draws rate and length such that a frame is an eighth of a period at most and the table not too long.
void draw_frames(Random& random, double frequency, Setup& truth, RecordingSettings& recording) {
  constexpr double least_frames_a_period = 8, most_frames = 20000;
  do {
    recording.frame_rate = log_between(random, 5, 1000);
    truth.run.duration = log_between(random, 8, 60) / frequency;
  } while (recording.frame_rate < least_frames_a_period * frequency ||
           recording.frame_rate * truth.run.duration > most_frames);
  recording.frame_rate = std::round(recording.frame_rate * 10) / 10;
  recording.start = between(random, 0.2, 1.2) / frequency;
  truth.run.duration += recording.start;
}

RingDownNoise draw_noise(Random& random, double release, RecordingSettings& recording) {
  const auto noise = static_cast<RingDownNoise>(random.bits() % 4);
  recording.box_noise = release * log_between(random, 3e-4, 1e-2);
  switch (noise) {
    case RingDownNoise::white: break;
    case RingDownNoise::rounded:
      recording.rounding = release * log_between(random, 1e-3, 3e-2);
      recording.box_noise = recording.rounding * log_between(random, 0.05, 1);
      break;
    case RingDownNoise::wandering:
      recording.wander = release * log_between(random, 1e-4, 3e-3);
      recording.wander_time = log_between(random, 0.05, 0.5);
      break;
    case RingDownNoise::jittered:
      recording.jitter = log_between(random, 0.01, 0.2) / recording.frame_rate;
      recording.stamped = random.uniform() < 0.5;
      break;
    case RingDownNoise::edges: break;  // drawn by themselves
  }
  recording.origin = release * between(random, -0.1, 0.1);
  recording.declared = random.uniform() < 0.5;
  return noise;
}

/// Draws a second swing's other numbers: its frequency not so near the box's own that they beat, which the
/// effect says it is not for, nor near a multiple of it.
void draw_second_swing(Random& random, KnownEffects known, Setup& truth) {
  constexpr double apart_from_own = 0.25, apart_from_multiples = 0.15;
  const auto is_apart = [](double ratio) {
    return std::abs(ratio - 1) > apart_from_own &&
           (ratio < 1.5 || std::abs(ratio - std::round(ratio)) > apart_from_multiples);
  };
  double ratio = 1;
  while (!is_apart(ratio)) ratio = log_between(random, 0.3, 4.5);
  const double frequency = truth.spring.frequency;
  set_number(truth, "second_mode.frequency", ratio * frequency, known);
  set_number(truth, "second_mode.rate", log_between(random, 0.003, 0.3) * frequency, known);
  set_number(truth, "second_mode.phase", between(random, -3, 3), known);
}

void hide_law(const Law& law, Random& random, KnownEffects known, RingDown& drawn,
              std::vector<std::string>& keys) {
  Setup& truth = drawn.trial.hidden.truth;
  const Scale scale{truth.box.mass, 2 * std::numbers::pi * truth.spring.frequency,
                    truth.release.displacement};
  double strength = log_between(random, law.low, law.high);
  if (law.either_sign && random.uniform() < 0.5) strength = -strength;
  keys.emplace_back(law.key);
  set_number(truth, keys.back(), std::clamp(strength * law.per_unit(scale), -law.most, law.most), known);
  drawn.hidden.emplace_back(effect_of(keys.back()));
  if (drawn.hidden.back() == "second_mode") draw_second_swing(random, known, truth);
}

/// Draws edges of an encoder in place of a camera's frames, not more than a table should have.
void draw_edges(Random& random, const Setup& truth, RecordingSettings& recording) {
  constexpr double most_rows = 20000;
  const double release = truth.release.displacement,
               periods = truth.spring.frequency * (truth.run.duration - recording.start);
  do recording.edge = release * log_between(random, 1e-3, 3e-2);
  while (4 * release / recording.edge * periods > most_rows);
  recording.rounding = recording.edge;
  recording.box_noise = recording.jitter = recording.wander = 0;
  // What signals are reckoned with: as many rows of an even clock, rounded by as much.
  recording.frame_rate = 4 * release / recording.edge * truth.spring.frequency;
}

/// Makes one attempt, whose signals may be too small.
RingDown drawn_once(Random& random, unsigned which, const Engine& engine, KnownEffects known) {
  RingDown drawn;
  Setup& truth = drawn.trial.hidden.truth;
  truth.grains.count = 0;
  truth.box.mass = log_between(random, 0.05, 2);
  truth.spring.frequency = log_between(random, 0.4, 4);
  truth.release.displacement = log_between(random, 0.01, 0.2);
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < laws.size(); ++i)
    if ((which >> i & 1) != 0) hide_law(laws[i], random, known, drawn, keys);
  RecordingSettings& recording = drawn.trial.recording;
  draw_frames(random, truth.spring.frequency, truth, recording);
  drawn.noise = draw_noise(random, truth.release.displacement, recording);
  constexpr double share_of_rigs = 0.5, share_of_encoders = 0.15;
  if (random.uniform() < share_of_rigs) {
    const auto rig = static_cast<std::size_t>(random.bits() >> 20) % of_rigs.size();
    // A pendulum's sine beside a cubic spring says the same twice.
    if (rig != a_pendulum || (which & a_cubic_spring) == 0)
      hide_law(of_rigs[rig], random, known, drawn, keys);
  }
  if (random.uniform() < share_of_encoders && find_choice(truth, "camera_tilt") == nullptr) {
    draw_edges(random, truth, recording);
    drawn.noise = RingDownNoise::edges;
  }
  drawn.frames_a_period = recording.frame_rate / truth.spring.frequency;
  const auto runs = 1 + random.bits() % 3;
  for (std::size_t run = 0; run < runs; ++run)
    drawn.trial.runs.push_back({"run_" + std::to_string(run + 1), {}});
  drawn.trial.hidden.believed = truth;
  drawn.trial.hidden.believed.effects.clear();
  drawn.trial.hidden.believed.spring.frequency *= 1 + 0.02 * random.normal();
  drawn.trial.seed = random.bits() >> 16;
  drawn.signals = signals_of(truth, keys, recording, engine, known);
  for (double& signal : drawn.signals) signal *= std::sqrt(static_cast<double>(runs));
  return drawn;
}

/// Tells whether only the waveform's finest marks tell the two apart (a pendulum's sine and a cubic spring).
bool look_alike(const std::string& one, const std::string& other, KnownEffects known) {
  const EffectRecord *a = known.find(one), *b = known.find(other);
  return a != nullptr && b != nullptr && !a->family.empty() && a->family == b->family &&
         (search_of(*a).in_waveform || search_of(*b).in_waveform);
}

/// Returns what is named, with a look-alike of something hidden that is not named put under the name of that.
std::vector<std::string> as_hidden(std::vector<std::string> named, const std::vector<std::string>& hidden,
                                   KnownEffects known) {
  const auto among = [](const std::string& effect, const std::vector<std::string>& list) {
    return std::find(list.begin(), list.end(), effect) != list.end();
  };
  for (std::string& effect : named)
    for (const std::string& truth : hidden)
      if (!among(effect, hidden) && !among(truth, named) && look_alike(effect, truth, known)) effect = truth;
  return named;
}

/// Tells whether a number of the answer is none: it stands among those that could not be computed. A balance
/// that was not possible (an encoder's rows are too uneven for it) has none, and says why, which does not
/// count.
bool is_not_finite(const Diagnosis& diagnosis) {
  const nlohmann::json document = nlohmann::json::parse(diagnosis_json(diagnosis));
  const nlohmann::json none = document.value("not_computed", nlohmann::json::object());
  return std::any_of(none.items().begin(), none.items().end(), [&](const auto& one) {
    return one.key().starts_with("/parameters/") ||
           (diagnosis.momentum.possible && one.key().starts_with("/momentum/"));
  });
}

}  // namespace

std::string_view name_of(RingDownNoise noise) {
  constexpr std::array<std::string_view, 5> names{"white", "rounded", "wandering", "jittered", "edges"};
  return names[static_cast<std::size_t>(noise)];
}

double RingDown::weakest() const {
  return signals.empty() ? std::numeric_limits<double>::infinity()
                         : *std::min_element(signals.begin(), signals.end());
}

RingDown draw_ring_down(std::uint64_t seed, int number, const Engine& engine, KnownEffects known) {
  constexpr int most_attempts = 200;
  Random random(seed, static_cast<std::uint64_t>(number), Stream::hidden);
  const unsigned which = laws_in_turn[static_cast<std::size_t>(number) % laws_in_turn.size()];
  for (int attempt = 1;; ++attempt) {
    RingDown drawn = drawn_once(random, which, engine, known);
    drawn.number = number;
    if (drawn.weakest() >= least_signal || attempt == most_attempts) return drawn;
  }
}

RingDownAnswer answer_of(const RingDown& case_, const TrialTools& tools) {
  RingDownAnswer answer;
  const auto begin = std::chrono::steady_clock::now();
  try {
    const Diagnosis diagnosis = diagnose_trial(case_.trial, tools);
    answer.verdict = name_of(diagnosis.verdict);
    answer.missing = diagnosis.missing;
    answer.not_finite = is_not_finite(diagnosis);
    if (!diagnosis.left.empty()) answer.left = times_floor(diagnosis.left.front());
    answer.holds = diagnosis.judgement.holds();
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    answer.stopped = error.what();
  }
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return answer;
}

std::string answer_json(const RingDownAnswer& answer, const std::string& program) {
  return nlohmann::json{{"program", program},
                        {"verdict", answer.verdict},
                        {"missing", answer.missing},
                        {"stopped", answer.stopped},
                        {"not_finite", answer.not_finite},
                        {"seconds", answer.seconds},
                        {"left", std::isfinite(answer.left) ? nlohmann::json(answer.left) : nlohmann::json()},
                        {"holds", answer.holds}}
             .dump(2) +
         "\n";
}

RingDownAnswer read_answer(const std::filesystem::path& file, const std::string& program) {
  RingDownAnswer answer;
  std::string answered_by;
  constexpr std::string_view remedy = "remove it, and the case is answered again";
  read_json_file(file, "a ring-down's answer", remedy, [&](const std::string& text) {
    const nlohmann::json document = nlohmann::json::parse(text);
    answered_by = document.at("program").get<std::string>();
    answer = {document.at("verdict"), document.at("missing"), document.at("stopped"),
              document.at("not_finite"), document.at("seconds")};
    if (document.at("left").is_number()) answer.left = document.at("left");
    answer.holds = document.at("holds");
  });
  if (answered_by != program)
    throw InputError({{{file.string(), 0, 0},
                       "program",
                       "is another one (" + answered_by + ") than the one that asks",
                       std::string(remedy) + ", or choose another folder"}});
  return answer;
}

RingDownResult judged(RingDown drawn, RingDownAnswer answer, KnownEffects known) {
  RingDownResult result;
  const auto ordered = [&](const std::vector<std::string>& effects) {
    std::vector<std::string> physics = physics_among(effects, known);
    std::sort(physics.begin(), physics.end());
    return physics;
  };
  const std::vector<std::string> truth = ordered(drawn.hidden),
                                 named = ordered(as_hidden(answer.missing, drawn.hidden, known));
  result.invented =
      answer.verdict == "unknown" || !std::includes(truth.begin(), truth.end(), named.begin(), named.end());
  result.right = answer.stopped.empty() && answer.verdict != "unknown" && named == truth;
  result.drawn = std::move(drawn);
  result.answer = std::move(answer);
  return result;
}

}  // namespace shakedown
