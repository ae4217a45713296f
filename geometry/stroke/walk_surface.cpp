// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/walk_surface.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "physics/base/cancel_scope.h"

namespace furrow::geometry {

SurfaceWalk walk_surface(const Mesh& mesh, Face face, const Point& start, const Point& target,
                         const Vector& normal, std::optional<Face> target_face, double length_limit) {
  SurfaceWalk walk;
  const Vector chord = target - start, side = CGAL::cross_product(chord, normal);
  if (!(side.squared_length() > 1e-24 * chord.squared_length())) return walk;
  const auto height = [&](Vertex v) { return side * (mesh.point(v) - start); };
  Point last = start;
  while (true) {
    physics::throw_if_cancelled("walk_surface");
    // Seen from above, the path leaves a face where the edge goes from its right (height >= 0) to its left.
    std::optional<Halfedge> exit;
    for (Halfedge h : halfedges_of(mesh, face)) {
      if (height(mesh.source(h)) >= 0 && height(mesh.target(h)) < 0) exit = h;
    }
    if (!exit) return walk.end = SurfaceWalk::End::no_way, walk;
    const Point &a = mesh.point(mesh.source(*exit)), &b = mesh.point(mesh.target(*exit));
    const double from = height(mesh.source(*exit)), to = height(mesh.target(*exit));
    const double t = from / (from - to);
    const Point x = a + t * (b - a);
    if (!target_face && (x - start) * chord > chord.squared_length()) {
      return walk.end = SurfaceWalk::End::stopped, walk;
    }
    walk.length += std::sqrt(CGAL::squared_distance(last, x));
    if (walk.length > length_limit) return walk.end = SurfaceWalk::End::too_long, walk;
    walk.crossings.push_back({*exit, t, x});
    last = x;
    const Halfedge beyond = mesh.opposite(*exit);
    if (mesh.is_border(beyond)) return walk.end = SurfaceWalk::End::border, walk;
    face = mesh.face(beyond);
    if (target_face == face) return walk.end = SurfaceWalk::End::reached, walk;
    // A plane that meets no border comes back to its first face.
    if (walk.crossings.size() > mesh.number_of_faces()) return walk.end = SurfaceWalk::End::too_long, walk;
  }
}

std::vector<Face> faces_reachable_within(const Mesh& mesh, Face face, const Point& centre, double radius) {
  std::set<Face> seen{face};
  std::vector<Face> queue{face};
  const auto near = [&](Vertex v) {
    return CGAL::squared_distance(mesh.point(v), centre) <= radius * radius;
  };
  for (std::size_t next = 0; next < queue.size(); ++next) {
    physics::throw_if_cancelled("walk_surface");
    for (Halfedge h : halfedges_of(mesh, queue[next])) {
      const Halfedge beyond = mesh.opposite(h);
      if (mesh.is_border(beyond) || !(near(mesh.source(h)) || near(mesh.target(h)))) continue;
      if (seen.insert(mesh.face(beyond)).second) queue.push_back(mesh.face(beyond));
    }
  }
  return {seen.begin(), seen.end()};
}

std::vector<EdgeCrossing> fewest_crossings(const Mesh& mesh, Face from, Face to, const Point& guide,
                                           std::size_t most) {
  std::map<Face, Halfedge> entered_by;  // the halfedge of the face before
  std::vector<Face> ring{from};
  std::set<Face> seen{from};
  for (std::size_t steps = 0; steps < most && seen.count(to) == 0; ++steps) {
    std::vector<Face> next;
    for (Face face : ring) {
      physics::throw_if_cancelled("walk_surface");
      for (Halfedge h : halfedges_of(mesh, face)) {
        if (mesh.is_border(mesh.opposite(h))) continue;
        const Face beyond = mesh.face(mesh.opposite(h));
        if (seen.insert(beyond).second) entered_by[beyond] = h, next.push_back(beyond);
      }
    }
    ring = std::move(next);
  }
  std::vector<EdgeCrossing> crossings;
  if (seen.count(to) == 0) return crossings;
  for (Face face = to; face != from; face = mesh.face(crossings.back().halfedge)) {
    const Halfedge h = entered_by.at(face);
    const Point& a = mesh.point(mesh.source(h));
    const Vector edge = mesh.point(mesh.target(h)) - a;
    const double t = std::clamp(((guide - a) * edge) / edge.squared_length(), 1e-3, 1 - 1e-3);
    crossings.push_back({h, t, a + t * edge});
  }
  std::reverse(crossings.begin(), crossings.end());
  return crossings;
}

}  // namespace furrow::geometry
