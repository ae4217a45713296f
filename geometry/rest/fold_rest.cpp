// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/fold_rest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/face_point.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/rest_angles.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double crease = 0.99;  ///< chord over unfolded length: an edge that is shorter leads over a crease
constexpr double flattest = 1 - 0.01;  ///< longest side over the other two

double apart(const Point& p, const Point& q) { return std::sqrt(CGAL::squared_distance(p, q)); }

/// |ab| with the triangles (c, d, a) and (c, d, b) laid flat on either side of cd; 0 if that has no length.
double unfolded(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Vector axis = d - c;
  const double length = std::sqrt(axis.squared_length());
  if (!(length > 0)) return 0;
  const auto place = [&](const Point& p) {
    const double x = (p - c) * axis / length;
    return std::array<double, 2>{x, std::sqrt(std::max(0.0, (p - c).squared_length() - x * x))};
  };
  const auto u = place(a), v = place(b);
  return std::hypot(u[0] - v[0], u[1] + v[1]);
}

/// Edge lengths of faces at rest, those of a face's own where it has them.
struct RestTriangles {
  const Mesh& mesh;
  EdgeMap<double> edges;
  std::optional<HalfedgeMap<double>> own;
  double of(Halfedge h) const { return own && !std::isnan((*own)[h]) ? (*own)[h] : edges[mesh.edge(h)]; }
  /// Longest side over the sum of the others; infinite where a length is none.
  double flatness(Face f) const {
    const auto h = halfedges_of(mesh, f);
    const double a = of(h[0]), b = of(h[1]), c = of(h[2]), longest = std::max({a, b, c});
    return std::isfinite(a + b + c) ? longest / (a + b + c - longest)
                                    : std::numeric_limits<double>::infinity();
  }
};

bool moved(const Mesh& mesh, const RestSnapshot& before, Vertex v) {
  return mesh.point(v) != before.positions[v.idx()];
}

/// The factor of the unfolded pair, where the chord says too little.
std::optional<double> unfolded_factor(const Mesh& mesh, const RestSnapshot& before, double rest, Edge e) {
  if (mesh.is_border(e)) return std::nullopt;
  const Halfedge h = mesh.halfedge(e), o = mesh.opposite(h);
  const std::array<Vertex, 4> v{mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)),
                                mesh.target(mesh.next(o))};
  const auto& old = before.positions;
  const double lay = apart(old[v[0].idx()], old[v[1].idx()]);
  const double earlier = unfolded(old[v[0].idx()], old[v[1].idx()], old[v[2].idx()], old[v[3].idx()]);
  const double now = unfolded(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]), mesh.point(v[3]));
  // Strained cloth that lies flat has no crease: there both say the same, and the chord goes on.
  if (!(lay < crease * earlier) || !(std::abs(rest - earlier) < std::abs(rest - lay))) return std::nullopt;
  if (!(earlier > 0) || !(now > 0)) return std::nullopt;
  return now / earlier;
}

/// Edges before and after apply_rest_rule(): those over creases get their own factor.
std::size_t unfold_edges(Mesh& mesh, const RestSnapshot& before, const std::vector<double>& rest_before) {
  auto rest = ensure_map(mesh, attribute::rest_length);
  std::size_t unfolded = 0;
  for (Edge e : mesh.edges()) {
    if (!moved(mesh, before, mesh.vertex(e, 0)) && !moved(mesh, before, mesh.vertex(e, 1))) continue;
    const auto factor = unfolded_factor(mesh, before, rest_before[e.idx()], e);
    if (!factor) continue;
    rest[e] = *factor * rest_before[e.idx()];
    ++unfolded;
  }
  return unfolded;
}

/// Faces of `asked` that are too flat at rest take their present lengths; their neighbours are asked again.
std::size_t reshape(Mesh& mesh, std::vector<Face> asked) {
  RestTriangles rest{mesh, ensure_map(mesh, attribute::rest_length),
                     find_map(mesh, attribute::triangle_rest_length)};
  std::vector<char> is_reshaped(mesh.num_faces(), 0);
  std::size_t reshaped = 0;
  while (!asked.empty()) {
    physics::throw_if_cancelled("wrinkle");
    const Face f = asked.back();
    asked.pop_back();
    if (is_reshaped[f.idx()] || !(rest.flatness(f) > flattest)) continue;
    is_reshaped[f.idx()] = 1;
    ++reshaped;
    for (Halfedge h : halfedges_of(mesh, f)) {
      rest.edges[mesh.edge(h)] = spatial_length(mesh, mesh.edge(h));
      if (rest.own && !std::isnan((*rest.own)[h])) (*rest.own)[h] = rest.edges[mesh.edge(h)];
      if (!mesh.is_border(mesh.opposite(h))) asked.push_back(mesh.face(mesh.opposite(h)));
    }
  }
  return reshaped;
}

