// SPDX-License-Identifier: MIT
#include <algorithm>

#include "curve_table.hpp"
#include "kept_files.hpp"
#include "known_effects.hpp"
#include "override_tree.hpp"
#include "quantity.hpp"
#include "setup_file.hpp"
#include "setup_keys.hpp"
#include "suggestion.hpp"
#include "text.hpp"
#include "value_reading.hpp"

namespace shakedown {

namespace {

using Known = KnownEffects;

std::vector<std::string_view> names_of(Known known) {
  std::vector<std::string_view> names;
  for (const EffectRecord* record : known) names.push_back(record->name);
  return names;
}

std::vector<std::string_view> section_names() {
  std::vector<std::string_view> names;
  for (const SetupKey& key : setup_keys())
    if (names.empty() || names.back() != key.section()) names.push_back(key.section());
  names.push_back("effect");
  return names;
}

std::vector<std::string_view> keys_of_section(std::string_view section) {
  std::vector<std::string_view> names;
  for (const SetupKey& key : setup_keys())
    if (key.section() == section) names.push_back(key.name());
  return names;
}

/// Returns "did you mean ...?" and what is known.
std::string remedy_for(std::string_view word, std::span<const std::string_view> candidates,
                       const std::string& what) {
  return did_you_mean(word, candidates) + what + ": " + listed(candidates);
}

struct Reader {
  Known known;
  std::filesystem::path folder;
  Setup setup{};  ///< what is read goes on top of it
  std::vector<Violation> found{};
  std::size_t already = 0;  ///< effects that the setup had before

  void add(const SourcePlace& place, std::string key, std::string problem, std::string remedy) {
    found.push_back({place, std::move(key), std::move(problem), std::move(remedy)});
  }

  /// Stores the value, or the problem with its place.
  template <class T, class Store>
  void take(const ValueOrProblem<T>& value, const TomlValue& from, std::string_view path, Store store) {
    if (const auto* wrong = std::get_if<Problem>(&value))
      add(from.place, std::string(path), wrong->problem, wrong->remedy);
    else
      store(std::get<T>(value));
  }

  void read(const SetupKey& key, const TomlValue& value) {
    std::visit([&](auto field) { read_field(key, field, value); }, key.field);
  }
  void read_field(const SetupKey& key, Field<double> field, const TomlValue& value) {
    take(number_in(value, key.unit), value, key.path, [&](double number) { field(setup) = number; });
  }
  /// Reads two widths, ["50 mm", "60 mm"], or one for both.
  void read_field(const SetupKey& key, Field<std::array<double, 2>> field, const TomlValue& value) {
    if (value.kind != TomlValue::Kind::array)
      return take(number_in(value, key.unit), value, key.path, [&](double number) {
        field(setup) = {number, number};
      });
    if (value.items.size() != 2)
      return add(value.place, std::string(key.path),
                 "has " + std::to_string(value.items.size()) + " values (two are expected)",
                 "write both, e.g. [\"50 mm\", \"50 mm\"]");
    for (std::size_t i = 0; i < 2; ++i)
      take(number_in(value.items[i], key.unit), value.items[i], key.path,
           [&](double number) { field(setup)[i] = number; });
  }
  void read_field(const SetupKey& key, Field<int> field, const TomlValue& value) {
    take(count_in(value, key.high), value, key.path,
         [&](std::int64_t count) { field(setup) = static_cast<int>(count); });
  }
  void read_field(const SetupKey& key, Field<std::uint64_t> field, const TomlValue& value) {
    take(count_in(value, key.high), value, key.path,
         [&](std::int64_t count) { field(setup) = static_cast<std::uint64_t>(count); });
  }
  void read_field(const SetupKey& key, Field<bool> field, const TomlValue& value) {
    take(boolean_in(value), value, key.path, [&](bool given) { field(setup) = given; });
  }
  void read_field(const SetupKey& key, Field<std::string> field, const TomlValue& value) {
    take(text_in(value), value, key.path, [&](const std::string& text) {
      // The only text is the path of a file: absolute, so that the setup as used can be read from anywhere.
      const std::filesystem::path base = value.place.line > 0 ? folder : std::filesystem::path{};
      field(setup) = text.empty() ? "" : std::filesystem::absolute(base / text).lexically_normal().string();
    });
  }
  template <class Enumeration>
  void read_field(const SetupKey& key, Field<Enumeration> field, const TomlValue& value) {
    const auto choices = choices_of(key);
    take(choice_in(value, choices), value, key.path, [&](const std::string& word) {
      field(setup) =
          static_cast<Enumeration>(std::find(choices.begin(), choices.end(), word) - choices.begin());
    });
  }

