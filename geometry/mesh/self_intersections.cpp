// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Exact = CGAL::Exact_predicates_inexact_constructions_kernel;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

/// Pairs of overlapping boxes that are looked at; a garment has about ten a face.
double most_candidates(std::size_t triangles) { return std::max(2e7, 200 * double(triangles)); }

bool is_finite(const Point& p) {
  return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

/// For each point, the lowest index of a point at the same position.
std::vector<int> weld(std::span<const Point> points) {
  std::vector<int> order(points.size()), first(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
    return points[i] != points[j] ? points[i] < points[j] : a < b;
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto here = static_cast<std::size_t>(order[i]);
    const bool same = i > 0 && points[here] == points[static_cast<std::size_t>(order[i - 1])];
    first[here] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  return first;
}

/// Triangles with an area, as the predicates take them.
struct Soup {
  std::vector<Exact::Triangle_3> shapes;
  std::vector<std::array<int, 3>> corners;  ///< welded
  std::vector<std::size_t> names;           ///< indices of the triangles given
  std::vector<Box> boxes;
};

Soup gather(std::span<const Point> points, std::span<const std::array<int, 3>> triangles) {
  if (!std::all_of(points.begin(), points.end(), is_finite))
    throw ContentError("count_self_intersections: a position is not finite; repair the mesh first");
  const std::vector<int> welded = weld(points);
  Soup soup;
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    physics::throw_if_cancelled("count_self_intersections");
    const std::array<int, 3>& t = triangles[k];
    std::array<Exact::Point_3, 3> p;
    std::array<int, 3> ids;
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] < 0 || static_cast<std::size_t>(t[i]) >= points.size())
        throw ContentError("count_self_intersections: a triangle names the vertex " + std::to_string(t[i]));
      const Point& q = points[static_cast<std::size_t>(t[i])];
      p[i] = {q.x(), q.y(), q.z()};
      ids[i] = welded[static_cast<std::size_t>(t[i])];
    }
    if (CGAL::collinear(p[0], p[1], p[2])) continue;
    soup.shapes.emplace_back(p[0], p[1], p[2]);
    soup.corners.push_back(ids);
    soup.names.push_back(k);
    soup.boxes.emplace_back(soup.shapes.back().bbox(), soup.shapes.size() - 1);
  }
  return soup;
}

/// Boxes that are sorted and scanned in place of cut in halves: faces are small and spread out, for which
/// CGAL's own 10 takes two to three times as long (3,000 to 49,000 vertices).
constexpr std::ptrdiff_t scanned = 1000;
constexpr std::size_t looks_a_question = 32;

/// Calls `found` with each pair, as the triangles were numbered.
template <class Found>
void for_each_pair(std::span<const Point> points, std::span<const std::array<int, 3>> triangles,
                   const Found& found) {
  Soup soup = gather(points, triangles);
  std::size_t looked = 0;
  const auto look_at = [&](const Box& a, const Box& b) {
    if (++looked % looks_a_question == 0) physics::throw_if_cancelled("count_self_intersections");
    if (double(looked) > most_candidates(triangles.size()))
      throw ContentError("too many of the faces lie at one place to count those that cross each other");
    const auto& s = soup.corners[a.info()];
    const auto& t = soup.corners[b.info()];
    if (std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) != s.end()) return;
    if (CGAL::do_intersect(soup.shapes[a.info()], soup.shapes[b.info()]))
      found(soup.names[a.info()], soup.names[b.info()]);
  };
  CGAL::box_self_intersection_d(soup.boxes.begin(), soup.boxes.end(), look_at, scanned);
}

std::vector<std::array<int, 3>> triangles_of(const Mesh& mesh) {
  require_finite(mesh, "count_self_intersections");
  require_triangles(mesh, "count_self_intersections");
  std::vector<std::array<int, 3>> triangles;
  for (Face f : mesh.faces()) {
    std::size_t i = 0;
    triangles.emplace_back();
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      triangles.back()[i++] = static_cast<int>(v.idx());
  }
  return triangles;
}

std::vector<Point> points_of(const Mesh& mesh) { return {mesh.points().begin(), mesh.points().end()}; }

}  // namespace

std::size_t count_self_intersections(std::span<const Point> points,
                                     std::span<const std::array<int, 3>> triangles) {
  std::size_t pairs = 0;
  for_each_pair(points, triangles, [&](std::size_t, std::size_t) { ++pairs; });
  return pairs;
}

std::size_t count_self_intersections(const Mesh& mesh) {
  return count_self_intersections(points_of(mesh), triangles_of(mesh));
}

std::vector<std::array<Face, 2>> self_intersections(const Mesh& mesh) {
  const std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  std::vector<std::array<Face, 2>> pairs;
  for_each_pair(points_of(mesh), triangles_of(mesh), [&](std::size_t i, std::size_t j) {
    pairs.push_back({faces[std::min(i, j)], faces[std::max(i, j)]});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace furrow::geometry
