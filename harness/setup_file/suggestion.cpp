// SPDX-License-Identifier: MIT
#include "suggestion.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace shakedown {

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<int>> cost(a.size() + 1, std::vector<int>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cost[i][j] = static_cast<int>(i + j);
        continue;
      }
      const int replaced = cost[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      cost[i][j] = std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
    }
  return cost[a.size()][b.size()];
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  std::string_view best;
  if (word.size() < 2) return best;  // everything short is near
  int least = std::max(1, static_cast<int>(word.size()) / 3) + 1;
  for (const std::string_view candidate : candidates)
    if (const int distance = edit_distance(word, candidate); distance < least) {
      least = distance;
      best = candidate;
    }
  return best;
}

namespace {

std::vector<std::string_view> parts_of(std::string_view word) {
  std::vector<std::string_view> parts;
  while (!word.empty()) {
    const std::size_t end = std::min(word.find('_'), word.size());
    if (end > 0) parts.push_back(word.substr(0, end));
    word.remove_prefix(std::min(end + 1, word.size()));
  }
  return parts;
}

/// Returns how many letters differ over all parts of the word, each beside the part of the candidate that is
/// most like it; -1 where a part is like none.
int distance_by_parts(const std::vector<std::string_view>& word, std::string_view candidate) {
  const std::vector<std::string_view> parts = parts_of(candidate);
  int sum = 0;
  for (const std::string_view part : word) {
    int least = static_cast<int>(part.size()) / 4 + 1;
    for (const std::string_view other : parts) least = std::min(least, edit_distance(part, other));
    if (least > static_cast<int>(part.size()) / 4) return -1;
    sum += least;
  }
  return sum;
}

}  // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
  constexpr int slip = 2;
  constexpr std::size_t most = 3;
  std::vector<std::string_view> like;
  const std::string_view near = nearest(word, candidates);
  const std::vector<std::string_view> parts = parts_of(word);
  if (near.empty() || edit_distance(word, near) > slip) {
    int least = std::numeric_limits<int>::max();
    for (const std::string_view candidate : candidates) {
      const int distance = parts.empty() ? -1 : distance_by_parts(parts, candidate);
      if (distance < 0 || distance > least) continue;
      if (distance < least) like.clear();
      least = distance;
      like.push_back(candidate);
    }
  }
  if (like.empty() && !near.empty()) like.push_back(near);
  if (like.size() > most) like.resize(most);
  std::string text;
  for (const std::string_view one : like)
    text += (text.empty() ? "did you mean '" : " or '") + std::string(one) + "'";
  return text.empty() ? text : text + "? ";
}

std::string listed(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) (text += text.empty() ? "" : ", ") += word;
  return text;
}

}  // namespace shakedown
