// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/touch.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "geometry/fold/line_region.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/mesh.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/mesh/property_names.h"
#include "geometry/rest/bending_springs.h"
#include "geometry/rest/rest_angles.h"
#include "geometry/rest/rest_metric.h"
#include "geometry/rest/rest_state.h"

namespace furrow::geometry {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;

void check_touch(const Touch& touch) {
  constexpr const char* me = "touch";
  if (!(touch.radius > 0) || !std::isfinite(touch.radius))
    refuse(me, "radius is " + std::to_string(touch.radius));
  if (!(touch.strength > 0 && touch.strength <= 1))
    refuse(me, "strength is " + std::to_string(touch.strength));
  const Point at = touch.at;
  const Vector by = touch.by;
  for (int k = 0; k < 3; ++k)
    if (!std::isfinite(at[k]) || !std::isfinite(by[k])) refuse(me, "a number is not finite");
}

/// From 0 to 1 without a kink, as t goes there.
double eased(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// 1 up to half of the radius, 0 from the radius on.
double hold_at(double distance, double radius) { return eased(2 * (1 - distance / radius)); }

/// The vertex nearest to the touch within its radius; buttons and what else rides on cloth is passed over.
Vertex nearest_cloth(const Mesh& mesh, const Touch& touch) {
  const auto rides = find_map(mesh, attribute::rides);
  Vertex nearest;
  double least = touch.radius * touch.radius;
  for (const Vertex v : mesh.vertices()) {
    const double d = CGAL::squared_distance(mesh.point(v), Point(touch.at));
    if (d > least || mesh.is_isolated(v) || (d == least && nearest.is_valid())) continue;
    const auto on_cloth = [&](Face f) { return f.is_valid() && ((*rides)[f] == 1 || (*rides)[f] == 2); };
    const auto faces = mesh.faces_around_target(mesh.halfedge(v));
    if (rides && std::any_of(faces.begin(), faces.end(), on_cloth)) continue;
    nearest = v;
    least = d;
  }
  return nearest;
}

/// Cloth that is smoothed, wider than what is ironed, so that how it is held around does not matter there.
struct IronedPatch {
  std::vector<Vertex> vertices;  ///< but for those of borders
  std::vector<int> index;        ///< by vertex: its place there, or -1
  std::vector<Vertex> border;    ///< vertices of borders
};

IronedPatch patch_of(const Mesh& mesh, const std::vector<double>& weights) {
  IronedPatch patch{{}, std::vector<int>(mesh.num_vertices(), -1), {}};
  for (const Vertex v : mesh.vertices()) {
    if (!(weights[v.idx()] > 0)) continue;
    if (mesh.is_border(v)) {
      patch.border.push_back(v);
      continue;
    }
    patch.index[v.idx()] = int(patch.vertices.size());
    patch.vertices.push_back(v);
  }
  return patch;
}

/// Lengths of all edges as the mesh lies [m], by index.
std::vector<double> lengths_as_it_lies(const Mesh& mesh) {
  std::vector<double> lengths(mesh.num_edges(), 0);
  for (const Edge e : mesh.edges()) lengths[e.idx()] = spatial_length(mesh, e);
  return lengths;
}

/// How strongly ironing acts at a vertex: whole from a radius off borders, where folds end freely, and would
/// flare, and not at all on them.
double grip_at(const Mesh& mesh, const IronedPatch& patch, Vertex v, double radius) {
  double nearest = radius * radius;
  for (const Vertex b : patch.border)
    nearest = std::min(nearest, CGAL::squared_distance(mesh.point(v), mesh.point(b)));
  return eased(std::sqrt(nearest) / radius);
}

/// Rows of the Laplacian by cotangents at the patch's vertices, each over the root of its area: of these in
/// `inner`, and what all others add in `held`. Fills the areas.
void laplacian(const Mesh& mesh, const IronedPatch& patch, double radius, Triplets& inner,
               Eigen::MatrixXd& held, Eigen::VectorXd& mass) {
  const std::vector<double> lengths = lengths_as_it_lies(mesh);
  for (std::size_t i = 0; i < patch.vertices.size(); ++i) {
    const Vertex v = patch.vertices[i];
    double area = 0;
    for (const Face f : mesh.faces_around_target(mesh.halfedge(v))) {
      const auto [a, b, c] = edge_lengths(mesh, f, lengths);
      area += triangle_area(a, b, c) / 3;
    }
    area = std::max(area, 1e-16);
    mass[Eigen::Index(i)] = area;
    const double scale = grip_at(mesh, patch, v, radius) / std::sqrt(area);
    const auto add = [&](Vertex to, double w) {
      const int column = patch.index[to.idx()];
      if (column >= 0) inner.emplace_back(int(i), column, w * scale);
      if (column < 0)
        for (int k = 0; k < 3; ++k) held(Eigen::Index(i), k) += w * scale * mesh.point(to)[k];
    };
    for (const Halfedge in : mesh.halfedges_around_target(mesh.halfedge(v))) {
      double w = 0;
      for (const Halfedge h : {in, mesh.opposite(in)}) {
        const double a = lengths[mesh.edge(h).idx()], b = lengths[mesh.edge(mesh.next(h)).idx()],
                     c = lengths[mesh.edge(mesh.prev(h)).idx()];
        w += bounded_cotangents(a, b, c)[0] / 2;
      }
      add(mesh.source(in), w);
      add(v, -w);
    }
  }
}

/// Where smoothing puts the patch's vertices, with all else held; empty where that has no solution.
Eigen::MatrixXd ironed(const Mesh& mesh, const IronedPatch& patch, double radius) {
  constexpr double wider = 1.4;  // of each pass, so that all halve waves of twice the radius
  const double t = std::pow(wider * radius / std::numbers::pi, 4);
  const auto n = Eigen::Index(patch.vertices.size());
  Triplets inner;
  Eigen::MatrixXd held = Eigen::MatrixXd::Zero(n, 3), given(n, 3);
  Eigen::VectorXd mass(n);
  laplacian(mesh, patch, radius, inner, held, mass);
  for (Eigen::Index i = 0; i < n; ++i)
    for (int k = 0; k < 3; ++k) given(i, k) = mesh.point(patch.vertices[std::size_t(i)])[k];
  Eigen::SparseMatrix<double> rows(n, n);
  rows.setFromTriplets(inner.begin(), inner.end());
  const Eigen::SparseMatrix<double> weighed = t * rows.transpose();
  Eigen::SparseMatrix<double> matrix = weighed * rows;
  matrix.diagonal() += mass;
  const Eigen::MatrixXd right = mass.asDiagonal() * given - weighed * held;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  if (solver.info() != Eigen::Success) return {};
  Eigen::MatrixXd smooth = solver.solve(right);
  for (int again = 0; again < 2; ++again) smooth += solver.solve(mass.asDiagonal() * (given - smooth));
  if (!smooth.allFinite()) return {};
  return smooth;
}

void pull_cloth(Mesh& mesh, const Touch& touch, const std::vector<double>& weights) {
  for (const Vertex v : mesh.vertices())
    if (const double share = weights[v.idx()] * touch.strength; share > 0)
      mesh.point(v) = mesh.point(v) + share * Vector(touch.by);
}

void iron_cloth(Mesh& mesh, const Touch& touch, const std::vector<double>& weights) {
  Touch wider = touch;
  wider.radius *= 1.75;
  const IronedPatch patch = patch_of(mesh, touch_weights(mesh, wider));
  if (patch.vertices.empty()) return;
  const Eigen::MatrixXd smooth = ironed(mesh, patch, touch.radius);
  for (Eigen::Index i = 0; i < smooth.rows(); ++i) {
    const Vertex v = patch.vertices[std::size_t(i)];
    const double share = weights[v.idx()] * touch.strength;
    mesh.point(v) = mesh.point(v) + share * (Point(smooth(i, 0), smooth(i, 1), smooth(i, 2)) - mesh.point(v));
  }
}

/// A touch's share of a change from `a` to `b`.
class Blend {
 public:
  Blend(const Touch& touch, const std::vector<double>& weights) : touch_(touch), weights_(weights) {}
  double share(Vertex a, Vertex b) const {
    return touch_.strength * (weights_[a.idx()] + weights_[b.idx()]) / 2;
  }
  static double between(double from, double to, double share) { return from + share * (to - from); }

 private:
  const Touch& touch_;
  const std::vector<double>& weights_;
};

/// By edge: the factor of a pinch, as small as its triangles bear: one whose sides would not meet is pinched
/// less.
std::vector<double> pinch_factors(const Mesh& mesh, const std::vector<double>& rest, const Blend& blend) {
  std::vector<double> factor(mesh.num_edges(), 1);
  for (const Edge e : mesh.edges())
    factor[e.idx()] = std::max(1 - blend.share(mesh.vertex(e, 0), mesh.vertex(e, 1)), 0.05);
  for (bool changed = true; changed;) {
    changed = false;
    for (const Face f : mesh.faces()) {
      std::array<Edge, 3> edges;
      TriangleLengths now{}, before{};
      std::size_t i = 0;
      double sum = 0;
      for (const Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f))) {
        edges[i] = mesh.edge(h);
        before[i] = rest[edges[i].idx()];
        now[i] = before[i] * factor[edges[i].idx()];
        sum += factor[edges[i++].idx()] / 3;
      }
      if (triangle_area(now) > 0.1 * sum * sum * triangle_area(before) || sum >= 1) continue;
      for (const Edge e : edges) factor[e.idx()] = std::min(1.0, (factor[e.idx()] + 0.05) * 1.1);
      changed = true;
    }
  }
  return factor;
}

