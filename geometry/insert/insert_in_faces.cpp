// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/insert/insert_in_faces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/insert/flip_rules.h"
#include "geometry/insert/restore_delaunay.h"
#include "geometry/mesh/degenerate_faces.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"

namespace furrow::geometry {
namespace {

void check_points(const Mesh& mesh, std::span<const FacePoint> points) {
  std::set<Face> seen;
  for (const FacePoint& p : points) {
    const std::string where = "face " + std::to_string(p.face);
    if (!mesh.is_valid(p.face) || !mesh.has_valid_index(p.face))
      refuse("insert_in_faces", where + " is not in the mesh");
    if (!seen.insert(p.face).second) refuse("insert_in_faces", where + " is given twice");
    const double sum = p.barycentrics[0] + p.barycentrics[1] + p.barycentrics[2];
    const bool inside =
        std::all_of(p.barycentrics.begin(), p.barycentrics.end(), [](double b) { return b > 0; });
    if (!inside || !(std::abs(sum - 1) < 1e-9))
      refuse("insert_in_faces",
             where + ": barycentrics must be > 0 and sum to 1, not " + std::to_string(sum));
  }
}

}  // namespace

Barycentrics clamped(const Barycentrics& barycentrics, double least) {
  Barycentrics result;
  double excess = 0;
  for (int i = 0; i < 3; ++i) excess += result[i] = std::max(barycentrics[i] - least, 0.0);
  for (double& b : result) b = least + (excess > 0 ? b * (1 - 3 * least) / excess : 0);
  return result;
}

void check_face(const Mesh& mesh, const EdgeMap<double>& rest, Face face) {
  const bool proper = is_proper_triangle(rest_lengths_of(mesh, rest, face));
  if (!proper || is_degenerate(mesh, face)) {
    throw ContentError(name_with_place(mesh, face) + " is degenerate (" +
                       (proper ? "no area in space" : "its rest lengths make no triangle") +
                       "); repair the mesh there, or draw elsewhere");
  }
}

std::vector<Edge> edges_in_flip_order(const Mesh& mesh, std::span<const Face> selected,
                                      const std::set<Edge>& skip) {
  const std::set<Face> inside(selected.begin(), selected.end());
  std::set<Edge> seen = skip;
  std::vector<Edge> shared, rim;
  for (Face face : selected) {
    std::vector<Edge> edges;
    for (Halfedge h : halfedges_of(mesh, face)) edges.push_back(mesh.edge(h));
    std::sort(edges.begin(), edges.end());
    for (Edge e : edges) {
      if (!seen.insert(e).second || mesh.is_border(e)) continue;
      const Face f = mesh.face(mesh.halfedge(e, 0)), g = mesh.face(mesh.halfedge(e, 1));
      (inside.count(f) > 0 && inside.count(g) > 0 ? shared : rim).push_back(e);
    }
  }
  shared.insert(shared.end(), rim.begin(), rim.end());
  return shared;
}

void flip_edges(MeshEditor& editor, std::span<const Edge> edges, const InsertionOptions& options,
                InsertionReport& report) {
  for (Edge e : edges) {
    if (const auto refusal = refusal_of_flip(editor, e, options)) {
      ++report.refused_flips[*refusal];
      continue;
    }
    report.folded_flips += folds_over(editor, e);
    editor.flip_edge(e);
    ++report.flipped;
  }
}

void conclude(const MeshEditor& editor, InsertionReport& report) {
  report.changed_faces.assign(editor.changed().begin(), editor.changed().end());
  double least = std::numbers::pi / 3;
  for (Face f : report.changed_faces) {
    least = std::min(least, smallest_angle(rest_lengths_of(editor.mesh(), editor.rest(), f)));
  }
  report.min_angle_deg = least * 180 / std::numbers::pi;
}

InsertionReport insert_in_faces(Mesh& mesh, std::span<const FacePoint> points,
                                const InsertionOptions& options) {
  check(options);
  require_triangles(mesh, "insert_in_faces");
  check_points(mesh, points);
  Mesh work = mesh;
  MeshEditor editor(work);
  InsertionReport report;
  std::vector<Face> selected;
  for (const FacePoint& p : points) {
    check_face(work, editor.rest(), p.face);
    selected.push_back(p.face);
  }
  const std::vector<Edge> edges = edges_in_flip_order(work, selected, {});
  const bool safe = options.rule == InsertionRule::safe;
  for (const FacePoint& p : points) {
    editor.split_face({p.face, safe ? clamped(p.barycentrics, options.min_barycentric) : p.barycentrics});
    ++report.inserted;
  }
  flip_edges(editor, edges, options, report);
  if (safe) report.delaunay_flips = restore_delaunay(editor, options);
  conclude(editor, report);
  mesh = std::move(work);
  return report;
}

}  // namespace furrow::geometry
