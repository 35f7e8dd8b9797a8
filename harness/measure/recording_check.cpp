// SPDX-License-Identifier: MIT
#include "recording_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "experiment_file.hpp"
#include "grain_file.hpp"
#include "layer_check.hpp"
#include "quantity.hpp"
#include "rough_motion.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

/// One thing about one run; alike ones of several runs become one message.
struct Finding {
  std::string kind;
  bool impossible = false;
  std::string run;
  Violation violation;
};

/// Three digits and a unit.
std::string rounded(double si, const char* unit) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.3g", si);
  return write_quantity(std::strtod(digits, nullptr), unit);
}
std::string mm(double metres) { return rounded(metres, "mm"); }

std::string factor_text(double factor) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", factor);
  return text;
}

class RunCheck {
 public:
  RunCheck(const MeasuredRun& run, const Setup& setup, std::vector<Finding>& findings)
      : run_(run), setup_(setup), findings_(findings), motion_(rough_motion(run.time, run.x_box)) {}

  void check() {
    if (!check_frames()) return;
    if (!std::isfinite(motion_.frequency)) {
      if (motion_.unbroken > 0)
        add("still", false, "box", "does not swing (or less than one and a half times)",
            "look whether this is the column of the box, and whether the recording is long enough");
      return;
    }
    if (!check_clock()) return;
    if (!check_scale()) return;
    check_side();
    check_origin();
    check_start();
    check_columns();
  }

 private:
  void add(const char* kind, bool impossible, const std::string& key, const std::string& problem,
           const std::string& remedy) {
    findings_.push_back({kind, impossible, run_.name, {run_.place, key, problem, remedy}});
  }

  bool released() const {
    return !starts_anywhere(run_, setup_) && setup_.domain == Domain::damper &&
           setup_.release.displacement != 0;
  }

  /// Noise and memory are found from frames in a row: with two thirds of them in no stretch of five, nothing
  /// is known of either, and any model would do.
  bool check_frames() {
    constexpr double least = 1.0 / 3;
    const auto enough = [&](const char* what, const std::vector<double>& x, double unbroken) {
      if (x.empty() || unbroken >= least) return true;
      const auto gone = std::count_if(x.begin(), x.end(), [](double value) { return !std::isfinite(value); });
      add(what, true, what,
          "has too few frames in a row (" +
              factor_text(100 * static_cast<double>(gone) / static_cast<double>(x.size())) +
              " % of the cells are empty, and " + factor_text(100 * unbroken) +
              " % of the time is covered by five frames without a gap): noise cannot be told from motion",
          std::string(what) == "box_position" ? "track it again, or leave this run out"
                                              : "track it again, or write column.grain_centre.from = \"\"");
      return false;
    };
    if (!enough("box_position", run_.x_box, motion_.unbroken)) return false;
    if (run_.has_com()) enough("grain_centre", run_.x_com, rough_motion(run_.time, run_.x_com).unbroken);
    return true;
  }

  bool check_clock() {
    const double ratio = motion_.frequency / setup_.spring.frequency;
    constexpr double absurd = 30, doubtful = 1.5;  // grains lower the frequency by some per cent only
    if (ratio < doubtful && ratio > 1 / doubtful) return true;
    const bool impossible = ratio > absurd || ratio < 1 / absurd;
    const std::string found = "the box swings at " + rounded(motion_.frequency, "Hz") +
                              " where the spring of the setup has " + rounded(setup_.spring.frequency, "Hz") +
                              " (" + factor_text(ratio) + " times)";
    const double thousands = std::log10(ratio) / 3;
    const bool unit = std::abs(thousands - std::round(thousands)) < 0.1;
    add("clock", impossible, "column.time",
        found + (impossible && unit ? ": the clock is in another unit" : ""),
        impossible && unit && ratio < 1
            ? "write the smaller unit in [column.time]: unit = \"" +
                  std::string(thousands < -1.5 ? "us" : "ms") + "\" where it says s"
            : "look at the unit of [column.time], at frame_rate (of a slow-motion film the one while "
              "filming) and at spring.frequency");
    return !impossible;
  }