/// Faces without area keep none in their own shape: their shorter sides grow until they have one.
void give_area(Mesh& mesh) {
  constexpr double least = 1e-4;  // of the longest side
  RestTriangles rest{mesh, ensure_map(mesh, attribute::rest_length),
                     find_map(mesh, attribute::triangle_rest_length)};
  bool changed = true;
  for (int round = 0; changed && round < 1000; ++round) {
    changed = false;
    physics::throw_if_cancelled("wrinkle");
    for (Face f : mesh.faces()) {
      if (rest.flatness(f) < 1 - 1e-9) continue;
      changed = true;
      const auto h = halfedges_of(mesh, f);
      const double longest = std::max({rest.of(h[0]), rest.of(h[1]), rest.of(h[2])});
      const double sum = rest.of(h[0]) + rest.of(h[1]) + rest.of(h[2]) - longest;
      for (Halfedge side : h) {
        if (rest.of(side) == longest) continue;
        rest.edges[mesh.edge(side)] = rest.of(side) + ((1 + least) * longest - sum) / 2;
        if (rest.own && !std::isnan((*rest.own)[side])) (*rest.own)[side] = rest.edges[mesh.edge(side)];
      }
    }
  }
}

std::vector<Face> faces_moved(const Mesh& mesh, const RestSnapshot& before) {
  std::vector<Face> faces;
  for (Face f : mesh.faces())
    for (Vertex v : corners_of(mesh, f))
      if (moved(mesh, before, v)) {
        faces.push_back(f);
        break;
      }
  return faces;
}

}  // namespace

std::size_t turn_hinges(Mesh& mesh, const RestSnapshot& before, std::span<const double> base_angles,
                        std::span<const double> set, RestRule rule) {
  const auto rest = find_map(mesh, attribute::rest_angle);
  std::size_t turned = 0;
  for (Edge e : mesh.edges()) {
    if (!rest || before.angles.empty() || mesh.is_border(e) || std::isnan((*rest)[e])) continue;
    const double base = base_angles[e.idx()], share = rule == RestRule::copied ? 1 : set[e.idx()];
    const double grown = base - before.angles[e.idx()] + share * (dihedral_angle(mesh, e) - base);
    if (grown == 0) continue;
    (*rest)[e] = std::remainder((*rest)[e] + grown, 2 * std::numbers::pi);
    ++turned;
  }
  return turned;
}

FoldRestReport apply_fold_rest(Mesh& mesh, const RestSnapshot& before, std::span<const double> base_angles,
                               std::span<const double> set, RestRule rule) {
  if (base_angles.size() != mesh.num_edges() || set.size() != mesh.num_edges())
    refuse("apply_fold_rest", "angles and set must have one entry for each edge");
  const std::vector<double> rest_before = rest_lengths(mesh);
  FoldRestReport report;
  report.carried = apply_rest_rule(mesh, before, rule == RestRule::flat ? rule : RestRule::drawn);
  if (rule != RestRule::flat) {
    report.unfolded_edges = unfold_edges(mesh, before, rest_before);
    report.reshaped_faces = reshape(mesh, faces_moved(mesh, before));
    give_area(mesh);
    report.carried.turned_hinges = turn_hinges(mesh, before, base_angles, set, rule);
  }
  report.invalid_faces = invalid_rest_faces(mesh);
  return report;
}

std::size_t invalid_rest_faces(const Mesh& mesh) {
  const auto edges = find_map(mesh, attribute::rest_length);
  if (!edges) return 0;
  const RestTriangles rest{mesh, *edges, find_map(mesh, attribute::triangle_rest_length)};
  std::size_t invalid = 0;
  for (Face f : mesh.faces()) invalid += !(rest.flatness(f) < 1);
  return invalid;
}

}  // namespace furrow::geometry
