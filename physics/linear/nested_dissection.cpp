// SPDX-License-Identifier: MIT
#include "physics/linear/nested_dissection.h"

#include <metis.h>

#include <mutex>
#include <new>
#include <numeric>

namespace furrow::physics {

std::vector<int> nested_dissection(std::span<const std::vector<int>> below) {
  std::vector<idx_t> first(below.size() + 1, 0);
  for (std::size_t c = 0; c < below.size(); ++c) {
    first[c + 1] += idx_t(below[c].size());
    for (const int r : below[c]) ++first[std::size_t(r) + 1];
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<int> place(below.size());
  std::iota(place.begin(), place.end(), 0);
  if (first.back() == 0) return place;  // nothing is joined
  std::vector<idx_t> next(first.begin(), first.end() - 1), neighbours(std::size_t(first.back()));
  for (std::size_t c = 0; c < below.size(); ++c) {
    for (const int r : below[c]) {
      neighbours[std::size_t(next[c]++)] = r;
      neighbours[std::size_t(next[std::size_t(r)]++)] = idx_t(c);
    }
  }
  idx_t options[METIS_NOPTIONS], n = idx_t(below.size());
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_COMPRESS] = 0;  // vertices of a mesh have no twins
  std::vector<idx_t> order(below.size()), found(below.size());
  static std::mutex random_numbers;
  const std::lock_guard lock(random_numbers);
  if (METIS_NodeND(&n, first.data(), neighbours.data(), nullptr, options, order.data(), found.data()) !=
      METIS_OK)
    throw std::bad_alloc();
  place.assign(found.begin(), found.end());
  return place;
}

}  // namespace furrow::physics
