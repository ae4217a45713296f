// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/mesh/self_intersections.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/exact_triangles.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

/// Pairs of overlapping boxes that are looked at; a garment has about ten a face.
double most_candidates(std::size_t triangles) { return std::max(2e7, 200 * double(triangles)); }

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

/// Boxes that are sorted and scanned in place of cut in halves: faces are small and spread out, for which
/// CGAL's own 10 takes two to three times as long (3,000 to 49,000 vertices).
constexpr std::ptrdiff_t scanned = 1000;
constexpr std::size_t looks_a_question = 32;

/// Calls `found` with each pair, as the triangles were numbered; `fresh` (empty: all), by number: only with
/// pairs of which one is.
template <class Found>
void for_each_pair(std::span<const Point> points, std::span<const std::array<int, 3>> triangles,
                   const std::vector<bool>& fresh, const Found& found) {
  ExactTriangles exact(points, triangles, "count_self_intersections");
  const std::vector<int> welded = weld(points);
  std::vector<std::array<int, 3>> corners;
  for (const std::size_t name : exact.names) {
    const std::array<int, 3>& t = triangles[name];
    corners.push_back({welded[std::size_t(t[0])], welded[std::size_t(t[1])], welded[std::size_t(t[2])]});
  }
  std::size_t looked = 0;
  const auto look_at = [&](const ExactTriangles::Box& a, const ExactTriangles::Box& b) {
    if (++looked % looks_a_question == 0) physics::throw_if_cancelled("count_self_intersections");
    if (double(looked) > most_candidates(triangles.size()))
      throw ContentError("too many of the faces lie at one place to count those that cross each other");
    const auto &s = corners[a.info()], &t = corners[b.info()];
    if (std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) != s.end()) return;
    if (CGAL::do_intersect(exact.shapes[a.info()], exact.shapes[b.info()]))
      found(exact.names[a.info()], exact.names[b.info()]);
  };
  const auto old = std::partition(exact.boxes.begin(), exact.boxes.end(), [&](const ExactTriangles::Box& b) {
    return fresh.empty() || fresh[exact.names[b.info()]];
  });
  CGAL::box_self_intersection_d(exact.boxes.begin(), old, look_at, scanned);
  CGAL::box_intersection_d(exact.boxes.begin(), old, old, exact.boxes.end(), look_at, scanned);
}

using Triangle = std::array<int, 3>;
using Pairs = std::vector<std::array<std::size_t, 2>>;

CGAL::Bbox_3 box_of(std::span<const Point> points, const Triangle& t) {
  const auto at = [&](int i) { return points[std::size_t(t[std::size_t(i)])].bbox(); };
  return at(0) + at(1) + at(2);
}

/// Adds the pairs of which one is fresh. Faces away from all fresh ones are not looked at.
void add_fresh_pairs(std::span<const Point> points, std::span<const Triangle> triangles,
                     const std::vector<bool>& fresh, Pairs& pairs) {
  CGAL::Bbox_3 all;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    if (fresh[i]) all += box_of(points, triangles[i]);
  std::vector<int> number(points.size(), -1);
  std::vector<Point> near_points;
  std::vector<Triangle> near;
  std::vector<std::size_t> names;
  std::vector<bool> near_fresh;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!CGAL::do_overlap(box_of(points, triangles[i]), all)) continue;
    Triangle& t = near.emplace_back(triangles[i]);
    for (int& v : t) {
      const auto of = static_cast<std::size_t>(v);
      if (number[of] < 0)
        number[of] = static_cast<int>(near_points.size()), near_points.push_back(points[of]);
      v = number[of];
    }
    names.push_back(i);
    near_fresh.push_back(fresh[i]);
  }
  if (near.empty()) return;
  for_each_pair(near_points, near, near_fresh, [&](std::size_t i, std::size_t j) {
    pairs.push_back({names[i], names[j]});
  });
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
  for_each_pair(points, triangles, {}, [&](std::size_t, std::size_t) { ++pairs; });
  return pairs;
}

std::size_t count_self_intersections(const Mesh& mesh) {
  return count_self_intersections(points_of(mesh), triangles_of(mesh));
}

std::vector<std::array<Face, 2>> self_intersections(const Mesh& mesh) {
  const std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  std::vector<std::array<Face, 2>> pairs;
  for_each_pair(points_of(mesh), triangles_of(mesh), {}, [&](std::size_t i, std::size_t j) {
    pairs.push_back({faces[std::min(i, j)], faces[std::max(i, j)]});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::vector<std::array<Face, 2>> self_intersections(const Mesh& mesh, CrossingMemory& memory) {
  const std::lock_guard lock(memory.mutex);
  std::vector<Point> points = points_of(mesh);
  std::vector<Triangle> triangles = triangles_of(mesh);
  const std::vector<Face> faces(mesh.faces().begin(), mesh.faces().end());
  std::vector<bool> fresh;
  for (std::size_t i = 0; i < triangles.size(); ++i)
    fresh.push_back(i >= memory.triangles.size() || triangles[i] != memory.triangles[i] ||
                    std::any_of(triangles[i].begin(), triangles[i].end(), [&](int v) {
                      return points[std::size_t(v)] != memory.points[std::size_t(v)];
                    }));
  Pairs pairs;
  for (const auto& [i, j] : memory.pairs)
    if (std::max(i, j) < fresh.size() && !fresh[i] && !fresh[j]) pairs.push_back({i, j});
  add_fresh_pairs(points, triangles, fresh, pairs);
  std::vector<std::array<Face, 2>> result;
  for (const auto& [i, j] : pairs) result.push_back({faces[std::min(i, j)], faces[std::max(i, j)]});
  std::sort(result.begin(), result.end());
  memory.points = std::move(points);
  memory.triangles = std::move(triangles);
  memory.pairs = std::move(pairs);
  return result;
}

}  // namespace furrow::geometry
