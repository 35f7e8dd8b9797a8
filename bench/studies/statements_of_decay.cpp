// SPDX-License-Identifier: MIT
// Judges statements on the linear decay, the friction-damped oscillator and the fitted restitutions.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "linear_decay.hpp"
#include "paper.hpp"

namespace shakedown {

namespace {

Statement cycles(const PaperRuns& runs) {
  Statement s{
      "cycles to rest",
      "The cycles before oscillations are sufficiently damped fall from 13 to 4 as the box gets longer.",
      "13 (40 mm) to 4 (104 mm)",
      "as many whole cycles until the first peak below 10 mm (the paper does not say what \"sufficiently\" "
      "is), both engines"};
  std::vector<Judgement> all;
  for (std::size_t i = 0; i < 4; ++i)
    for (const DamperRuns* r : {&runs.hard[i], &runs.soft[i]}) {
      s.findings.push_back(finding_of(name_of(*r), r->over([](const RunReading& run) {
        return run.seen.first_small_peak * run.seen.frequency;
      }),
                                      "cycles"));
      if (i == 0) all.push_back(judge(s.findings.back(), 13, 14));
      if (i == 3) all.push_back(judge(s.findings.back(), 4, 5));
    }
  s.judgement = all_of(all);
  return s;
}

/// Returns rms about the line over rms about the exponential, over the first peaks.
double straightness(const RunReading& run) {
  std::vector<Peak> peaks = peaks_of_the_decay(run.seen.peaks, run.seen.small_peak);
  if (peaks.size() > regime_peaks) peaks.resize(regime_peaks);
  const Decay decay = decay_through(peaks);
  return decay.linear.rms / decay.exponential.rms;
}

/// Returns how much the slope changes over the decay, as a fraction of it.
double bending(const RunReading& run) {
  const std::vector<Peak> peaks = peaks_of_the_decay(run.seen.peaks, run.seen.small_peak);
  if (peaks.size() < 4) return absent;
  return run.seen.decay.curvature * (peaks.back().time - peaks.front().time) / run.seen.decay.linear.slope;
}

Statement linear(const PaperRuns& runs) {
  Statement s{"linear decay",
              "The peaks fall along a straight line, as under dry friction, not along an exponential.",
              "linear",
              "a line fits and an exponential does not: at most half its rms, first eight peaks, 40 to 104 "
              "mm, both engines"};
  std::vector<Judgement> all;
  for (std::size_t i = 0; i < 4; ++i)
    for (const DamperRuns* r : {&runs.hard[i], &runs.soft[i]}) {
      s.findings.push_back(finding_of("rms ratio, " + name_of(*r), r->over(straightness), ""));
      all.push_back(judge(s.findings.back(), -1, 0.5));
    }
  s.judgement = all_of(all);
  return s;
}

Statement strictly_linear(const PaperRuns& runs) {
  Statement s{"strictly linear",
              "\"A linear decay of the amplitude is observed\", without limits in length or time.",
              "no number",
              "the slope changes by less than a tenth between the first peak and the last (t < 8 s, above 10 "
              "mm), 40 to 104 mm, hard engine"};
  std::vector<Judgement> all;
  for (std::size_t i = 0; i < 4; ++i) {
    s.findings.push_back(
        finding_of("change of slope, " + name_of(runs.hard[i]), runs.hard[i].over(bending), "of the slope"));
    all.push_back(judge(s.findings.back(), -0.1, 0.1));
  }
  s.judgement = all_of(all);
  s.remark =
      "Strictly only at 40 mm before 8 s, and over the few peaks at 104 mm. At 65 and 85 mm the slope falls "
      "by a third to a half as collecting and colliding breaks down: near enough for the eye, too far for a "
      "claim of linearity.";
  return s;
}

Statement friction(const PaperRuns& runs) {
  Statement s{"effective friction",
              "The third peak gives an effective friction mu M_tot that compares dampers.",
              "no number printed", "its numbers are ours within their intervals; the paper prints none"};
  for (std::size_t i = 0; i < 5; ++i)
    for (const DamperRuns* r : {&runs.hard[i], &runs.soft[i]})
      s.findings.push_back(finding_of(name_of(*r), r->over(&RunReading::friction), "mN", 1e3));
  s.remark =
      "The printed denominator 2n + 1 - (-1)^(2n) equals 2n: its last two terms cancel for every n, odd or "
      "even.";
  return s;
}

Statement friction_curve(const PaperRuns& runs) {
  Statement s{
      "friction curve",
      "The friction-damped oscillator fits the measured dampers well, and the optimal one not as well.",
      "fits 40 to 104 mm, not 311 mm",
      "the share of x_box that it explains until the first peak below 10 mm is larger at each of 40 to 104 "
      "mm than at 311 mm (hard engine); how much is \"well\" the paper does not say"};
  for (const DamperRuns& r : runs.hard)
    s.findings.push_back(finding_of("R^2, " + name_of(r), r.over(&RunReading::friction_curve_r2), ""));
  const Finding& optimal = s.findings.back();
  std::vector<Judgement> all;
  for (std::size_t i = 0; i < 4; ++i)
    all.push_back(s.findings[i].low > optimal.high   ? Judgement::holds
                  : s.findings[i].high < optimal.low ? Judgement::fails
                                                     : Judgement::cannot_tell);
  s.judgement = all_of(all);
  s.remark =
      "At 40 mm it explains less than 0.9: its frequency is f_loaded, 1.06 Hz, and over 13 cycles the phase "
      "runs away from the damper's own 1.048 Hz; the envelope fits better than the curve.";
  return s;
}

Statement root_energy(const PaperRuns& runs) {
  Statement s{
      "root of the energy", "The square root of the total energy falls linearly, with steps.",
      "linear, with steps",
      "the line leaves less than an exponential does, and the energy stands still (less than a fifth of the "
      "mean rate) for more of the time than a viscous damper's 20 %, 40 to 104 mm, hard engine"};
  std::vector<Judgement> all;
  for (std::size_t i = 0; i < 4; ++i) {
    s.findings.push_back(
        finding_of("rms about the line over that about an exponential, " + name_of(runs.hard[i]),
                   runs.hard[i].over(&RunReading::energy_line_ratio), ""));
    all.push_back(judge(s.findings.back(), -1, 1));
    s.findings.push_back(finding_of("R^2 of the line, " + name_of(runs.hard[i]),
                                    runs.hard[i].over(&RunReading::energy_line_r2), ""));
    s.findings.push_back(finding_of("share of time on steps, " + name_of(runs.hard[i]),
                                    runs.hard[i].over(&RunReading::energy_flat), ""));
    all.push_back(judge(s.findings.back(), 0.2, 1));
  }
  s.judgement = all_of(all);
  return s;
}

Statement fitted_restitutions(const PaperRuns& runs) {
  Statement s{"fitted restitutions", "The fit to L = 40 mm gives both restitutions to two digits.",
              "0.75 and 0.76",
              "95 % intervals no wider than the printed digits, +- 0.005, both fitted to two filmed runs at "
              "40 mm of the soft engine with 0.75 and 0.76"};
  std::vector<Judgement> all;
  for (const FittedParameter& p : runs.puzzle.as_the_paper.parameters) {
    s.findings.push_back({p.key, p.value, p.low, p.high, ""});
    all.push_back(p.high - p.low <= 0.01 ? Judgement::holds : Judgement::fails);
  }
  s.findings.push_back(
      exact("correlation of the two estimates", runs.puzzle.as_the_paper.correlation(0, 1), ""));
  s.judgement = all_of(all);
  s.remark =
      "The box at 40 mm tells one combination of the two sharply and the other hardly: two digits for both "
      "is more than the data hold. With one of them known, the other is known to about +- 0.01.";
  return s;
}

Statement puzzle(const PaperRuns& runs) {
  Statement s{"the puzzle",
              "The drop test gives 0.95 for two grains, the fit 0.75, perhaps for want of grain friction.",
              "0.95 against 0.75",
              "with some friction up to 0.5 the frictionless fit to grains of 0.95 has 0.75 in its 95 % "
              "interval; fails when every interval lies above 0.755"};
  std::vector<Judgement> points;
  for (const PuzzlePoint& point : runs.puzzle.points) {
    const FittedParameter& p = point.one.parameters.front();
    s.findings.push_back({fmt::format("fitted grain-grain restitution, friction {:g}", point.friction),
                          p.value, p.low, p.high, ""});
    points.push_back(p.low <= 0.75 && 0.75 <= p.high ? Judgement::holds
                     : p.low > 0.755                 ? Judgement::fails
                                                     : Judgement::cannot_tell);
  }
  s.findings.push_back(exact("smallest friction of these whose fit is 0.75 within interval and rounding",
                             friction_that_looks_like(runs.puzzle, 0.75), ""));
  const auto any = [&](Judgement wanted) {
    return std::find(points.begin(), points.end(), wanted) != points.end();
  };
  s.judgement = any(Judgement::holds)         ? Judgement::holds
                : any(Judgement::cannot_tell) ? Judgement::cannot_tell
                                              : Judgement::fails;
  s.remark =
      "The paper's guess accounts for its puzzle, and more: the fitted value falls steeply to 0.78 at a "
      "friction of 0.1 and then stays about 0.75 whatever the friction. 0.75 is what a frictionless model "
      "makes of any grains of 0.95 that rub.";
  return s;
}

}  // namespace

std::vector<Statement> statements_of_decay(const PaperRuns& runs) {
  return {cycles(runs),         linear(runs),      strictly_linear(runs),     friction(runs),
          friction_curve(runs), root_energy(runs), fitted_restitutions(runs), puzzle(runs)};
}

}  // namespace shakedown
