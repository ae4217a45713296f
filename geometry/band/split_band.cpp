// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/split_band.h"

#include <algorithm>

#include "geometry/band/split_longest.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double too_long = 1.33;  ///< of the sizing

Point centre_of(const Mesh& mesh, Face f) {
  const auto c = corners_of(mesh, f);
  return CGAL::centroid(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2]));
}

}  // namespace

std::vector<bool> band_faces(const Mesh& mesh, const EdgeMap<double>& rest, std::span<const FoldCurve> curves,
                             const BandSizing& sizing) {
  std::vector<bool> inside(mesh.num_faces(), false);
  std::vector<Face> queue;
  const auto add = [&](Face f) {
    if (!f.is_valid() || inside[f.idx()]) return;
    inside[f.idx()] = true;
    queue.push_back(f);
  };
  for (const FoldCurve& curve : curves)
    for (const FacePoint& p : curve.places) add(p.face);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    physics::throw_if_cancelled("wrinkle");
    const auto lengths = rest_lengths_of(mesh, rest, queue[next]);
    const double longest = *std::max_element(lengths.begin(), lengths.end());
    const Point centre = centre_of(mesh, queue[next]);
    if (!(sizing.at(centre, longest) < longest) && !sizing.in_band(centre)) continue;
    for (Halfedge h : halfedges_of(mesh, queue[next]))
      if (!mesh.is_border(mesh.opposite(h))) add(mesh.face(mesh.opposite(h)));
  }
  return inside;
}

std::size_t split_band(BandMesh& band, const BandSizing& sizing) {
  const Mesh& mesh = band.mesh;
  const auto length = [&](Edge e) { return band.rest[e]; };
  const auto is_too_long = [&](Edge e) {
    const double most = band.rest[e] / too_long;
    const Halfedge h = band.from_lower(e);
    return sizing.at(CGAL::midpoint(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))), most) < most;
  };
  return split_longest(band, length, is_too_long, [&](Edge e) { return band.split(e, 0.5); });
}

}  // namespace furrow::geometry