double distance_of(const Mesh& mesh, const BendingSpring& s) {
  return std::sqrt(CGAL::squared_distance(mesh.point(s.a), mesh.point(s.b)));
}

/// Calls change(length, edge) for each rest length of an edge, that of its spring and those of its triangles,
/// and change_spring(spring) for the rest length of each spring across an edge; both return the new one.
template <class Change, class ChangeSpring>
void change_lengths(Mesh& mesh, const Change& change, const ChangeSpring& change_spring) {
  const auto rest = ensure_rest_lengths(mesh);
  const auto own = find_map(mesh, attribute::triangle_rest_length);
  for (const Edge e : mesh.edges()) {
    rest[e] = change(rest[e], e);
    for (const Halfedge h : {mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))})
      if (own && !std::isnan((*own)[h])) (*own)[h] = change((*own)[h], e);
  }
  for (const BendingSpring& s : bending_springs(mesh))
    (*find_map(mesh, attribute::bending_rest_length))[s.across] = change_spring(s);
}

/// Calls change(angle, edge), which returns the new one, for each rest angle that is set.
template <class Change>
void change_angles(Mesh& mesh, const Change& change) {
  const auto angle = find_map(mesh, attribute::rest_angle);
  if (!angle) return;
  for (const Edge e : mesh.edges())
    if (!mesh.is_border(e) && !std::isnan((*angle)[e])) (*angle)[e] = change((*angle)[e], e);
}

