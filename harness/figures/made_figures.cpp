// SPDX-License-Identifier: MIT
#include "made_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "effects.hpp"
#include "errors.hpp"
#include "known_effects.hpp"

namespace shakedown {

namespace {

/// Returns a number, the mean of an ensemble, or NaN.
double number_in(const Json& value) {
  if (value.is_object()) return number_in(value.at("mean"));
  return value.is_null() ? std::nan("") : value.get<double>();
}
double spread_in(const Json& value) { return value.is_object() ? number_in(value.at("sd")) : 0; }

std::vector<double> numbers_in(const Json& list) {
  std::vector<double> numbers;
  for (const Json& one : list) numbers.push_back(number_in(one));
  return numbers;
}

std::vector<double> times(double factor, std::vector<double> values) {
  for (double& value : values) value *= factor;
  return values;
}

/// Makes a panel for each wanted run; `fill` adds its curves.
template <class Fill>
Figure by_run(const Json& curves, const FigureRequest& request, Fill&& fill) {
  Figure figure;
  std::string runs;
  for (const Json& curve : curves) {
    const std::string run = curve.at("run").get<std::string>();
    if (curve.at("observable") != request.observable) continue;
    runs += (runs.empty() ? "" : ", ") + run;
    if (!request.run.empty() && run != request.run) continue;
    Panel panel;
    panel.title = run, panel.x_label = "time since release, s";
    fill(curve, panel);
    figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty())
    throw InputError({{{"--run", 0, 0},
                       "",
                       runs.empty() ? "the " + request.observable + " was not followed in any run"
                                    : "'" + request.run + "' is no run of the result",
                       runs.empty() ? "draw the box" : "it has " + runs}});
  if (figure.panels.size() == 1) figure.panels.front().title.clear();
  return figure;
}

const char* word_of(const std::string& observable) {
  return observable == "box" ? "position of the box, mm" : "grains' centre, mm";
}

/// Draws the peaks of simulated runs, which fall along a straight line.
Figure peaks_figure(const Json& result) {
  FigureCurve peaks{"peaks", Look::measured, {}, {}, {}, true};
  const Json &heights = result.at("peaks_mm"), &moments = result.at("peak_times_s");
  for (std::size_t i = 0; i < heights.size() && i < moments.size(); ++i) {
    peaks.x.push_back(number_in(moments[i]));
    peaks.y.push_back(std::abs(number_in(heights[i])));
    peaks.errors.push_back(spread_in(heights[i]));
  }
  Figure figure;
  Panel& panel = figure.panels.emplace_back();
  panel.x_label = "time since release, s", panel.y_label = "amplitude of the swing, mm";
  const Json& decay = result.at("decay");
  const double count = number_in(decay.at("peaks"));
  if (std::isfinite(count) && count >= 2 && !peaks.x.empty()) {
    const std::size_t last = std::min(peaks.x.size(), static_cast<std::size_t>(count)) - 1;
    FigureCurve line{"straight line", Look::model, {}, {}, {}, false},
        fall{"exponential", Look::as_given, {}, {}, {}, false};
    const Json &linear = decay.at("linear"), &exponential = decay.at("exponential");
    constexpr int parts = 60;
    for (int i = 0; i <= parts; ++i) {
      const double t = peaks.x[last] * i / parts;
      line.x.push_back(t), fall.x.push_back(t);
      line.y.push_back(number_in(linear.at("intercept_mm")) + number_in(linear.at("slope_mm_per_s")) * t);
      fall.y.push_back(number_in(exponential.at("amplitude_mm")) *
                       std::exp(-number_in(exponential.at("rate_per_s")) * t));
    }
    panel.curves = {line, fall};
  }
  panel.curves.insert(panel.curves.begin(), std::move(peaks));
  panel.through_zero = true;
  return figure;
}

std::string words_of(const Json& effects) {
  std::string words;
  for (const Json& one : effects) {
    const std::string effect = one.get<std::string>();
    const EffectRecord* record = find_effect(effect);
    words += (words.empty() ? "" : " + ") + (effect == "unknown" ? std::string("something in no list")
                                             : record != nullptr && !record->label.empty()
                                                 ? std::string(record->label)
                                                 : effect);
  }
  return words.empty() ? "nothing is missing" : words;
}

constexpr std::array more_looks{Look::as_given, Look::second, Look::third, Look::fourth};

Figure energy_shares(const Json& result) {
  Figure figure;
  Panel& panel = figure.panels.emplace_back();
  panel.x_label = "share of the energy at release, %";
  double left = 100;
  const auto add = [&](const std::string& label, const Json& share) {
    panel.bars.push_back({label, 100 * number_in(share)});
    left -= panel.bars.back().value;
  };
  const Json& lost = result.at("energy_loss");
  add("lost between grains", lost.at("grain_grain"));
  add("lost at end walls", lost.at("end_wall"));
  add("lost at side walls", lost.at("side_wall"));
  for (const auto& [effect, share] : result.at("effect_energy_loss").items())
    add("taken by " + words_of(Json::array({effect})), share);
  panel.bars.push_back({"left at the end", left});
  return figure;
}

}  // namespace

Figure decay_figure(const Json& result, const FigureRequest& request) {
  if (!result.contains("curves")) return peaks_figure(result);
  return by_run(result.at("curves"), request, [&](const Json& curve, Panel& panel) {
    panel.y_label = word_of(request.observable);
    const std::vector<double> time = numbers_in(curve.at("time_s")), model = numbers_in(curve.at("model_mm")),
                              spread = numbers_in(curve.at("spread_mm"));
    const std::vector<double> given = numbers_in(curve.at("as_given_mm"));
    FigureBand band{"two expected spreads", time, model, model};
    for (std::size_t i = 0; i < time.size(); ++i)
      band.low[i] -= 2 * spread.at(i), band.high[i] += 2 * spread.at(i);
    panel.bands = {band};
    if (given != model) panel.curves.push_back({"as given", Look::as_given, time, given, {}, false});
    panel.curves.push_back({"model", Look::model, time, model, {}, false});
    panel.curves.push_back({"measured", Look::measured, time, numbers_in(curve.at("measured_mm")), {}, true});
  });
}

Figure residuals_figure(const Json& result, const FigureRequest& request) {
  return by_run(result.at("curves"), request, [&](const Json& curve, Panel& panel) {
    panel.y_label = "measured less model, mm", panel.through_zero = true;
    const std::vector<double> time = numbers_in(curve.at("time_s")),
                              spread = times(2, numbers_in(curve.at("spread_mm")));
    panel.bands = {{"two expected spreads", time, times(-1, spread), spread}};
    panel.curves = {{request.observable == "box" ? "box" : "grains' centre",
                     Look::measured,
                     time,
                     numbers_in(curve.at("residual_mm")),
                     {},
                     true}};
  });
}

Figure ladder_figure(const Json& result) {
  Figure figure;
  Panel& panel = figure.panels.emplace_back();
  panel.x_label = "error of the box, mm (rms)";
  figure.floor_name = "noise and spread";
  const auto floor_of = [](const Json& of) { return number_in(of.at("noise_floor").at("box_mm")); };
  bool held_out = false;
  for (const Json& step : result.at("ladder")) {
    const double second = number_in(step.at("held_out_error_box_mm"));
    held_out = held_out || std::isfinite(second);
    panel.bars.push_back({step.at(step.contains("step") ? "step" : "setup").get<std::string>(),
                          number_in(step.at("error_box_mm")), second});
    if (step.contains("noise_floor")) panel.floor = floor_of(step);
  }
  if (result.contains("noise_floor")) panel.floor = floor_of(result);
  if (held_out) figure.bar_name = "fitted to", figure.second_name = "foretold from the other box lengths";
  return figure;
}

std::vector<Json> energy_plots_of(const Json& report) {
  std::vector<Json> plots;
  if (!report.contains("sections")) return plots;
  for (const Json& section : report.at("sections"))
    if (section.contains("plots"))
      for (const Json& plot : section.at("plots"))
        if (plot.value("title", "") == "Energy") plots.push_back(plot);
  return plots;
}

Figure energy_figure(const Json& result, const FigureRequest& request) {
  if (result.contains("energy_loss")) return energy_shares(result);
  Json named = Json::array();
  for (Json plot : energy_plots_of(result)) {
    plot["run"] = plot.at("group"), plot["observable"] = request.observable;
    named.push_back(std::move(plot));
  }
  return by_run(named, request, [](const Json& plot, Panel& panel) {
    panel.x_label = plot.at("x_label").get<std::string>(),
    panel.y_label = plot.at("y_label").get<std::string>();
    panel.through_zero = true;
    const std::vector<double> time = numbers_in(plot.at("x"));
    for (const Json& curve : plot.at("curves")) {
      const std::size_t k = panel.curves.size();
      panel.curves.push_back({curve.at("name").get<std::string>(),
                              k == 0 ? Look::model : more_looks[(k - 1) % more_looks.size()],
                              time,
                              numbers_in(curve.at("y")),
                              {},
                              false});
    }
  });
}

Figure probabilities_figure(const Json& result) {
  Figure figure;
  Panel& panel = figure.panels.emplace_back();
  panel.x_label = "probability, %";
  constexpr double least = 0.005;
  constexpr std::size_t most = 12;
  if (result.contains("laws")) {
    for (const Json& law : result.at("laws")) {
      std::string name = law.at("law").get<std::string>();
      if (name == "curve") name = "none of these";
      if (law.at("air") == "free") name += " and air";
      const double probability = number_in(law.at("probability"));
      if (probability >= least && panel.bars.size() < most) panel.bars.push_back({name, 100 * probability});
    }
    std::stable_sort(panel.bars.begin(), panel.bars.end(),
                     [](const FigureBar& a, const FigureBar& b) { return a.value > b.value; });
    return figure;
  }
  const Json answers = result.value("answer_set", Json::array());
  for (const Json& hypothesis : result.at("hypotheses")) {
    const double probability = number_in(hypothesis.at("probability"));
    const bool tied =
        answers.size() > 1 && std::any_of(answers.begin(), answers.end(), [&](const Json& answer) {
          return answer.at("effects") == hypothesis.at("effects");
        });
    if (panel.bars.size() == most || (probability < least && !tied)) continue;
    panel.bars.push_back({words_of(hypothesis.at("effects")), 100 * probability, std::nan(""), tied});
    if (tied) figure.tied_name = "not told apart";
  }
  return figure;
}

Figure restitution_figure(const Json& result) {
  Figure figure;
  Panel& panel = figure.panels.emplace_back();
  panel.x_label = "speed of impact, m/s", panel.y_label = "coefficient of restitution";
  FigureBand band{"95 %", {}, {}, {}};
  FigureCurve law{result.at("law").get<std::string>(), Look::model, {}, {}, {}, false},
      averaged{"averaged over the laws", Look::as_given, {}, {}, {}, false},
      impacts{"impacts", Look::measured, {}, {}, {}, true};
  for (const Json& at : result.at("restitution")) {
    const double speed = number_in(at.at("speed_m_per_s"));
    const Json& told = at.at("restitution");
    band.x.push_back(speed), law.x.push_back(speed), averaged.x.push_back(speed);
    band.low.push_back(number_in(told.at("low"))), band.high.push_back(number_in(told.at("high")));
    law.y.push_back(number_in(told.at("value")));
    averaged.y.push_back(number_in(at.at("averaged").at("value")));
  }
  for (const Json& one : result.at("impacts"))
    impacts.x.push_back(number_in(one.at("speed_m_per_s"))),
        impacts.y.push_back(number_in(one.at("restitution")));
  panel.bands = {band};
  panel.curves = {law, averaged, impacts};
  return figure;
}

}  // namespace shakedown
