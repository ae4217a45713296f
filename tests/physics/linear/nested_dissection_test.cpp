// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/linear/nested_dissection.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "physics/base/cancel_scope.h"
#include "physics/base/progress.h"

using namespace furrow::physics;
using Lists = std::vector<std::vector<int>>;

namespace {

/// Neighbours on a sheet of n x n.
Lists sheet(int n) {
  Lists below(std::size_t(n * n));
  for (int i = 0; i < n * n; ++i) {
    if (i % n < n - 1) below[std::size_t(i)].push_back(i + 1);
    if (i + n < n * n) below[std::size_t(i)].push_back(i + n);
  }
  return below;
}

/// Entries of the factor below its diagonal, by elimination as it is.
std::size_t factor_size(const Lists& below, const std::vector<int>& place) {
  std::vector<std::set<int>> rows(below.size());
  for (std::size_t c = 0; c < below.size(); ++c) {
    for (const int r : below[c]) {
      const auto [low, high] = std::minmax(place[c], place[std::size_t(r)]);
      rows[std::size_t(low)].insert(high);
    }
  }
  std::size_t size = 0;
  for (auto& column : rows) {
    size += column.size();
    if (!column.empty()) rows[std::size_t(*column.begin())].insert(++column.begin(), column.end());
  }
  return size;
}

}  // namespace

TEST_CASE("nested_dissection: it is a permutation, the same each time, with a small factor") {
  const Lists below = sheet(40);
  const std::vector<int> place = nested_dissection(ColumnRows(below));
  std::vector<int> sorted = place, natural(place.size());
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < 1600; ++i) natural[std::size_t(i)] = i;
  CHECK(sorted == natural);
  CHECK(nested_dissection(ColumnRows(below)) == place);
  // Of the order n^2 log n against the band's n^3.
  CHECK(factor_size(below, place) < factor_size(below, natural) / 2);
}

TEST_CASE("nested_dissection: it takes nothing, one column, and columns that nothing joins") {
  CHECK(nested_dissection(ColumnRows(Lists{})).empty());
  CHECK(nested_dissection(ColumnRows(Lists(1))) == std::vector{0});
  CHECK(nested_dissection(ColumnRows(Lists(3))) == std::vector{0, 1, 2});
  Lists some(300);  // one pair among loners
  some[7].push_back(250);
  std::vector<int> place = nested_dissection(ColumnRows(some));
  std::sort(place.begin(), place.end());
  for (int i = 0; i < 300; ++i) CHECK(place[std::size_t(i)] == i);
}

TEST_CASE(
    "nested_dissection: a large graph is cut in pieces, with as small a factor, and questions in between") {
  const Lists below = sheet(200);
  int asked = 0;
  std::vector<int> place;
  {
    const CancelScope scope([&] { return ++asked < 0; });
    place = nested_dissection(ColumnRows(below));
  }
  CHECK(asked >= 3);
  CHECK(nested_dissection(ColumnRows(below)) == place);
  std::vector<int> sorted = place;
  std::sort(sorted.begin(), sorted.end());
  for (int i = 0; i < 40000; ++i) REQUIRE(sorted[std::size_t(i)] == i);
  // Nested dissection of a sheet of n x n by hand: 31/4 n^2 log2 n entries and lower terms (George 1973).
  CHECK(double(factor_size(below, place)) < 31.0 / 4 * 40000 * std::log2(200.0));
  const CancelScope scope([&] { return true; });
  CHECK_THROWS_AS(nested_dissection(ColumnRows(below)), Cancelled);
}
