// SPDX-License-Identifier: GPL-3.0-or-later
#include "physics/packed/sweep_order.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <set>

using namespace furrow::physics;

namespace {

using Pairs = std::vector<std::array<int, 2>>;

Pairs random_pairs(int n, int count) {
  Pairs pairs;
  for (int i = 0; i < count; ++i) {
    const int a = *rc::gen::inRange(0, n), step = *rc::gen::inRange(1, n);
    pairs.push_back({a, (a + step) % n});
  }
  return pairs;
}

}  // namespace

TEST_CASE("sweep_order: a sweep holds every pair once, groups share no particle, blocks do not meet") {
  CHECK(rc::check([] {
    const int n = *rc::gen::inRange(2, 60);
    const Pairs pairs = random_pairs(n, *rc::gen::inRange(0, 200));
    const int block_size = *rc::gen::inRange(1, 40);
    const SweepOrder order = sweep_order(n, pairs, block_size);
    RC_ASSERT(std::set<int>(order.pairs.begin(), order.pairs.end()).size() == pairs.size());
    RC_ASSERT(order.pairs.size() == pairs.size());
    RC_ASSERT(order.group_begin.back() == int(pairs.size()));
    for (int g = 0; g < order.groups(); ++g) {
      std::set<int> seen;
      for (int i = order.group_begin[g]; i < order.group_begin[g + 1]; ++i) {
        RC_ASSERT(seen.insert(pairs[order.pairs[i]][0]).second);
        RC_ASSERT(seen.insert(pairs[order.pairs[i]][1]).second);
      }
    }
    for (int block = 0; block < order.blocks(); ++block) {
      for (int g = order.block_begin[block]; g < order.block_begin[block + 1]; ++g) {
        for (int i = order.group_begin[g]; i < order.group_begin[g + 1]; ++i) {
          for (const int p : pairs[order.pairs[i]]) RC_ASSERT(p / block_size == block);
        }
      }
    }
  }));
}

TEST_CASE("sweep_order: a particle with more pairs than colours still works") {
  Pairs star;
  for (int i = 1; i <= 100; ++i) star.push_back({0, i});
  const SweepOrder order = sweep_order(101, star);
  CHECK(order.groups() == 100);
  CHECK(std::set<int>(order.pairs.begin(), order.pairs.end()).size() == 100);
}

TEST_CASE("sweep_order: breadth-first order is a permutation and follows a chain from its end") {
  CHECK(rc::check([] {
    const int n = *rc::gen::inRange(2, 60);
    const std::vector<int> order = breadth_first_order(n, random_pairs(n, *rc::gen::inRange(0, 100)));
    RC_ASSERT(int(order.size()) == n);
    RC_ASSERT(int(std::set<int>(order.begin(), order.end()).size()) == n);
  }));
  CHECK(breadth_first_order(5, Pairs{{3, 0}, {0, 4}, {4, 1}, {1, 2}}) == std::vector<int>{2, 1, 4, 0, 3});
}
