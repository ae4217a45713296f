// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/geometry/insert/insertion_checks.h"

#include <CGAL/boost/graph/helpers.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "geometry/rest/rest_metric.h"
#include "geometry/rest/rest_state.h"
#include "geometry/stroke/trace_stroke.h"

namespace furrow::tests {

using namespace geometry;

namespace {

using Pair = std::pair<Vertex, Vertex>;

Pair ends_of(const Mesh& mesh, Edge e) {
  const Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
  return {std::min(a, b), std::max(a, b)};
}

std::set<Pair> border_of(const Mesh& mesh) {
  std::set<Pair> border;
  for (Edge e : mesh.edges()) {
    if (mesh.is_border(e)) border.insert(ends_of(mesh, e));
  }
  return border;
}

double distance_to_line(const Mesh& mesh, const InsertedLine& line, const Point& p) {
  double least = 1e300;
  for (const auto& chain : line.chains) {
    for (std::size_t i = 0; i < chain.size(); ++i) {
      const Point a = mesh.point(chain[i > 0 ? i - 1 : 0]), b = mesh.point(chain[i]);
      const double length = CGAL::squared_distance(a, b);
      const double t = length > 0 ? std::clamp((p - a) * (b - a) / length, 0.0, 1.0) : 0;
      least = std::min(least, CGAL::squared_distance(p, a + t * (b - a)));
    }
  }
  return std::sqrt(least);
}

}  // namespace

std::vector<std::string> faults_of_insertion(const Mesh& before, const Mesh& after,
                                             const Insertion& insertion, bool flat) {
  std::vector<std::string> faults;
  const auto expect = [&](bool holds, const char* what) {
    if (!holds) faults.push_back(what);
  };
  const InsertionReport& report = insertion.report;
  const std::size_t n = report.inserted;
  expect(after.number_of_vertices() == before.number_of_vertices() + n, "#V += n");
  expect(after.number_of_faces() == before.number_of_faces() + 2 * n, "#F += 2n");
  expect(after.number_of_edges() == before.number_of_edges() + 3 * n, "#E += 3n");
  expect(CGAL::is_valid_polygon_mesh(after), "manifold");
  expect(border_of(after) == border_of(before), "border unchanged");
  const RestMetricAudit audit = audit_rest_metric(after), old = audit_rest_metric(before);
  expect(audit.inverted_faces == 0, "no inverted face");
  expect(audit.duplicate_edges == 0, "no duplicate edge");
  expect(std::abs(audit.area - old.area) <= 1e-12 * old.area || !flat, "rest area kept");
  for (Face f : after.faces()) {
    if (flat && !(area_normal_of(after, f).z() > 0)) expect(false, "signed area > 0");
  }
  const auto rest = find_map(after, attribute::rest_length);
  const auto line = find_map(after, attribute::line);
  const auto line_edge = find_map(after, attribute::line_edge);
  if (!rest || !line || !line_edge) return faults.push_back("maps present"), faults;
  for (Edge e : after.edges()) {
    const Point &a = after.point(after.vertex(e, 0)), &b = after.point(after.vertex(e, 1));
    const double space = std::sqrt(CGAL::squared_distance(a, b));
    if (!std::isfinite((*rest)[e])) expect(false, "rest lengths finite");
    if (flat && std::abs((*rest)[e] - space) > 1e-12)
      expect(false, "rest lengths are lengths on a flat mesh");
  }
  expect(report.missing_edges.empty(), "no missing line edge");
  std::set<Vertex> described;
  for (const LineVertex& v : insertion.line.vertices) {
    expect(described.insert(v.vertex).second, "each line vertex once");
    expect(std::abs(v.normal.squared_length() - 1) < 1e-9, "unit normals");
    expect(v.stroke_parameter >= 0 && v.stroke_parameter <= 1, "parameter in [0, 1]");
    expect((*line)[v.vertex] == insertion.line.id, "attribute::line of line vertices");
  }
  for (const auto& chain : insertion.line.chains) {
    expect(!chain.empty(), "no empty chain");
    for (std::size_t i = 0; i < chain.size(); ++i) {
      expect(described.count(chain[i]) == 1, "chain vertices are described");
      if (i == 0) continue;
      const Halfedge h = after.halfedge(chain[i - 1], chain[i]);
      expect(h.is_valid() && (*line_edge)[after.edge(h)],
             "consecutive line vertices are joined by a line edge");
    }
  }
  // Lines drawn before are still there.
  const auto old_edges = find_map(before, attribute::line_edge);
  std::set<Pair> split;
  for (const SplitEdge& s : report.split_edges)
    split.insert({std::min(s.from, s.to), std::max(s.from, s.to)});
  for (Edge e : before.edges()) {
    if (!old_edges || !(*old_edges)[e] || split.count(ends_of(before, e)) > 0) continue;
    const Halfedge h = after.halfedge(before.vertex(e, 0), before.vertex(e, 1));
    expect(h.is_valid() && (*line_edge)[after.edge(h)], "earlier line edges stay");
  }
  return faults;
}

double relative_deviation(const Mesh& before, const Mesh& after, const Stroke& stroke,
                          const Insertion& insertion, double mean_edge) {
  const TracedStroke traced = trace_stroke(before, SurfaceProjector(before), stroke, {0.3, mean_edge});
  const auto rest = *find_map(before, attribute::rest_length);
  double worst = 0;
  for (const ProjectedSample& sample : traced.samples) {
    double longest = 0;
    for (const SubStroke& part : traced.sub_strokes) {
      for (std::size_t i = 0; i < part.faces.size(); ++i) {
        if (part.faces[i].face != sample.point.face) continue;
        for (std::size_t j = i > 0 ? i - 1 : 0; j < std::min(i + 2, part.faces.size()); ++j) {
          for (double l : rest_lengths_of(before, rest, part.faces[j].face)) longest = std::max(longest, l);
        }
      }
    }
    longest = std::max(longest, mean_edge);
    worst = std::max(worst, distance_to_line(after, insertion.line, sample.position) / (longest / 2));
  }
  return worst;
}

std::string fingerprint(const Mesh& mesh) {
  std::string bits;
  const auto add = [&](const auto& value) {
    bits.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (Vertex v : mesh.vertices()) {
    for (int k = 0; k < 3; ++k) add(mesh.point(v)[k]);
  }
  for (Face f : mesh.faces()) {
    for (Vertex v : corners_of(mesh, f)) add(static_cast<std::uint32_t>(v));
  }
  if (const auto rest = find_map(mesh, attribute::rest_length)) {
    for (Edge e : mesh.edges()) add((*rest)[e]);
  }
  if (const auto line = find_map(mesh, attribute::line)) {
    for (Vertex v : mesh.vertices()) add((*line)[v]);
  }
  for (const std::string& name : mesh.properties<Edge>()) bits += name;
  for (const std::string& name : mesh.properties<Vertex>()) bits += name;
  return bits;
}

}  // namespace furrow::tests
