// SPDX-License-Identifier: MIT
#include "recording_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "audit.hpp"
#include "base_column.hpp"
#include "experiment.hpp"
#include "grain_column.hpp"
#include "grain_file.hpp"
#include "initial_state.hpp"
#include "layer_check.hpp"
#include "quantity.hpp"
#include "rough_motion.hpp"
#include "setup_keys.hpp"
#include "steady_forcing.hpp"
#include "steady_pull.hpp"

namespace shakedown {

namespace {

/// One thing about one run; alike ones of several runs become one message.
struct Finding {
  std::string kind;
  bool impossible = false;
  std::string run;
  Violation violation;
};

/// Returns three digits and a unit.
std::string rounded(double si, const char* unit) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.3g", si);
  return write_quantity(std::strtod(digits, nullptr), unit);
}
std::string rounded_mm(double metres) { return rounded(metres, "mm"); }

/// Returns the frame rate at which cameras run, Hz, that is within 5 % of this one; else this one.
double usual_rate_near(double rate) {
  constexpr std::array<double, 14> usual{24, 25, 30, 48, 50, 60, 90, 100, 120, 200, 240, 480, 500, 960};
  for (const double one : usual)
    if (std::abs(rate / one - 1) < 0.05) return one;
  return rate;
}

std::string factor_text(double factor) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", factor);
  return text;
}

class RunCheck {
 public:
  /// Begins without wrong frames, which say nothing of units, origins and columns.
  RunCheck(const MeasuredRun& run, const Setup& setup, std::vector<Finding>& findings)
      : run_(run),
        setup_(setup),
        rests_at_(steady_pull(setup).rest),
        findings_(findings),
        audit_(audit_run(run)),
        motion_(rough_motion(run.time, audit_.x_box)) {}

  void check() {
    if (!check_frames()) return;
    if (!std::isfinite(motion_.frequency)) {
      if (motion_.unbroken > 0)
        add("still", true, "box", "does not swing (or less than one and a half times)",
            "look whether this is the column of the box, and whether the recording is long enough; leave a "
            "film of the box at rest out");
      return;
    }
    if (!check_clock() || !check_rate()) return;
    if (!check_scale()) return;
    check_side();
    check_origin();
    check_start();
    if (check_columns()) check_grains();
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

  /// Reports recordings with more than two thirds of their time in no stretch of five frames: noise and its
  /// memory are found from frames in a row, and without them any model would do.
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
    constexpr double absurd = 30, doubtful = 1.5;
    // Grains that move with the box lower its frequency to this share at most.
    const double grains = static_cast<double>(setup_.grains.count) * setup_.grains.mass,
                 carried = std::sqrt(setup_.box.mass / (setup_.box.mass + grains));
    const auto may_be = [&](double frequency) {
      const double times = frequency / setup_.spring.frequency;
      return times < doubtful && times > carried / doubtful;
    };
    // A force that drives the box sets the pace when the release has died away.
    if (may_be(motion_.frequency) || may_be(motion_.first_frequency)) return true;
    const double ratio = motion_.frequency / setup_.spring.frequency;
    const bool far = ratio > absurd || ratio < 1 / absurd;
    const std::string found = "the box swings at " + rounded(motion_.frequency, "Hz") +
                              " where the spring of the setup has " + rounded(setup_.spring.frequency, "Hz") +
                              " (" + factor_text(ratio) + " times)";
    const double thousands = std::log10(ratio) / 3;
    if (far && std::abs(thousands - std::round(thousands)) < 0.1) {
      add("clock", true, "column.time", found + ": the clock is in another unit",
          ratio < 1 ? "write the smaller unit in [column.time]: unit = \"" +
                          std::string(thousands < -1.5 ? "us" : "ms") + "\" where it says s"
                    : "look at the unit of [column.time]");
      return false;
    }
    const double rate = 1 / (audit_.frame_interval * ratio);
    add("clock", true, "column.time", found,
        "write the frames a second of the motion itself, of slow motion those while filming (frame_rate = "
        "\"" +
            rounded(usual_rate_near(rate), "Hz") + "\" would fit); or correct spring.frequency");
    return false;
  }