  bool check_scale() {
    if (!released()) return true;
    const double stated = std::abs(setup_.release.displacement);
    const double shown = std::max(motion_.amplitude, std::abs(motion_.first - motion_.centre));
    const double tens = std::log10(shown / stated);
    constexpr double near = 0.12;     // of a power of ten: 30 %
    constexpr double doubtful = 1.3;  // of what was set with a ruler
    const std::string found =
        "the box starts with a swing of " + mm(shown) + " where release.displacement is " + mm(stated);
    if (std::abs(tens) > 0.5 && std::abs(tens - std::round(tens)) < near) {
      const double factor = std::pow(10, -std::round(tens));
      const char* unit = factor == 10      ? "centimetres? Write unit = \"cm\" where it says mm"
                         : factor == 1000  ? "metres? Write unit = \"m\" where it says mm"
                         : factor == 100   ? "metres? Write unit = \"m\" where it says cm"
                         : factor == 0.1   ? "millimetres? Write unit = \"mm\" where it says cm"
                         : factor == 0.001 ? "millimetres? Write unit = \"mm\" where it says m"
                                           : "Look at the unit of the column";
      add("scale", true, "column.box_position",
          found + ", off by a factor of " + factor_text(std::max(factor, 1 / factor)),
          std::string(unit) + "; or correct release.displacement");
      return false;
    }
    if (shown > stated * doubtful || shown < stated / doubtful)
      add("release", false, "release.displacement", found,
          "write release.displacement = \"" + mm(shown) + "\" under its [[run]] if that is right");
    return true;
  }

  void check_side() {
    const double from_centre = motion_.first - motion_.centre;
    if (!released() || std::abs(from_centre) < 0.5 * motion_.amplitude) return;
    if ((from_centre > 0) == (setup_.release.displacement > 0)) return;
    add("side", true, "column.box_position",
        "the box starts on the other side (" + mm(from_centre) + " from where it swings about; released at " +
            mm(setup_.release.displacement) + ")",
        "write reversed = true in [column.box_position] and [column.grain_centre], or turn the sign of "
        "release.displacement");
  }

  void check_origin() {
    if (starts_anywhere(run_, setup_) && !run_.origin_stated) return;  // unknown, and fitted
    constexpr double worth_saying = 0.01, absurd = 0.5;                // of the amplitude
    const double off = std::abs(motion_.centre);
    if (off < std::max(worth_saying * motion_.amplitude, 4 * motion_.centre_error)) return;
    const bool impossible = released() && off > absurd * motion_.amplitude;
    add("origin", impossible, "column.box_position.origin",
        "the box swings about x = " + mm(motion_.centre) + ", not about 0 (where the spring is relaxed)",
        run_.origin_stated
            ? "move the origin by that much, unless a steady force pulls there"
            : "write origin = \"" + mm(motion_.centre) +
                  "\" in [column.box_position] and [column.grain_centre], unless a steady force pulls there");
  }

  void check_start() {
    if (!released()) return;
    constexpr double worth_saying = 0.02;  // of a period
    const double least = worth_saying / motion_.frequency;
    if (motion_.lead_in > least) {
      add("lead-in", false, "run.release_time",
          "the box stands still for the first " + rounded(motion_.lead_in, "s"),
          "write release_time = \"" + rounded(run_.time.front() + motion_.lead_in, "s") +
              "\" under its [[run]]");
      return;
    }
    if (run_.time.front() > least && run_.lead_in.time.empty())
      add("clock start", false, "run.release_time",
          "the first frame is at " + rounded(run_.time.front(), "s") + ", so long after the release at 0",
          "write release_time = \"" + rounded(run_.time.front(), "s") + "\" if the film begins with it");
    else if (std::abs(motion_.start_delay) > std::max(least, 5 * motion_.delay_error))
      add("late", false, "run.release_time",
          "at the first frame the box moves as " + rounded(motion_.start_delay, "s") +
              (motion_.start_delay > 0 ? " after a release from rest (or it was pushed)"
                                       : " before it turns (or it was pushed)"),
          "let the table begin at the release, or write release_time = \"" +
              rounded(run_.time.front() - motion_.start_delay, "s") + "\" under its [[run]]");
  }

