// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_weave.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>

#include "geometry/rest/warp_directions.h"
#include "io/picture/render_scene.h"

namespace furrow::io {
namespace {

using geometry::Face, geometry::Mesh, geometry::Point, geometry::Vector;

struct WeavePoint {
  Face face;
  Point at;
  std::uint64_t order;  ///< points are tried in this order, so that none is taken by rows
};

std::uint64_t mixed(std::uint64_t x) {  // splitmix64
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Points of a lattice in each face, finer than half the spacing.
std::vector<WeavePoint> candidates(const Mesh& mesh, double spacing) {
  std::vector<WeavePoint> points;
  for (const Face f : mesh.faces()) {
    const auto h = mesh.halfedge(f);
    const Point& a = mesh.point(mesh.source(h));
    const Vector b = mesh.point(mesh.target(h)) - a, c = mesh.point(mesh.target(mesh.next(h))) - a;
    const double longest =
        std::sqrt(std::max({b.squared_length(), c.squared_length(), (b - c).squared_length()}));
    const int n = std::clamp(int(std::ceil(3 * longest / spacing)), 1, 400);
    for (int i = 0; i < n; ++i)
      for (int j = 0; i + j < n; ++j) {
        const double u = (i + 1. / 3) / n, v = (j + 1. / 3) / n;
        points.push_back({f, a + u * b + v * c, mixed(points.size())});
      }
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const WeavePoint& p, const WeavePoint& q) { return p.order < q.order; });
  return points;
}

/// Those that keep the spacing from the ones taken before.
std::vector<WeavePoint> apart(const std::vector<WeavePoint>& points, double spacing) {
  std::map<std::array<int, 3>, std::vector<Point>> cells;
  std::vector<WeavePoint> taken;
  const auto cell_of = [&](const Point& p) {
    return std::array{int(std::floor(p.x() / spacing)), int(std::floor(p.y() / spacing)),
                      int(std::floor(p.z() / spacing))};
  };
  const auto is_free = [&](const Point& p) {
    const auto c = cell_of(p);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (const auto found = cells.find({c[0] + i, c[1] + j, c[2] + k}); found != cells.end())
            for (const Point& q : found->second)
              if ((p - q).squared_length() < spacing * spacing) return false;
    return true;
  };
  for (const WeavePoint& p : points)
    if (is_free(p.at)) {
      cells[cell_of(p.at)].push_back(p.at);
      taken.push_back(p);
    }
  return taken;
}

}  // namespace

std::vector<RenderLine> weave_lines_from(const Mesh& mesh, double spacing) {
  if (!(spacing > 0)) throw std::invalid_argument("weave_lines_from: spacing must be > 0");
  std::vector<RenderLine> lines;
  for (const WeavePoint& p : apart(candidates(mesh, spacing), spacing)) {
    const geometry::Threading threads = geometry::threading_of(mesh, p.face);
    if (threads.warp == Vector(0, 0, 0)) continue;
    const auto add = [&](const Vector& along, double length, const Colour& colour) {
      lines.push_back(
          {{position_of(p.at - length / 2 * along), position_of(p.at + length / 2 * along)}, colour, 0.7});
    };
    add(threads.weft, 0.35 * spacing, weft_colour);
    add(threads.warp, 0.7 * spacing, warp_colour);
  }
  return lines;
}

double weave_spacing(const Mesh& mesh) {
  Point low(1e300, 1e300, 1e300), high(-1e300, -1e300, -1e300);
  for (const geometry::Vertex v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    low = Point(std::min(low.x(), p.x()), std::min(low.y(), p.y()), std::min(low.z(), p.z()));
    high = Point(std::max(high.x(), p.x()), std::max(high.y(), p.y()), std::max(high.z(), p.z()));
  }
  return std::max(1e-6, std::sqrt((high - low).squared_length()) / 40);
}

}  // namespace furrow::io
