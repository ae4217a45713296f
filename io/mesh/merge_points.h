// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>

#include "geometry/mesh/mesh.h"

namespace furrow::io {

/// Numbers positions in the order of their first occurrence; exactly equal ones (0 = -0) get the same number.
class PointNumbers {
 public:
  /// The number of p, and whether it is new. Equal positions of different `kind` have different numbers.
  std::pair<std::size_t, bool> number(const geometry::Point& p, std::uint64_t kind = 0) {
    const auto [found, is_new] =
        known_.try_emplace(Key{bits(p.x()), bits(p.y()), bits(p.z()), kind}, known_.size());
    return {found->second, is_new};
  }

 private:
  using Key = std::array<std::uint64_t, 4>;
  struct Hash {
    std::size_t operator()(const Key& k) const {
      std::uint64_t h = 0;
      for (const std::uint64_t word : k) {
        h = (h ^ word) * 0x9E3779B97F4A7C15u;
        h ^= h >> 32;
      }
      return h;
    }
  };
  static std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x); }

  std::unordered_map<Key, std::size_t, Hash> known_;  ///< looked up only: its order never shows
};

}  // namespace furrow::io
