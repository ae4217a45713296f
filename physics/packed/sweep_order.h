// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <vector>

namespace furrow::physics {

/// Particles in breadth-first order over the pairs, starting in each component at its particle of least
/// degree (the lowest index of several): neighbours in the mesh become neighbours in memory. Returns for each
/// place its particle: a permutation of 0 … n-1. Cost: O(n + pairs log).
std::vector<int> breadth_first_order(int n, std::span<const std::array<int, 2>> pairs);

/// An order in which a sweep over pairs may work on several pairs at once and still give one result.
/// Pairs of one group share no particle. Pairs of one block touch only particles of that block, so blocks are
/// independent of each other; what lies between blocks comes last and is not a block.
struct SweepOrder {
  std::vector<int> pairs;        ///< indices of the given pairs, in order
  std::vector<int> group_begin;  ///< first place of each group in `pairs`, and the end
  std::vector<int> block_begin;  ///< first group of each block; the last entry: first group between blocks
  int blocks() const { return int(block_begin.size()) - 1; }
  int groups() const { return int(group_begin.size()) - 1; }
};

/// Blocks are runs of `block_size` particles; within a block, and between blocks, pairs are coloured greedily
/// in their given order. The result depends on the pairs alone, never on a number of threads.
SweepOrder sweep_order(int n, std::span<const std::array<int, 2>> pairs, int block_size = 2048);

}  // namespace furrow::physics
