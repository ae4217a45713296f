// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/rest_state.h"

#include <cmath>
#include <string>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/fold_rest.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/tie_length.h"

namespace furrow::geometry {
namespace {

/// Compares the present shape with the snapshot's.
class Change {
 public:
  Change(const Mesh& mesh, const RestSnapshot& before) : mesh_(mesh), before_(before) {}
  bool touches(Vertex a, Vertex b) const { return moved(a) || moved(b); }
  /// The rest length `rest` [m] of a spring a-b carried over to the present shape.
  double carried(double rest, Vertex a, Vertex b) const {
    const double after = distance(mesh_.point(a), mesh_.point(b));
    const double earlier = distance(before_.positions[a.idx()], before_.positions[b.idx()]);
    return std::isnan(rest) || !(earlier > 0) ? after : rest * (after / earlier);
  }

 private:
  static double distance(const Point& p, const Point& q) { return std::sqrt(CGAL::squared_distance(p, q)); }
  bool moved(Vertex v) const { return mesh_.point(v) != before_.positions[v.idx()]; }
  const Mesh& mesh_;
  const RestSnapshot& before_;
};

/// Returns how many rest lengths changed.
std::size_t carry_struts(Mesh& mesh, const Change& change) {
  std::vector<Strut> list = struts(mesh);
  std::size_t scaled = 0;
  for (Strut& s : list) {
    if (s.rest_length <= tie_length || !change.touches(s.a, s.b)) continue;
    s.rest_length = change.carried(s.rest_length, s.a, s.b);
    ++scaled;
  }
  if (scaled) set_struts(mesh, list);
  return scaled;
}

}  // namespace

RestSnapshot take_rest_snapshot(const Mesh& mesh) {
  check_mesh(mesh, "take_rest_snapshot");
  RestSnapshot snapshot;
  snapshot.positions.assign(mesh.points().begin(), mesh.points().end());
  snapshot.edges = mesh.num_edges();
  if (find_map(mesh, attribute::rest_angle)) {
    snapshot.angles.resize(mesh.num_edges());
    for (Edge e : mesh.edges()) snapshot.angles[e.idx()] = dihedral_angle(mesh, e);
  }
  return snapshot;
}

RestReport apply_rest_rule(Mesh& mesh, const RestSnapshot& before, RestRule rule) {
  if (before.positions.size() != mesh.num_vertices() || before.edges != mesh.num_edges())
    refuse("apply_rest_rule", "the snapshot has " + std::to_string(before.positions.size()) +
                                  " vertices and " + std::to_string(before.edges) + " edges, the mesh has " +
                                  std::to_string(mesh.num_vertices()) + " and " +
                                  std::to_string(mesh.num_edges()));
  check_mesh(mesh, "apply_rest_rule");
  RestReport report;
  if (rule == RestRule::flat) return report;
  const Change change(mesh, before);
  auto rest = ensure_map(mesh, attribute::rest_length);
  const auto own = find_map(mesh, attribute::triangle_rest_length);
  for (Edge e : mesh.edges()) {
    const Vertex a = mesh.vertex(e, 0), b = mesh.vertex(e, 1);
    if (!change.touches(a, b)) continue;
    rest[e] = change.carried(rest[e], a, b);
    for (Halfedge h : {mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))})
      if (own && !std::isnan((*own)[h])) (*own)[h] = change.carried((*own)[h], a, b);
    ++report.scaled_edges;
  }
  for (const BendingSpring& s : bending_springs(mesh)) {
    if (!change.touches(s.a, s.b)) continue;
    (*find_map(mesh, attribute::bending_rest_length))[s.across] = change.carried(s.rest_length, s.a, s.b);
    ++report.scaled_bending_springs;
  }
  report.scaled_struts = carry_struts(mesh, change);
  if (rule == RestRule::copied) report.turned_hinges = turn_hinges(mesh, before, before.angles, {}, rule);
  return report;
}

double rest_area(const Mesh& mesh) {
  check_mesh(mesh, "rest_area");
  const std::vector<double> lengths = rest_lengths(mesh);
  double sum = 0;
  for (Face f : mesh.faces()) {
    const auto [a, b, c] = edge_lengths(mesh, f, lengths);
    sum += triangle_area(a, b, c);
  }
  return sum;
}

}  // namespace furrow::geometry
