// SPDX-License-Identifier: MIT
// One table holds the setup's keys: reading, writing, overrides, bounds, JSON schema and documentation come
// from it.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "setup.hpp"

namespace shakedown {

constexpr std::array<std::string_view, 3> domain_names{"damper", "closed",
                                                       "periodic"};  ///< by value of Domain
constexpr std::array<std::string_view, 4> packing_names{"fcc", "square", "random",
                                                        "spread"};  ///< by value of Packing
/// Return the name that a setup file gives the value.
inline std::string_view name_of(Domain domain) { return domain_names[static_cast<std::size_t>(domain)]; }
inline std::string_view name_of(Packing packing) { return packing_names[static_cast<std::size_t>(packing)]; }
/// Returns the packing of this name, which must be one of packing_names (EXPECT).
Packing packing_of(std::string_view name);

template <class T>
using Field = T& (*)(Setup&);

/// Where a key's value lives; its type says how it is written in a file.
using SetupField = std::variant<Field<double>, Field<std::array<double, 2>>, Field<int>, Field<std::uint64_t>,
                                Field<bool>, Field<std::string>, Field<Domain>, Field<Packing>>;

struct SetupKey {
  std::string_view path;  ///< "box.mass"
  SetupField field;
  std::string_view
      unit;  ///< in which people read and write it, e.g. "mm"; empty: none. The setup itself holds SI.
  double low, high;           ///< bounds of a numeric value, SI
  bool low_excluded = false;  ///< must be greater than `low`, not equal
  std::string_view sentence;

  /// Return the parts of the path before and behind its dot: "box" and "mass".
  std::string_view section() const { return path.substr(0, path.find('.')); }
  std::string_view name() const { return path.substr(path.find('.') + 1); }
};

/// Returns every key except the list of effects, in the order in which a setup file is written.
std::span<const SetupKey> setup_keys();

/// Returns the key of this path, or nullptr.
const SetupKey* find_setup_key(std::string_view path);

/// Returns the words that a choice may be (domain.kind, release.packing); empty for other keys.
std::span<const std::string_view> choices_of(const SetupKey& key);

/// True for keys that set_number can set: quantities, pure numbers and counts.
bool is_numeric(const SetupKey& key);

/// Returns the numbers behind a numeric key (two for box.width, else one), SI; empty for other keys.
std::vector<double> numbers_of(const SetupKey& key, const Setup& setup);

/// Returns the value as it stands in a TOML file: `"40 mm"`, `37`, `["50 mm", "50 mm"]`, `"fcc"`, `false`.
std::string toml_of(const SetupKey& key, const Setup& setup);

/// Returns a quantity as it stands in a TOML file: `"40 mm"`, or `0.75` without a unit.
std::string toml_of(double si, std::string_view unit);

}  // namespace shakedown
