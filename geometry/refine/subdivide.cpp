// SPDX-License-Identifier: GPL-3.0-or-later
// CGAL's step of sqrt(3) ends with the postcondition that no vertex is isolated. Ours may be: KeepIsolated
// below looks after them, and the tests check the result. All other checks of CGAL stay on.
#define CGAL_NO_POSTCONDITIONS
#include "geometry/refine/subdivide.h"

#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/subdivision_method_3.h>

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/mesh/carry_attributes.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/refine/quarters.h"
#include "geometry/refine/refine_rest.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

namespace cgal = CGAL::Subdivision_method_3;
using PointMap = boost::property_map<Mesh, CGAL::vertex_point_t>::type;

/// CGAL's masks, except that a vertex without faces stays where it is.
template <class Mask>
class KeepIsolated : public Mask {
 public:
  explicit KeepIsolated(Mesh& mesh) : Mask(&mesh, mesh.points()), mesh_(mesh) {}
  void vertex_node(Vertex v, Point& p) {
    if (mesh_.is_isolated(v))
      p = mesh_.point(v);
    else
      Mask::vertex_node(v, p);
  }

 private:
  const Mesh& mesh_;
};

/// The mask of no smoothing: mid-points, and old vertices where they are.
class MidpointMask : public CGAL::PQQ_stencil_3<Mesh, PointMap> {
 public:
  explicit MidpointMask(Mesh& mesh) : PQQ_stencil_3(&mesh, mesh.points()), mesh_(mesh) {}
  void edge_node(Halfedge h, Point& p) {
    p = CGAL::midpoint(mesh_.point(mesh_.source(h)), mesh_.point(mesh_.target(h)));
  }
  void vertex_node(Vertex v, Point& p) { p = mesh_.point(v); }
  void border_node(Halfedge h, Point& on_edge, Point& at_target) {
    edge_node(h, on_edge);
    at_target = mesh_.point(mesh_.target(h));
  }

 private:
  const Mesh& mesh_;
};

void check(Mesh& mesh, int steps, int faces_per_face, const char* operation) {
  if (steps < 0 || steps > 6) refuse(operation, "steps is " + std::to_string(steps) + ", not in [0, 6]");
  require_structure(mesh, operation);
  require_triangles(mesh, operation);
  require_finite(mesh, operation);
  const double faces = static_cast<double>(mesh.number_of_faces()) * std::pow(faces_per_face, steps);
  if (faces > 50e6)
    refuse(operation, "steps is " + std::to_string(steps) + ", which would make more than 50 million faces");
  if (steps == 0) return;
  rest_lengths(mesh);  // throws for one that cannot be refined
  mesh.collect_garbage();
}

/// Mid-points of the edges of lines get the line of both ends.
void carry_lines(const Mesh& before, Mesh& mesh) {
  const auto line = find_map(mesh, attribute::line);
  const auto was_line_edge = find_map(before, attribute::line_edge);
  if (!line || !was_line_edge) return;
  for (Edge e : before.edges()) {
    const Vertex a = before.vertex(e, 0), b = before.vertex(e, 1);
    if ((*was_line_edge)[e] && (*line)[a] == (*line)[b]) (*line)[middle_of(before, e)] = (*line)[a];
  }
}

/// Marks the halves of diagonals, and the new edges parallel to them: between the mid-points of the other two
/// sides of a face.
void carry_diagonals(const Mesh& before, Mesh& mesh) {
  const auto was_diagonal = find_map(before, attribute::diagonal);
  const auto diagonal = find_map(mesh, attribute::diagonal);
  if (!was_diagonal || !diagonal) return;
  const auto mark = [&](Vertex a, Vertex b) { (*diagonal)[mesh.edge(mesh.halfedge(a, b))] = true; };
  for (Edge e : before.edges()) {
    if (!(*was_diagonal)[e]) continue;
    for (int end : {0, 1}) mark(before.vertex(e, end), middle_of(before, e));
    for (Halfedge h : {before.halfedge(e), before.opposite(before.halfedge(e))})
      if (!before.is_border(h))
        mark(middle_of(before, before.edge(before.next(h))), middle_of(before, before.edge(before.prev(h))));
  }
}

