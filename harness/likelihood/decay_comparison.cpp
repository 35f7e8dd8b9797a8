// SPDX-License-Identifier: MIT
#include "decay_comparison.hpp"

#include <cmath>

#include "experiment.hpp"
#include "frame_motion.hpp"
#include "in_order.hpp"
#include "landings.hpp"
#include "observables.hpp"
#include "printed_text.hpp"
#include "random.hpp"
#include "statistic.hpp"

namespace shakedown {

namespace {

struct Numbers {
  double frequency = absent, slope = absent;
  std::vector<double> peaks;
  std::string why_not;
  std::optional<SteadyState> steady{};
  std::vector<Landing> landings{};
};

/// Holds the frames of one run that take part: those with a position, from the run's start to the end of what
/// still moves.
struct UsedFrames {
  std::vector<double> time, x, centre;  ///< s, m; centre of the grains: empty where it was not tracked
  double middle = 0;                    ///< m, about which the recorded box swings
};

UsedFrames used_frames(const Measurement::Run& run, double end) {
  const MeasuredRun& recorded = run.recorded;
  const RunAudit& audit = run.audit;
  const Setup& setup = run.setup;
  const bool anywhere = starts_anywhere(recorded, setup);
  const double start = anywhere ? audit.release.start : std::max(0.0, audit.release.start);
  UsedFrames used;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < recorded.time.size(); ++i)
    if (std::isfinite(audit.x_box[i]) && recorded.time[i] >= start && recorded.time[i] <= end)
      used.time.push_back(recorded.time[i]), used.x.push_back(audit.x_box[i]), numbers.push_back(i);
  if (!audit.x_com.empty())
    for (const std::size_t i : numbers) used.centre.push_back(audit.x_com[i]);
  if (anywhere && std::isfinite(audit.release.centre)) used.middle = audit.release.centre;
  return used;
}

/// Returns the places at other times, along straight lines. Between the samples of a simulation, 500 a
/// second, these are off by less than a micrometre for each centimetre of amplitude.
std::vector<double> at_times(const std::vector<double>& times, const std::vector<double>& time,
                             const std::vector<double>& place) {
  std::vector<double> x;
  std::size_t after = 1;
  for (const double t : times) {
    while (after + 1 < time.size() && time[after] < t) ++after;
    const double share = (t - time[after - 1]) / (time[after] - time[after - 1]);
    x.push_back(place[after - 1] + share * (place[after] - place[after - 1]));
  }
  return x;
}

/// Returns the steady state of a forced run from frames on any clock. Straight lines join the frames; a cubic
/// between them would be off where grains land.
std::optional<SteadyState> steady_by_frames(const Setup& setup, const std::vector<double>& time,
                                            const std::vector<double>& x, const std::vector<double>& centre) {
  const std::optional<SteadyForcing> forcing = steady_forcing_of(setup);
  if (!forcing || time.size() < 2) return {};
  const double cycles = (time.back() - time.front()) * forcing->frequency;
  if (cycles < steady_cycles || static_cast<double>(time.size()) < fewest_samples_a_cycle * cycles) return {};
  Trajectory even;
  const double step = 1 / (samples_a_cycle * forcing->frequency);
  for (double t = 0; t <= time.back(); t += step) even.time.push_back(t);
  // What comes before the first frame is not looked at.
  const auto resampled = [&](const std::vector<double>& place) {
    std::vector<double> values = at_times(even.time, time, place);
    for (std::size_t i = 0; i < values.size() && even.time[i] < time.front(); ++i) values[i] = place.front();
    return values;
  };
  even.x_box = resampled(x);
  Setup seen = setup;
  if (centre.empty())
    seen.grains.count = 0;
  else
    even.x_com = resampled(centre);
  return steady_state_if_any(seen, even);
}

/// Returns the first landings of a run that is not forced.
std::vector<Landing> landings_of(const UsedFrames& frames, const Setup& setup) {
  constexpr std::size_t most = 12;  // later ones are slow, and chaos has parted the runs
  if (frames.centre.empty() || is_shaken(setup)) return {};
  std::vector<Landing> found =
      landings(frames.time, frames.x, frames.centre,
               {setup.box.length, static_cast<double>(setup.grains.count) * setup.grains.mass,
                1 / setup.spring.frequency});
  if (found.size() > most) found.resize(most);
  return found;
}

/// Adds the camera's noise to the frames of a simulation, because what is told of single landings has it in
/// the film too.
UsedFrames with_noise(UsedFrames frames, const RunAudit& audit, std::uint64_t seed, int run) {
  Random random(seed, static_cast<std::uint64_t>(run), Stream::camera);
  for (double& x : frames.x) x += audit.box.standard_deviation * random.normal();
  for (double& x : frames.centre) x += audit.com.standard_deviation * random.normal();
  return frames;
}

Numbers numbers_of(const UsedFrames& frames, const Setup& setup, int most_peaks) {
  const FrameMotion motion =
      frame_motion(frames.time, frames.x, frames.middle, 4 * shortest_half_period(setup));
  Numbers numbers{motion.frequency,
                  decay_of(motion.peaks, small_peak(setup)).linear.slope,
                  {},
                  motion.why_not,
                  steady_by_frames(setup, frames.time, frames.x, frames.centre)};
  for (std::size_t i = 0; i < motion.peaks.size() && i < static_cast<std::size_t>(most_peaks); ++i)
    numbers.peaks.push_back(motion.peaks[i].position);
  return numbers;
}

/// Sets a measured number beside mean and spread of the simulated ones; NaN where fewer than two are finite.
MeasuredNumber beside(double measured, const std::vector<double>& simulated) {
  std::vector<double> finite;
  std::copy_if(simulated.begin(), simulated.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  const Statistic told = statistic_of(finite);
  return told.n < 2 ? MeasuredNumber{measured, absent, absent} : MeasuredNumber{measured, told.mean, told.sd};
}

/// Compares each measured landing with those of the simulations that come within a quarter of a period of it.
std::vector<LandingComparison> compare_landings(const std::vector<Landing>& measured,
                                                const std::vector<Numbers>& simulated, double period) {
  std::vector<LandingComparison> list;
  for (const Landing& one : measured) {
    std::vector<Landing> same;
    for (const Numbers& run : simulated)
      for (const Landing& other : run.landings)
        if (std::abs(other.time - one.time) < period / 4) same.push_back(other);
    const auto of = [&](double Landing::*member) {
      std::vector<double> values;
      for (const Landing& other : same) values.push_back(other.*member);
      return beside(one.*member, values);
    };
    if (std::isfinite(one.time))
      list.push_back({one.time, of(&Landing::speed), of(&Landing::momentum), of(&Landing::rebound),
                      of(&Landing::lasting), of(&Landing::thickness)});
  }
  return list;
}

template <class Pick>
MeasuredNumber number(const Numbers& measured, const std::vector<Numbers>& simulated, const Pick& pick) {
  std::vector<double> values;
  for (const Numbers& one : simulated) values.push_back(pick(one));
  return beside(pick(measured), values);
}

/// Returns "lag 0.31 (0.30 +- 0.01) rad": measured (model +- spread).
template <class Row>
std::string told(const Row& row, const MeasuredNumber& number) {
  return row.label +
         text_of(" %.*f (%.*f +- %.*f)", row.digits, number.measured * row.scale, row.digits,
                 number.model * row.scale, row.digits, number.spread * row.scale) +
         (*row.unit ? " " : "") + row.unit;
}

}  // namespace

std::vector<ForcedRow> rows_of(const ForcedComparison& forced) {
  std::vector<ForcedRow> rows{
      {"amplitude_mm", "amplitude", "mm", 1e3, 2, forced.amplitude},
      {"phase_lag_rad", "lag", "rad", 1, 3, forced.phase_lag},
      {"loss_factor", "loss factor", "", 1, 4, forced.loss_factor},
      {"effective_mass_g", "effective mass of grains", "g", 1e3, 1, forced.effective_mass}};
  std::erase_if(rows, [](const ForcedRow& row) { return !std::isfinite(row.number.measured); });
  return rows;
}

std::string told(const ForcedComparison& forced) {
  std::string text;
  for (const ForcedRow& row : rows_of(forced)) text += (text.empty() ? "" : ", ") + told(row, row.number);
  return text;
}

std::span<const LandingRow> landing_rows() {
  static constexpr LandingRow rows[] = {
      {"speed_m_per_s", "speed at landing", "at", "m/s", 1, 3, &LandingComparison::speed},
      {"momentum_mn_s", "momentum given to the wall", "given to the wall", "mN s", 1e3, 1,
       &LandingComparison::momentum},
      {"rebound", "rebound of the layer", "rebound", "", 1, 3, &LandingComparison::rebound},
      {"lasting_ms", "duration of the landing", "lasting", "ms", 1e3, 1, &LandingComparison::lasting},
      {"thickness_mm", "thickness of the layer", "layer", "mm", 1e3, 2, &LandingComparison::thickness}};
  return rows;
}

MeasuredNumber mean_of(const std::vector<LandingComparison>& landings, const LandingRow& row) {
  double measured = 0, model = 0, squares = 0, count = 0;
  for (const LandingComparison& landing : landings) {
    const MeasuredNumber& number = landing.*row.number;
    if (!std::isfinite(number.measured) || !std::isfinite(number.model)) continue;
    measured += number.measured, model += number.model, squares += number.spread * number.spread, ++count;
  }
  if (count == 0) return {absent, absent, absent};
  return {measured / count, model / count, std::sqrt(squares) / count};
}

std::string told(const std::vector<LandingComparison>& landings) {
  std::string text;
  for (const LandingRow& row : landing_rows()) {
    const MeasuredNumber mean = mean_of(landings, row);
    if (std::isfinite(mean.measured)) text += (text.empty() ? "" : ", ") + told(row, mean);
  }
  return text.empty() ? "" : std::to_string(landings.size()) + " landings, mean: " + text;
}

std::vector<DecayComparison> compare_decay(const Measurement& measurement, const Workshop& workshop, int runs,
                                           int first_run, int most_peaks) {
  std::vector<UsedFrames> frames;
  for (const Measurement::Run& run : measurement.runs)
    frames.push_back(used_frames(run, plan_features(run, Observed::box_only).end));
  std::vector<std::vector<Numbers>> simulated(frames.size());
  const int all = static_cast<int>(frames.size()) * runs;
  work_in_parallel_deliver_in_order(
      all, threads_or_all(workshop.execution.threads), [&](int job) -> std::function<void()> {
        const auto r = static_cast<std::size_t>(job / runs);
        if (workshop.execution.stopped()) throw Interrupted("interrupted");
        Setup setup = measurement.runs[r].setup;
        simulate_until(setup, frames[r].time.empty() ? 0.0 : frames[r].time.back());
        RunOptions options;
        options.run = first_run + job;
        options.stop = workshop.execution.stop;
        const Trajectory trajectory = workshop.engine->run(setup, options);
        if (trajectory.interrupted) throw Interrupted("interrupted");
        const Recording seen = recorded_by(physics_of(setup).camera, trajectory);
        UsedFrames as_filmed{frames[r].time, at_times(frames[r].time, seen.time, seen.x_box), {}, 0};
        if (!frames[r].centre.empty()) as_filmed.centre = at_times(frames[r].time, seen.time, seen.x_com);
        Numbers numbers = numbers_of(as_filmed, measurement.runs[r].setup, most_peaks);
        numbers.landings = landings_of(
            with_noise(std::move(as_filmed), measurement.runs[r].audit, setup.run.seed, options.run), setup);
        return [&, r, numbers = std::move(numbers)] { simulated[r].push_back(numbers); };
      });
  std::vector<DecayComparison> list;
  for (std::size_t r = 0; r < frames.size(); ++r) {
    const Measurement::Run& run = measurement.runs[r];
    Numbers measured = numbers_of(frames[r], run.setup, most_peaks);
    measured.landings = landings_of(frames[r], run.setup);
    DecayComparison one{run.recorded.name,
                        number(measured, simulated[r], [](const Numbers& n) { return n.frequency; }),
                        number(measured, simulated[r], [](const Numbers& n) { return n.slope; }),
                        {},
                        measured.why_not};
    for (std::size_t p = 0; p < measured.peaks.size(); ++p)
      one.peaks.push_back(number(measured, simulated[r],
                                 [p](const Numbers& n) { return p < n.peaks.size() ? n.peaks[p] : absent; }));
    if (measured.steady) {
      const auto of_steady = [&](double SteadyState::*member) {
        return number(measured, simulated[r],
                      [&](const Numbers& n) { return n.steady ? (*n.steady).*member : absent; });
      };
      one.forced = {of_steady(&SteadyState::amplitude), of_steady(&SteadyState::phase_lag),
                    of_steady(&SteadyState::loss_factor), of_steady(&SteadyState::effective_mass)};
    }
    one.landings = compare_landings(measured.landings, simulated[r], 1 / run.setup.spring.frequency);
    list.push_back(std::move(one));
  }
  return list;
}

}  // namespace shakedown
