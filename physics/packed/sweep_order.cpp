// SPDX-License-Identifier: MIT
#include "physics/packed/sweep_order.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

namespace furrow::physics {
namespace {

std::vector<std::vector<int>> neighbours(int n, std::span<const std::array<int, 2>> pairs) {
  std::vector<std::vector<int>> result(static_cast<std::size_t>(n));
  for (const auto& [a, b] : pairs) {
    result[std::size_t(a)].push_back(b);
    result[std::size_t(b)].push_back(a);
  }
  for (std::vector<int>& list : result) std::sort(list.begin(), list.end());
  return result;
}

/// Appends the pairs `members` group by group: greedy colours, 64 of them; what finds none gets groups of
/// one. used: the colours around each particle, one bit each.
void append_coloured(std::span<const std::array<int, 2>> pairs, std::span<const int> members,
                     std::vector<std::uint64_t>& used, SweepOrder& order) {
  constexpr int colours = 64;
  std::array<std::vector<int>, colours> groups;
  std::vector<int> alone;
  for (const int p : members) {
    const auto [a, b] = pairs[std::size_t(p)];
    const std::uint64_t taken = used[std::size_t(a)] | used[std::size_t(b)];
    const int colour = std::countr_one(taken);
    if (colour == colours) {
      alone.push_back(p);
      continue;
    }
    used[std::size_t(a)] |= std::uint64_t{1} << colour;
    used[std::size_t(b)] |= std::uint64_t{1} << colour;
    groups[std::size_t(colour)].push_back(p);
  }
  for (const std::vector<int>& group : groups) {
    if (group.empty()) continue;
    order.pairs.insert(order.pairs.end(), group.begin(), group.end());
    order.group_begin.push_back(int(order.pairs.size()));
  }
  for (const int p : alone) {
    order.pairs.push_back(p);
    order.group_begin.push_back(int(order.pairs.size()));
  }
}

}  // namespace

std::vector<int> breadth_first_order(int n, std::span<const std::array<int, 2>> pairs) {
  const std::vector<std::vector<int>> around = neighbours(n, pairs);
  std::vector<int> starts(static_cast<std::size_t>(n)), order;
  std::iota(starts.begin(), starts.end(), 0);
  std::stable_sort(starts.begin(), starts.end(), [&](int a, int b) {
    return around[std::size_t(a)].size() < around[std::size_t(b)].size();
  });
  std::vector<char> seen(static_cast<std::size_t>(n), 0);
  order.reserve(static_cast<std::size_t>(n));
  for (const int start : starts) {
    if (seen[std::size_t(start)]) continue;
    seen[std::size_t(start)] = 1;
    order.push_back(start);
    for (std::size_t next = order.size() - 1; next < order.size(); ++next) {
      for (const int other : around[std::size_t(order[next])]) {
        if (seen[std::size_t(other)]) continue;
        seen[std::size_t(other)] = 1;
        order.push_back(other);
      }
    }
  }
  return order;
}

SweepOrder sweep_order(int n, std::span<const std::array<int, 2>> pairs, int block_size) {
  const int blocks = std::max(1, (n + block_size - 1) / block_size);
  std::vector<std::vector<int>> members(static_cast<std::size_t>(blocks) + 1);
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    const int block_a = pairs[p][0] / block_size, block_b = pairs[p][1] / block_size;
    members[std::size_t(block_a == block_b ? block_a : blocks)].push_back(int(p));
  }
  SweepOrder order;
  order.group_begin.push_back(0);
  std::vector<std::uint64_t> used(static_cast<std::size_t>(n), 0);
  for (std::size_t block = 0; block < members.size(); ++block) {
    if (block + 1 == members.size()) std::fill(used.begin(), used.end(), 0);  // the rest meets all blocks
    order.block_begin.push_back(order.groups());
    append_coloured(pairs, members[block], used, order);
  }
  return order;
}

}  // namespace furrow::physics
