// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/figure/horizontal_section.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <unordered_map>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/preconditions.h"
#include "physics/base/cancel_scope.h"

namespace furrow::geometry {
namespace {

using EdgeKey = std::uint64_t;

EdgeKey key_of(int a, int b) {
  return (static_cast<EdgeKey>(std::min(a, b)) << 32) | static_cast<EdgeKey>(std::max(a, b));
}

/// A triangle's part of the section: from the edge that goes down through the plane to the one that comes up.
struct Piece {
  EdgeKey from, to;
  int triangle;
};

std::vector<Piece> cut(std::span<const Point> points, std::span<const std::array<int, 3>> triangles,
                       double height) {
  std::vector<Piece> pieces;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<bool, 3> above{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int v = triangles[t][k];
      if (v < 0 || static_cast<std::size_t>(v) >= points.size())
        refuse("horizontal_section", "triangle " + std::to_string(t) + " has corner " + std::to_string(v) +
                                         " of " + std::to_string(points.size()) + " points");
      above[k] = points[static_cast<std::size_t>(v)].y() >= height;
    }
    if (above[0] == above[1] && above[1] == above[2]) continue;
    Piece piece{0, 0, static_cast<int>(t)};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t n = (k + 1) % 3;
      if (above[k] != above[n]) (above[k] ? piece.from : piece.to) = key_of(triangles[t][k], triangles[t][n]);
    }
    pieces.push_back(piece);
  }
  return pieces;
}

SectionPoint point_on(EdgeKey key, std::span<const Point> points, double height) {
  SectionPoint p;
  p.a = static_cast<int>(key >> 32);
  p.b = static_cast<int>(key & 0xffffffffu);
  const Point &a = points[static_cast<std::size_t>(p.a)], &b = points[static_cast<std::size_t>(p.b)];
  p.share = std::clamp((height - a.y()) / (b.y() - a.y()), 0.0, 1.0);
  p.x = a.x() + p.share * (b.x() - a.x());
  p.z = a.z() + p.share * (b.z() - a.z());
  return p;
}

double length_of(const SectionLoop& loop) {
  double length = 0;
  const std::size_t n = loop.points.size();
  for (std::size_t i = 0; i < loop.triangles.size(); ++i) {
    const SectionPoint &p = loop.points[i], &q = loop.points[(i + 1) % n];
    length += std::hypot(q.x - p.x, q.z - p.z);
  }
  return length;
}

/// Cross products of neighbouring points, relative to the first so that no digits are lost far away; seen
/// from above, x to the right and z towards the viewer, counter-clockwise is negative in (x, z).
template <class Visit>
void for_each_wedge(const SectionLoop& loop, const Visit& visit) {
  const std::size_t n = loop.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const SectionPoint &o = loop.points[0], &p = loop.points[i], &q = loop.points[(i + 1) % n];
    visit(p.x - o.x, p.z - o.z, q.x - o.x, q.z - o.z);
  }
}

}  // namespace

std::vector<SectionLoop> horizontal_section(std::span<const Point> points,
                                            std::span<const std::array<int, 3>> triangles, double height) {
  if (!std::isfinite(height))
    refuse("horizontal_section", "height = " + std::to_string(height) + " is not finite");
  physics::throw_if_cancelled("horizontal_section");
  const std::vector<Piece> pieces = cut(points, triangles, height);
  std::unordered_map<EdgeKey, std::size_t> starting, ending;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (!starting.emplace(pieces[i].from, i).second || !ending.emplace(pieces[i].to, i).second)
      throw ContentError("horizontal_section: triangle " + std::to_string(pieces[i].triangle) +
                         " is not wound as its neighbours, or shares an edge with two of them");
  std::vector<SectionLoop> loops;
  std::vector<char> seen(pieces.size(), 0);
  const auto walk = [&](std::size_t first, bool closed) {
    SectionLoop& loop = loops.emplace_back();
    loop.closed = closed;
    for (std::size_t i = first; !seen[i];) {
      seen[i] = 1;
      loop.points.push_back(point_on(pieces[i].from, points, height));
      loop.triangles.push_back(pieces[i].triangle);
      const auto next = starting.find(pieces[i].to);
      if (next == starting.end()) loop.points.push_back(point_on(pieces[i].to, points, height));
      if (next != starting.end()) i = next->second;
    }
    loop.length = length_of(loop);
  };
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (!ending.count(pieces[i].from)) walk(i, false);
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (!seen[i]) walk(i, true);
  std::stable_sort(loops.begin(), loops.end(), [](const SectionLoop& a, const SectionLoop& b) {
    return a.length != b.length ? a.length > b.length : a.triangles.front() < b.triangles.front();
  });
  return loops;
}