  /// Between impacts grains fly straight; only the box swings like a spring.
  void check_columns() {
    if (!run_.has_com()) return;
    const RoughMotion grains = rough_motion(run_.time, run_.x_com);
    const double box_off = distance_from_sine(run_.time, run_.x_box, motion_.frequency, motion_.centre);
    const double grains_off = distance_from_sine(run_.time, run_.x_com, grains.frequency, grains.centre);
    constexpr double clearly = 0.8;  // seen: 0.55 to 0.66 swapped, above 1.5 as it should be
    if (grains_off < clearly * box_off)
      add("columns", false, "column.grain_centre",
          "swings like a spring and column.box_position does not: are the two columns swapped?",
          "exchange their from");
  }

  const MeasuredRun& run_;
  const Setup& setup_;
  std::vector<Finding>& findings_;
  RoughMotion motion_;
};

/// Alike findings of several runs in one: the first with its numbers, and the names of the others.
void gather(const std::vector<Finding>& findings, RecordingCheck& result) {
  std::vector<char> said(findings.size(), 0);
  for (std::size_t i = 0; i < findings.size(); ++i) {
    if (said[i]) continue;
    std::string others;
    for (std::size_t j = i + 1; j < findings.size(); ++j)
      if (findings[j].kind == findings[i].kind && findings[j].impossible == findings[i].impossible) {
        others += (others.empty() ? "" : ", ") + findings[j].run;
        said[j] = 1;
      }
    Violation one = findings[i].violation;
    one.problem += others.empty() ? "" : "; likewise " + others;
    if (findings[i].impossible) {
      one.key = findings[i].run + ": " + one.key;
      result.impossible.push_back(one);
    } else {
      result.notes.push_back(findings[i].run + ": " + one.key + ": " + one.problem + ". " + one.remedy);
    }
  }
}

/// What the setup says against what is said to be known.
void check_known(const Experiment& experiment, const std::vector<Setup>& setups, RecordingCheck& result) {
  constexpr double far = 5;  // standard deviations
  for (const KnownValue& known : experiment.known) {
    const SetupKey* key = find_setup_key(known.key);
    if (!key || setups.empty() || is_of_each_run(known.key)) continue;
    const double set = numbers_of(*key, setups.front()).front();
    if (std::abs(set - known.value) > far * known.error && set != known.value)
      result.notes.push_back(known.key + " is " + write_quantity(set, key->unit) +
                             " in the setup, and known to be " + write_quantity(known.value, key->unit) +
                             " +- " + write_quantity(known.error, key->unit) + ". Correct one of the two");
  }
}

}  // namespace

RecordingCheck check_recordings(const Experiment& experiment, const std::vector<Setup>& setups) {
  EXPECT(setups.size() == experiment.runs.size());
  RecordingCheck result;
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < setups.size(); ++i) RunCheck(experiment.runs[i], setups[i], findings).check();
  gather(findings, result);
  check_known(experiment, setups, result);
  if (result.impossible.empty()) {
    const std::vector<std::string> layers = notes_on_layers(experiment, setups);
    result.notes.insert(result.notes.end(), layers.begin(), layers.end());
  }
  return result;
}

std::vector<std::string> notes_before_modelling(const Experiment& experiment,
                                                const std::vector<Setup>& setups) {
  RecordingCheck check = check_recordings(experiment, setups);
  if (!check.impossible.empty()) throw InputError(std::move(check.impossible));
  for (const Setup& setup : setups)
    if (const std::string note = note_on_measured_grains(setup); !note.empty()) check.notes.push_back(note);
  check.notes.insert(check.notes.begin(), experiment.notes.begin(), experiment.notes.end());
  return check.notes;
}

}  // namespace shakedown
