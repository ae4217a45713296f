// SPDX-License-Identifier: MIT
#include "physics/cloth/elastic_band.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>

namespace furrow::physics {

void add_elastic_band(Cloth& cloth, std::span<const int> loop, const ElasticBandOptions& o) {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("add_elastic_band: " + what); };
  if (!(o.length > 0 && o.length <= 2)) fail("length = " + std::to_string(o.length) + " is not in (0, 2]");
  if (!(o.stiffness >= 0) || !std::isfinite(o.stiffness))
    fail("stiffness = " + std::to_string(o.stiffness) + " is not >= 0");
  if (loop.size() < 3) fail("a loop of " + std::to_string(loop.size()) + " particles");
  const std::vector<Vec3>& x = cloth.particles.x;
  for (const int i : loop)
    if (i < 0 || std::size_t(i) >= x.size())
      fail("particle " + std::to_string(i) + " of " + std::to_string(x.size()));
  std::vector<Spring> band;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto [a, b] = std::minmax(loop[i], loop[(i + 1) % loop.size()]);
    const double length = o.length * (x[b] - x[a]).norm();
    if (!(length > 0))
      fail("particles " + std::to_string(a) + " and " + std::to_string(b) + " lie at one place");
    band.push_back({a, b, length, o.stiffness / length});
  }
  cloth.bending.insert(cloth.bending.end(), band.begin(), band.end());
  std::stable_sort(cloth.bending.begin(), cloth.bending.end(),
                   [](const Spring& s, const Spring& t) { return std::tie(s.a, s.b) < std::tie(t.a, t.b); });
}

}  // namespace furrow::physics