  void unknown_key(const TomlEntry& section, const TomlEntry& entry) {
    std::string remedy;
    for (const SetupKey& key : setup_keys())
      if (key.name() == entry.key)
        remedy += (remedy.empty() ? "did you mean " : " or ") + std::string(key.path);
    if (!remedy.empty()) remedy += "? ";
    const auto names = keys_of_section(section.key);
    add(entry.place, section.key + "." + entry.key, "is not a key of a setup (the section has no such key)",
        remedy + remedy_for(entry.key, names, "keys of [" + section.key + "]"));
  }

  void read_section(const TomlEntry& section) {
    const auto names = section_names();
    if (std::find(names.begin(), names.end(), section.key) == names.end()) {
      const bool effect = known.find(section.key) != nullptr;
      std::vector<std::string_view> meant =
          names_of(known);  // --set EFFECT.PARAMETER=VALUE has an effect there
      meant.insert(meant.end(), names.begin(), names.end());
      return add(section.place, section.key, "is not a section of a setup",
                 effect ? "write [[effect]] and name = " + toml_string(section.key) + ", or --set " +
                              section.key + ".PARAMETER=VALUE"
                        : did_you_mean(section.key, meant) + "sections: " + listed(names));
    }
    if (section.value.kind != TomlValue::Kind::table)
      return add(section.place, section.key,
                 "is " + std::string(describe(section.value.kind)) + " (a section is expected)",
                 "write [" + section.key + "] and its keys below");
    for (const TomlEntry& entry : section.value.entries) {
      const SetupKey* key = find_setup_key(section.key + "." + entry.key);
      if (key == nullptr) {
        unknown_key(section, entry);
        continue;
      }
      setup.places[std::string(key->path)] = entry.value.place;
      read(*key, entry.value);
    }
  }

  /// Gives the curve through a table's points to another parameter as its formula.
  void read_points(const std::string& file, const Parameter& parameter, const SourcePlace& place,
                   const TomlValue& table, EffectChoice& choice) {
    const std::string formula(parameter.becomes);
    const std::string path = std::string(choice.record->name) + "." + std::string(parameter.name);
    if (table.find(formula) != nullptr)
      return add(place, path, "is given beside " + formula + " (each says the whole law)", "leave one out");
    const std::filesystem::path base = place.line > 0 ? folder : std::filesystem::path{};
    try {
      choice.values[formula] = curve_through_table(base / file, formula);
    } catch (const InputError& error) {
      found.insert(found.end(), error.violations.begin(), error.violations.end());
    }
  }

  void read_parameters(const TomlValue& table, EffectChoice& choice) {
    const EffectRecord& record = *choice.record;
    std::vector<std::string_view> names;
    for (const Parameter& parameter : record.parameters) names.push_back(parameter.name);
    for (const TomlEntry& entry : table.entries) {
      if (entry.key == "name") continue;
      const std::string path = std::string(record.name) + "." + entry.key;
      const Parameter* parameter = record.find(entry.key);
      if (parameter == nullptr) {
        add(entry.place, path, "is not a parameter of this effect",
            remedy_for(entry.key, names, "its parameters"));
        continue;
      }
      setup.places[path] = entry.value.place;
      take(parameter_in(entry.value, *parameter), entry.value, path, [&](const ParameterValue& value) {
        if (parameter->becomes.empty())
          choice.values[std::string(entry.key)] = value;
        else
          read_points(std::get<std::string>(value), *parameter, entry.value.place, table, choice);
      });
    }
    const auto is_given = [&](const Parameter& parameter) {
      return std::any_of(record.parameters.begin(), record.parameters.end(), [&](const Parameter& other) {
        return (other.name == parameter.name || other.becomes == parameter.name) &&
               table.find(other.name) != nullptr;
      });
    };
    for (const Parameter& parameter : record.parameters)
      if (parameter.required && !is_given(parameter))
        add(choice.place, std::string(record.name) + "." + std::string(parameter.name),
            "is missing (the effect has no strength without it)",
            parameter.unit.empty() ? "add it"
                                   : "add it, e.g. " + std::string(parameter.name) + " = \"" +
                                         write_quantity(parameter.typical, parameter.unit) + "\"");
  }

