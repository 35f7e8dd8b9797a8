// SPDX-License-Identifier: MIT
// Which sounds are the impacts of one ball.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drop_sequences.hpp"
#include "drop_tables.hpp"
#include "errors.hpp"
#include "sound.hpp"

namespace shakedown {

namespace {

constexpr double shortest_flight = 0.03, longest_flight = 2.5;  // s, of a flight
constexpr double least_ratio = 0.3, most_ratio = 0.995;
constexpr double ratio_changes =
    0.025;                          // deviation of an interval from what the last two foretell, its share
constexpr double placed_to = 5e-4;  // s, and besides
constexpr double furthest = 3;      // deviations
constexpr double price_of_missing = 2.3;
constexpr double quieter = 2, loudness_changes = 5;         // dB from impact to impact, and deviation
constexpr double least_evidence = 1, said_to_be_there = 2;  // of a drop, and of the first of a file
constexpr std::size_t most_onsets = 160;
constexpr std::size_t least_impacts = 4;
/// In sounds fainter than this, dB over the noise, the noise reaches the share of the peak that places them.
constexpr double placed_well = 14;

struct Chain {
  std::vector<std::size_t> members;
  double score = 0;
};

/// Returns the index of the onset nearest to a time, within a tolerance (s); onsets.size() where there is
/// none.
std::size_t nearest(const std::vector<Onset>& onsets, double time, double within) {
  const auto after = std::lower_bound(onsets.begin(), onsets.end(), time,
                                      [](const Onset& onset, double t) { return onset.time < t; });
  std::size_t best = onsets.size();
  double least = within;
  for (auto one = after == onsets.begin() ? after : after - 1; one != onsets.end() && one <= after; ++one)
    if (std::abs(one->time - time) <= least)
      least = std::abs(one->time - time), best = static_cast<std::size_t>(one - onsets.begin());
  return best;
}

/// Returns ln of how much likelier an onset is as the next impact of a drop than by chance, `density` onsets
/// a second.
double evidence(const Onset& before, const Onset& onset, double off, double deviation, double density) {
  const double unusual = (before.strength - onset.strength - quieter) / loudness_changes;
  return -std::log(density * std::sqrt(2 * std::numbers::pi) * deviation) - off * off / 2 +
         std::max(-2.0, 0.5 - unusual * unusual / 2);
}

/// Follows a drop from its first two impacts and a ratio; the ratio follows what is found. The third impact
/// gave the ratio and counts nothing.
Chain followed(const std::vector<Onset>& onsets, std::size_t a, std::size_t b, double ratio, double density) {
  Chain chain{{a, b}, 0};
  double interval = onsets[b].time - onsets[a].time, at = onsets[b].time;
  int missing = 0;
  while (interval * ratio > shortest_flight) {
    const double next = interval * ratio, deviation = ratio_changes * next + placed_to;
    const std::size_t found = nearest(onsets, at + next, furthest * deviation);
    if (found == onsets.size() || found <= chain.members.back()) {
      if (++missing > 1) break;
      at += next, interval = next;
      continue;
    }
    const double off = (onsets[found].time - at - next) / deviation;
    if (chain.members.size() > 2)
      chain.score += evidence(onsets[chain.members.back()], onsets[found], off, deviation, density) -
                     missing * price_of_missing;
    const double seen = (onsets[found].time - at) / interval;
    if (missing == 0) ratio = std::clamp(0.5 * ratio + 0.5 * seen, least_ratio, most_ratio);
    interval = onsets[found].time - at;
    missing = 0;
    at = onsets[found].time;
    chain.members.push_back(found);
  }
  return chain;
}

/// Returns the indices of the strongest onsets, in order of time.
std::vector<std::size_t> strongest(const std::vector<Onset>& onsets) {
  std::vector<std::size_t> all(onsets.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::stable_sort(all.begin(), all.end(),
                   [&](std::size_t a, std::size_t b) { return onsets[a].strength > onsets[b].strength; });
  all.resize(std::min(all.size(), most_onsets));
  std::sort(all.begin(), all.end());
  return all;
}

SoundShown shown(const Sound& sound, const std::string& file) {
  constexpr std::size_t points = 1600;
  SoundShown picture;
  picture.file = file;
  const std::size_t samples = sound.channel[0].size(), bin = std::max<std::size_t>(1, samples / points);
  for (std::size_t from = 0; from + bin <= samples; from += bin) {
    double most = 0;
    for (const std::vector<float>& channel : sound.channel)
      for (std::size_t i = from; i < from + bin; ++i) most = std::max(most, std::abs(double(channel[i])));
    picture.time.push_back((static_cast<double>(from) + static_cast<double>(bin) / 2) / sound.rate);
    picture.level.push_back(20 * std::log10(most + 1e-5));
  }
  return picture;
}

}  // namespace

std::vector<std::size_t> chain_of(const std::vector<Onset>& all, bool first) {
  const std::vector<std::size_t> kept = strongest(all);
  std::vector<Onset> onsets;
  for (const std::size_t i : kept) onsets.push_back(all[i]);
  if (onsets.size() < least_impacts) return {};
  const double density =
      static_cast<double>(onsets.size()) / std::max(1.0, onsets.back().time - onsets.front().time);
  Chain best;
  double tried = 1;
  for (std::size_t a = 0; a < onsets.size(); ++a)
    for (std::size_t b = a + 1; b < onsets.size(); ++b) {
      const double interval = onsets[b].time - onsets[a].time;
      if (interval < shortest_flight) continue;
      if (interval > longest_flight) break;
      for (std::size_t c = b + 1; c < onsets.size(); ++c) {
        const double ratio = (onsets[c].time - onsets[b].time) / interval;
        if (ratio < least_ratio) continue;
        if (ratio > most_ratio) break;
        ++tried;
        Chain chain = followed(onsets, a, b, ratio, density);
        if (chain.members.size() >= least_impacts && chain.score > best.score) best = std::move(chain);
      }
    }
  if (best.score < std::max(least_evidence, std::log(tried) - (first ? said_to_be_there : 0))) return {};
  std::vector<std::size_t> members;
  for (const std::size_t i : best.members) members.push_back(kept[i]);
  return members;
}

ReadDrops drops_of_sound(const Sound& sound, const std::string& file, const DropReading& reading) {
  const std::vector<Onset> onsets = onsets_of(sound);
  ReadDrops read;
  SoundShown picture = shown(sound, file);
  std::vector<Onset> left = onsets;
  for (std::vector<std::size_t> chain; !(chain = chain_of(left, read.drops.empty())).empty();) {
    const double from = left[chain.front()].time - 0.05, to = left[chain.back()].time + 0.05;
    std::size_t used = std::min(least_impacts, chain.size());
    while (used < chain.size() && left[chain[used]].strength >= placed_well) ++used;
    const std::size_t faint = chain.size() - used;
    chain.resize(used);
    if (faint > 0)
      read.notes.push_back(fmt::format(
          "{}: {} impact{} at the end from where they are fainter than {:.0f} dB over the noise {} not used",
          file, faint, faint == 1 ? "" : "s", placed_well, faint == 1 ? "is" : "are"));
    std::vector<double> instants;
    for (const std::size_t i : chain) instants.push_back(left[i].time);
    picture.impacts.insert(picture.impacts.end(), instants.begin(), instants.end());
    for (Drop& drop : drops_of_instants(instants, "")) {
      drop.file = file;
      drop.name = fmt::format("from {:.2f} s", instants.front());
      drop.height = reading.height;
      drop.resolution = 1 / sound.rate;
      read.drops.push_back(std::move(drop));
    }
    std::erase_if(left, [&](const Onset& onset) { return onset.time >= from && onset.time <= to; });
  }
  if (read.drops.empty())
    throw InputError({{{file, 0, 0},
                       "",
                       fmt::format("{} sudden sounds, and no four of them are impacts of one ball (intervals "
                                   "that fall by a steady ratio)",
                                   onsets.size()),
                       "record nearer to the floor in a quiet room, or cut the file to the drop"}});
  std::stable_sort(read.drops.begin(), read.drops.end(), [](const Drop& a, const Drop& b) {
    return a.name.size() < b.name.size() || (a.name.size() == b.name.size() && a.name < b.name);
  });
  std::sort(picture.impacts.begin(), picture.impacts.end());
  for (const Onset& onset : onsets)
    if (!std::binary_search(picture.impacts.begin(), picture.impacts.end(), onset.time))
      picture.others.push_back(onset.time);
  read.notes.push_back(
      fmt::format("{}: sound, {:.1f} kHz, {} channel{}; {} onsets, {} of them impacts of {} drop{}", file,
                  sound.rate / 1e3, sound.channel.size(), sound.channel.size() == 1 ? "" : "s", onsets.size(),
                  picture.impacts.size(), read.drops.size(), read.drops.size() == 1 ? "" : "s"));
  read.sounds.push_back(std::move(picture));
  return read;
}

ReadDrops read_drops(const std::string& file, const DropReading& reading) {
  if (reading.as == "sound" || (reading.as.empty() && is_sound(file)))
    return drops_of_sound(read_sound(file), file, reading);
  return drops_of_table(read_bounce_table(file), reading);
}

}  // namespace shakedown
