// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/project_onto_surface.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/mesh/errors.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
using Traits = CGAL::AABB_traits<Kernel, Primitive>;

/// Below this barycentric a point counts as lying on the edge.
constexpr double on_edge = 1e-9;

bool lies_on_border(const Mesh& mesh, const FacePoint& p) {
  const auto h = halfedges_of(mesh, p.face);
  for (int i = 0; i < 3; ++i) {
    const bool at_corner = p.barycentrics[i] > 1 - on_edge;
    if (at_corner && mesh.is_border(mesh.source(h[i]))) return true;
    if (p.barycentrics[(i + 2) % 3] < on_edge && mesh.is_border(mesh.edge(h[i]))) return true;
  }
  return false;
}

SurfaceHit make_hit(const Mesh& mesh, Face face, const Point& position, const Point& query) {
  SurfaceHit hit;
  hit.point = {face, barycentrics_of(mesh, face, position)};
  hit.position = position;
  const Vector offset = query - position;
  hit.distance = std::sqrt(offset.squared_length());
  hit.on_border = lies_on_border(mesh, hit.point);
  if (hit.on_border) {
    const Vector n = normalized(area_normal_of(mesh, face));
    hit.beyond_border = std::sqrt((offset - (offset * n) * n).squared_length());
  }
  return hit;
}

}  // namespace

struct SurfaceProjector::Tree {
  const Mesh& mesh;
  CGAL::AABB_tree<Traits> tree;
};

namespace {

/// More faces than this with one reference point make CGAL's tree of these points deep, as it cannot part
/// them: it calls itself once for each.
constexpr std::size_t most_with_one_point = 1000;

using Tree = CGAL::AABB_tree<Traits>;
using Hint = Tree::Point_and_primitive_id;

/// The reference points that the tree of hints takes by default, one a face, sorted by place.
std::vector<Hint> sorted_hints(const Mesh& mesh) {
  std::vector<Hint> hints;
  for (Face face : mesh.faces()) hints.emplace_back(mesh.point(mesh.target(mesh.halfedge(face))), face);
  std::sort(hints.begin(), hints.end());
  return hints;
}

/// Lets the tree find first guesses among fewer points where too many coincide: one of each place.
void part_coincident_hints(Tree& tree, const Mesh& mesh) {
  std::vector<Hint> hints = sorted_hints(mesh);
  const auto same_place = [](const Hint& a, const Hint& b) { return a.first == b.first; };
  std::size_t most = 0;
  for (std::size_t i = 0, first = 0; i < hints.size(); ++i) {
    if (!same_place(hints[i], hints[first])) first = i;
    most = std::max(most, i - first + 1);
  }
  if (most <= most_with_one_point) return;
  hints.erase(std::unique(hints.begin(), hints.end(), same_place), hints.end());
  tree.accelerate_distance_queries(hints.begin(), hints.end());
}

}  // namespace

SurfaceProjector::SurfaceProjector(const Mesh& mesh) {
  if (mesh.number_of_faces() == 0) throw ContentError("the mesh has no faces to draw on");
  tree_ = std::make_unique<Tree>(Tree{mesh, {}});
  tree_->tree.insert(faces(mesh).first, faces(mesh).second, mesh);
  tree_->tree.build();
  part_coincident_hints(tree_->tree, mesh);
}

SurfaceProjector::~SurfaceProjector() = default;

SurfaceHit SurfaceProjector::closest(const Point& query) const {
  physics::throw_if_cancelled("SurfaceProjector");
  const auto [position, face] = tree_->tree.closest_point_and_primitive(query);
  return make_hit(tree_->mesh, face, position, query);
}

SurfaceHit SurfaceProjector::closest_among(const Point& query, std::span<const Face> faces) const {
  physics::throw_if_cancelled("SurfaceProjector");
  const Mesh& mesh = tree_->mesh;
  const auto project = Kernel().construct_projected_point_3_object();
  Face best_face = faces.front();
  Point best = query;
  double best_distance = std::numeric_limits<double>::infinity();
  for (Face face : faces) {
    const auto c = corners_of(mesh, face);
    const Point p = project(Kernel::Triangle_3(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2])), query);
    const double distance = CGAL::squared_distance(p, query);
    if (distance < best_distance) best_distance = distance, best = p, best_face = face;
  }
  return make_hit(mesh, best_face, best, query);
}

std::optional<SurfaceHit> SurfaceProjector::first_hit(const Point& origin, const Vector& direction) const {
  physics::throw_if_cancelled("SurfaceProjector");
  const Mesh& mesh = tree_->mesh;
  // Rounding may let a ray slip through the edge between two faces: two neighbours of it do not both.
  const auto box = tree_->tree.bbox();
  const double size = std::max({box.x_span(), box.y_span(), box.z_span()});
  const Vector axis = std::abs(direction.x()) < 0.5 * std::sqrt(direction.squared_length()) ? Vector(1, 0, 0)
                                                                                            : Vector(0, 1, 0);
  const Vector u = normalized(CGAL::cross_product(direction, axis));
  const Vector v = normalized(CGAL::cross_product(direction, u));
  std::vector<Face> crossed;
  for (const Vector& aside : {Vector(0, 0, 0), u + 0.3 * v, v - 0.3 * u})
    tree_->tree.all_intersected_primitives(Kernel::Ray_3(origin + 1e-9 * size * aside, direction),
                                           std::back_inserter(crossed));
  std::sort(crossed.begin(), crossed.end());
  crossed.erase(std::unique(crossed.begin(), crossed.end()), crossed.end());
  std::optional<SurfaceHit> best;
  bool best_faces_origin = false;
  for (Face face : crossed) {
    const Vector n = area_normal_of(mesh, face);
    const double slope = n * direction;
    if (slope == 0) continue;
    const double along = (n * (mesh.point(corners_of(mesh, face)[0]) - origin)) / slope;
    const SurfaceHit hit = make_hit(mesh, face, origin + along * direction, origin);
    // A neighbour of the ray may hit a face seen edge-on that the ray itself passes by.
    const Barycentrics& b = hit.point.barycentrics;
    if (std::min({b[0], b[1], b[2]}) < -1e-3) continue;
    const bool faces_origin = slope < 0;
    const bool better = !best || (faces_origin && !best_faces_origin) ||
                        (faces_origin == best_faces_origin && hit.distance < best->distance);
    if (better) best = hit, best_faces_origin = faces_origin;
  }
  if (best) best->beyond_border = 0;
  return best;
}

Barycentrics barycentrics_of(const Mesh& mesh, Face face, const Point& query) {
  const auto c = corners_of(mesh, face);
  const Point& p = mesh.point(c[0]);
  const Vector a = mesh.point(c[1]) - p, b = mesh.point(c[2]) - p, q = query - p;
  const Vector n = CGAL::cross_product(a, b);
  const double squared = n.squared_length();
  if (!(squared > 0)) return {1, 0, 0};
  const double beta = (CGAL::cross_product(q, b) * n) / squared;
  const double gamma = (CGAL::cross_product(a, q) * n) / squared;
  return {1 - beta - gamma, beta, gamma};
}

}  // namespace furrow::geometry
