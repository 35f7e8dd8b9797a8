// SPDX-License-Identifier: MIT
// Data made with other people's soft spheres, each with something hidden whose truth is known: does an
// engine, told the truth, follow them to within the spread of runs? Not a test: the data are not part of the
// tree.
//   challenge_truths FOLDER [RUNS=8] [hard|soft] [CASE...]
// FOLDER holds truth.json and cases o01/ ... with setup.toml and L*.csv (t_s,x_box_m,x_com_m)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "effects.hpp"
#include "ensemble.hpp"
#include "hard_engine.hpp"
#include "setup_file.hpp"
#include "soft_engine.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

/// What the names in truth.json mean as keys of a setup.
std::vector<Override> truth_as_overrides(const nlohmann::json& laboratory) {
  const auto number = [&](const char* name) { return laboratory.at(name).dump(); };
  std::vector<Override> overrides;
  const auto take = [&](const char* name, std::string key, std::string unit) {
    if (laboratory.contains(name)) overrides.push_back({std::move(key), number(name) + unit});
  };
  take("epp", "restitution.grain_grain", "");
  take("epw", "restitution.grain_wall", "");
  take("mu_pp", "grain_friction.grain_grain", "");
  take("mu_pw", "grain_friction.grain_wall", "");
  take("c_box", "blade_viscous_damping.damping", " N s/m");
  take("gx", "constant_acceleration.acceleration.x", " m/s^2");
  take("plastic", "velocity_dependent_restitution.exponent", "");
  take("k3", "spring_cubic.coefficient", "");
  take("com_bias", "camera_com_bias.bias", "");
  take("F_clamp", "clamp_dry_friction.force", " N");
  if (laboratory.contains("eddy")) {
    const std::string away = "((x-" + number("x_eddy") + ")/" + number("w_eddy") + ")";
    overrides.push_back({"user_force.force", "\"-" + number("eddy") + "*v*exp(-" + away + "^2)\""});
  }
  return overrides;
}

struct Series {
  std::vector<double> time, x_box;
};

Series read_series(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw FileError(path.string() + ": cannot be read");
  Series series;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    double t = 0, x = 0;
    char comma = 0;
    if (!(fields >> t >> comma >> x)) continue;
    series.time.push_back(t);
    series.x_box.push_back(x);
  }
  return series;
}

/// Standard deviation of the noise of one sample, from fourth differences, in which the motion vanishes (sum
/// of squared weights: 70).
double noise_of(const std::vector<double>& x) {
  std::vector<double> size;
  for (std::size_t k = 4; k < x.size(); ++k)
    size.push_back(std::abs(x[k] - 4 * x[k - 1] + 6 * x[k - 2] - 4 * x[k - 3] + x[k - 4]));
  std::nth_element(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2), size.end());
  return size[size.size() / 2] / 0.6745 / std::sqrt(70.0);
}

struct Comparison {
  double error = 0, spread = 0, noise = 0, until = 0;  // m, m, m, s
  double expected(int runs) const { return std::sqrt(noise * noise + spread * spread * (1 + 1.0 / runs)); }
};

Comparison compare(const Series& data, const Ensemble& ensemble) {
  Comparison result;
  std::vector<double> ends;
  for (const RunResult& run : ensemble.runs) ends.push_back(run.observables.first_small_peak);
  result.until = statistic_of(ends).mean;
  result.noise = noise_of(data.x_box);
  const std::vector<double>& time = ensemble.runs.front().trajectory.time;
  double squares = 0, variances = 0;
  std::size_t n = 0;
  for (; n < data.time.size() && n < time.size() && !(data.time[n] >= result.until); ++n) {
    if (std::abs(data.time[n] - time[n]) > 1e-6)
      throw FileError("the samples of data and runs are not at the same times");
    std::vector<double> x;
    for (const RunResult& run : ensemble.runs) x.push_back(run.trajectory.x_box[n]);
    const Statistic at = statistic_of(x);
    squares += std::pow(data.x_box[n] - at.mean, 2);
    variances += at.sd * at.sd;
  }
  result.error = std::sqrt(squares / static_cast<double>(n));
  result.spread = std::sqrt(variances / static_cast<double>(n));
  return result;
}

Ensemble told(const Engine& engine, const fs::path& folder, const std::string& file,
              std::vector<Override> truth, int runs) {
  truth.push_back({"box.length", file.substr(1, 3) + " mm"});  // "L040_a.csv"
  const Setup setup = read_setup(folder / "setup.toml", all_effects(), truth);
  EnsembleOptions options;
  options.runs = runs;
  options.keep_samples = true;
  return run_ensemble(engine, setup, options);
}

void report_case(const Engine& engine, const fs::path& folder, const nlohmann::json& truth, int runs) {
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".csv") files.push_back(entry.path().filename());
  std::sort(files.begin(), files.end());
  const std::vector<Override> overrides = truth_as_overrides(truth.at("laboratory"));
  for (const std::string& file : files) {
    const Series data = read_series(folder / file);
    const Comparison with = compare(data, told(engine, folder, file, overrides, runs)),
                     without = compare(data, told(engine, folder, file, {}, runs));
    std::printf("%s  %-10s  %6.2f  %9.3f  %9.3f  %9.3f  %9.3f  %6.2f  %9.3f\n", folder.filename().c_str(),
                file.c_str(), with.until, with.error * 1e3, with.spread * 1e3, with.noise * 1e3,
                with.expected(runs) * 1e3, with.error / with.expected(runs), without.error * 1e3);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count < 2) {
    std::fprintf(stderr, "usage: challenge_truths FOLDER [RUNS=8] [hard|soft] [CASE...]\n");
    return 2;
  }
  try {
    const fs::path folder = arguments[1];
    const int runs = count > 2 ? std::max(2, std::atoi(arguments[2])) : 8;
    std::ifstream file(folder / "truth.json");
    if (!file) throw FileError((folder / "truth.json").string() + ": cannot be read");
    const nlohmann::json truths = nlohmann::json::parse(file);
    std::printf(
        "x_box of the mean of %d runs told the truth against the data, while the amplitude exceeds 10 mm; "
        "mm\n",
        runs);
    std::printf(
        "case file        until s  rms error  sd of run      noise   expected   ratio   untold rms\n");
    const std::unique_ptr<Engine> engine =
        count > 3 && arguments[3] == std::string("soft") ? make_soft_engine() : make_hard_engine();
    const std::vector<std::string> wanted(arguments + std::min(count, 4), arguments + count);
    for (const auto& [name, truth] : truths.items())
      if (wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end())
        report_case(*engine, folder / name, truth, runs);
  } catch (const FileError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 4;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
