// SPDX-License-Identifier: MIT
// Frequencies, stroke and landing, ensembles, the model's own rules.
#include <fmt/format.h>

#include <cmath>

#include "paper.hpp"
#include "theory.hpp"

namespace shakedown {

namespace {

std::string at(const DamperRuns& runs) { return fmt::format("L = {:g} mm, {}", 1e3 * runs.setup.box.length, runs.engine); }

/// Both engines at the four lengths that were measured.
template <class F>
void at_measured_lengths(const PaperRuns& runs, F f) {
  for (std::size_t i = 0; i < 4; ++i) f(runs.hard[i]), f(runs.soft[i]);
}

Statement frequency(const PaperRuns& runs) {
  Statement s{"frequency", "The damper's frequency is the same for all box lengths.", "1.05 +- 0.01 Hz", "every length within 1.05 +- 0.02 Hz (two of the paper's standard deviations)"};
  std::vector<Judgement> all;
  at_measured_lengths(runs, [&](const DamperRuns& r) {
    s.findings.push_back(finding_of(at(r), r.over([](const RunReading& run) { return run.seen.frequency; }), "Hz"));
    all.push_back(judge(s.findings.back(), 1.03, 1.07));
  });
  s.judgement = all_of(all);
  s.remark = "The model agrees at 40, 65 and 85 mm. At 104 mm the grains are apart from the box for longer and the box swings faster: the frequency is not the same for all lengths.";
  return s;
}

Statement beam() {
  const Theory theory = theory_of(Setup{});
  Statement s{"beam frequency", "The blade's beam formula gives k and the frequency of the empty box.", "0.0254 N/mm, 1.217 Hz", "within rounding"};
  s.findings = {exact("k of the blade", theory.beam_stiffness, "N/m"), exact("frequency", theory.beam_frequency, "Hz"), exact("k used", theory.stiffness, "N/m")};
  s.judgement = all_of({judge(s.findings[0], 25.35, 25.45), judge(s.findings[1], 1.2165, 1.218)});
  s.remark = "The formula holds, but the simulations use 1.23 Hz, that is k = 25.92 N/m: 2 % more than the blade.";
  return s;
}

Statement side_walls(const PaperRuns& runs) {
  Statement s{"side walls", "The side walls are unimportant for the damper.", "no number", "the decay's slope at 40 mm changes by less than a tenth when side walls are elastic"};
  for (const DamperRuns& r : runs.hard) s.findings.push_back(finding_of("share of the loss, " + at(r), r.over([](const RunReading& run) { return run.seen.energy_loss[2]; }), "of E0"));
  const Statistic plain = runs.hard[0].over([](const RunReading& run) { return run.seen.slope; }), elastic = runs.elastic_side_walls.over([](const RunReading& run) { return run.seen.slope; });
  const double spread = std::hypot(plain.sd / std::sqrt(plain.n), elastic.sd / std::sqrt(elastic.n)) / std::abs(plain.mean), change = elastic.mean / plain.mean - 1;
  s.findings.push_back({"change of slope with elastic side walls, L = 40 mm, hard", 100 * change, 100 * (change - 2 * spread), 100 * (change + 2 * spread), "%"});
  s.judgement = judge(s.findings.back(), -10, 10);
  s.remark = "Imprecise: they take an eighth (40 mm) to more than a fifth (311 mm) of the energy; but when they take none, grains and end walls take it instead, and the decay is even a little faster.";
  return s;
}

Statement repeatability(const PaperRuns& runs) {
  Statement s{"single runs", "Single realisations represent the averages.", "no number", "a run's rms deviation from the mean below 2 % of the release, at the measured lengths"};
  std::vector<Judgement> all;
  for (const DamperRuns& r : runs.hard) {
    s.findings.push_back(exact("x_box, one run about the mean, " + at(r), 1e3 * r.rms_of_one_run_box, "mm"));
    if (r.setup.box.length < 0.2) all.push_back(judge(s.findings.back(), 0, 0.02 * 107.5));
  }
  s.findings.push_back(exact("x_com, " + at(runs.hard[3]), 1e3 * runs.hard[3].rms_of_one_run_centre, "mm"));
  s.judgement = all_of(all);
  s.remark = "True of the box at 40 to 104 mm; at 311 mm a single run tells less.";
  return s;
}

Statement threshold(const PaperRuns& runs) {
  Statement s{"elastic threshold", "Smaller values of the elastic threshold do not change the results.", "no number", "slopes change by less than 2 % when all thresholds are divided by 3"};
  std::vector<Judgement> all;
  for (const auto& [plain, finer] : {std::pair(&runs.hard[0], &runs.finer[0]), std::pair(&runs.hard[3], &runs.finer[1])}) {
    const Statistic a = plain->over([](const RunReading& run) { return run.seen.slope; }), b = finer->over([](const RunReading& run) { return run.seen.slope; });
    const double change = b.mean / a.mean - 1, spread = std::hypot(a.sd / std::sqrt(a.n), b.sd / std::sqrt(b.n)) / std::abs(a.mean);
    s.findings.push_back({"change of slope, " + at(*plain), 100 * change, 100 * (change - 2 * spread), 100 * (change + 2 * spread), "%"});
    all.push_back(judge(s.findings.back(), -2, 2));
  }
  s.judgement = all_of(all);
  s.remark = "As printed the rule has no magnitude: every approaching impact on one side would be elastic. Taken as |n.(v - v_box)|. Grains stall against each other too, which the paper does not mention; both rules are divided by 3 here.";
  return s;
}

Statement scaling(const PaperRuns& runs) {
  Statement s{"scaling with f", "Results scale trivially with the frequency: the model has one time scale.", "no number",
              "at twice the frequency the eighth peak is as high, and 95 % of the energy gone after as many cycles, within 2 % (L = 40 mm)"};
  const auto ratio = [&](const std::string& what, double (*number)(const RunReading&), double factor) {
    const Statistic once = runs.hard[0].over(number), twice = runs.twice_the_frequency.over(number);
    const double value = factor * twice.mean / once.mean, spread = std::hypot(once.sd / once.mean / std::sqrt(once.n), twice.sd / twice.mean / std::sqrt(twice.n));
    s.findings.push_back({what + ", f = 2.46 Hz over f = 1.23 Hz", value, value * (1 - 2 * spread), value * (1 + 2 * spread), ""});
    return judge(s.findings.back(), 0.98, 1.02);
  };
  s.judgement = all_of({ratio("eighth peak", [](const RunReading& run) { return run.seen.peaks.size() < 8 ? absent : std::abs(run.seen.peaks[7].position); }, 1),
                        ratio("cycles to lose 95 %", [](const RunReading& run) { return run.seen.seconds_to_energy_fraction[3]; }, 2)});
  s.remark = "Only thresholds in m/s (and the soft engine's contact time) break the scaling, and they do not show.";
  return s;
}

Statement leaving(const PaperRuns& runs) {
  Statement s{"leaving at mid-stroke", "The granulate leaves the wall at mid-stroke with the box's top speed.", "ratio 1 at x = 0", "speed ratio within 0.95 to 1.05 and top speed within 5 % of the release from the middle (L = 311 mm)"};
  for (const DamperRuns* r : {&runs.hard[4], &runs.soft[4]}) {
    s.findings.push_back(finding_of("speed of the grains' centre over the box's top speed, " + at(*r), r->over(&RunReading::leaving_speed_ratio), ""));
    s.findings.push_back(finding_of("|x_box| over release at top speed, " + at(*r), r->over(&RunReading::leaving_phase), ""));
  }
  s.judgement = all_of({judge(s.findings[0], 0.95, 1.05), judge(s.findings[1], -1, 0.05), judge(s.findings[2], 0.95, 1.05), judge(s.findings[3], -1, 0.05)});
  return s;
}

Statement times_to_peak(const PaperRuns& runs) {
  Statement s{"t_g,peak", "The landing is on the outward stroke, f t_g,peak < 1/4, for all lengths but 104 mm.", "< 1/4 for 40, 65, 85 mm; > 1/4 for 104 mm", "the printed formula, with f of the empty box and with f_loaded"};
  bool with_empty = true, with_loaded = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const Theory theory = theory_of(runs.hard[i].setup);
    const double loaded = theory.loaded_frequency * theory.time_to_peak, length = runs.hard[i].setup.box.length;
    s.findings.push_back(exact(fmt::format("f t_g,peak, L = {:g} mm", 1e3 * length), theory.phase_to_peak, ""));
    s.findings.push_back(exact(fmt::format("f_loaded t_g,peak, L = {:g} mm", 1e3 * length), loaded, ""));
    with_empty = with_empty && (theory.phase_to_peak < 0.25) == (i < 3);
    with_loaded = with_loaded && (loaded < 0.25) == (i < 3);
  }
  s.judgement = with_empty || with_loaded ? Judgement::holds : Judgement::fails;
  s.remark = "Wrong as printed: with f only 40 mm lies below 1/4, with f_loaded 40 and 65 mm; 85 mm never does. The inequality for the favourable range, n + 1/4 > f t_g,peak > n + 1, cannot be met by any number; n + 1/4 < f t_g,peak < n + 1 is meant.";
  return s;
}

Statement time_through_box(const PaperRuns& runs) {
  const Theory theory = theory_of(runs.hard[3].setup);
  Statement s{"t_g,Box", "f t_g,Box is about 0.15 for L = 104 mm.", "0.15", "within 0.01"};
  s.findings = {exact("f t_g,Box, L = 104 mm", theory.phase_through_box, ""), exact("f_loaded t_g,Box, L = 104 mm", theory.loaded_frequency * theory.time_through_box, "")};
  s.judgement = judge(s.findings[0], 0.14, 0.16);
  s.remark = "0.144 with f of the empty box (0.15 by generous rounding), 0.124 with f_loaded: their omega is f.";
  return s;
}

}  // namespace

std::vector<Statement> statements_of_motion(const PaperRuns& runs) {
  return {frequency(runs), beam(), side_walls(runs), repeatability(runs), threshold(runs), scaling(runs), leaving(runs), times_to_peak(runs), time_through_box(runs)};
}

}  // namespace shakedown
