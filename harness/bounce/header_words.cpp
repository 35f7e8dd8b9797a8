// SPDX-License-Identifier: MIT
// What headers of tables of bounces say, in English, German, French, Italian and Spanish.
#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "table_layout.hpp"

namespace shakedown {

namespace {

std::vector<std::string> words_of(const std::string& header) {
  std::vector<std::string> words(1);
  for (const char letter : header) {
    const unsigned char c = static_cast<unsigned char>(letter);
    if (std::isalpha(c) || c >= 0x80)
      words.back() += static_cast<char>(std::tolower(c));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

struct Vocabulary {
  Topic topic;
  std::vector<std::string_view> whole, begins;
};

const std::vector<Vocabulary>& vocabulary() {
  static const std::vector<Vocabulary> all{
      {Topic::error,
       {"err", "sd", "std", "unc", "u", "sigma", "se"},
       {"error", "uncert", "incert", "fehler", "unsicher", "devia", "abweich", "ecart-type", "sigma"}},
      {Topic::other_quantity,
       {"v", "e", "cor", "speed", "amp"},
       {"veloc", "vitesse", "geschw", "restit", "coeff", "energ", "temper", "mass", "ampli", "volume",
        "ratio", "dist"}},
      {Topic::interval,
       {"dt", "\xce\x94t", "\xce\xb4t", "tof", "gap", "intervalle"},
       {"interv", "delta", "flight", "flug", "durat", "dauer", "period", "between", "spacing", "abstand",
        "zwischen", "diff", "volo", "vuelo", "vol", "ecart",
        "\xc3\xa9"
        "cart"}},
      {Topic::index,
       {"n", "no", "nr", "i", "k", "id", "index", "num", "number", "nummer"},
       {"bounce", "impact", "hit", "rimbalz", "rebond", "rebote", "aufprall", "sto\xc3\x9f", "stoss",
        "numero", "num\xc3\xa9r"}},
      {Topic::height,
       {"h", "y", "z"},
       {"height", "h\xc3\xb6he", "hoehe", "hauteur", "altez", "altura", "quota", "fallh", "pos", "y"}},
      {Topic::instant,
       {"t", "s", "ms"},
       {"time", "zeit", "temps", "tempo", "tiempo", "instant", "istant", "onset", "clock", "uhr", "stamp",
        "moment"}}};
  return all;
}

}  // namespace

Topic topic_of(const std::string& header) {
  const std::vector<std::string> words = words_of(header);
  for (const Vocabulary& entry : vocabulary())
    for (const std::string& word : words) {
      const auto is = [&](std::string_view one) { return word == one; };
      const auto begins = [&](std::string_view one) {
        return word.starts_with(one) && (one.size() > 1 || word.size() == 1);
      };
      if (std::any_of(entry.whole.begin(), entry.whole.end(), is) ||
          std::any_of(entry.begins.begin(), entry.begins.end(), begins))
        return entry.topic;
    }
  return Topic::none;
}

std::string unit_in_name(const std::string& header) {
  const std::size_t at = header.find_last_of("_ ,/");
  if (at == std::string::npos || at + 1 >= header.size()) return "";
  const std::string last = header.substr(at + 1);
  constexpr std::array<std::string_view, 9> units{"s", "ms", "us", "sec", "m", "cm", "mm", "px", "\xc2\xb5s"};
  return std::find(units.begin(), units.end(), last) != units.end() ? last : "";
}

}  // namespace shakedown
