// SPDX-License-Identifier: MIT
// Sounds of drops, made: clicks that ring, in noise, beside other sounds.
#include "drop_tables.hpp"
#include "sound.hpp"

#include <gtest/gtest.h>
#include <sndfile.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "errors.hpp"
#include "random.hpp"
#include "scratch_folder.hpp"
#include "within.hpp"

using namespace shakedown;

namespace {

struct Click {
  double time = 0, height = 1;
};

Sound made_sound(const std::vector<Click>& clicks, double rate, double length, double noise, int channels) {
  Random random(7, 1, Stream::other);
  Sound sound;
  sound.rate = rate;
  for (int c = 0; c < channels; ++c) {
    std::vector<float> signal(static_cast<std::size_t>(length * rate));
    for (std::size_t i = 0; i < signal.size(); ++i) {
      const double t = static_cast<double>(i) / rate;
      double value = noise * random.normal() + 0.02 * std::sin(2 * std::numbers::pi * 50 * t);
      for (const Click& click : clicks)
        if (const double since = t - click.time; since >= 0 && since < 0.1)
          value +=
              0.5 * click.height * std::exp(-since / 0.004) * std::sin(2 * std::numbers::pi * 2300 * since);
      signal[i] = static_cast<float>(value);
    }
    sound.channel.push_back(std::move(signal));
  }
  return sound;
}

std::vector<double> impacts(double start, double first, double e, int count) {
  std::vector<double> t{start};
  for (int i = 1; i < count; ++i, first *= e) t.push_back(t.back() + first);
  return t;
}

std::vector<Click> clicks_at(const std::vector<double>& times, double e) {
  std::vector<Click> clicks;
  double height = 1;
  for (const double t : times) clicks.push_back({t, height}), height *= e;
  return clicks;
}

}  // namespace

TEST(Sound, FindsImpactsAmongOtherSoundsAndNoise) {
  const std::vector<double> t = impacts(0.913, 0.72, 0.8, 9);
  for (const double rate : {44100.0, 48000.0, 16000.0, 96000.0})
    for (const int channels : {1, 2}) {
      std::vector<Click> clicks = clicks_at(t, 0.8);
      for (const Click& other : {Click{0.31, 0.7}, Click{1.2, 0.2}, Click{2.05, 0.3}, Click{4.7, 0.9}})
        clicks.push_back(other);
      const Sound sound = made_sound(clicks, rate, 5.2, 2e-3, channels);
      const ReadDrops read = drops_of_sound(sound, "a.wav", {});
      ASSERT_EQ(read.drops.size(), 1u);
      ASSERT_EQ(read.drops[0].interval.size(), 8u) << rate;
      for (std::size_t i = 0; i < 8; ++i)
        WITHIN(read.drops[0].interval[i], t[i + 1] - t[i], 7e-4, 3.7e-5) << rate << " " << i;
      WITHIN(read.sounds[0].impacts[0], t[0], 1e-3, 6.3e-5);
      EXPECT_EQ(read.sounds[0].impacts.size(), 9u);
    }
}

TEST(Sound, AMissedImpactIsOneLongInterval) {
  std::vector<double> t = impacts(0.4, 0.7, 0.82, 9);
  t.erase(t.begin() + 4);
  const ReadDrops read = drops_of_sound(made_sound(clicks_at(t, 0.85), 44100, 4, 1e-3, 1), "a.wav", {});
  ASSERT_EQ(read.drops.size(), 1u);
  EXPECT_EQ(read.drops[0].interval.size(), 7u);
  const std::vector<Outlier> gross = gross_outliers(read.drops);
  ASSERT_EQ(gross.size(), 1u);
  EXPECT_EQ(gross[0].kind, OutlierKind::missed);
}

TEST(Sound, TwoDropsInOneFile) {
  std::vector<Click> clicks = clicks_at(impacts(0.4, 0.7, 0.8, 7), 0.8);
  for (const Click& click : clicks_at(impacts(5.1, 0.6, 0.8, 7), 0.8)) clicks.push_back(click);
  const ReadDrops read = drops_of_sound(made_sound(clicks, 44100, 9, 1e-3, 1), "a.wav", {});
  ASSERT_EQ(read.drops.size(), 2u);
  EXPECT_EQ(read.drops[0].interval.size(), 6u);
  EXPECT_EQ(read.drops[1].interval.size(), 6u);
}

TEST(Sound, NoDropIsSaid) {
  EXPECT_THROW(drops_of_sound(made_sound({}, 44100, 2, 1e-3, 1), "a.wav", {}), InputError);
  EXPECT_THROW(drops_of_sound(made_sound({{0.3, 1}, {0.5, 1}, {1.2, 1}}, 44100, 2, 1e-3, 1), "a.wav", {}),
               InputError);
}

TEST(Sound, IsReadFromWavFlacAndOgg) {
  const ScratchFolder folder;
  const std::vector<double> t = impacts(0.4, 0.6, 0.8, 7);
  const Sound made = made_sound(clicks_at(t, 0.8), 44100, 3, 1e-3, 1);
  for (const auto& [name, format] : {std::pair{"a.wav", SF_FORMAT_WAV | SF_FORMAT_PCM_16},
                                     std::pair{"a.flac", SF_FORMAT_FLAC | SF_FORMAT_PCM_16},
                                     std::pair{"a.ogg", SF_FORMAT_OGG | SF_FORMAT_VORBIS}}) {
    const std::string file = (folder / name).string();
    SF_INFO info{};
    info.samplerate = 44100, info.channels = 1, info.format = format;
    SNDFILE* out = sf_open(file.c_str(), SFM_WRITE, &info);
    ASSERT_NE(out, nullptr) << name;
    for (std::size_t i = 0; i < made.channel[0].size(); i += 4096)
      sf_write_float(out, made.channel[0].data() + i,
                     static_cast<sf_count_t>(std::min<std::size_t>(4096, made.channel[0].size() - i)));
    sf_close(out);
    ASSERT_TRUE(is_sound(file)) << name;
    const ReadDrops read = read_drops(file, {});
    ASSERT_EQ(read.drops.size(), 1u) << name;
    EXPECT_EQ(read.drops[0].interval.size(), 6u) << name;
    WITHIN(read.drops[0].interval[0], 0.6, 4e-4, 2.3e-5) << name;  // a sample
  }
  std::ofstream(folder / "b.wav") << "RIFFxxxxWAVEbroken";
  EXPECT_THROW(read_drops((folder / "b.wav").string(), {}), FileError);
}

TEST(Sound, AHeaderThatPromisesTooMuchTakesNoMemory) {
  const ScratchFolder folder;
  // FLAC of 8 channels of 16 bits at 44.1 kHz: 2^36 - 1 frames, and none of them there
  std::string bytes("fLaC\x80\0\0\x22\x10\0\x10\0\0\0\0\0\0\0\x0a\xc4\x4e\xff\xff\xff\xff\xff", 26);
  bytes.append(16, '\0');
  std::ofstream(folder / "a.flac", std::ios::binary) << bytes;
  EXPECT_THROW(read_drops((folder / "a.flac").string(), {}), InputError);
}
