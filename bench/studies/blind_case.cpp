// SPDX-License-Identifier: MIT
#include "blind_case.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "comma_list.hpp"
#include "embedded_table.hpp"
#include "quantity.hpp"
#include "random.hpp"
#include "setup_keys.hpp"
#include "suggestion.hpp"
#include "toml_document.hpp"

namespace shakedown {

extern const std::string_view twin_pairs_csv;

namespace {

PlannedRun lasting(PlannedRun run, double seconds) {
  run.overrides.push_back({"run.duration", toml_string(write_quantity(seconds, "s")), "blind suite"});
  return run;
}

std::vector<PlannedRun> lasting(std::vector<PlannedRun> runs, const std::vector<double>& seconds) {
  for (std::size_t i = 0; i < runs.size(); ++i) runs[i] = lasting(std::move(runs[i]), seconds[i]);
  return runs;
}

class Draw {
 public:
  Draw(const Setup& believed, const BlindDesign& design, const SignalLaws& laws, std::uint64_t seed,
       KnownEffects known)
      : believed_(believed), design_(design), laws_(laws), seed_(seed), known_(known) {}

  BlindCase one(BlindKind kind, int index) const;

 private:
  double between(Random& random, double low, double high) const {
    return low + (high - low) * random.uniform();
  }
  std::size_t choice(Random& random, std::size_t count) const {
    return std::min(count - 1, static_cast<std::size_t>(random.uniform() * static_cast<double>(count)));
  }
  void nuisances(Random& random, std::vector<Override>& truth, RecordingSettings& recording) const;
  void parameters(Random& random, const Setup& believed, std::vector<Override>& truth) const;
  void hide(Random& random, const Hideable& hideable, double signal, std::vector<Override>& truth,
            BlindCase& drawn) const;
  void another_damper(Random& random, int number, std::vector<Override>& truth, BlindCase& drawn) const;
  void film(Random& random, std::vector<Override>& truth, BlindCase& drawn) const;
  void hide_pair(Random& random, std::vector<Override>& truth, BlindCase& drawn) const;
  void hide_twin(std::size_t number, Random& random, std::vector<Override>& truth, BlindCase& drawn) const;
  void hide_what_the_kind_says(Random& random, int index, std::vector<Override>& truth,
                               BlindCase& drawn) const;

