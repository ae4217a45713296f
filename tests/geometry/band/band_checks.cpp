// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry/band/band_checks.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/rest_state.h"
#include "geometry/stroke/project_onto_surface.h"

namespace furrow::tests {
namespace {

using namespace geometry;

std::vector<Point> dense(const std::vector<Point>& points, double step, bool closed) {
  std::vector<Point> result;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const Point &a = points[i], &b = points[(i + 1) % n];
    const int parts = std::max(1, static_cast<int>(std::ceil(std::sqrt((b - a).squared_length()) / step)));
    for (int j = 0; j < parts; ++j) result.push_back(a + (static_cast<double>(j) / parts) * (b - a));
  }
  if (!closed) result.push_back(points.back());
  return result;
}

std::string name(Vertex v) { return "vertex " + std::to_string(v.idx()); }

void check_chains(const Mesh& mesh, const std::vector<FoldCurve>& curves, const BandReport& report,
                  std::vector<std::string>& faults) {
  const auto line = find_map(mesh, attribute::line);
  const auto line_edge = find_map(mesh, attribute::line_edge);
  if (report.chains.size() != curves.size()) faults.push_back("not a chain for each curve");
  for (std::size_t c = 0; c < report.chains.size(); ++c) {
    const auto& chain = report.chains[c];
    const std::size_t n = chain.vertices.size();
    if (n < 2) faults.push_back("a chain of " + std::to_string(n));
    for (std::size_t i = 0; i < n; ++i) {
      const Vertex v = chain.vertices[i];
      if ((*line)[v] < 0) faults.push_back(name(v) + " has no line");
      if (i > 0 && !(chain.along[i] > chain.along[i - 1])) faults.push_back("a chain turns back");
      if (i + 1 == n && !chain.closed) continue;
      const Halfedge h = mesh.halfedge(v, chain.vertices[(i + 1) % n]);
      if (!h.is_valid())
        faults.push_back("no edge after " + name(v));
      else if (!(*line_edge)[mesh.edge(h)])
        faults.push_back("no line edge after " + name(v));
    }
    if (chain.lateral > 0.005 * *std::min_element(curves[c].width.begin(), curves[c].width.end()))
      faults.push_back("lateral " + std::to_string(chain.lateral));
  }
}

void check_topology(const Mesh& before, const Mesh& after, const BandReport& report,
                    std::vector<std::string>& faults) {
  const auto euler = [](const Mesh& m) {
    return static_cast<long>(m.number_of_vertices()) - static_cast<long>(m.number_of_edges()) +
           static_cast<long>(m.number_of_faces());
  };
  if (!after.is_valid(false)) faults.push_back("the mesh is not valid");
  if (euler(before) != euler(after)) faults.push_back("Euler's number changed");
  if (after.number_of_vertices() != before.number_of_vertices() + report.inserted)
    faults.push_back("the report counts other vertices");
  std::set<std::pair<Vertex, Vertex>> edges;
  for (Edge e : after.edges()) edges.insert(std::minmax(after.vertex(e, 0), after.vertex(e, 1)));
  if (edges.size() != after.number_of_edges()) faults.push_back("an edge is there twice");
  for (Vertex v : before.vertices()) {
    const bool snapped = std::count(report.snapped.begin(), report.snapped.end(), v) > 0;
    if (!snapped && before.point(v) != after.point(v)) faults.push_back(name(v) + " moved");
  }
}

void check_places(const Mesh& before, const Mesh& after, const BandReport& report,
                  std::vector<std::string>& faults) {
  const auto rest = find_map(after, attribute::rest_position);
  if (report.places.size() != after.num_vertices()) faults.push_back("not a place for each vertex");
  for (Vertex v : after.vertices()) {
    if (after.is_isolated(v)) continue;
    const Point p = position_of(before, report.places[v.idx()]);
    const auto& r = (*rest)[v];
    if ((p - Point(r[0], r[1], r[2])).squared_length() > 1e-18)
      faults.push_back(name(v) + " rests elsewhere");
  }
}

}  // namespace

FoldCurve curve_on(const Mesh& mesh, const std::vector<Point>& points, double width, double height,
                   bool closed, int line) {
  const SurfaceProjector projector(mesh);
  const double step = crest_edge(width, height, Detail::normal, 0.003) / 4;
  FoldCurve curve;
  curve.line = line;
  curve.name = "curve";
  curve.closed = closed;
  for (const Point& p : dense(points, step, closed)) {
    const SurfaceHit hit = projector.closest(p);
    const Eigen::Vector3d q(hit.position.x(), hit.position.y(), hit.position.z());
    if (hit.beyond_border > 1e-9)
      (curve.points.size() < 2 ? curve.begins_at_border : curve.ends_at_border) = true;
    if (!curve.points.empty() && (q - curve.points.back()).norm() < 0.05 * step) continue;
    curve.arc.push_back(curve.points.empty() ? 0 : curve.arc.back() + (q - curve.points.back()).norm());
    curve.points.push_back(q);
    curve.places.push_back(hit.point);
    curve.width.push_back(width);
    curve.height.push_back(height);
  }
  curve.length = curve.arc.back() + (closed ? (curve.points.front() - curve.points.back()).norm() : 0);
  return curve;
}

std::vector<std::string> faults_of_band(const Mesh& before, const Mesh& after,
                                        const std::vector<FoldCurve>& curves, const BandReport& report) {
  std::vector<std::string> faults;
  check_chains(after, curves, report, faults);
  check_topology(before, after, report, faults);
  check_places(before, after, report, faults);
  if (report.detours > 0) faults.push_back(std::to_string(report.detours) + " detours");
  const RestMetricAudit audit = audit_rest_metric(after);
  if (audit.inverted_faces > 0) faults.push_back("inverted faces at rest");
  for (double l : rest_lengths(after))
    if (!(l > 0)) faults.push_back("an edge without length");
  return faults;
}

double least_angle(const BandReport& report, double width, double height) {
  return std::min(std::abs(height) > 0.3 * width ? 10.0 : 15.0, report.min_angle_before_deg - 2);
}

}  // namespace furrow::tests