/// Where a mask puts the old vertices, and then the middle of each edge.
template <class Mask>
std::vector<Point> masked_points(const Mesh& mesh, Mask mask) {
  const std::size_t vertices = mesh.number_of_vertices();
  std::vector<Point> points(vertices + mesh.number_of_edges());
  for (Edge e : mesh.edges()) {
    physics::throw_if_cancelled("subdivide");
    Halfedge h = mesh.halfedge(e);
    if (!mesh.is_border(e)) {
      mask.edge_node(h, points[vertices + e.idx()]);
      continue;
    }
    if (mesh.is_border(h)) h = mesh.opposite(h);
    mask.border_node(h, points[vertices + e.idx()], points[mesh.target(h).idx()]);
  }
  for (Vertex v : mesh.vertices()) {
    physics::throw_if_cancelled("subdivide");
    if (mesh.is_isolated(v) || !mesh.is_border(v)) mask.vertex_node(v, points[v.idx()]);
  }
  return points;
}

/// Cuts each edge of the mesh in two; the new half is the one at its target.
void cut_edges(Mesh& mesh) {
  const Mesh::size_type edges = mesh.number_of_edges();
  mesh.reserve(mesh.number_of_vertices() + edges, 4 * edges, 2 * edges);
  for (Mesh::size_type i = 0; i < edges; ++i) {
    physics::throw_if_cancelled("subdivide");
    const Halfedge h = mesh.halfedge(Edge(i)), back = mesh.opposite(h);
    const Halfedge half = CGAL::Euler::split_vertex(mesh.prev(back), h, mesh);
    if (!mesh.is_border(h)) mesh.set_halfedge(mesh.face(h), half);
    if (!mesh.is_border(back)) mesh.set_halfedge(mesh.face(back), back);
  }
}

/// Cuts each face, whose edges have been cut, into four.
void cut_faces(Mesh& mesh) {
  const Mesh::size_type faces = mesh.number_of_faces();
  for (Mesh::size_type i = 0; i < faces; ++i) {
    physics::throw_if_cancelled("subdivide");
    const auto after = [&](Halfedge h) { return mesh.next(mesh.next(h)); };
    const Halfedge first = mesh.next(mesh.halfedge(Face(i))), second = after(first), third = after(second);
    const Halfedge to_second = CGAL::Euler::split_face(first, second, mesh);
    const Halfedge to_third = CGAL::Euler::split_face(to_second, third, mesh);
    CGAL::Euler::split_face(to_third, first, mesh);
  }
}

/// A step of a mask that keeps the topology of Loop's scheme. Its numbers are those of CGAL's step, which
/// cannot be left early without a leak, and takes a second for 180,000 vertices.
template <class Mask>
void quadrisect(Mesh& mesh) {
  const SavedAttributes saved(mesh);
  const std::size_t old_vertices = mesh.number_of_vertices(), old_faces = mesh.number_of_faces();
  const Mesh& before = saved.before();
  const std::vector<Point> points = masked_points(mesh, Mask(mesh));
  cut_edges(mesh);
  cut_faces(mesh);
  for (Vertex v : mesh.vertices()) mesh.point(v) = points[v.idx()];
  const auto parent = [&](Face f) {
    physics::throw_if_cancelled("subdivide");
    return whole_of(f, old_faces);
  };
  const auto origin = [&](Vertex v, Face in) {
    Origin at{in};
    const bool is_old = v.idx() < old_vertices;
    const Edge cut(is_old ? Edge() : Edge(static_cast<Edge::size_type>(v.idx() - old_vertices)));
    const Vertex a = is_old ? v : before.vertex(cut, 0), b = is_old ? v : before.vertex(cut, 1);
    if (saved.corner(in, a) == 3 || saved.corner(in, b) == 3)
      throw std::logic_error("subdivide: a part of a face is not numbered as expected");
    at.weights[saved.corner(in, a)] += 0.5;
    at.weights[saved.corner(in, b)] += 0.5;
    return at;
  };
  saved.restore(mesh, parent, origin);
  saved.restore_halves(mesh);
  refine_rest_of_quarters(saved, mesh, parent);
  carry_lines(before, mesh);
  carry_diagonals(before, mesh);
}

