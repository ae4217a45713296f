// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshes/surfaces.h"

#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace furrow::meshes {
namespace {

using geometry::Mesh;
using geometry::Point;
using geometry::Vertex;

Vec vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

/// The parts of triangles on the kept side, with one new vertex for each crossed edge.
class Cutter {
 public:
  Cutter(const Mesh& mesh, const Solid& keep) : mesh_(mesh), kept_(mesh.num_vertices()) {
    value_.reserve(mesh.num_vertices());
    for (Vertex v : mesh.vertices()) value_.push_back(keep(vec(mesh.point(v))));
  }

  Mesh cut() {
    for (geometry::Face f : mesh_.faces()) {
      std::vector<Vertex> polygon;
      for (auto h : mesh_.halfedges_around_face(mesh_.halfedge(f))) {
        const Vertex a = mesh_.source(h), b = mesh_.target(h);
        if (value_[a.idx()] > 0) polygon.push_back(copy(a));
        if ((value_[a.idx()] > 0) != (value_[b.idx()] > 0)) polygon.push_back(crossing(a, b));
      }
      for (std::size_t i = 2; i < polygon.size(); ++i) out_.add_face(polygon[0], polygon[i - 1], polygon[i]);
    }
    return std::move(out_);
  }

 private:
  Vertex copy(Vertex v) {
    if (!kept_[v.idx()].is_valid()) kept_[v.idx()] = out_.add_vertex(mesh_.point(v));
    return kept_[v.idx()];
  }
  Vertex crossing(Vertex a, Vertex b) {
    if (b < a) std::swap(a, b);
    const auto [at, is_new] = crossings_.try_emplace({a, b});
    if (is_new) {
      const double fa = value_[a.idx()], fb = value_[b.idx()];
      at->second = out_.add_vertex(mesh_.point(a) + fa / (fa - fb) * (mesh_.point(b) - mesh_.point(a)));
    }
    return at->second;
  }

  const Mesh& mesh_;
  std::vector<double> value_;
  std::vector<Vertex> kept_;
  std::map<std::pair<Vertex, Vertex>, Vertex> crossings_;
  Mesh out_;
};

/// Moves the vertices onto the surface by Newton's steps along the gradient.
void settle(Mesh& mesh, const Solid& solid) {
  constexpr double step_length = 1e-5;  // of the differences [m]
  for (int step = 0; step < 4; ++step)
    for (Vertex v : mesh.vertices()) {
      const Vec p = vec(mesh.point(v));
      Vec gradient;
      for (int k = 0; k < 3; ++k) {
        const Vec e = step_length * Vec::Unit(k);
        gradient[k] = (solid(p + e) - solid(p - e)) / (2 * step_length);
      }
      const Vec q = p - solid(p) / gradient.squaredNorm() * gradient;
      mesh.point(v) = {q.x(), q.y(), q.z()};
    }
}

/// Slides the vertices of the borders along them: CGAL splits and collapses border edges, but leaves the rest
/// where it was.
void space_borders_evenly(Mesh& mesh) {
  for (int step = 0; step < 20; ++step)
    for (auto h : mesh.halfedges()) {
      if (!mesh.is_border(h)) continue;
      Point& p = mesh.point(mesh.target(h));
      const Point &before = mesh.point(mesh.source(h)), &after = mesh.point(mesh.target(mesh.next(h)));
      const geometry::Vector tangent = after - before;
      p += (CGAL::midpoint(before, after) - p) * tangent / tangent.squared_length() * 0.5 * tangent;
    }
}

}  // namespace

Mesh mesh_surface(const Solid& solid, const Vec& low, const Vec& high, double edge) {
  Mesh mesh = march(solid, low, high, 0.7 * edge);
  remesh(mesh, edge, 1);
  settle(mesh, solid);
  return mesh;
}

Mesh cut(const Mesh& mesh, const Solid& keep) { return Cutter(mesh, keep).cut(); }

void remesh(Mesh& mesh, double edge, int rounds) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  for (int round = 0; round < rounds; ++round) {
    pmp::isotropic_remeshing(mesh.faces(), edge, mesh,
                             pmp::parameters::number_of_iterations(3).number_of_relaxation_steps(3));
    mesh.collect_garbage();
    space_borders_evenly(mesh);
  }
}

void stand_on_ground(Mesh& mesh) {
  double lowest = std::numeric_limits<double>::max();
  for (Vertex v : mesh.vertices()) lowest = std::min(lowest, mesh.point(v).y());
  for (Vertex v : mesh.vertices()) {
    const Point p = mesh.point(v);
    mesh.point(v) = {p.x(), p.y() - lowest, p.z()};
  }
}

}  // namespace furrow::meshes
