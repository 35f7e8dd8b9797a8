// SPDX-License-Identifier: MIT
// The corpora, and simple damage to them, through every reader: any compiler, the same bytes
// each time. A refusal is fine, anything else is a finding. By hand, longer: `test_fuzz TARGET MINUTES SEED`;
// one file: `test_fuzz TARGET FILE`.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "random.hpp"
#include "targets.hpp"

using namespace shakedown;
namespace fs = std::filesystem;

namespace {

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<std::string> corpus_of(std::string_view target) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(FUZZ_CORPUS) / target))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> corpus;
  for (const fs::path& file : files) corpus.push_back(bytes_of(file));
  return corpus;
}

/// Damage as editors, disks and people do it, at random places.
class Damage {
 public:
  explicit Damage(std::uint64_t seed) : random_(seed, 0, Stream::other) {}

  std::string to(std::string bytes) {
    const std::size_t times = 1 + below(4);
    for (std::size_t i = 0; i < times; ++i) once(bytes);
    return bytes;
  }
  std::size_t below(std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(random_.uniform() * static_cast<double>(n)));
  }

 private:
  void once(std::string& bytes) {
    static constexpr std::array<std::string_view, 20> words{
        "1e308",    "-1",
        "nan",      "inf",
        "0",        "\n",
        "\"",       "[[",
        "]",        ",",
        "1e9",      ";",
        "-",        "= ",
        ".",        " ",
        "\xff\xfe", std::string_view("\0\0\0\0\0\0\0\0", 8),
        "(",        "9999999999999999999"};
    if (bytes.empty()) bytes = " ";
    const std::size_t at = below(bytes.size()),
                      length = below(std::min<std::size_t>(bytes.size() - at, 16)) + 1;
    const std::string_view word = words[below(words.size())];
    switch (below(6)) {
      case 0: bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8))); break;
      case 1: bytes[at] = static_cast<char>(below(256)); break;
      case 2: bytes.erase(at, length); break;
      case 3: bytes.insert(below(bytes.size()), bytes.substr(at, length)); break;
      case 4: bytes.insert(at, word); break;
      default: bytes.replace(at, length, word);
    }
  }
  Random random_;
};

class Fuzz : public testing::TestWithParam<FuzzTarget> {};

/// Which bytes it was, where a reader ends the program.
void leave(const std::string& bytes) {
  if (const char* file = std::getenv("FUZZ_LAST"))
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

}  // namespace

TEST_P(Fuzz, CorpusAndDamageToIt) {
  constexpr int damages = 60;  // of each file
  const std::vector<std::string> corpus = corpus_of(GetParam().name);
  ASSERT_FALSE(corpus.empty());
  Damage damage(1);
  for (const std::string& bytes : corpus) {
    EXPECT_NO_THROW(GetParam().read(bytes)) << bytes;
    for (int i = 0; i < damages; ++i) {
      const std::string damaged = damage.to(bytes);
      EXPECT_NO_THROW(GetParam().read(damaged)) << damaged;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EachTarget, Fuzz, testing::ValuesIn(fuzz_targets().begin(), fuzz_targets().end()),
                         [](const auto& target) { return std::string(target.param.name); });

namespace {

/// For some minutes by hand; returns 1 with the damaged bytes in $FUZZ_LAST at the first finding.
int hunt(const FuzzTarget& target, double minutes, std::uint64_t seed) {
  const std::vector<std::string> corpus = corpus_of(target.name);
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto end = now() + std::chrono::duration<double>(60 * minutes);
  Damage damage(seed);
  double longest = 0;  // s
  long inputs = 0;
  for (; now() < end; ++inputs) {
    const std::string bytes = damage.to(corpus[damage.below(corpus.size())]);
    leave(bytes);
    const auto begin = now();
    try {
      target.read(bytes);
    } catch (const std::exception& finding) {
      std::cout << target.name << ": " << finding.what() << "\n";
      return 1;
    }
    longest = std::max(longest, std::chrono::duration<double>(now() - begin).count());
  }
  std::cout << target.name << ": " << inputs << " inputs, longest " << longest << " s, no finding\n";
  return 0;
}

}  // namespace

int main(int count, char** words) {
  testing::InitGoogleTest(&count, words);
  if (const FuzzTarget* target = count >= 3 ? find_fuzz_target(words[1]) : nullptr) {
    if (count == 3) return target->read(bytes_of(words[2])), 0;
    if (count == 4)
      return hunt(*target, std::strtod(words[2], nullptr), std::strtoull(words[3], nullptr, 10));
  }
  return RUN_ALL_TESTS();
}