  void read_effect(const TomlValue& table) {
    const TomlValue* name = table.kind == TomlValue::Kind::table ? table.find("name") : nullptr;
    if (name == nullptr || name->kind != TomlValue::Kind::text)
      return add(table.place, "effect", "has no name",
                 "write name = \"...\"; `shakedown effects` lists the names");
    const EffectRecord* record = known.find(name->text);
    if (record == nullptr)
      return add(name->place, "effect.name", toml_string(name->text) + " is not an effect",
                 remedy_for(name->text, names_of(known), "effects"));
    EffectChoice choice = with_defaults(*record);
    choice.place = name->place;
    read_parameters(table, choice);
    if (EffectChoice* changed = changed_choice(*record)) {
      changed->values = std::move(choice.values);
      return;
    }
    setup.effects.push_back(std::move(choice));
  }

  /// Returns the effect as the setup had it before overrides, or nullptr.
  EffectChoice* changed_choice(const EffectRecord& record) {
    for (std::size_t i = 0; i < already; ++i)
      if (setup.effects[i].record == &record) return &setup.effects[i];
    return nullptr;
  }

  void read_effects(const TomlEntry& entry) {
    if (entry.value.kind != TomlValue::Kind::array)
      return add(entry.place, "effect",
                 "is " + std::string(describe(entry.value.kind)) + " (a list of effects is expected)",
                 "write [[effect]] with double brackets for each effect");
    for (const TomlValue& table : entry.value.items) read_effect(table);
  }

  void read_all(const TomlValue& root) {
    for (const TomlEntry& entry : root.entries)
      entry.key == "effect" ? read_effects(entry) : read_section(entry);
  }

  /// Adds what is wrong with the values that could be read.
  void check_values() {
    std::set<std::string, std::less<>> unread;
    for (const Violation& violation : found) unread.insert(violation.key);
    const std::vector<Violation> more = violations_of(setup, unread);
    found.insert(found.end(), more.begin(), more.end());
    std::stable_sort(found.begin(), found.end(), [](const Violation& a, const Violation& b) {
      return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
    });
  }

  Setup read_to_the_end(const TomlValue& root) {
    read_all(root);
    check_values();
    if (!found.empty()) throw InputError(std::move(found));
    std::erase_if(setup.effects, [](const EffectChoice& choice) { return is_neutral(choice); });
    return std::move(setup);
  }
};

/// Tells whether the first line has words or numbers with separators between them, as no setup has.
bool begins_as_table(std::string_view text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  return line.find_first_of(",;\t") != line.npos && line.find_first_of("=[#") == line.npos;
}

}  // namespace

Setup parse_setup(std::string_view text, const std::string& name, Known known,
                  std::span<const Override> overrides, const std::filesystem::path& folder) {
  TomlValue root = parse_toml(text, name);
  for (const Override& override : overrides) write_override(root, override, known);
  return Reader{known, folder}.read_to_the_end(root);
}

Setup with_overrides(Setup setup, std::span<const Override> overrides, Known known) {
  TomlValue root = changed_in_part(setup, overrides);
  for (const Override& override : overrides) write_override(root, override, known);
  Reader reader{known, {}, std::move(setup)};
  reader.already = reader.setup.effects.size();
  return reader.read_to_the_end(root);
}

Setup read_setup(const std::filesystem::path& file, Known known, std::span<const Override> overrides) {
  keep_unchanged(file);
  const std::string text = read_text_file(file);
  if (begins_as_table(text))
    throw InputError({{{file.string(), 1, 1},
                       "",
                       "is a table, not a setup",
                       "give the setup first and the tables by --data, through an experiment file: shakedown "
                       "import " +
                           file.string()}});
  if (parse_toml(text, file.string()).entries.empty())
    throw InputError({{{file.string(), 0, 0},
                       "",
                       "holds no key (everything would be the paper's damper)",
                       "check that it is the file you mean; harness/examples/L040.toml is such a setup"}});
  return parse_setup(text, file.string(), known, overrides, file.parent_path());
}

}  // namespace shakedown
