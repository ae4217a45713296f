// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert_along_stroke.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <stdexcept>

#include "geometry/draw_line.h"
#include "geometry/insert_in_faces.h"

namespace furrow::geometry {
namespace {

constexpr int kRounds = 12;

/// Smallest rest angle [rad] of the faces crossed and their edge neighbours.
double angle_before(const Mesh& mesh, const EdgeMap<double>& rest, const TracedStroke& traced) {
  std::set<Face> faces;
  for (const SubStroke& part : traced.sub_strokes) {
    for (const CrossedFace& visit : part.faces) {
      faces.insert(visit.face);
      for (Halfedge h : halfedges_of(mesh, visit.face)) {
        if (!mesh.is_border(mesh.opposite(h))) faces.insert(mesh.face(mesh.opposite(h)));
      }
    }
  }
  double least = std::numbers::pi;
  for (Face f : faces) least = std::min(least, smallest_angle(rest_lengths_of(mesh, rest, f)));
  return least;
}

double squared_distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Vector ab = b - a;
  const double squared = ab.squared_length();
  const double t = squared > 0 ? std::clamp(((p - a) * ab) / squared, 0.0, 1.0) : 0.0;
  return CGAL::squared_distance(p, a + t * ab);
}

double max_deviation(const Mesh& mesh, const InsertedLine& line, const std::vector<ProjectedSample>& samples) {
  double largest = 0;
  for (const ProjectedSample& sample : samples) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& chain : line.chains) {
      for (std::size_t i = 0; i < chain.size(); ++i) {
        const Point &a = mesh.point(chain[i == 0 ? 0 : i - 1]), &b = mesh.point(chain[i]);
        nearest = std::min(nearest, squared_distance_to_segment(sample.position, a, b));
      }
    }
    largest = std::max(largest, nearest);
  }
  return std::sqrt(largest);
}

}  // namespace

Insertion insert_along_stroke(Mesh& mesh, const Stroke& stroke, int line_id, const InsertionOptions& options) {
  check(options);
  if (line_id < 0) throw std::invalid_argument("insertion: line_id must be >= 0, not " + std::to_string(line_id));
  check_triangles(mesh);
  const SurfaceProjector projector(mesh);
  Mesh original = mesh;
  const auto rest = ensure_rest_lengths(original);
  const double h = options.mean_edge.value_or(mean_rest_length(original, rest));
  const TracedStroke traced = trace_stroke(mesh, projector, stroke, {options.max_distance, h});
  const double wanted = options.min_angle_deg * std::numbers::pi / 180;
  const double least_angle = std::min(wanted, angle_before(original, rest, traced)) - 1e-9;

  LinePlan plan;
  DrawnLine best = draw_line(original, traced, plan, line_id, h, options);
  std::size_t attempts = 1;
  const auto angle_of = [](const DrawnLine& d) { return d.insertion.report.min_angle_deg * std::numbers::pi / 180; };
  if (options.rule == InsertionRule::safe && angle_of(best) < least_angle) {
    DrawnLine last = best;
    while (attempts < kRounds && improve_plan(last, least_angle, plan)) {
      last = draw_line(original, traced, plan, line_id, h, options);
      ++attempts;
      if (angle_of(last) > angle_of(best)) best = last;
      if (angle_of(best) >= least_angle) break;
    }
  }
  InsertionReport& report = best.insertion.report;
  report.attempts = attempts;
  report.nudges = traced.nudges;
  report.warnings = traced.warnings;
  report.max_deviation = max_deviation(best.mesh, best.insertion.line, traced.samples);
  mesh = std::move(best.mesh);
  return std::move(best.insertion);
}

}  // namespace furrow::geometry
