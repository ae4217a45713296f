// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/chain_segments.h"

#include <rapidcheck.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

using furrow::io::Chain;
using furrow::io::chain_segments;
using Segments = std::vector<std::array<std::size_t, 2>>;
using List = std::vector<std::size_t>;

TEST_CASE("chain_segments: a path in disorder is one chain") {
  const auto chains = chain_segments({{2, 3}, {0, 1}, {4, 3}, {2, 1}});
  REQUIRE(chains.size() == 1);
  CHECK_FALSE(chains[0].closed);
  CHECK((chains[0].vertices == List{0, 1, 2, 3, 4} || chains[0].vertices == List{4, 3, 2, 1, 0}));
}

TEST_CASE("chain_segments: loops are closed, junctions end chains, repetitions are dropped") {
  const auto loop = chain_segments({{7, 8}, {8, 9}, {9, 7}, {8, 7}, {5, 5}});
  REQUIRE(loop.size() == 1);
  CHECK((loop[0].closed && loop[0].vertices == List{7, 8, 9}));
  CHECK(chain_segments({{0, 1}, {1, 2}, {1, 3}}).size() == 3);
  const auto drop_shape = chain_segments({{0, 1}, {1, 2}, {2, 3}, {3, 1}});
  REQUIRE(drop_shape.size() == 2);
  CHECK((drop_shape[1].closed && drop_shape[1].vertices.front() == 1));
  CHECK(chain_segments({}).empty());
}

TEST_CASE("chain_segments: every segment is in one chain, once") {
  CHECK(rc::check([](const std::vector<std::pair<unsigned char, unsigned char>>& pairs) {
    Segments segments;
    std::set<std::pair<std::size_t, std::size_t>> expected, seen;
    for (const auto& [a, b] : pairs) {
      const std::size_t i = a % 8, j = b % 8;
      segments.push_back({i, j});
      if (i != j) expected.insert(std::minmax(i, j));
    }
    std::size_t count = 0;
    for (const Chain& chain : chain_segments(segments)) {
      const std::size_t n = chain.vertices.size();
      for (std::size_t k = 0; k + 1 < n + chain.closed; ++k, ++count)
        seen.insert(std::minmax(chain.vertices[k], chain.vertices[(k + 1) % n]));
    }
    RC_ASSERT(seen == expected);
    RC_ASSERT(count == expected.size());
  }));
}
