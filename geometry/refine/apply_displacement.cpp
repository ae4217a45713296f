// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/apply_displacement.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/tangent_frames.h"
#include "geometry/refine/subdivide.h"
#include "geometry/stroke/project_onto_surface.h"

namespace furrow::geometry {
namespace {

/// Bilinear between the middles of the texels; beyond the outer ones, those.
std::array<double, 3> sample(const VectorMap& map, const TextureCoordinate& at) {
  const auto place = [&](double x) { return std::clamp(x * map.size - 0.5, 0.0, map.size - 1.0); };
  const double x = place(at[0]), y = place(1 - at[1]);
  const int column = std::min(int(x), std::max(0, map.size - 2)),
            row = std::min(int(y), std::max(0, map.size - 2));
  std::array<double, 3> sum{0, 0, 0};
  for (int k = 0; k < 4; ++k) {
    const double weight = (k % 2 ? x - column : 1 - (x - column)) * (k / 2 ? y - row : 1 - (y - row));
    if (weight == 0) continue;
    const auto& texel = map.texels[std::size_t(row + k / 2) * map.size + column + k % 2];
    for (int i = 0; i < 3; ++i) sum[i] += weight * texel[i];
  }
  return sum;
}

}  // namespace

void apply_displacement(Mesh& mesh, const VectorMap& displacement, int steps) {
  if (displacement.size < 1 ||
      displacement.texels.size() != std::size_t(displacement.size) * displacement.size)
    refuse("apply_displacement", "the map has " + std::to_string(displacement.texels.size()) +
                                     " texels for a size of " + std::to_string(displacement.size));
  if (!find_map(mesh, attribute::texture))
    throw ContentError("apply_displacement: the mesh has no texture coordinates");
  Mesh fine = mesh;
  fine.collect_garbage();
  const Mesh low = fine;
  const TangentFrames frames = tangent_frames(low);
  const std::vector<Face> parents = midpoint_subdivide(fine, steps);
  const auto texture = *find_map(fine, attribute::texture);
  std::vector<Vector> sums(fine.num_vertices(), Vector(0, 0, 0));
  std::vector<int> corners(fine.num_vertices(), 0);
  for (Face f : fine.faces()) {
    for (Halfedge h : halfedges_of(fine, f)) {
      const Vertex v = fine.target(h);
      ++corners[v.idx()];
      if (!std::isfinite(texture[h][0]) || !std::isfinite(texture[h][1])) continue;
      const Face parent = parents[f.idx()];
      const InnerFrame frame =
          orthonormal(frame_inside(frames[parent.idx()], barycentrics_of(low, parent, fine.point(v))));
      const auto d = sample(displacement, texture[h]);
      sums[v.idx()] = sums[v.idx()] + d[0] * frame.tangent + d[1] * frame.bitangent + d[2] * frame.normal;
    }
  }
  for (Vertex v : fine.vertices())
    if (corners[v.idx()] > 0) fine.point(v) = fine.point(v) + sums[v.idx()] / corners[v.idx()];
  mesh = std::move(fine);
}

}  // namespace furrow::geometry