  /// Reports fewer than ten frames a swing, which are needed between the landings of grains; a swing alone
  /// can do with six.
  bool check_rate() {
    constexpr double least = 10, least_alone = 6;
    const double frames = 1 / (motion_.frequency * audit_.frame_interval);
    if (frames >= (setup_.grains.count > 0 ? least : least_alone)) return true;
    add("rate", true, "column.time",
        "has " + factor_text(frames) + " frames a swing (" +
            factor_text(setup_.grains.count > 0 ? least : least_alone) +
            " are the least: with fewer any model would do)",
        "film with more frames a second, or leave this run out");
    return false;
  }

  bool check_scale() {
    if (!released()) return true;
    const double stated = std::abs(setup_.release.displacement - rests_at_);
    const double shown = std::max(motion_.amplitude, std::abs(motion_.first - motion_.centre));
    const double tens = std::log10(shown / stated);
    constexpr double near = 0.12;     // of a power of ten: 30 %
    constexpr double doubtful = 1.3;  // of what was set with a ruler
    const std::string found =
        "the box starts with a swing of " + rounded_mm(shown) +
        (rests_at_ == 0 ? " where release.displacement is " + rounded_mm(stated)
                        : " where that from release.displacement is " + rounded_mm(stated) +
                              " (the setup's steady forces hold the box at " + rounded_mm(rests_at_) + ")");
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
    if (shown > stated * doubtful || shown < stated / doubtful) {
      add("release", starts_at_rest(), "release.displacement", found,
          "write release.displacement = \"" +
              rounded_mm(std::copysign(shown, setup_.release.displacement - rests_at_) + rests_at_) +
              "\" under its [[run]], or correct the scale of the picture (pixel_size, unit)");
      return !starts_at_rest();
    }
    return true;
  }

  void check_side() {
    const double from_centre = motion_.first - motion_.centre;
    if (!released() || std::abs(from_centre) < 0.5 * motion_.amplitude) return;
    if ((from_centre > 0) == (setup_.release.displacement > rests_at_)) return;
    add("side", true, "column.box_position",
        "the box starts on the other side (" + rounded_mm(from_centre) +
            " from where it swings about; released at " + rounded_mm(setup_.release.displacement) + ")",
        "write reversed = true in [column.box_position] and [column.grain_centre], or turn the sign of "
        "release.displacement");
  }

  void check_origin() {
    if (starts_anywhere(run_, setup_) && !run_.origin_stated) return;  // unknown, and fitted
    constexpr double worth_saying = 0.01, absurd = 0.5;                // of the amplitude
    const double away = motion_.centre - rests_at_, off = std::abs(away);
    if (off < std::max(worth_saying * motion_.amplitude, 4 * motion_.centre_error)) return;
    const bool impossible = released() && off > absurd * motion_.amplitude;
    add("origin", impossible, "column.box_position.origin",
        "the box swings about x = " + rounded_mm(motion_.centre) + ", not about " +
            (rests_at_ == 0 ? "0 (where the spring is relaxed)"
                            : rounded_mm(rests_at_) + " (where the setup's steady forces hold it)"),
        run_.origin_stated
            ? "move the origin by " + (rests_at_ == 0 ? "that much" : rounded_mm(away)) +
                  ", unless a steady force pulls there"
            : "write origin = \"" + rounded_mm(away) +
                  "\" in [column.box_position] and [column.grain_centre], unless a steady force pulls there");
  }

