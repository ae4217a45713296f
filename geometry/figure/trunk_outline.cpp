// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/trunk_outline.h"

#include <algorithm>

namespace furrow::geometry {

TrunkOutline outline_of(const SectionLoop& loop, double height) {
  constexpr int directions = TrunkOutline::directions;
  TrunkOutline outline{height, centre_of(loop), {}};
  for (std::size_t i = 0; i < loop.points.size(); ++i) {
    const SectionPoint &p = loop.points[i], &q = loop.points[(i + 1) % loop.points.size()];
    for (double s = 0; s < 1; s += 0.1) {
      const double x = p.x + s * (q.x - p.x) - outline.centre[0],
                   z = p.z + s * (q.z - p.z) - outline.centre[1];
      const double turn = std::atan2(z, x) / (2 * std::numbers::pi) + 1;
      double& radius = outline.radius[std::size_t(std::lround(turn * directions)) % directions];
      radius = std::max(radius, std::hypot(x, z));
    }
  }
  for (std::size_t i = 0; i < directions; ++i)  // coarse meshes leave gaps
    if (outline.radius[i] == 0) outline.radius[i] = outline.radius[(i + directions - 1) % directions];
  return outline;
}

}  // namespace furrow::geometry
