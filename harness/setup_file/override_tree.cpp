// SPDX-License-Identifier: MIT
#include "override_tree.hpp"

#include <algorithm>

#include "known_effects.hpp"
#include "setup_keys.hpp"
#include "text.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

TomlValue value_of_override(const Override& override) {
  const SourcePlace place{override.origin, 0, 0};
  TomlValue value;
  try {
    TomlValue parsed = parse_toml("value = " + override.value, override.origin);
    if (parsed.entries.size() == 1) value = std::move(parsed.entries.front().value);
  } catch (const InputError&) {
    value.kind = TomlValue::Kind::text;  // a bare word or quantity
    value.text = override.value;
  }
  value.place = place;
  for (TomlValue& item : value.items) item.place = place;
  for (TomlEntry& entry : value.entries) entry.place = entry.value.place = place;
  return value;
}

TomlEntry& entry_of(TomlValue& table, std::string_view key, const SourcePlace& place) {
  for (TomlEntry& entry : table.entries)
    if (entry.key == key) return entry;
  TomlValue empty;
  empty.place = place;
  return table.entries.emplace_back(TomlEntry{std::string(key), place, std::move(empty)});
}

/// Makes a table of something that is none, so that the reader sees and reports the key below it.
TomlValue& as_table(TomlValue& value, const SourcePlace& place) {
  if (value.kind == TomlValue::Kind::table) return value;
  value = TomlValue{};
  value.place = place;
  return value;
}

/// Returns the table of an effect in the list `effect`, made when it is not there.
TomlValue& effect_table(TomlValue& root, std::string_view name, const SourcePlace& place) {
  TomlValue& list = entry_of(root, "effect", place).value;
  // [effect] in the file: the reader reports it
  if (list.kind != TomlValue::Kind::array && list.place.line > 0) return list;
  list.kind = TomlValue::Kind::array;
  for (TomlValue& item : list.items)
    if (const TomlValue* found = item.find("name"); found != nullptr && found->text == name) return item;
  TomlValue item, text;
  text.kind = TomlValue::Kind::text;
  text.text = name;
  text.place = item.place = place;
  item.entries.push_back({"name", place, std::move(text)});
  return list.items.emplace_back(std::move(item));
}

/// Returns the component of an array that .x, .y or .z names, or nullptr.
TomlValue* component_named(TomlValue& array, std::string_view axis) {
  if (array.kind != TomlValue::Kind::array || axis.size() != 1 || axis[0] < 'x' || axis[0] > 'z')
    return nullptr;
  const std::size_t index = static_cast<std::size_t>(axis[0] - 'x');
  return index < array.items.size() ? &array.items[index] : nullptr;
}

void set(TomlEntry& entry, TomlValue value) {
  entry.place = value.place;
  entry.value = std::move(value);
}

/// Returns the table of an effect that the setup has, to be changed in part; what is not changed keeps its
/// place.
TomlValue table_of(const EffectChoice& choice, const Setup& setup) {
  TomlValue table = parse_toml(write_effect(choice), "").find("effect")->items.front();
  table.place = choice.place;
  for (TomlEntry& entry : table.entries)
    entry.place = entry.value.place =
        entry.key == "name" ? choice.place
                            : place_of(setup, std::string(choice.record->name) + "." + entry.key);
  return table;
}

}  // namespace

void write_override(TomlValue& root, const Override& override, KnownEffects known) {
  TomlValue value = value_of_override(override);
  const SourcePlace place = value.place;
  std::string_view path = override.key;
  const auto next_word = [&] {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const std::string_view word = path.substr(0, dot);
    path.remove_prefix(std::min(dot + 1, path.size()));
    return word;
  };
  std::string_view word = next_word();
  if (path.empty()) return set(entry_of(root, word, place), std::move(value));
  TomlValue* table = known.find(word) ? &effect_table(root, word, place)
                                      : &as_table(entry_of(root, word, place).value, place);
  for (word = next_word(); !path.empty(); word = next_word()) {
    TomlEntry& deeper = entry_of(*table, word, place);
    if (TomlValue* axis = component_named(deeper.value, path)) {
      *axis = std::move(value);
      return;
    }
    table = &as_table(deeper.value, place);
  }
  set(entry_of(*table, word, place), std::move(value));
}

TomlValue changed_in_part(const Setup& setup, std::span<const Override> overrides) {
  TomlValue root;
  for (const Override& override : overrides) {
    const std::string_view key = override.key;
    const SourcePlace place{override.origin, 0, 0};
    if (const EffectChoice* choice = find_choice(setup, key.substr(0, key.find('.')))) {
      TomlValue& list = entry_of(root, "effect", place).value;
      list.kind = TomlValue::Kind::array;
      const auto same = [&](const TomlValue& item) {
        return item.find("name")->text == choice->record->name;
      };
      if (std::none_of(list.items.begin(), list.items.end(), same))
        list.items.push_back(table_of(*choice, setup));
    } else if (const SetupKey* list = find_setup_key(key.substr(0, key.rfind('.')))) {
      TomlValue& section = entry_of(root, list->section(), place).value;
      set(entry_of(section, list->name(), place),
          value_of_override({"", toml_of(*list, setup), override.origin}));
    }
  }
  return root;
}

Override parse_override(std::string_view text, const std::string& origin) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0)
    throw InputError({{{origin, 0, 0},
                       "",
                       toml_string(text) + " does not set a key",
                       "write it as key=value, e.g. box.length=65mm"}});
  return {std::string(trimmed(text.substr(0, equals))), std::string(trimmed(text.substr(equals + 1))),
          origin};
}

std::string toml_value(const Override& override) {
  const TomlValue value = value_of_override(override);
  return value.kind == TomlValue::Kind::text ? toml_string(value.text) : override.value;
}

}  // namespace shakedown
