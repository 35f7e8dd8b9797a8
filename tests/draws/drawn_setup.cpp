// SPDX-License-Identifier: MIT
#include "drawn_setup.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <utility>
#include <vector>

#include "effects.hpp"
#include "random.hpp"
#include "setup_keys.hpp"

namespace shakedown {

namespace {

class Drawing {
 public:
  explicit Drawing(std::uint64_t number) : random_(number, 0, Stream::other) {}

  std::string setup() {
    // The last of two lines for one key would be an error: keys are drawn without repetition.
    std::vector<const SetupKey*> keys;
    for (const SetupKey& key : setup_keys())
      if (is_numeric(key) || !choices_of(key).empty()) keys.push_back(&key);
    std::vector<std::pair<const SetupKey*, std::string>> drawn;
    for (std::size_t i = 0, many = 1 + below(4); i < many; ++i) {
      const std::size_t at = below(keys.size());
      drawn.emplace_back(keys[at], value_of(*keys[at]));
      keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(at));
    }
    if (std::none_of(drawn.begin(), drawn.end(),
                     [](const auto& one) { return one.first->path == "run.duration"; }))
      drawn.emplace_back(find_setup_key("run.duration"), "\"3 s\"");
    std::ostringstream text;
    text.precision(17);
    // A dotted key stands wherever its section is not written as a table.
    for (const auto& [key, value] : drawn) text << key->path << " = " << value << "\n";
    const KnownEffects effects = all_effects();
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0, many = below(3); i < many; ++i) {
      const std::size_t at = below(effects.size());
      if (std::find(chosen.begin(), chosen.end(), at) != chosen.end()) continue;
      chosen.push_back(at);
      write(*effects[at], text);
    }
    return text.str();
  }

 private:
  std::size_t below(std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(random_.uniform() * static_cast<double>(n)));
  }

  /// Anywhere from low to high; `usual` where there is no bound.
  double number(double low, double high, double usual) {
    constexpr double decades = 6;  // to either side of what is usual
    if (usual == 0 || !std::isfinite(usual)) usual = 1;
    const double most = std::isfinite(high) ? high : std::abs(usual) * std::pow(10, decades),
                 least = std::isfinite(low) ? low : -std::abs(usual) * std::pow(10, decades);
    if (random_.uniform() < 0.1) return random_.uniform() < 0.5 ? least : most;
    const bool negative = least < 0 && (most <= 0 || random_.uniform() < 0.5);
    const double top = negative ? -least : most;
    double bottom = std::max(negative ? -most : least, 0.0);
    if (bottom == 0) bottom = std::min(top, std::abs(usual)) * std::pow(10, -decades);
    if (!(top > bottom)) return negative ? -top : top;
    const double size = bottom * std::pow(top / bottom, random_.uniform());
    return negative ? -size : size;
  }

  std::string value_of(const SetupKey& key) {
    const std::span<const std::string_view> words = choices_of(key);
    if (!words.empty()) return "\"" + std::string(words[below(words.size())]) + "\"";
    const std::vector<double> usual = numbers_of(key, Setup{});
    const bool whole = key.path == "grains.count" || key.path == "run.seed";
    std::string text;
    for (const double one : usual) {
      double value = number(key.low, key.high, one);
      if (whole) value = std::floor(std::min(value, 9e18));
      text += (text.empty() ? "" : ", ") +
              (whole ? std::to_string(static_cast<std::int64_t>(value)) : toml_of(value, key.unit));
    }
    return usual.size() > 1 ? "[" + text + "]" : text;
  }

  void write(const EffectRecord& record, std::ostringstream& text) {
    text << "[[effect]]\nname = \"" << record.name << "\"\n";
    for (const Parameter& parameter : record.parameters) {
      const double typical = parameter.typical;
      if (!parameter.required && random_.uniform() < 0.3) continue;
      if (parameter.kind == ParameterKind::number)
        text << parameter.name << " = "
             << toml_of(number(parameter.low, parameter.high, typical), parameter.unit) << "\n";
      if (parameter.kind == ParameterKind::vector) {
        text << parameter.name << " = [";
        for (int axis = 0; axis < 3; ++axis)
          text << (axis > 0 ? ", " : "")
               << toml_of(number(parameter.low, parameter.high, typical), parameter.unit);
        text << "]\n";
      }
      if (parameter.kind == ParameterKind::choice)
        text << parameter.name << " = \"" << parameter.choices[below(parameter.choices.size())] << "\"\n";
      if (parameter.kind == ParameterKind::text || parameter.kind == ParameterKind::constants)
        if (!parameter.example.empty()) text << parameter.name << " = " << parameter.example << "\n";
    }
  }

  Random random_;
};

}  // namespace

std::string drawn_setup(std::uint64_t number) { return Drawing(number).setup(); }

}  // namespace shakedown