  const Setup& believed_;
  const BlindDesign& design_;
  const SignalLaws& laws_;
  std::uint64_t seed_;
  KnownEffects known_;
};

/// Returns the factor by which a strength of this unit grows from the believed damper to another one, so that
/// it does as much there. What happens inside contacts stays.
double growth(std::string_view unit, const Setup& from, const Setup& to) {
  const double mass = to.box.mass / from.box.mass, rate = to.spring.frequency / from.spring.frequency,
               reach = to.release.displacement / from.release.displacement;
  if (unit == "N") return mass * rate * rate * reach;
  if (unit == "N s/m") return mass * rate;
  if (unit == "N s^2/m^2") return mass / reach;
  if (unit == "m/s^2") return rate * rate * reach;
  if (unit == "m/s") return rate * reach;
  return unit == "kg" ? mass : 1;
}

void Draw::nuisances(Random& random, std::vector<Override>& truth, RecordingSettings& recording) const {
  const auto add = [&](const char* key, const std::string& value) {
    truth.push_back({key, value, "blind suite"});
  };
  add("soft.contact_time", toml_of(1e-4 * std::pow(5.0, random.uniform()), "ms"));  // 0.1 to 0.5 ms
  const double packing = random.uniform();
  if (packing > 0.8)
    add("release.packing", "\"random\"");
  else if (packing > 0.6)
    add("release.packing", "\"square\"");
  recording.box_noise = between(random, 0.1e-3, 0.4e-3);
  recording.centre_noise = between(random, 0.3e-3, 0.8e-3);
}

void Draw::parameters(Random& random, const Setup& believed, std::vector<Override>& truth) const {
  const auto add = [&](const char* key, double value, std::string_view unit) {
    truth.push_back({key, toml_of(value, unit), "blind suite"});
  };
  add("restitution.grain_grain",
      std::clamp(believed.restitution.grain_grain + between(random, -0.1, 0.1), 0.3, 0.98), "");
  add("restitution.grain_wall",
      std::clamp(believed.restitution.grain_wall + between(random, -0.1, 0.1), 0.3, 0.98), "");
  add("spring.frequency", believed.spring.frequency * (1 + between(random, -0.004, 0.004)), "Hz");
}

void Draw::hide(Random& random, const Hideable& hideable, double signal, std::vector<Override>& truth,
                BlindCase& drawn) const {
  const std::string name = strength_name(hideable.id, drawn.kind);
  const auto found = laws_.find(name);
  const SignalLaw law =
      found == laws_.end() || found->second.signal <= 0 ? SignalLaw{1, signal} : found->second;
  const Setup& believed = drawn.trial.hidden.believed;
  const double noise = relative_noise(drawn.trial.recording, believed);
  const bool outside = hideable.effect->acts_on == ActsOn::box || hideable.effect->acts_on == ActsOn::all;
  const double grown =
      outside && hideable.formula.empty()
          ? growth(parameter_of(*hideable.effect, hideable.strength).unit, believed_, believed)
          : 1;
  const double strength = grown * std::min(law.strength_for(signal, noise), hideable.strongest);
  // Not faster: the balance's windows would see much less of it than of the one that the law was measured
  // with.
  DrawnTone tone{between(random, 0.5, 3), between(random, 0, 6)};
  for (double& height : tone.table) height = between(random, -1, 1);
  for (Override& override : at_strength(hideable, strength, drawn.trial.hidden.believed, tone))
    truth.push_back(std::move(override));
  drawn.ids.emplace_back(hideable.id);
  drawn.strengths.push_back(name);
  const double reached = law.signal_at(strength / grown, noise);
  drawn.signal_to_noise = drawn.signal_to_noise > 0 ? std::min(drawn.signal_to_noise, reached) : reached;
}

/// Draws a camera, from metrology to a phone in a hand: each error log-uniform by itself. The masses are off
/// by as much as the experimenter says that they may be.
void Draw::film(Random& random, std::vector<Override>& truth, BlindCase& drawn) const {
  const auto log_between = [&](double low, double high) {
    return low * std::pow(high / low, random.uniform());
  };
  const auto signed_between = [&](double low, double high) {
    return log_between(low, high) * (random.uniform() < 0.5 ? -1 : 1);
  };
  RecordingSettings& camera = drawn.trial.recording;
  constexpr std::array<double, 5> rates{120, 240, 300, 500,
                                        1000};  // Hz: phones, action and laboratory cameras
  camera.frame_rate = rates[choice(random, rates.size())];
  camera.lens = signed_between(1e-4, 0.02);
  camera.shutter = signed_between(5e-5, 0.01);
  camera.near = signed_between(2e-4, 0.02);
  camera.wander = log_between(2e-6, 1e-4);
  camera.wander_time = log_between(0.05, 1);
  camera.trigger = log_between(1e-4, 5e-3);
  camera.release = log_between(5e-5, 1e-3);
  camera.box_noise = log_between(5e-5, 1e-3);
  camera.centre_noise = camera.box_noise * log_between(1.5, 4);
  camera.missing = random.uniform() < 0.5 ? 0 : log_between(1e-3, 0.05);
  drawn.trial.known = usually_known(believed_, camera);
  for (const KnownValue& known : drawn.trial.known)
    if (known.key == "box.mass" || known.key == "grains.mass")
      truth.push_back({known.key, toml_of(known.value + known.error * random.normal(), "kg"), "blind suite"});
}

/// Draws another damper. Its lengths leave the layer of grains free ways of a fifth to four fifths of the
/// release.
void Draw::another_damper(Random& random, int number, std::vector<Override>& truth, BlindCase& drawn) const {
  const auto log_between = [&](double low, double high) {
    return low * std::pow(high / low, random.uniform());
  };
  const double diameter = between(random, 8e-3, 12e-3), release = between(random, 0.05, 0.14),
               frequency = log_between(0.7, 2.5), width = 0.05;
  const int count = static_cast<int>(between(random, 12, 81));
  const auto key = [&](std::vector<Override>& to, const char* path, const std::string& value) {
    to.push_back({path, value, "blind suite"});
  };
  std::vector<Override> damper;
  key(damper, "box.mass", toml_of(log_between(0.15, 1.2), "kg"));
  key(damper, "spring.frequency", toml_of(frequency, "Hz"));
  key(damper, "grains.count", std::to_string(count));
  key(damper, "grains.diameter", toml_of(diameter, "m"));
  key(damper, "grains.mass",
      toml_of(believed_.grains.mass * std::pow(diameter / believed_.grains.diameter, 3), "kg"));
  key(damper, "release.displacement", toml_of(release, "m"));
  // Densest layers: every other place of a grid of 1/sqrt(2) diameters.
  const double grid = diameter / std::numbers::sqrt2, row = std::floor((width - diameter) / grid) + 1;
  const double layer = diameter + grid * (std::ceil(count / std::floor(row * row / 2)) - 1);
  const auto length = [&](double way) { return layer + way * release + 2e-3; };
  std::vector<double> lengths{length(0.2), length(0.2), length(0.42), length(0.6), length(0.78)};
  if (number % 3 == 1) lengths = {lengths[2], lengths[2]};
  drawn.trial.runs = runs_of_lengths(lengths);
  for (PlannedRun& run : drawn.trial.runs) run = lasting(std::move(run), 12);
  key(damper, "box.length", toml_of(lengths.front(), "m"));
  if (number % 3 == 2) {  // driven near its frequency, by a tenth of the spring's pull at the release
    const auto shaken =
        std::find_if(hideable_effects().begin(), hideable_effects().end(),
                     [](const Hideable& one) { return one.effect->search.harmonic.has_value(); });
    const double pull = std::pow(2 * std::numbers::pi * frequency, 2) * release;
    for (Override& override : at_strength(*shaken, 0.1 * pull / shaken->strength.typical, believed_,
                                          {frequency * between(random, 0.7, 1.3), between(random, 0, 6)}))
      damper.push_back(std::move(override));
  }
  drawn.trial.hidden.believed = changed(believed_, damper, known_);
  truth.insert(truth.begin(), damper.begin(), damper.end());
}

/// Hides an effect inside the contacts, and one that acts on the box, on everything or in the camera.
void Draw::hide_pair(Random& random, std::vector<Override>& truth, BlindCase& drawn) const {
  std::vector<const Hideable*> inside, outside;
  for (const Hideable& hideable : hideable_effects()) {
    if (hideable.effect->acts_on == ActsOn::contact)
      inside.push_back(&hideable);
    else if (hideable.effect->acts_on != ActsOn::grains)
      outside.push_back(&hideable);
  }
  hide(random, *outside[choice(random, outside.size())], 12, truth, drawn);
  hide(random, *inside[choice(random, inside.size())], 12, truth, drawn);
}

/// Hides an effect that another imitates, and plans runs that tell the two apart.
void Draw::hide_twin(std::size_t number, Random& random, std::vector<Override>& truth,
                     BlindCase& drawn) const {
  const TwinPair& pair = twin_pairs()[number % twin_pairs().size()];
  hide(random, *find_hideable(pair.hidden), twin_signal, truth, drawn);
  drawn.twin = pair.twin;
  drawn.trial.runs = twin_runs(), drawn.more = design_.runs;
  const auto add = [&](const char* name, const char* length, const char* key, const std::string& value,
                       const char* duration) {
    drawn.more.push_back({name,
                          {{"box.length", toml_string(length), ""},
                           {key, value, ""},
                           {"run.duration", toml_string(duration), ""}}});
  };
  add("N60", "65 mm", "grains.count", "60", "12 s");
  add("N20", "40 mm", "grains.count", "20", "20 s");
  add("empty", "40 mm", "grains.count", "0", "12 s");
  // A late clock shifts the box by a distance that grows with the release; a push at release does not.
  add("half", "40 mm", "release.displacement",
      toml_string(write_quantity(0.5 * believed_.release.displacement, "m")), "12 s");
}

void Draw::hide_what_the_kind_says(Random& random, int index, std::vector<Override>& truth,
                                   BlindCase& drawn) const {
  const auto number = static_cast<std::size_t>(index);
  // All of a list in turn, each time round at the next signal: a few cases meet every one, many meet every
  // one at every signal.
  const auto hide_next = [&](const std::vector<Hideable>& all, double least_signal, auto accepts) {
    std::vector<const Hideable*> list;
    for (const Hideable& hideable : all)
      if (accepts(hideable)) list.push_back(&hideable);
    const std::size_t place = number % list.size(), turn = number / list.size();
    const double any = weakest_signal * std::pow(strongest_signal / weakest_signal, random.uniform());
    const double signal =
        design_.signals.empty() ? any : design_.signals[(place + turn) % design_.signals.size()];
    hide(random, *list[place], std::max(least_signal, signal), truth, drawn);
  };
  switch (drawn.kind) {
    case BlindKind::null: return;
    case BlindKind::parameters: return;
    case BlindKind::single:
      return hide_next(hideable_effects(), 0,
                       [](const Hideable& h) { return h.effect->acts_on != ActsOn::camera; });
    case BlindKind::camera:
      return hide_next(hideable_effects(), 0,
                       [](const Hideable& h) { return h.effect->acts_on == ActsOn::camera; });
    case BlindKind::films:
      film(random, truth, drawn);
      if (number % 4 == 0) return;  // a quarter hides nothing
      return hide_next(hideable_effects(), 0,
                       [](const Hideable& h) { return h.effect->acts_on != ActsOn::camera; });
    case BlindKind::dampers:
      if (number % 4 == 0) return;  // a quarter hides nothing
      return hide_next(hideable_effects(), 0, [&](const Hideable& h) {
        // What drives it is known; nobody asks for it a second time.
        return h.effect->acts_on != ActsOn::camera && (!h.effect->search.harmonic || number % 3 != 2);
      });
    case BlindKind::pair: return hide_pair(random, truth, drawn);
    case BlindKind::unlisted: return hide_next(hideable_forces(), 12, [](const Hideable&) { return true; });
    case BlindKind::twins: return hide_twin(number, random, truth, drawn);
  }
}

BlindCase Draw::one(BlindKind kind, int index) const {
  Random random(seed_, static_cast<std::uint64_t>(index) + 1000 * static_cast<std::uint64_t>(kind),
                Stream::hidden);
  BlindCase drawn;
  drawn.kind = kind;
  drawn.trial.runs = design_.runs;
  drawn.trial.recording = design_.recording;
  std::vector<Override> truth;
  nuisances(random, truth, drawn.trial.recording);
  drawn.trial.hidden.believed = believed_;
  if (kind == BlindKind::dampers) another_damper(random, index, truth, drawn);
  const bool as_believed =
      kind == BlindKind::null || (kind != BlindKind::parameters && random.uniform() < 0.25);
  if (!as_believed) parameters(random, drawn.trial.hidden.believed, truth);
  hide_what_the_kind_says(random, index, truth, drawn);
  drawn.trial.hidden.truth = changed(believed_, truth, known_);
  drawn.trial.seed = random.bits() >> 16;
  return drawn;
}

}  // namespace

BlindCounts parse_counts(std::string_view text, const std::string& origin) {
  BlindCounts counts{};
  for (const std::string& part : split_at_commas(text)) {
    const auto [key, value, place] = parse_override(part, origin);
    const auto found = std::find(blind_kind_names.begin(), blind_kind_names.end(), key);
    if (found == blind_kind_names.end())
      throw InputError(
          {{{origin, 0, 0}, key, "is not a kind of case", "known: " + listed(blind_kind_names)}});
    if (value.empty() || value.size() > 4 || value.find_first_not_of("0123456789") != value.npos)
      throw InputError({{{origin, 0, 0},
                         key,
                         "\"" + value + "\" is not a number of cases",
                         "write a whole number below 10000"}});
    counts[static_cast<std::size_t>(found - blind_kind_names.begin())] = std::stoi(value);
  }
  return counts;
}

const std::vector<TwinPair>& twin_pairs() {
  static const std::vector<TwinPair> pairs = [] {
    std::vector<TwinPair> read;
    for (const std::vector<std::string>& row : embedded_rows(twin_pairs_csv))
      read.push_back({row.at(0), row.at(1)});
    return read;
  }();
  return pairs;
}

std::vector<PlannedRun> twin_runs() { return lasting(runs_of_lengths({0.04, 0.04}), {10, 10}); }

std::string strength_name(std::string_view id, BlindKind kind) {
  return (kind == BlindKind::twins ? "twins:" : "") + std::string(id);
}

BlindDesign full_design() {
  return {lasting(runs_of_lengths({0.04, 0.04, 0.065, 0.085, 0.104}), {20, 20, 12, 10, 8}), {}, {}};
}

BlindDesign small_design() { return {lasting(runs_of_lengths({0.04, 0.065}), {5, 4}), {25}, {}}; }

BlindDesign varied(BlindDesign design, std::string_view variant, const std::string& origin) {
  const auto length_of = [](const PlannedRun& run) { return run.overrides.front().value; };
  if (variant == "one-repeat" || variant == "two-lengths") {
    std::vector<PlannedRun> kept;
    for (const PlannedRun& run : design.runs)
      if (kept.empty() || length_of(run) != length_of(kept.back())) kept.push_back(run);
    design.runs = variant == "one-repeat" ? kept : std::vector<PlannedRun>{kept.front(), kept.back()};
  } else if (variant == "half-duration") {
    for (PlannedRun& run : design.runs)
      for (Override& override : run.overrides)
        if (override.key == "run.duration") {
          const std::string text = override.value.substr(1, override.value.size() - 2);
          override.value = toml_of(std::get<Quantity>(parse_quantity(text)).si / 2, "s");
        }
  } else if (variant == "250fps") {
    design.recording.frame_rate = 250;
  } else if (variant == "missing") {
    design.recording.missing = 0.02;
  } else if (variant == "outliers") {
    design.recording.outliers = 0.05;
  } else if (variant == "no-centre") {
    design.recording.centre = false;
  } else if (!variant.empty()) {
    throw InputError({{{origin, 0, 0},
                       std::string(variant),
                       "is not a variant of the experiment",
                       "known: " + listed(variant_names)}});
  }
  return design;
}

std::vector<BlindCase> draw_cases(const Setup& believed, const BlindCounts& counts, const BlindDesign& design,
                                  const SignalLaws& laws, std::uint64_t seed, KnownEffects known) {
  const Draw draw(believed, design, laws, seed, known);
  std::vector<BlindCase> cases;
  for (std::size_t kind = 0; kind < counts.size(); ++kind)
    for (int index = 0; index < counts[kind]; ++index)
      cases.push_back(draw.one(static_cast<BlindKind>(kind), index));
  Random random(seed, 999999, Stream::hidden);  // Fisher and Yates
  for (std::size_t i = cases.size(); i > 1; --i)
    std::swap(cases[i - 1], cases[static_cast<std::size_t>(random.bits() % i)]);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "case_%04zu", i + 1);
    cases[i].name = name;
  }
  return cases;
}

std::vector<BlindCase> cases_within_reach(std::vector<BlindCase> cases, const Engine& laboratory) {
  std::erase_if(cases, [&](const BlindCase& one) {
    try {
      refuse_what_is_not_modelled(laboratory, one.trial.hidden.truth);
      return false;
    } catch (const InputError&) {
      return true;
    }
  });
  return cases;
}

}  // namespace shakedown
