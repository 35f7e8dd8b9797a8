// SPDX-License-Identifier: MIT
#include "series_file.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "errors.hpp"

namespace shakedown {

namespace {

void append_number(std::string& line, double number) {
  if (std::isnan(number)) return;
  std::array<char, 32> digits;
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, std::chars_format::general, 10).ptr;
  line.append(digits.data(), end);
}

}  // namespace

std::string csv_line(const std::vector<double>& numbers) {
  std::string line;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) line += ',';
    append_number(line, numbers[i]);
  }
  return line + '\n';
}

std::string series_csv(const Trajectory& trajectory) {
  std::string text =
      "t_s,x_box_m,v_box_m_per_s,x_com_m,total_energy_J,loss_grain_grain_J,loss_end_wall_J,loss_side_wall_"
      "J\n";
  text.reserve(text.size() + trajectory.time.size() * 100);
  for (std::size_t i = 0; i < trajectory.time.size(); ++i)
    text += csv_line({trajectory.time[i], trajectory.x_box[i], trajectory.v_box[i], trajectory.x_com[i],
                      trajectory.total_energy[i], trajectory.loss[0][i], trajectory.loss[1][i],
                      trajectory.loss[2][i]});
  return text;
}

void MeanSeries::add(const Trajectory& trajectory) {
  if (time_.empty()) time_ = trajectory.time;
  EXPECT(trajectory.time.size() == time_.size());
  const auto add_to = [&](std::vector<RunningStatistic>& statistics, const std::vector<double>& values) {
    statistics.resize(time_.size());
    for (std::size_t i = 0; i < time_.size(); ++i) statistics[i].add(values[i]);
  };
  add_to(x_box_, trajectory.x_box);
  add_to(x_com_, trajectory.x_com);
  add_to(energy_, trajectory.total_energy);
}

std::string MeanSeries::csv() const {
  std::string text =
      "t_s,x_box_mean_m,x_box_sd_m,x_com_mean_m,x_com_sd_m,total_energy_mean_J,total_energy_sd_J\n";
  for (std::size_t i = 0; i < time_.size(); ++i) {
    const Statistic box = x_box_[i].statistic(), com = x_com_[i].statistic(), energy = energy_[i].statistic();
    text += csv_line({time_[i], box.mean, box.sd, com.mean, com.sd, energy.mean, energy.sd});
  }
  return text;
}

}  // namespace shakedown
