// SPDX-License-Identifier: MIT
#include "ledger.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <ctime>

#include "errors.hpp"
#include "output_file.hpp"
#include "toml_document.hpp"

namespace shakedown {

namespace {

constexpr std::string_view header = "study,seed,program,drawn,answered,opened";

std::string now() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

std::string without_commas(std::string text) {
  std::replace(text.begin(), text.end(), ',', ';');
  return text;
}

LedgerLine parsed(std::string_view text, const std::string& file, int number) {
  std::array<std::string, 6> cells;
  std::size_t cell = 0;
  for (const char c : text) {
    if (c == ',')
      ++cell;
    else if (cell < cells.size())
      cells[cell] += c;
  }
  LedgerLine line{cells[0], 0, cells[2], cells[3], cells[4], cells[5]};
  const std::string& seed = cells[1];
  const auto [end, wrong] = std::from_chars(seed.data(), seed.data() + seed.size(), line.seed);
  if (cell != 5 || wrong != std::errc{} || end != seed.data() + seed.size())
    throw InputError({{{file, number, 1}, "", "is no line of a ledger", "expected " + std::string(header)}});
  return line;
}

bool is_of(const LedgerLine& line, const LedgerKey& key) {
  return line.study == key.study && line.seed == key.seed;
}

}  // namespace

SeedLedger::SeedLedger(std::filesystem::path file) : file_(std::move(file)) {
  if (file_.empty() || !std::filesystem::exists(file_)) return;
  const std::string text = read_text_file(file_);
  int number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = std::string_view(text).substr(at, end - at);
    if (++number == 1 && line != header)
      throw InputError({{{file_.string(), 1, 1}, "", "is no ledger", "expected " + std::string(header)}});
    if (number > 1 && !line.empty()) lines_.push_back(parsed(line, file_.string(), number));
    at = end + 1;
  }
}

LedgerKey SeedLedger::begin(const std::string& study, std::uint64_t seed, const std::string& program) {
  const LedgerKey key{study, seed, now()};
  line(key).program = without_commas(program);
  write();
  return key;
}

LedgerLine& SeedLedger::line(const LedgerKey& key) {
  for (LedgerLine& line : lines_)
    if (is_of(line, key) && line.drawn == key.drawn) return line;
  return lines_.emplace_back(LedgerLine{key.study, key.seed, "", key.drawn, "", ""});
}

void SeedLedger::answered(const LedgerKey& key) {
  if (std::string& time = line(key).answered; time.empty()) time = now();
  write();
}

void SeedLedger::opened(const LedgerKey& key) {
  if (std::string& time = line(key).opened; time.empty()) time = now();
  write();
}

bool SeedLedger::seen(const LedgerKey& key) const {
  std::string answered = now();
  for (const LedgerLine& line : lines_)
    if (is_of(line, key) && line.drawn == key.drawn && !line.answered.empty()) answered = line.answered;
  return std::any_of(lines_.begin(), lines_.end(), [&](const LedgerLine& line) {
    return is_of(line, key) && line.drawn != key.drawn && !line.opened.empty() && line.opened < answered;
  });
}

void SeedLedger::write() const {
  if (file_.empty()) return;
  std::string text(header);
  for (const LedgerLine& line : lines_)
    text += fmt::format("\n{},{},{},{},{},{}", line.study, line.seed, line.program, line.drawn, line.answered,
                        line.opened);
  write_file(file_, text + "\n");
}

}  // namespace shakedown
