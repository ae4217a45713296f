// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/shortest_path.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>

#include "geometry/mesh/degenerate_faces.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/face_point.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using PathKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PathPoint = PathKernel::Point_3;
using PathMesh = CGAL::Surface_mesh<PathPoint>;

using PathFinder =
    CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<PathKernel, PathMesh>>;

/// Length of the shortest path along edges (Dijkstra); infinite if there is none.
double length_along_edges(const Mesh& mesh, Vertex from, Vertex to) {
  std::vector<double> length(mesh.num_vertices(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, Vertex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.push({length[from.idx()] = 0, from});
  while (!queue.empty()) {
    physics::throw_if_cancelled("shortest_path");
    const auto [reached, v] = queue.top();
    queue.pop();
    if (v == to) return reached;
    if (reached > length[v.idx()]) continue;
    for (Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v))) {
      const Vertex next = mesh.source(h);
      const double through = reached + spatial_length(mesh, mesh.edge(h));
      if (through < length[next.idx()]) queue.push({length[next.idx()] = through, next});
    }
  }
  return length[to.idx()];
}

/// The faces that a path of that length can come to: each of its points p has |p - a| + |p - b| <= length,
/// and a corner of p's face lies no farther from p than the face's longest edge.
std::vector<Face> faces_in_reach(const Mesh& mesh, Vertex from, Vertex to, double length) {
  const Point &a = mesh.point(from), &b = mesh.point(to);
  const auto distance = [](const Point& p, const Point& q) {
    return std::sqrt(CGAL::squared_distance(p, q));
  };
  std::vector<Face> faces;
  for (Face face : mesh.faces()) {
    physics::throw_if_cancelled("shortest_path");
    double longest = 0, detour = std::numeric_limits<double>::infinity();
    for (Halfedge h : halfedges_of(mesh, face)) {
      const Point& p = mesh.point(mesh.source(h));
      longest = std::max(longest, spatial_length(mesh, mesh.edge(h)));
      detour = std::min(detour, distance(p, a) + distance(p, b));
    }
    if (detour <= (1 + 1e-9) * length + 2 * longest) faces.push_back(face);
  }
  return faces;
}

/// A copy of some faces without the collapsed ones; `index` by vertex of the mesh. False if they cannot be
/// joined alone.
bool copy_faces(const Mesh& mesh, const std::vector<Face>& faces, PathMesh& copy,
                std::vector<PathMesh::Vertex_index>& index) {
  copy.clear();
  index.assign(mesh.num_vertices(), PathMesh::null_vertex());
  for (Face face : faces) {
    if (is_degenerate(mesh, face)) continue;
    std::array<PathMesh::Vertex_index, 3> corners;
    for (int i = 0; i < 3; ++i) {
      const Vertex v = corners_of(mesh, face)[i];
      const Point& p = mesh.point(v);
      if (!index[v.idx()].is_valid()) index[v.idx()] = copy.add_vertex(PathPoint(p.x(), p.y(), p.z()));
      corners[i] = index[v.idx()];
    }
    if (!copy.add_face(corners[0], corners[1], corners[2]).is_valid()) return false;
  }
  return true;
}

std::vector<Point> path_over(const PathMesh& mesh, PathMesh::Vertex_index from, PathMesh::Vertex_index to) {
  PathFinder finder(mesh);
  finder.add_source_point(to);
  std::vector<PathPoint> way;
  finder.shortest_path_points_to_source_points(from, std::back_inserter(way));
  std::vector<Point> path;
  for (const PathPoint& p : way) path.emplace_back(p.x(), p.y(), p.z());
  return path;
}

/// A collapsed face among those that a path of that length can come to.
std::optional<Face> degenerate_in_reach(const Mesh& mesh, Vertex from, Vertex to, double length) {
  for (Face face : faces_in_reach(mesh, from, to, length))
    if (is_degenerate(mesh, face)) return face;
  return std::nullopt;
}

double length_of(const std::vector<Point>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    length += std::sqrt(CGAL::squared_distance(path[i - 1], path[i]));
  return length;
}

}  // namespace

ShortestPath shortest_path(const Mesh& mesh, Vertex from, Vertex to) {
  const double bound = length_along_edges(mesh, from, to);
  if (!std::isfinite(bound)) return {};
  PathMesh copy;
  std::vector<PathMesh::Vertex_index> index;
  // Some faces alone may not join as they do among all.
  const bool joined = copy_faces(mesh, faces_in_reach(mesh, from, to, bound), copy, index) ||
                      copy_faces(mesh, {mesh.faces().begin(), mesh.faces().end()}, copy, index);
  ShortestPath path;
  if (joined && index[from.idx()].is_valid() && index[to.idx()].is_valid())
    path.points = path_over(copy, index[from.idx()], index[to.idx()]);
  path.degenerate = degenerate_in_reach(mesh, from, to, path.points.empty() ? bound : length_of(path.points));
  return path;
}

}  // namespace furrow::geometry