/// Where CGAL's step will put the new vertices, in its order: the centroid of each face, or, where the border
/// is refined, two vertices on the border edge of a face that has one.
std::vector<Origin> sqrt3_origins(const Mesh& mesh, const SavedAttributes& saved, bool refine_border) {
  std::vector<Origin> origins;
  for (Face f : mesh.faces()) {
    Halfedge border;
    for (Halfedge h : mesh.halfedges_around_face(mesh.halfedge(f)))
      if (!border.is_valid() && mesh.is_border(mesh.opposite(h))) border = h;
    if (!refine_border || !border.is_valid()) {
      origins.push_back({f, {1. / 3, 1. / 3, 1. / 3}});
      continue;
    }
    const std::size_t from = saved.corner(f, mesh.source(border)), to = saved.corner(f, mesh.target(border));
    for (double share : {1. / 3, 2. / 3}) {
      Origin at{f};
      at.weights[from] = 1 - share;
      at.weights[to] = share;
      origins.push_back(at);
    }
  }
  return origins;
}

void sqrt3_step(Mesh& mesh, bool refine_border) {
  const SavedAttributes saved(mesh);
  const std::size_t old_vertices = mesh.number_of_vertices();
  const std::vector<Origin> origins = sqrt3_origins(mesh, saved, refine_border);
  KeepIsolated<CGAL::Sqrt3_mask_3<Mesh, PointMap>> mask(mesh);
  // CGAL's public function makes all steps at once; attributes have to be carried after each.
  cgal::internal::Sqrt3_1step(mesh, mesh.points(), mask, refine_border);
  mesh.collect_garbage();
  const auto parent = [&](Face f) {
    Vertex newest;  // every new face has a new vertex; the one of lowest index decides
    for (Vertex v : mesh.vertices_around_face(mesh.halfedge(f)))
      if (v.idx() >= old_vertices && (!newest.is_valid() || v < newest)) newest = v;
    return origins.at(newest.idx() - old_vertices).face;
  };
  const auto origin = [&](Vertex v, Face in) {
    if (v.idx() >= old_vertices) return origins[v.idx() - old_vertices];
    Origin at{in};
    at.weights.at(saved.corner(in, v)) = 1;
    return at;
  };
  saved.restore(mesh, parent, origin);
  refine_rest_of_sqrt3(saved, mesh, origins);
}

/// All steps, or the mesh as it was where they end by an exception.
template <class Step>
void whole(Mesh& mesh, int steps, const Step& step) {
  const Mesh before = mesh;
  try {
    for (int i = 0; i < steps; ++i) step(i);
  } catch (...) {
    mesh = before;
    throw;
  }
}

}  // namespace

void loop_subdivide(Mesh& mesh, int steps) {
  check(mesh, steps, 4, "loop_subdivide");
  whole(mesh, steps, [&](int) { quadrisect<KeepIsolated<CGAL::Loop_mask_3<Mesh, PointMap>>>(mesh); });
}

std::vector<Face> midpoint_subdivide(Mesh& mesh, int steps) {
  check(mesh, steps, 4, "midpoint_subdivide");
  mesh.collect_garbage();
  std::vector<Face> parents(mesh.faces().begin(), mesh.faces().end());
  whole(mesh, steps, [&](int) {
    const std::size_t old_faces = parents.size();
    quadrisect<MidpointMask>(mesh);
    for (std::size_t f = old_faces; f < mesh.number_of_faces(); ++f)
      parents.push_back(parents[whole_of(Face(static_cast<Face::size_type>(f)), old_faces).idx()]);
  });
  return parents;
}

void sqrt3_subdivide(Mesh& mesh, int steps) {
  check(mesh, steps, 3, "sqrt3_subdivide");
  whole(mesh, steps, [&](int i) { sqrt3_step(mesh, i % 2 == 1); });
}

}  // namespace furrow::geometry
