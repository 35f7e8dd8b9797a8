// SPDX-License-Identifier: MIT
#include "sound.hpp"

#include <fmt/format.h>
#include <sndfile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>

#include "errors.hpp"
#include "kept_files.hpp"

namespace shakedown {

namespace {

constexpr double step = 0.25e-3;                   // s, of the level
constexpr std::size_t window = 4;                  // steps: 1 ms
constexpr double noise_window = 1.5;               // s
constexpr double noise_share = 0.3;                // of the levels there lie below the noise
constexpr double least_rise = 6, least_level = 8;  // dB
constexpr double apart = 0.015;                    // s, between onsets
constexpr float share_of_peak = 0.3f;
constexpr double silence = 1e-14;  // power, of 16 bits' last digit

/// Returns the samples in 23 us, whatever the rate: in steps of the signal over that time hum and rumble are
/// weak and impacts strong.
std::size_t lag_of(double rate) { return std::max<std::size_t>(1, static_cast<std::size_t>(rate / 44000)); }
std::vector<float> steps_of(const std::vector<float>& signal, std::size_t lag) {
  std::vector<float> steps(signal.size());
  for (std::size_t i = lag; i < signal.size(); ++i) steps[i] = signal[i] - signal[i - lag];
  return steps;
}

/// Returns the level of the power over 1 ms from each step on, all channels, dB.
std::vector<double> levels_of(const Sound& sound) {
  const std::size_t samples = sound.channel[0].size();
  const double per_step = sound.rate * step;
  const std::size_t count = static_cast<std::size_t>(static_cast<double>(samples) / per_step);
  std::vector<double> power(count, 0);
  for (const std::vector<float>& channel : sound.channel) {
    const std::vector<float> steps = steps_of(channel, lag_of(sound.rate));
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t from = static_cast<std::size_t>(static_cast<double>(k) * per_step),
                        to = static_cast<std::size_t>(static_cast<double>(k + 1) * per_step);
      double sum = 0;
      for (std::size_t i = from; i < to; ++i) sum += static_cast<double>(steps[i]) * steps[i];
      power[k] += sum / static_cast<double>(std::max<std::size_t>(1, to - from));
    }
  }
  std::vector<double> level(count);
  for (std::size_t k = 0; k < count; ++k) {
    double sum = 0;
    const std::size_t to = std::min(count, k + window);
    for (std::size_t i = k; i < to; ++i) sum += power[i];
    level[k] = 10 * std::log10(sum / static_cast<double>(to - k) + silence);
  }
  return level;
}

/// Returns the level below which a share of the levels about each step lies, dB.
std::vector<double> noise_of(const std::vector<double>& level) {
  const std::size_t half = static_cast<std::size_t>(noise_window / step / 2), stride = half / 4;
  std::vector<double> noise(level.size());
  for (std::size_t k = 0; k < level.size(); k += stride) {
    const std::size_t from = k > half ? k - half : 0, to = std::min(level.size(), k + half);
    std::vector<double> about(level.begin() + static_cast<std::ptrdiff_t>(from),
                              level.begin() + static_cast<std::ptrdiff_t>(to));
    const auto at =
        about.begin() + static_cast<std::ptrdiff_t>(noise_share * static_cast<double>(about.size()));
    std::nth_element(about.begin(), at, about.end());
    for (std::size_t i = k; i < std::min(level.size(), k + stride); ++i) noise[i] = *at;
  }
  return noise;
}

/// Returns the sample at which the variance before and that after describe the signal best.
std::size_t meeting_of_variances(std::span<const float> signal) {
  std::vector<double> sum{0};
  for (const float one : signal) sum.push_back(sum.back() + static_cast<double>(one) * one);
  const double n = static_cast<double>(signal.size());
  double best = 1e300;
  std::size_t at = 0;
  for (std::size_t k = 8; k + 8 < signal.size(); ++k) {
    const double before = sum[k] / static_cast<double>(k) + silence,
                 after = (sum.back() - sum[k]) / (n - static_cast<double>(k)) + silence;
    const double value =
        static_cast<double>(k) * std::log(before) + (n - static_cast<double>(k)) * std::log(after);
    if (value < best) best = value, at = k;
  }
  return at;
}

/// Returns the sample at which an impact reaches a share of its own peak, which is the same moment of each: a
/// loud one shows a weak beginning that is lost in the noise of the next.
std::size_t samples_risen(std::span<const float> signal, std::size_t onset) {
  float peak = 0;
  for (std::size_t i = onset; i < signal.size(); ++i) peak = std::max(peak, std::abs(signal[i]));
  std::size_t i = onset;
  while (i + 1 < signal.size() && std::abs(signal[i]) < share_of_peak * peak) ++i;
  return i;
}

/// Places an onset, s, by the signal from 6 ms before a rise to 3 ms after it, in the channel that is loudest
/// there.
double placed(const Sound& sound, double about) {
  const std::size_t all = sound.channel[0].size(), lag = lag_of(sound.rate);
  const auto sample = [&](double t) {
    return static_cast<std::size_t>(
        std::clamp(t * sound.rate, static_cast<double>(lag), static_cast<double>(all)));
  };
  const std::size_t from = sample(about - 0.006), to = sample(about + 0.003);
  if (to < from + 20) return about;
  double loudest = -1, place = about;
  for (const std::vector<float>& channel : sound.channel) {
    std::vector<float> part(to - from);
    double power = 0;
    for (std::size_t i = from; i < to; ++i) {
      part[i - from] = channel[i] - channel[i - lag];
      power += static_cast<double>(part[i - from]) * part[i - from];
    }
    if (power <= loudest) continue;
    loudest = power;
    place = static_cast<double>(from + samples_risen(part, meeting_of_variances(part))) / sound.rate;
  }
  return place;
}

}  // namespace

