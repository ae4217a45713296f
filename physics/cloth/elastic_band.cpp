// SPDX-License-Identifier: MIT
#include "physics/cloth/elastic_band.h"

#include <algorithm>
#include <tuple>

#include "physics/base/require.h"

namespace furrow::physics {

void add_elastic_band(Cloth& cloth, std::span<const int> loop, const ElasticBandOptions& o) {
  const char* const operation = "add_elastic_band";
  require(operation, "length", o.length, o.length > 0 && o.length <= 2, "in (0, 2]");
  require(operation, "stiffness", o.stiffness, o.stiffness >= 0, ">= 0");
  if (loop.size() < 3) refuse(operation, "a loop of ", loop.size(), " particles");
  const std::vector<Vec3>& x = cloth.particles.x;
  for (const int i : loop)
    if (i < 0 || std::size_t(i) >= x.size()) refuse(operation, "particle ", i, " of ", x.size());
  std::vector<Spring> band;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
    const double length = o.length * (x[b] - x[a]).norm();
    if (!(length > 0)) refuse(operation, "particles ", a, " and ", b, " lie at one place");
    band.push_back({a, b, length, o.stiffness / length});
  }
  cloth.bending.insert(cloth.bending.end(), band.begin(), band.end());
  std::stable_sort(cloth.bending.begin(), cloth.bending.end(),
                   [](const Spring& s, const Spring& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); });
}

}  // namespace furrow::physics
