// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/band/star.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/band/base_surface.h"

namespace furrow::geometry {
namespace {

double cross(const Place2& a, const Place2& b, const Place2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}
double squared(const Place2& a, const Place2& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}
Place2 turned(const Place2& a, const Place2& by) {
  return {a[0] * by[0] - a[1] * by[1], a[0] * by[1] + a[1] * by[0]};
}

/// Outgoing halfedges, counter-clockwise.
std::vector<Halfedge> spokes_of(const Mesh& mesh, Vertex v, bool& closed) {
  const Halfedge any = mesh.opposite(mesh.halfedge(v));
  Halfedge first = any;
  closed = true;
  // clockwise to the right end of the fan, if there is one
  for (Halfedge h = any;;) {
    const Halfedge back = mesh.opposite(h);
    if (mesh.is_border(back)) {
      first = h;
      closed = false;
      break;
    }
    h = mesh.next(back);
    if (h == any) break;
    if (mesh.target(h) < mesh.target(first)) first = h;
  }
  std::vector<Halfedge> spokes;
  for (Halfedge h = first;;) {
    spokes.push_back(h);
    if (mesh.is_border(h)) break;
    h = mesh.opposite(mesh.prev(h));
    if (h == first) break;
  }
  return spokes;
}

/// The cosine and sine of a triangle's angle between sides r and s, opposite o.
Place2 angle_between(double r, double s, double o) {
  const double cosine = std::clamp((r * r + s * s - o * o) / (2 * r * s), -1.0, 1.0);
  return {cosine, std::sqrt(std::max(0.0, 1 - cosine * cosine))};
}

StarPoint best_of(const Star& star, const auto& weights_in) {
  StarPoint best;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < star.faces(); ++i) {
    const Barycentrics b = weights_in(i);
    const double least = std::min({b[0], b[1], b[2]});
    if (!(least > most)) continue;
    most = least;
    best = {i, b};
  }
  return best;
}

template <class Length>
Star laid_flat(const Mesh& mesh, const Length& length, Vertex v) {
  Star star;
  star.centre = v;
  star.spokes = spokes_of(mesh, v, star.closed);
  const std::size_t n = star.spokes.size();
  star.ends.resize(n);
  Place2 direction{1, 0};
  for (std::size_t i = 0; i < n; ++i) {
    const Halfedge h = star.spokes[i];
    const double r = length(h);
    star.ends[i] = {r * direction[0], r * direction[1]};
    if (i + 1 == n && !star.closed) return star;
    const double s = length(star.spokes[star.after(i)]), o = length(mesh.next(h));
    direction = turned(direction, angle_between(r, s, o));
  }
  star.defect = -std::atan2(direction[1], direction[0]);
  if (std::abs(star.defect) < 1e-9) return star;
  for (std::size_t i = 1; i < n; ++i) {
    const double by = star.defect * static_cast<double>(i) / static_cast<double>(n);
    star.ends[i] = turned(star.ends[i], {std::cos(by), std::sin(by)});
  }
  return star;
}

}  // namespace

Star lay_flat(const Mesh& mesh, const EdgeMap<double>& rest, Vertex v) {
  return laid_flat(
      mesh, [&](Halfedge h) { return rest[mesh.edge(h)]; }, v);
}

Star lay_flat(const Mesh& mesh, const std::vector<Point>& positions, Vertex v) {
  const auto length = [&](Halfedge h) {
    return std::sqrt((positions[mesh.target(h).idx()] - positions[mesh.source(h).idx()]).squared_length());
  };
  return laid_flat(mesh, length, v);
}

double quality(const Place2& a, const Place2& b, const Place2& c) {
  const double sides = squared(a, b) + squared(b, c) + squared(c, a);
  return sides > 0 ? 2 * std::numbers::sqrt3 * cross(a, b, c) / sides : 0;
}

double least_quality(const Star& star, const Place2& x) {
  double least = 1;
  for (std::size_t i = 0; i < star.faces(); ++i)
    least = std::min(least, quality(x, star.ends[i], star.ends[star.after(i)]));
  return least;
}

StarPoint find_in_star(const Star& star, const Place2& x) {
  const Place2 centre{0, 0};
  return best_of(star, [&](std::size_t i) -> Barycentrics {
    const Place2 &a = star.ends[i], &b = star.ends[star.after(i)];
    const double whole = cross(centre, a, b);
    if (!(whole > 0)) return {-1, 1, 1};
    const double to_a = cross(x, b, centre) / whole, to_b = cross(x, centre, a) / whole;
    return {1 - to_a - to_b, to_a, to_b};
  });
}

StarPoint find_in_star(const Mesh& mesh, const Star& star, const Point& p) {
  return best_of(star, [&](std::size_t i) -> Barycentrics {
    return plane_barycentrics({mesh.point(star.centre), mesh.point(mesh.target(star.spokes[i])),
                               mesh.point(mesh.target(star.spokes[star.after(i)]))},
                              p);
  });
}

Place2 place_in(const Star& star, const StarPoint& at) {
  const Place2 &a = star.ends[at.face], &b = star.ends[star.after(at.face)];
  return {at.weights[1] * a[0] + at.weights[2] * b[0], at.weights[1] * a[1] + at.weights[2] * b[1]};
}

Point position_in(const Mesh& mesh, const Star& star, const StarPoint& at) {
  const Point& p = mesh.point(star.centre);
  const Vector to_a = mesh.point(mesh.target(star.spokes[at.face])) - p,
               to_b = mesh.point(mesh.target(star.spokes[star.after(at.face)])) - p;
  return p + at.weights[1] * to_a + at.weights[2] * to_b;
}

}  // namespace furrow::geometry