  void check_start() {
    if (!released()) return;
    constexpr double worth_saying = 0.02;  // of a period
    const double least = worth_saying / motion_.frequency;
    // A box that is let go leaves its place slowly: shorter rests are a trigger's error, which is fitted.
    constexpr double surely = 0.15;  // of a period, as in prelude_of
    if (motion_.lead_in > surely / motion_.frequency) {
      add("lead-in", true, "run.release_time",
          "the box stands still for the first " + rounded(motion_.lead_in, "s"),
          "write release_time = \"" + rounded(run_.time.front() + motion_.lead_in, "s") +
              "\" under its [[run]] (plus what is stated there already)");
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

  bool starts_at_rest() const {
    constexpr double of_a_period = 0.02;
    return std::abs(motion_.start_delay) < std::max(of_a_period / motion_.frequency, 5 * motion_.delay_error);
  }

  /// Reports columns that are swapped: between impacts grains fly straight, and only the box swings like a
  /// spring.
  bool check_columns() {
    if (!run_.has_com()) return false;
    // What is shaken swings as it is shaken, box and grains alike, and its momentum is not the spring's
    // alone.
    if (is_driven(run_) || is_shaken(setup_)) return true;
    const RoughMotion grains = rough_motion(run_.time, audit_.x_com);
    const double box_off = distance_from_sine(run_.time, audit_.x_box, motion_.frequency, motion_.centre);
    const double grains_off = distance_from_sine(run_.time, audit_.x_com, grains.frequency, grains.centre);
    constexpr double clearly = 0.8;  // seen: 0.55 to 0.66 swapped, above 1.5 as it should be
    if (!(grains_off < clearly * box_off)) return true;
    // Grains that weigh more than their box shake it: then it is the spring's force that tells whose place it
    // is.
    if (!(unbalanced(audit_.x_com, audit_.x_box) < unbalanced(audit_.x_box, audit_.x_com))) return true;
    add("columns", true, "column.grain_centre",
        "swings like a spring and column.box_position does not: the two columns are swapped",
        "exchange what stands behind from in [column.box_position] and [column.grain_centre]");
    return false;
  }

  /// Returns the share of the momentum's change, box and grains as weighed, that no spring on `box` explains
  /// (of the sum of squares over windows of 0.6 periods): M x_box'' + N m x_com'' = -k x_box, k free, by
  /// parts as in the balance. 1 where nothing can be said.
  double unbalanced(const std::vector<double>& box, const std::vector<double>& grains) const {
    const double length = 0.6 / motion_.frequency, half = length / 2,
                 mass = static_cast<double>(setup_.grains.count) * setup_.grains.mass;
    double pushes = 0, pulls = 0, both = 0;
    for (double start = run_.time.front(); start + length <= run_.time.back(); start += half) {
      double push = 0, pull = 0;
      const double middle = start + half;
      const auto first = static_cast<std::size_t>(
          std::lower_bound(run_.time.begin(), run_.time.end(), start) - run_.time.begin());
      for (std::size_t i = std::max<std::size_t>(first, 1);
           i + 1 < run_.time.size() && run_.time[i] < start + length; ++i) {
        const double u = (run_.time[i] - middle) / half, dt = (run_.time[i + 1] - run_.time[i - 1]) / 2,
                     rest = 1 - u * u;
        const double bump = std::pow(rest, 4),
                     bent = (48 * u * u * rest * rest - 8 * rest * rest * rest) / (half * half);
        push += bent * (setup_.box.mass * box[i] + mass * grains[i]) * dt;
        pull += bump * box[i] * dt;
      }
      if (!std::isfinite(push) || !std::isfinite(pull)) continue;  // a frame is missing
      pushes += push * push, pulls += pull * pull, both += push * pull;
    }
    return pushes > 0 && pulls > 0 ? 1 - both * both / (pushes * pulls) : 1;
  }

  void check_grains() {
    if (const std::optional<Problem> problem =
            problem_of_grains(audit_.x_box, audit_.x_com, setup_.box.length))
      add("grains", true, "column.grain_centre", problem->problem, problem->remedy);
  }

  const MeasuredRun& run_;
  const Setup& setup_;
  const double rests_at_;
  std::vector<Finding>& findings_;
  RunAudit audit_;
  RoughMotion motion_;
};

/// Puts alike findings of several runs into one: the first with its numbers, and the names of the others.
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

}  // namespace

RecordingCheck check_recordings(const Experiment& experiment, const std::vector<Setup>& setups) {
  EXPECT(setups.size() == experiment.runs.size());
  RecordingCheck result;
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < setups.size(); ++i) RunCheck(experiment.runs[i], setups[i], findings).check();
  gather(findings, result);
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
    for (const std::string& note : {note_on_measured_grains(setup), note_on_pull(steady_pull(setup))})
      if (!note.empty() && std::find(check.notes.begin(), check.notes.end(), note) == check.notes.end())
        check.notes.push_back(note);
  check.notes.insert(check.notes.begin(), experiment.notes.begin(), experiment.notes.end());
  return check.notes;
}

}  // namespace shakedown
