// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace furrow::io {

/// How many letters must be added, removed or replaced to get from one word to the other. Cost: O(|a| |b|).
/// Source: Wagner, Fischer, J. ACM 21 (1974) 168-173.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] != b[j]);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// The first of the nearest words, for "did you mean"; only the first 64 letters of a word count.
/// `words` must not be empty.
inline std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
  const auto distance = [&](const std::string& w) { return edit_distance(word.substr(0, 64), w); };
  return *std::ranges::min_element(words, {}, distance);
}

}  // namespace furrow::io
