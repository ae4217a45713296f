// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/relax_displaced.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/band/relax_band.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

constexpr double good_displaced = 0.6;    ///< quality that a step may come down to in the displaced shape
constexpr double good_undisplaced = 0.3;  ///< and undisplaced, where flanks are short

/// Least quality of the star's faces with its centre at p, negative where one turns over.
double displaced_quality(const Mesh& mesh, const std::vector<Point>& at, const Star& star, const Point& p) {
  const Point& before = at[star.centre.idx()];
  double least = 1;
  for (std::size_t i = 0; i < star.faces(); ++i) {
    const Point &a = at[mesh.target(star.spokes[i]).idx()],
                &b = at[mesh.target(star.spokes[star.after(i)]).idx()];
    const Vector now = CGAL::cross_product(a - p, b - p), was = CGAL::cross_product(a - before, b - before);
    const double sides = (a - p).squared_length() + (b - a).squared_length() + (p - b).squared_length();
    const double area = std::sqrt(now.squared_length());
    least = std::min(least, 2 * std::numbers::sqrt3 * (now * was > 0 ? area : -area) / sides);
  }
  return least;
}

bool may_move(const BandMesh& band, Vertex v) {
  return !band.is_old(v) && band.hold[v.idx()] == Hold::free && band.on[v.idx()].empty();
}

}  // namespace

std::size_t relax_displaced(BandMesh& band, const BandSizing& sizing, std::vector<Point>& displaced,
                            const Displacing& displacing) {
  const Mesh& mesh = band.mesh;
  const std::vector<Vertex> vertices = band.vertices();
  std::vector<double> size(mesh.num_vertices(), 0);
  for (Vertex v : vertices) size[v.idx()] = sizing.at(mesh.point(v), 4 * band.mean_edge(v));
  std::size_t moved = 0;
  for (Vertex v : vertices) {
    physics::throw_if_cancelled("wrinkle");
    if (!may_move(band, v)) continue;
    const Star raised = lay_flat(mesh, displaced, v), flat = lay_flat(mesh, band.rest, v);
    const StarPoint to = find_in_star(raised, relaxed_place(mesh, raised, size));
    if (to.weights[0] == 1 || std::min({to.weights[0], to.weights[1], to.weights[2]}) < 0) continue;
    const Between between{
        {v, mesh.target(raised.spokes[to.face]), mesh.target(raised.spokes[raised.after(to.face)])},
        to.weights};
    const FacePoint place = band.base.project(band.place[v.idx()], position_in(mesh, flat, to));
    const Point p = displacing.at(between, place);
    const double now = displaced_quality(mesh, displaced, raised, displaced[v.idx()]);
    if (!(displaced_quality(mesh, displaced, raised, p) >= std::min(good_displaced, now))) continue;
    const Place2 there = place_in(flat, to);
    if (!band.move(flat, there, std::min(good_undisplaced, least_quality(flat, {0, 0})))) continue;
    displaced[v.idx()] = p;
    displacing.take(v);
    ++moved;
  }
  return moved;
}

}  // namespace furrow::geometry
