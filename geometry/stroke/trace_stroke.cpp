// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/trace_stroke.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/stroke/stroke_tracer.h"

namespace furrow::geometry {
namespace {

std::string name_of(const Stroke& stroke) {
  return stroke.name.empty() ? "the stroke" : "stroke \"" + stroke.name + "\"";
}

[[noreturn]] void refuse(const Stroke& stroke, std::size_t point, const std::string& what) {
  throw ContentError(name_of(stroke) + ", point " + std::to_string(point) + ": " + what);
}

void check_content(const Stroke& stroke) {
  if (stroke.points.empty()) throw ContentError(name_of(stroke) + " has no points");
  for (std::size_t i = 0; i < stroke.points.size(); ++i) {
    const Point p = stroke.points[i];
    if (!std::isfinite(p.x() + p.y() + p.z())) refuse(stroke, i, "its coordinates are not finite numbers");
  }
  if (stroke.direction && !(Vector(*stroke.direction).squared_length() > 0)) {
    throw ContentError(name_of(stroke) + ": its direction has no length");
  }
  for (std::size_t i = 0; i < stroke.breaks.size(); ++i) {
    const std::size_t at = stroke.breaks[i], least = i > 0 ? stroke.breaks[i - 1] + 1 : 1;
    if (stroke.closed || at < least || at >= stroke.points.size())
      throw ContentError(name_of(stroke) + ": the break at point " + std::to_string(at) +
                         " is out of place; breaks ascend from 1, in a stroke that is not closed");
  }
}

/// Positions of the points along the stroke by chord length, from 0 to 1.
std::vector<double> parameters_of(const Stroke& stroke) {
  const std::vector<Point> points(stroke.points.begin(), stroke.points.end());
  const std::size_t n = points.size();
  std::vector<double> s(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) {
    s[i] = s[i - 1] + std::sqrt(CGAL::squared_distance(points[i - 1], points[i]));
  }
  double total = s.back();
  if (stroke.closed) total += std::sqrt(CGAL::squared_distance(points.back(), points.front()));
  for (double& value : s) value = total > 0 ? value / total : 0;
  return s;
}

std::vector<StrokeHit> project(const SurfaceProjector& projector, const StrokeTracer& tracer,
                               const Stroke& stroke, const std::vector<Point>& points,
                               const std::vector<double>& parameters, double max_distance) {
  std::vector<StrokeHit> hits;
  for (std::size_t i = 0; i < points.size(); ++i) {
    SurfaceHit hit;
    if (stroke.direction) {
      const auto first = projector.first_hit(points[i], normalized(Vector(*stroke.direction)));
      if (!first)
        refuse(stroke, i, "its ray misses the surface; move the point or drop the stroke's direction");
      hit = *first;
    } else {
      hit = projector.closest(points[i]);
    }
    if (!(hit.distance <= max_distance)) {
      refuse(stroke, i,
             "it is " + length_text(hit.distance) + " from the surface, more than the largest distance of " +
                 length_text(max_distance) + "; check the unit (`unit`), or raise `max_distance`");
    }
    hits.push_back(tracer.hit_at(hit, points[i], parameters[i]));
    hits.back().starts = std::binary_search(stroke.breaks.begin(), stroke.breaks.end(), i);
  }
  return hits;
}

/// All points a little aside and onward: strokes along edges and through vertices come to lie inside faces.
std::vector<Point> nudged(const Mesh& mesh, const Stroke& stroke, const std::vector<StrokeHit>& hits,
                          double distance) {
  const std::size_t n = hits.size();
  const std::vector<Point> points(stroke.points.begin(), stroke.points.end());
  std::vector<Point> result;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = i > 0 ? i - 1 : (stroke.closed ? n - 1 : 0);
    const std::size_t after = i + 1 < n ? i + 1 : (stroke.closed ? 0 : n - 1);
    const Vector normal = normalized(area_normal_of(mesh, hits[i].point.face));
    Vector tangent = points[after] - points[before];
    tangent = normalized(tangent - (tangent * normal) * normal);
    if (tangent.squared_length() == 0) {
      tangent = normalized(mesh.point(corners_of(mesh, hits[i].point.face)[0]) - hits[i].position);
    }
    const Vector aside = CGAL::cross_product(normal, tangent);
    result.push_back(points[i] + distance * (aside + 0.37 * tangent));
  }
  return result;
}

/// One node a face: the mean of its samples over all visits, else of the mid-points of the parts inside.
void place_nodes(const Mesh& mesh, std::vector<SubStroke>& sub_strokes) {
  struct Sum {
    Barycentrics samples{}, middles{};
    std::size_t sample_count = 0;
    double middle_count = 0;
  };
  std::map<Face, Sum> sums;
  const auto add_crossing = [&](Sum& sum, Face face, const EdgeCrossing& x) {
    const auto h = halfedges_of(mesh, face);
    const int i = static_cast<int>(std::find(h.begin(), h.end(), x.halfedge) - h.begin());
    sum.middles[i] += 1 - x.t;
    sum.middles[(i + 1) % 3] += x.t;
    sum.middle_count += 1;
  };
  for (SubStroke& part : sub_strokes) {
    for (CrossedFace& visit : part.faces) {
      Sum& sum = sums[visit.face];
      for (int i = 0; i < 3; ++i) sum.samples[i] += visit.node[i];
      sum.sample_count += visit.samples;
      if (visit.entry) add_crossing(sum, visit.face, *visit.entry);
      if (visit.exit) add_crossing(sum, visit.face, *visit.exit);
    }
  }
  for (SubStroke& part : sub_strokes) {
    for (CrossedFace& visit : part.faces) {
      const Sum& sum = sums[visit.face];
      visit.samples = sum.sample_count;
      for (int i = 0; i < 3; ++i) {
        visit.node[i] = sum.sample_count > 0 ? sum.samples[i] / static_cast<double>(sum.sample_count)
                                             : sum.middles[i] / sum.middle_count;
      }
    }
  }
}

}  // namespace

