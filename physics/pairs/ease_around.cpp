// SPDX-License-Identifier: MIT
#include "physics/pairs/ease_around.h"

#include <algorithm>

namespace furrow::physics {
namespace {

constexpr double clear = 0.9;       // of a cut's share, so that it cuts no more
constexpr double per_edge = 0.05;   // that neighbours differ by
constexpr int edges_to_whole = 19;  // from nothing to the whole way

}  // namespace

void ease_around(std::span<const MoveCut> cuts, std::span<const std::array<int, 3>> triangles,
                 std::vector<double>& kept) {
  const std::vector<double> before = kept;
  for (const MoveCut& cut : cuts) {
    const auto i = std::size_t(cut.particle);
    double& own = kept.at(i);
    own = std::min(own, clear * cut.share * before[i]);
  }
  for (int pass = 0; pass < edges_to_whole; ++pass)
    for (const std::array<int, 3>& t : triangles) {
      double& a = kept.at(std::size_t(t[0]));
      double& b = kept.at(std::size_t(t[1]));
      double& c = kept.at(std::size_t(t[2]));
      const double most = std::min({a, b, c}) + per_edge;
      a = std::min(a, most), b = std::min(b, most), c = std::min(c, most);
    }
}

}  // namespace furrow::physics