bool is_sound(const std::string& file) {
  std::ifstream input(file, std::ios::binary);
  std::array<char, 12> first{};
  input.read(first.data(), first.size());
  const std::string_view bytes(first.data(), first.size());
  const bool wave = (bytes.starts_with("RIFF") || bytes.starts_with("RF64") || bytes.starts_with("RIFX")) &&
                    bytes.substr(8) == "WAVE";
  return wave || bytes.starts_with("fLaC") || bytes.starts_with("OggS") || bytes.starts_with("FORM") ||
         bytes.starts_with(".snd") || bytes.starts_with("caff") || bytes.starts_with("ID3");
}

Sound read_sound(const std::string& file) {
  keep_unchanged(file);
  SF_INFO info{};
  const std::unique_ptr<SNDFILE, int (*)(SNDFILE*)> input(sf_open(file.c_str(), SFM_READ, &info), sf_close);
  if (!input)
    throw FileError(file + ": cannot be read as sound (" + sf_strerror(nullptr) +
                    "); save it as WAV, FLAC or OGG");
  if (info.frames < 1 || info.channels < 1 || info.samplerate < 4000)
    throw FileError(file + ": holds no sound of 4 kHz or more; record at 44.1 or 48 kHz");
  Sound sound;
  sound.rate = info.samplerate;
  // Bit by bit: a damaged header promises more frames than there is memory for.
  constexpr sf_count_t at_once = 1 << 14;
  const std::size_t channels = static_cast<std::size_t>(info.channels);
  sound.channel.resize(channels);
  std::vector<float> frames(static_cast<std::size_t>(at_once) * channels);
  for (sf_count_t read = 0; (read = sf_readf_float(input.get(), frames.data(), at_once)) > 0;)
    for (std::size_t i = 0; i < static_cast<std::size_t>(read); ++i)
      for (std::size_t c = 0; c < channels; ++c) sound.channel[c].push_back(frames[i * channels + c]);
  return sound;
}

std::vector<Onset> onsets_of(const Sound& sound) {
  const std::vector<double> level = levels_of(sound), noise = noise_of(level);
  const std::size_t past = static_cast<std::size_t>(0.010 / step), gap = window;
  std::vector<double> rise(level.size(), 0);
  for (std::size_t k = past + gap; k < level.size(); ++k) {
    double before = 0;
    for (std::size_t i = k - past - gap; i < k - gap; ++i) before += level[i];
    rise[k] = level[k] - std::max(before / static_cast<double>(past), noise[k]);
  }
  std::vector<Onset> onsets;
  const std::size_t about = static_cast<std::size_t>(apart / step);
  for (std::size_t k = 0; k < rise.size(); ++k) {
    if (rise[k] < least_rise || level[k] - noise[k] < least_level) continue;
    const std::size_t from = k > about ? k - about : 0, to = std::min(rise.size(), k + about + 1);
    const auto highest = std::max_element(rise.begin() + static_cast<std::ptrdiff_t>(from),
                                          rise.begin() + static_cast<std::ptrdiff_t>(to));
    if (highest != rise.begin() + static_cast<std::ptrdiff_t>(k)) continue;
    onsets.push_back({placed(sound, static_cast<double>(k) * step), level[k] - noise[k]});
  }
  return onsets;
}

}  // namespace shakedown
