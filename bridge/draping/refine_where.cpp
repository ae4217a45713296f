// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/refine_where.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "bridge/arrays/convert.h"
#include "geometry/figure/principal_strain.h"
#include "geometry/mesh/edge_metric.h"
#include "geometry/refine/subdivide.h"

namespace furrow::bridge {
namespace {

using physics::Vec3;

Vec3 normal_of(const geometry::Mesh& mesh, geometry::Halfedge h) {
  const Vec3 a = to_eigen(mesh.point(mesh.source(h))), b = to_eigen(mesh.point(mesh.target(h))),
             c = to_eigen(mesh.point(mesh.target(mesh.next(h))));
  return (b - a).cross(c - a).normalized();
}

/// Between the normals of the two faces of an edge [rad]; 0 at a border.
double bend_of(const geometry::Mesh& mesh, geometry::Edge e) {
  const geometry::Halfedge h = mesh.halfedge(e), o = mesh.opposite(h);
  if (mesh.is_border(h) || mesh.is_border(o)) return 0;
  const Vec3 n = normal_of(mesh, h), m = normal_of(mesh, o);
  return std::atan2(n.cross(m).norm(), n.dot(m));
}

}  // namespace

double size_of(const geometry::Mesh& mesh, geometry::Face f, const std::vector<double>& lengths) {
  const auto [a, b, c] = geometry::edge_lengths(mesh, f, lengths);
  return std::sqrt(4 / std::numbers::sqrt3 * geometry::triangle_area(a, b, c));
}

std::vector<double> want_of_refinement(const geometry::Mesh& mesh, const RefineWhere& where) {
  std::vector<double> want(mesh.num_faces(), 0);
  for (const geometry::Edge e : mesh.edges()) {
    const double bend = bend_of(mesh, e) / where.bend;
    for (const geometry::Halfedge h : {mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))})
      if (!mesh.is_border(h)) want[mesh.face(h).idx()] = std::max(want[mesh.face(h).idx()], bend);
  }
  const std::vector<geometry::PrincipalStrain> strain = geometry::principal_strains(mesh);
  const std::vector<double> rest = geometry::rest_lengths(mesh);
  for (const geometry::Face f : mesh.faces()) {
    const double pressed = -strain[f.idx()].smallest;
    if (!(pressed > 0)) continue;
    const double height = 2 * size_of(mesh, f, rest) / std::numbers::pi * std::sqrt(pressed);
    want[f.idx()] = std::max(want[f.idx()], height / where.seen);
  }
  return want;
}

bool LocalLevels::refine(const geometry::Mesh& at_rest) {
  const std::vector<double> want = want_of_refinement(at_rest, where_),
                            rest = geometry::rest_lengths(at_rest);
  std::vector<geometry::Face> faces;
  for (const geometry::Face f : at_rest.faces())
    if (want[f.idx()] > 1 && refined_.cuts(f) < refined_.depth() &&
        size_of(at_rest, f, rest) >= 1.5 * where_.finest)
      faces.push_back(f);
  std::stable_sort(faces.begin(), faces.end(),
                   [&](geometry::Face a, geometry::Face b) { return want[a.idx()] > want[b.idx()]; });
  constexpr double vertices_a_face = 2;  // three edges are cut, which two faces share, and others follow
  const double room = (double(where_.most_vertices) - double(at_rest.num_vertices())) / vertices_a_face;
  if (const auto most = std::size_t(std::max(0.0, room)); faces.size() > most) {
    ran_out_ = true;
    faces.resize(most);
  }
  if (refined_.refine(faces) == 0) return false;
  ++rounds_;
  return true;
}

bool LocalLevels::out_of_cuts(const geometry::Mesh& at_rest) const {
  const std::vector<double> want = want_of_refinement(at_rest, where_),
                            rest = geometry::rest_lengths(at_rest);
  return where_.finest > 0 && std::any_of(at_rest.faces_begin(), at_rest.faces_end(), [&](geometry::Face f) {
           return want[f.idx()] > 1 && refined_.cuts(f) == refined_.depth() &&
                  size_of(at_rest, f, rest) >= 1.5 * where_.finest;
         });
}

Carried LocalLevels::carry(const geometry::Mesh& at_rest, const geometry::Mesh& refined) const {
  const auto before = *geometry::uniform_indices(at_rest);
  geometry::Mesh shape = refined_.uniform(rounds_ - 1);
  std::vector<char> known(shape.num_vertices(), 0);
  for (const geometry::Vertex v : at_rest.vertices()) {
    const auto u = geometry::Vertex(geometry::Vertex::size_type(before[v]));
    shape.point(u) = at_rest.point(v);
    known[u.idx()] = 1;
  }
  for (const geometry::Vertex v : shape.vertices()) {  // the ends come before their middle
    if (known[v.idx()]) continue;
    const auto ends = refined_.ends_of(v.idx());
    const auto at = [&](int i) {
      return shape.point(geometry::Vertex(geometry::Vertex::size_type(ends[std::size_t(i)])));
    };
    shape.point(v) = CGAL::midpoint(at(0), at(1));
  }
  std::vector<Vec3> coarse = positions_of(shape);
  geometry::loop_subdivide(shape, 1);
  const std::vector<Vec3> fine = positions_of(shape);
  for (std::size_t v = coarse.size(); v < fine.size(); ++v) {
    const auto ends = refined_.ends_of(v);
    coarse.push_back((coarse[ends[0]] + coarse[ends[1]]) / 2);
  }
  return {geometry::take_of_uniform(refined, coarse), geometry::take_of_uniform(refined, fine)};
}

}  // namespace furrow::bridge
