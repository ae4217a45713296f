// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/rest/spread_warp.h"

#include <Eigen/Sparse>
#include <cmath>
#include <complex>
#include <vector>

#include "geometry/rest/warp_frame.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using Complex = std::complex<double>;

/// A face laid flat, its first side along 1.
struct WarpPlane {
  FaceSides sides;
  double area = 0;
};

WarpPlane warp_plane(const Mesh& mesh, Face f) {
  WarpPlane plane{sides_as_made(mesh, mesh.halfedge(f)), 0};
  plane.area = plane.sides.col(0).cross(plane.sides.col(1)).norm() / 2;
  return plane;
}

/// Along a halfedge of the face, in its plane, of unit length.
Complex along_side(const Mesh& mesh, const WarpPlane& plane, Halfedge h) {
  const Halfedge first = mesh.halfedge(mesh.face(h));
  const Eigen::Vector3d a = plane.sides.col(0), c = plane.sides.col(1);
  const Eigen::Vector3d v = h == first ? a : h == mesh.next(first) ? Eigen::Vector3d(c - a) : -c;
  const Complex z = in_plane(plane.sides, v);
  return z / std::abs(z);
}

/// Two faces that share an edge: z_f = turn z_g.
struct WarpLink {
  Face f, g;
  double weight;
  Complex turn;
};

std::vector<WarpLink> warp_links(const Mesh& mesh, const std::vector<WarpPlane>& planes) {
  std::vector<WarpLink> links;
  for (Edge e : mesh.edges()) {
    if (mesh.is_border(e)) continue;
    const Halfedge h = mesh.halfedge(e), o = mesh.opposite(h);
    const Face f = mesh.face(h), g = mesh.face(o);
    const WarpPlane &p = planes[f.idx()], &q = planes[g.idx()];
    if (!(p.area > 0) || !(q.area > 0)) continue;
    const Complex a = along_side(mesh, p, h), b = along_side(mesh, q, o);
    const Halfedge first = mesh.halfedge(f);
    const double length = h == first              ? p.sides.col(0).norm()
                          : h == mesh.next(first) ? (p.sides.col(1) - p.sides.col(0)).norm()
                                                  : p.sides.col(1).norm();
    const Complex turn = a / b;
    links.push_back({f, g, 3 * length * length / (p.area + q.area), turn * turn});
  }
  return links;
}

/// Whether a face is joined to one that has a direction.
std::vector<char> reached_faces(const Mesh& mesh, const std::vector<WarpLink>& links,
                                const std::vector<char>& known) {
  std::vector<std::vector<std::size_t>> beside(mesh.num_faces());
  for (const WarpLink& l : links)
    beside[l.f.idx()].push_back(l.g.idx()), beside[l.g.idx()].push_back(l.f.idx());
  std::vector<char> reached = known;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i]) open.push_back(i);
  while (!open.empty()) {
    physics::throw_if_cancelled("spread_warp");
    const std::size_t at = open.back();
    open.pop_back();
    for (const std::size_t next : beside[at])
      if (!reached[next]) reached[next] = 1, open.push_back(next);
  }
  return reached;
}

/// z of all faces: of those in `row` (>= 0) found, of the others as given.
void solve_for(const std::vector<WarpLink>& links, const std::vector<int>& row, int rows,
               std::vector<Complex>& z) {
  std::vector<Eigen::Triplet<Complex>> entries;
  Eigen::VectorXcd right = Eigen::VectorXcd::Zero(rows);
  const auto add = [&](std::size_t f, std::size_t g, double w, Complex turn) {
    if (row[f] < 0) return;
    entries.emplace_back(row[f], row[f], w);
    if (row[g] >= 0)
      entries.emplace_back(row[f], row[g], -w * turn);
    else
      right[row[f]] += w * turn * z[g];
  };
  for (const WarpLink& l : links) {
    if (z[l.f.idx()] == 0. && row[l.f.idx()] < 0) continue;  // never reached
    if (z[l.g.idx()] == 0. && row[l.g.idx()] < 0) continue;
    add(l.f.idx(), l.g.idx(), l.weight, l.turn);
    add(l.g.idx(), l.f.idx(), l.weight, std::conj(l.turn));
  }
  Eigen::SparseMatrix<Complex> matrix(rows, rows);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<Complex>> solver(matrix);
  const Eigen::VectorXcd found = solver.solve(right);
  for (std::size_t i = 0; i < row.size(); ++i)
    if (row[i] >= 0) z[i] = found[row[i]];
}

}  // namespace

WarpCount spread_warp(Mesh& mesh) {
  auto map = ensure_map(mesh, attribute::warp);
  std::vector<WarpPlane> planes(mesh.num_faces());
  std::vector<Complex> z(mesh.num_faces(), 0);
  std::vector<char> known(mesh.num_faces(), 0);
  for (Face f : mesh.faces()) {
    planes[f.idx()] = warp_plane(mesh, f);
    const auto& w = map[f];
    const Eigen::Vector2d a = weights_along(planes[f.idx()].sides, {w[0], w[1], w[2]});
    if (!a.allFinite()) continue;
    const Complex along = in_plane(planes[f.idx()].sides, planes[f.idx()].sides * a);
    z[f.idx()] = (along / std::abs(along)) * (along / std::abs(along));
    known[f.idx()] = 1;
  }
  const std::vector<WarpLink> links = warp_links(mesh, planes);
  const std::vector<char> reached = reached_faces(mesh, links, known);
  std::vector<int> row(mesh.num_faces(), -1);
  int rows = 0;
  for (Face f : mesh.faces())
    if (reached[f.idx()] && !known[f.idx()]) row[f.idx()] = rows++;
  if (rows == 0) return count_warp(mesh);
  solve_for(links, row, rows, z);
  for (Face f : mesh.faces())
    if (row[f.idx()] >= 0 && std::isfinite(std::abs(z[f.idx()]))) {
      const Eigen::Vector3d v = in_space(planes[f.idx()].sides, std::arg(z[f.idx()]) / 2);
      map[f] = {v.x(), v.y(), v.z()};
    }
  return count_warp(mesh);
}

}  // namespace furrow::geometry
