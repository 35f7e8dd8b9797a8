// SPDX-License-Identifier: MIT
#include "added_effect.hpp"

#include <algorithm>

#include "catalogue.hpp"
#include "effects.hpp"
#include "suggestion.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

[[noreturn]] void refuse(const SourcePlace& place, const std::string& key, const std::string& problem,
                         const std::string& remedy) {
  throw InputError({{place, key, problem, remedy}});
}

const EffectRecord& record_named(const std::string& name) {
  if (const EffectRecord* record = find_effect(name)) return *record;
  std::vector<std::string_view> names;
  for (const EffectRecord* record : all_effects()) names.push_back(record->name);
  refuse({"EFFECT", 0, 0}, name, "is not an effect",
         did_you_mean(name, names) + "`shakedown effects` lists them");
}

bool has(const Setup& setup, const EffectRecord& record) {
  return std::any_of(setup.effects.begin(), setup.effects.end(),
                     [&](const EffectChoice& choice) { return choice.record == &record; });
}

/// Returns a value of the command line as it stands in a file: numbers, lists and tables as they are, all
/// else in quotes.
std::string as_toml(const std::string& value) {
  try {
    const TomlValue parsed = parse_toml("value = " + value, "");
    if (parsed.entries.size() == 1 && parsed.entries.front().value.kind != TomlValue::Kind::date)
      return value;
  } catch (const InputError&) {
  }
  return toml_string(value);
}

std::string lines_of(const EffectRecord& record, const std::vector<Override>& values) {
  if (values.empty()) return example_of(record);
  std::string lines = "[[effect]]\nname = " + toml_string(record.name) + "\n";
  for (const Override& value : values) lines += value.key + " = " + as_toml(value.value) + "\n";
  return lines;
}

std::vector<Override> parsed(const std::vector<std::string>& values) {
  std::vector<Override> overrides;
  std::vector<Violation> found;
  for (const std::string& value : values) {
    try {
      overrides.push_back(parse_override(value, "key=value"));
    } catch (const InputError& error) {
      found.insert(found.end(), error.violations.begin(), error.violations.end());
    }
  }
  if (!found.empty()) throw InputError(std::move(found));
  return overrides;
}

/// Returns the setup that the amended file must give when it is read back.
Setup wanted(const std::string& text, const std::filesystem::path& file, const EffectRecord& record,
             const std::vector<Override>& values) {
  if (has(parse_setup(text, file.string(), all_effects(), {}, file.parent_path()), record))
    refuse({file.string(), 0, 0}, std::string(record.name), "is in the setup already",
           "change its values there");
  std::vector<Override> overrides = values;
  for (Override& override : overrides) override.key = std::string(record.name) + "." + override.key;
  if (values.empty()) {
    const Setup example = parse_setup(example_of(record), "example", all_effects());
    Setup setup = parse_setup(text, file.string(), all_effects(), {}, file.parent_path());
    setup.effects.push_back(example.effects.at(0));
    return setup;
  }
  Setup setup = parse_setup(text, file.string(), all_effects(), overrides, file.parent_path());
  if (!has(setup, record))
    refuse({"key=value", 0, 0}, std::string(record.name), "does nothing at these values",
           "give it a strength");
  return setup;
}

}  // namespace

AmendedSetup with_effect_added(const std::string& text, const std::filesystem::path& file,
                               const std::string& effect, const std::vector<std::string>& values,
                               const std::filesystem::path& folder) {
  const EffectRecord& record = record_named(effect);
  const std::vector<Override> given = parsed(values);
  const Setup setup = wanted(text, file, record, given);
  const std::string appended =
      text + (text.empty() || text.ends_with('\n') ? "\n" : "\n\n") + lines_of(record, given);
  try {
    const Setup back = parse_setup(appended, file.string() + " with " + effect, all_effects(), {}, folder);
    if (write_setup(back) == write_setup(setup)) return {appended, back, true};
  } catch (const InputError&) {
    // two effects that exclude each other
    if (const std::vector<Violation> wrong = violations_of(setup); !wrong.empty()) throw;
  }
  // Effects in one line, or a path that counts from another folder.
  const std::string anew = write_setup(setup);
  return {anew, parse_setup(anew, file.string() + " with " + effect, all_effects(), {}, folder), false};
}

}  // namespace shakedown
