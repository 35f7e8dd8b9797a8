// SPDX-License-Identifier: MIT
#include "score_table.hpp"

#include <fmt/format.h>

namespace shakedown {

namespace {

using Kept = BlindFigure::Verdict;

std::string words(const Share& share) { return share.trials == 0 ? "no such case" : in_words(share); }

Kept verdict(const Share& share, bool good) {
  return share.trials == 0 ? Kept::not_measured : good ? Kept::met : Kept::missed;
}

}  // namespace

void ScoreTable::at_most(const std::string& what, const Count& count, double limit) {
  const Share share = share_of(count.hits, count.trials);
  plain(what, fmt::format("at most {:.0f} %", 100 * limit), words(share),
        verdict(share, share.value <= limit));
}

void ScoreTable::at_least(const std::string& what, const Count& count, double limit) {
  const Share share = share_of(count.hits, count.trials);
  plain(what, fmt::format("at least {:.0f} %", 100 * limit), words(share),
        verdict(share, share.value >= limit));
}

void ScoreTable::between(const std::string& what, const Count& count, double low, double high) {
  const Share share = share_of(count.hits, count.trials);
  plain(what, fmt::format("{:.0f} to {:.0f} %", 100 * low, 100 * high), words(share),
        share.trials >= 20 ? verdict(share, share.value >= low && share.value <= high) : Kept::not_measured);
}

void ScoreTable::plain(const std::string& what, const std::string& aim, const std::string& found, Kept kept) {
  rows.push_back({what, aim, found, kept});
}

void ScoreTable::beside(const std::string& what, const Count& count) {
  plain(what, "-", words(share_of(count.hits, count.trials)), Kept::not_measured);
}

}  // namespace shakedown