/// Rest lengths and angles go to those of the shape.
void take_shape(Mesh& mesh, const Blend& blend) {
  const auto share = [&](Edge e) { return blend.share(mesh.vertex(e, 0), mesh.vertex(e, 1)); };
  change_lengths(
      mesh,
      [&](double rest, Edge e) {
        return share(e) > 0 ? Blend::between(rest, spatial_length(mesh, e), share(e)) : rest;
      },
      [&](const BendingSpring& s) {
        const double by = blend.share(s.a, s.b);
        return by > 0 ? Blend::between(s.rest_length, distance_of(mesh, s), by) : s.rest_length;
      });
  change_angles(mesh, [&](double rest, Edge e) {
    return share(e) > 0 ? Blend::between(rest, dihedral_angle(mesh, e), share(e)) : rest;
  });
}

/// Rest lengths go along as the cloth was moved, so that its strain stays, and what bends it goes where its
/// bend went.
void go_along(Mesh& mesh, const RestSnapshot& before) {
  apply_rest_rule(mesh, before, RestRule::drawn);
  change_angles(mesh, [&](double rest, Edge e) {
    const double now = dihedral_angle(mesh, e), then = before.angles[e.idx()];
    if (now == then) return rest;
    const double left = then == 0 ? 0 : std::clamp(now / then, 0.0, 1.0);
    return std::clamp(now + left * (rest - then), -std::numbers::pi, std::numbers::pi);
  });
}

void shorten(Mesh& mesh, const Blend& blend) {
  const std::vector<double> factor = pinch_factors(mesh, rest_lengths(mesh), blend);
  change_lengths(
      mesh, [&](double rest, Edge e) { return rest * factor[e.idx()]; },
      [&](const BendingSpring& s) { return s.rest_length * std::max(1 - blend.share(s.a, s.b), 0.05); });
}

}  // namespace

const char* word_of(TouchKind kind) {
  switch (kind) {
    case TouchKind::iron:
      return "iron";
    case TouchKind::steam:
      return "steam";
    case TouchKind::pinch:
      return "pinch";
    case TouchKind::pull:
      break;
  }
  return "pull";
}

std::vector<double> touch_weights(const Mesh& mesh, const Touch& touch) {
  check_touch(touch);
  check_mesh(mesh, "touch");
  const std::array<Vertex, 1> seed{nearest_cloth(mesh, touch)};
  if (!seed[0].is_valid()) refuse("touch", "no cloth lies within its radius");
  const std::vector<double> lengths = lengths_as_it_lies(mesh);
  std::vector<double> weights(mesh.num_vertices(), 0);
  for (const Vertex v : vertices_within(mesh, seed, 1.5 * largest_detour * touch.radius, lengths))
    if (!mesh.is_isolated(v))
      weights[v.idx()] =
          hold_at(std::sqrt(CGAL::squared_distance(mesh.point(v), Point(touch.at))), touch.radius);
  return weights;
}

void apply_touch(Mesh& mesh, const Touch& touch, const std::vector<double>& weights) {
  check_touch(touch);
  check_mesh(mesh, "touch");
  if (weights.size() != mesh.num_vertices())
    refuse("touch", "there are " + std::to_string(weights.size()) + " weights of " +
                        std::to_string(mesh.num_vertices()) + " vertices");
  ensure_rest_lengths(mesh);
  const Blend blend(touch, weights);
  if (touch.kind == TouchKind::pinch) return shorten(mesh, blend);
  if (touch.kind == TouchKind::steam) return take_shape(mesh, blend);
  const RestSnapshot before = take_rest_snapshot(mesh);
  touch.kind == TouchKind::iron ? iron_cloth(mesh, touch, weights) : pull_cloth(mesh, touch, weights);
  go_along(mesh, before);
}

}  // namespace furrow::geometry