TracedStroke trace_stroke(const Mesh& mesh, const SurfaceProjector& projector, const Stroke& stroke,
                          const TraceOptions& options) {
  if (!(options.max_distance > 0)) refuse("trace_stroke", "max_distance must be > 0 m");
  if (!(options.mean_edge > 0)) refuse("trace_stroke", "mean_edge must be > 0 m");
  check_content(stroke);
  const std::vector<double> parameters = parameters_of(stroke);
  std::vector<StrokeHit> original;
  TracedStroke traced;
  for (double shift : {0.0, 1e-3, 1.7e-3, 2.9e-3}) {
    StrokeTracer tracer(mesh, projector, options);
    const std::vector<Point> points = shift == 0
                                          ? std::vector<Point>(stroke.points.begin(), stroke.points.end())
                                          : nudged(mesh, stroke, original, shift * options.mean_edge);
    const double slack = shift * 2 * options.mean_edge;
    const auto hits = project(projector, tracer, stroke, points, parameters, options.max_distance + slack);
    if (shift == 0) original = hits;
    if (std::all_of(hits.begin(), hits.end(), [](const StrokeHit& h) { return h.off_cloth; })) {
      throw ContentError(name_of(stroke) + ": all its points lie beyond the border of the cloth");
    }
    tracer.run(hits, stroke.closed, name_of(stroke));
    const bool degenerate =
        tracer.degenerate() ||
        std::any_of(hits.begin(), hits.end(), [](const StrokeHit& h) { return h.degenerate; });
    traced.sub_strokes = tracer.take_sub_strokes();
    traced.warnings = tracer.take_warnings();
    traced.samples = tracer.take_samples();
    if (!degenerate) break;
    if (shift < 2.9e-3) ++traced.nudges;
  }
  place_nodes(mesh, traced.sub_strokes);
  return traced;
}

}  // namespace furrow::geometry