namespace {

/// The corners of the convex hull in the plane, all the way round: the first is repeated at the end.
std::vector<std::array<double, 2>> hull_of(const SectionLoop& loop) {
  std::vector<std::array<double, 2>> p;
  for (const SectionPoint& q : loop.points) p.push_back({q.x, q.z});
  std::sort(p.begin(), p.end());
  // The hull's lower chain from left to right, then the upper one back (A. M. Andrew 1979).
  std::vector<std::array<double, 2>> hull;
  const auto add = [&](const std::array<double, 2>& q, std::size_t keep) {
    const auto left_turn = [&] {
      const auto &a = hull[hull.size() - 2], &b = hull.back();
      return (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]) > 0;
    };
    while (hull.size() >= keep + 2 && !left_turn()) hull.pop_back();
    hull.push_back(q);
  };
  for (const auto& q : p) add(q, 0);
  const std::size_t lower = hull.empty() ? 0 : hull.size() - 1;
  for (std::size_t i = p.size(); i-- > 0;) add(p[i], lower);
  return hull;
}

}  // namespace

double tape_measure(const SectionLoop& loop) {
  const auto hull = hull_of(loop);
  double perimeter = 0;
  for (std::size_t i = 1; i < hull.size(); ++i)
    perimeter += std::hypot(hull[i][0] - hull[i - 1][0], hull[i][1] - hull[i - 1][1]);
  return perimeter;
}

double breadth(const SectionLoop& loop) {
  const auto hull = hull_of(loop);
  const std::size_t n = hull.size() < 2 ? hull.size() : hull.size() - 1;
  const auto apart = [&](std::size_t i, std::size_t j) {
    return std::hypot(hull[i][0] - hull[j][0], hull[i][1] - hull[j][1]);
  };
  const auto above = [&](std::size_t i, std::size_t j) {  // the side from corner i to the next [m^2]
    const std::array<double, 2>&a = hull[i], &b = hull[i + 1], &q = hull[j];
    return (b[0] - a[0]) * (q[1] - a[1]) - (b[1] - a[1]) * (q[0] - a[0]);
  };
  double longest = n == 2 ? apart(0, 1) : 0;
  // Farthest corners lie opposite each other: j goes round once while i does (rotating calipers; Shamos
  // 1978).
  for (std::size_t i = 0, j = 1; n > 2 && i < n; ++i) {
    longest = std::max({longest, apart(i, j), apart((i + 1) % n, j)});
    for (std::size_t turns = 0; turns < n && above(i, (j + 1) % n) > above(i, j); ++turns) {
      j = (j + 1) % n;
      longest = std::max({longest, apart(i, j), apart((i + 1) % n, j)});
    }
  }
  return longest;
}

bool encloses(const SectionLoop& loop, double x, double z) {
  bool inside = false;
  const std::size_t n = loop.points.size();
  for (std::size_t i = 0; loop.closed && i < n; ++i) {
    const SectionPoint &p = loop.points[i], &q = loop.points[(i + 1) % n];
    if ((p.z > z) != (q.z > z) && x < p.x + (z - p.z) * (q.x - p.x) / (q.z - p.z)) inside = !inside;
  }
  return inside;
}

double enclosed_area(const SectionLoop& loop) {
  double area = 0;
  for_each_wedge(loop, [&](double px, double pz, double qx, double qz) { area -= (px * qz - pz * qx) / 2; });
  return loop.closed ? area : 0;
}

std::array<double, 2> centre_of(const SectionLoop& loop) {
  if (loop.points.empty()) refuse("centre_of", "the curve has no points");
  double doubled = 0, x = 0, z = 0, mean_x = 0, mean_z = 0;
  for_each_wedge(loop, [&](double px, double pz, double qx, double qz) {
    const double wedge = px * qz - pz * qx;
    doubled += wedge;
    x += wedge * (px + qx) / 3;
    z += wedge * (pz + qz) / 3;
    mean_x += px;
    mean_z += pz;
  });
  const double n = static_cast<double>(loop.points.size());
  const bool has_area = std::abs(doubled) > 1e-9 * loop.length * loop.length;
  const SectionPoint& o = loop.points[0];
  return {o.x + (has_area ? x / doubled : mean_x / n), o.z + (has_area ? z / doubled : mean_z / n)};
}

}  // namespace furrow::geometry
