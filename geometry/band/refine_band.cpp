// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/refine_band.h"

#include <algorithm>
#include <cmath>

#include "geometry/band/band_mesh.h"
#include "geometry/band/band_report.h"
#include "geometry/band/curve_arcs.h"
#include "geometry/band/embed_curve.h"
#include "geometry/band/relax_band.h"
#include "geometry/band/split_longest.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr int most_rounds = 12;  ///< of splits; each halves what is too long
constexpr int relaxations = 12;  ///< after the curves are embedded
constexpr int late_rounds = 3;
constexpr double too_long = 1.33;  ///< of the sizing

void check(const Mesh& mesh, std::span<const FoldCurve> curves, const BandOptions& options) {
  if (!(options.least_edge > 0))
    refuse("refine_band", "least_edge must be > 0 m, not " + std::to_string(options.least_edge));
  require_triangles(mesh, "refine_band");
  require_finite(mesh, "refine_band");
  require_vertices(mesh, options.held, "refine_band");
  for (const FoldCurve& curve : curves) {
    const std::size_t n = curve.points.size();
    const std::string name = "the curve of \"" + curve.name + "\" ";
    if (n < 2 || curve.places.size() != n || curve.width.size() != n || curve.height.size() != n)
      refuse("refine_band", name + "needs at least two points, each with place, width and height");
    for (std::size_t i = 0; i < n; ++i) {
      if (!curve.points[i].allFinite() || !(curve.width[i] > 0) || !std::isfinite(curve.height[i]))
        refuse("refine_band", name + "has a point, width or height out of range");
      if (!mesh.has_valid_index(curve.places[i].face))
        refuse("refine_band", name + "has a place that is not on the mesh");
    }
  }
}

Point centre_of(const Mesh& mesh, Face f) {
  const auto c = corners_of(mesh, f);
  return CGAL::centroid(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2]));
}

std::vector<Face> band_faces(const Mesh& mesh, const EdgeMap<double>& rest, std::span<const FoldCurve> curves,
                             const BandSizing& sizing, bool graded) {
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
    if (!(graded && sizing.at(centre, longest) < longest) && !sizing.in_band(centre)) continue;
    for (Halfedge h : halfedges_of(mesh, queue[next])) {
      const Face beyond = mesh.face(mesh.opposite(h));
      if (beyond.is_valid() && (graded || sizing.in_band(centre_of(mesh, beyond)))) add(beyond);
    }
  }
  return queue;
}

/// Splits edges of the band, the longest first, until none is longer at rest than 1.33 of the sizing at its
/// middle. Where a side of its two faces is longer than 1.25 of it, that side is split first (Rivara's
/// longest edge), so that angles stay bounded. Returns how many. O(n log n).
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

/// Splits, two relaxations, until nothing is too long.
void refine(BandMesh& band, const BandSizing& sizing, int rounds) {
  for (int i = 0; i < rounds; ++i) {
    if (split_band(band, sizing) == 0) return;
    for (int k = 0; k < 2; ++k) relax_band(band, sizing);
  }
}

void embed(BandMesh& band, const CurveArcs& arcs) {
  for (std::size_t i = 0; i < arcs.arcs.size(); ++i) {
    const int index = static_cast<int>(i), before = arcs.before(i), after = arcs.after(i);
    ArcEnds known;
    if (before >= 0 && before < index) known.first = band.curves[before].vertices.rbegin()->second;
    if (after >= 0 && after < index) known.last = band.curves[after].vertices.begin()->second;
    embed_curve(band, index, arcs.arcs[i], known);
  }
}

}  // namespace

std::vector<Face> faces_of_band(const Mesh& mesh, std::span<const FoldCurve> curves,
                                const BandOptions& options, bool graded) {
  const BandSizing sizing(curves, options.detail, options.least_edge);
  return band_faces(mesh, find_map(mesh, attribute::rest_length).value(), curves, sizing, graded);
}

BandReport refine_band(Mesh& mesh, std::span<const FoldCurve> curves, const BandOptions& options) {
  check(mesh, curves, options);
  Mesh work = mesh;
  BandMesh band(work);
  band.flip_options.may_flip = options.may_flip;
  for (Vertex v : options.held) band.hold[v.idx()] = Hold::fixed;
  const CurveArcs arcs(curves);
  const BandSizing sizing(arcs.arcs, options.detail, options.least_edge);
  for (Face f : band_faces(work, band.rest, arcs.arcs, sizing, true)) band.in_band[f.idx()] = true;
  for (std::size_t i = 0; i < arcs.arcs.size(); ++i)
    band.curves.emplace_back(arcs.arcs[i], sizing.on_curves()[i]);
  const double before = smallest_angle_of(band);
  band.flip_to_delaunay();
  refine(band, sizing, most_rounds);
  embed(band, arcs);
  band.flip_to_delaunay();
  for (int i = 0; i < relaxations; ++i) relax_band(band, sizing);
  refine(band, sizing, late_rounds);
  band.finish();
  BandReport report = report_on(band, arcs);
  report.min_angle_before_deg = before;
  mesh = std::move(work);
  return report;
}

}  // namespace furrow::geometry
