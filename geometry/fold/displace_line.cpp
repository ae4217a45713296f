// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/displace_line.h"

#include <cmath>
#include <string>

#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {

void displace_line(Mesh& mesh, std::span<const Displacement> displacements) {
  for (const Displacement& d : displacements) {
    require_vertices(mesh, std::span(&d.vertex, 1), "displace_line");
    const std::string of = " of vertex " + std::to_string(d.vertex.idx()) + " is ";
    if (!std::isfinite(d.height)) refuse("displace_line", "the height" + of + std::to_string(d.height));
    const double squared = d.normal.squared_length();
    if (!(std::abs(squared - 1) <= 2e-6))  // also refuses NaN
      refuse("displace_line", "the squared length of the normal" + of + std::to_string(squared) + ", not 1");
  }
  for (const Displacement& d : displacements)
    mesh.point(d.vertex) = mesh.point(d.vertex) + d.height * d.normal;
}

}  // namespace furrow::geometry
