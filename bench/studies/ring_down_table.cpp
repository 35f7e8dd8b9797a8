// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ring_down.hpp"

namespace shakedown {

namespace {

using Chosen = std::function<bool(const RingDownResult&)>;

std::string line(std::string_view what, const std::vector<RingDownResult>& results, const Chosen& chosen) {
  int cases = 0, right = 0, invented = 0, stopped = 0, not_finite = 0;
  for (const RingDownResult& one : results) {
    if (!chosen(one)) continue;
    ++cases;
    right += one.right;
    invented += one.invented;
    stopped += !one.answer.stopped.empty();
    not_finite += one.answer.not_finite;
  }
  if (cases == 0) return "";
  const Share share = share_of(right, cases);
  return fmt::format("{:<36}{:>6}{:>7}{:>6.0f} % ({:.0f} to {:.0f} %){:>10}{:>9}{:>6}\n", what, cases, right,
                     100 * share.value, 100 * share.low, 100 * share.high, invented, stopped, not_finite);
}

/// Says what right or wrong answers leave of the motion, and how many of them say that the model holds.
std::string answers_left_by(const std::vector<RingDownResult>& results, bool right) {
  std::vector<double> left;
  int hold = 0;
  for (const RingDownResult& one : results)
    if (one.right == right && std::isfinite(one.answer.left))
      left.push_back(one.answer.left), hold += one.answer.holds;
  if (left.empty()) return "";
  std::sort(left.begin(), left.end());
  return fmt::format(
      "{} answers leave {:.2f} times noise and spread at the median, {:.2f} at most; {} of {} hold\n",
      right ? "right" : "wrong", left[left.size() / 2], left.back(), hold, left.size());
}

Chosen hides(std::size_t number) {
  return [number](const RingDownResult& one) { return one.drawn.hidden.size() == number; };
}

Chosen hides_effect(std::string_view effect) {
  return [effect](const RingDownResult& one) {
    return std::find(one.drawn.hidden.begin(), one.drawn.hidden.end(), effect) != one.drawn.hidden.end();
  };
}

Chosen signal_between(double low, double high) {
  return [=](const RingDownResult& one) {
    return !one.drawn.hidden.empty() && one.drawn.weakest() >= low && one.drawn.weakest() < high;
  };
}

Chosen noise_is(RingDownNoise noise) {
  return [noise](const RingDownResult& one) { return one.drawn.noise == noise; };
}

Chosen frames_between(double low, double high) {
  return [=](const RingDownResult& one) {
    return one.drawn.frames_a_period >= low && one.drawn.frames_a_period < high;
  };
}

std::string text_of_words(const std::vector<std::string>& words, std::string_view between = " ") {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) (text += i == 0 ? "" : between) += words[i];
  return text;
}

std::string quoted(std::string text) {
  for (char& c : text)
    if (c == '"' || c == '\n') c = '\'';
  return "\"" + text + "\"";
}

}  // namespace

std::string ring_down_table(const std::vector<RingDownResult>& results) {
  constexpr double any = std::numeric_limits<double>::infinity();
  std::string text = fmt::format("{:<36}{:>6}{:>7}{:>22}{:>10}{:>9}{:>6}\n", "ring-downs of an empty box",
                                 "cases", "right", "", "invented", "stopped", "NaN");
  const auto add = [&](std::string_view what, const Chosen& chosen) { text += line(what, results, chosen); };
  add("all", [](const RingDownResult&) { return true; });
  add("nothing hidden", hides(0));
  add("one law", hides(1));
  add("two laws", hides(2));
  add("three laws", hides(3));
  add("four laws", hides(4));
  for (const std::string_view effect : {"second_mode", "spring_quadratic", "camera_tilt", "pendulum"})
    add(fmt::format("with {}", effect), hides_effect(effect));
  add("weakest signal 4 to 12", signal_between(4, 12));
  add("weakest signal 12 and more", signal_between(12, any));
  add("weakest signal 12 to 50", signal_between(12, 50));
  add("weakest signal 50 and more", signal_between(50, any));
  for (const RingDownNoise noise : {RingDownNoise::white, RingDownNoise::rounded, RingDownNoise::wandering,
                                    RingDownNoise::jittered, RingDownNoise::edges})
    add(fmt::format("noise {}", name_of(noise)), noise_is(noise));
  add("8 to 20 frames a period", frames_between(8, 20));
  add("20 to 100 frames a period", frames_between(20, 100));
  add("100 frames a period and more", frames_between(100, any));
  text += answers_left_by(results, true) + answers_left_by(results, false);
  std::vector<double> seconds;
  for (const RingDownResult& one : results) seconds.push_back(one.answer.seconds);
  std::sort(seconds.begin(), seconds.end());
  if (!seconds.empty())
    text += fmt::format("seconds a case, one thread: {:.1f} at the median, {:.1f} at most\n",
                        seconds[seconds.size() / 2], seconds.back());
  return text + "aims: weakest signal 12 and more: right 90 %, invented 3 %; no stop, no NaN\n";
}

std::string ring_down_csv(const std::vector<RingDownResult>& results) {
  std::string text =
      "case,hidden,signals,noise,frame_rate_hz,frames_a_period,runs,declared,verdict,missing,right,invented,"
      "not_finite,seconds,left,holds,stopped\n";
  for (const RingDownResult& one : results) {
    const RecordingSettings& recording = one.drawn.trial.recording;
    std::string signals;
    for (const double signal : one.drawn.signals)
      signals += fmt::format("{}{:.1f}", signals.empty() ? "" : " ", signal);
    const auto word = [](bool yes) { return std::string(yes ? "true" : "false"); };
    const std::vector<std::string> cells{std::to_string(one.drawn.number),
                                         text_of_words(one.drawn.hidden),
                                         signals,
                                         std::string(name_of(one.drawn.noise)),
                                         fmt::format("{:.1f}", recording.frame_rate),
                                         fmt::format("{:.1f}", one.drawn.frames_a_period),
                                         std::to_string(one.drawn.trial.runs.size()),
                                         word(recording.declared),
                                         one.answer.verdict,
                                         text_of_words(one.answer.missing),
                                         word(one.right),
                                         word(one.invented),
                                         word(one.answer.not_finite),
                                         fmt::format("{:.2f}", one.answer.seconds),
                                         fmt::format("{:.2f}", one.answer.left),
                                         word(one.answer.holds),
                                         quoted(one.answer.stopped)};
    text += text_of_words(cells, ",") + "\n";
  }
  return text;
}

}  // namespace shakedown
