// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/triangulate_polygon.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/mesh/errors.h"

using namespace furrow;
using geometry::Point;
using Triangles = std::vector<std::array<std::size_t, 3>>;

namespace {

Triangles cut(const std::vector<Point>& polygon) {
  Triangles out;
  io::triangulate_polygon(polygon, out);
  return out;
}

double signed_area(const Point& a, const Point& b, const Point& c) {
  return ((b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y())) / 2;
}

double area(const std::vector<Point>& p) {
  double sum = 0;
  for (std::size_t i = 2; i < p.size(); ++i) sum += signed_area(p[0], p[i - 1], p[i]);
  return sum;
}

}  // namespace

TEST_CASE("triangulate_polygon: quads are cut at the first corner, also concave ones") {
  CHECK(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) == Triangles{{0, 1, 2}, {0, 2, 3}});
  CHECK(cut({{2, 0, 0}, {0, 1, 0}, {0.5, 0, 0}, {0, -1, 0}}) == Triangles{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("triangulate_polygon: convex polygons become fans") {
  std::vector<Point> hexagon;
  for (int i = 0; i < 6; ++i)
    hexagon.emplace_back(std::cos(i * std::numbers::pi / 3), 0, -std::sin(i * std::numbers::pi / 3));
  CHECK(cut(hexagon) == Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}});
}

TEST_CASE("triangulate_polygon: an L is covered once, every triangle turned like the polygon") {
  const std::vector<Point> l = {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}};
  for (std::size_t shift = 0; shift < 6; ++shift) {
    std::vector<Point> p = l;
    std::rotate(p.begin(), p.begin() + static_cast<long>(shift), p.end());
    double sum = 0;
    for (const auto& [a, b, c] : cut(p)) {
      CHECK(signed_area(p[a], p[b], p[c]) > 0);
      sum += signed_area(p[a], p[b], p[c]);
    }
    CHECK(sum == Approx(5).epsilon(1e-14));
  }
}

TEST_CASE("triangulate_polygon: star-shaped polygons in any plane are covered once") {
  CHECK(rc::check([](const std::vector<unsigned char>& radii) {
    RC_PRE(radii.size() >= 5 && radii.size() <= 60);
    std::vector<Point> flat, tilted;
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(radii.size());
      const double r = 1 + radii[i] / 32.0;
      flat.emplace_back(r * std::cos(angle), r * std::sin(angle), 0);
      tilted.emplace_back(0.36 * flat[i].x() + 0.8 * flat[i].y(), 0.48 * flat[i].x() - 0.6 * flat[i].y(),
                          0.8 * flat[i].x());
    }
    double sum = 0;
    const Triangles triangles = cut(tilted);
    RC_ASSERT(triangles.size() == radii.size() - 2);
    for (const auto& [a, b, c] : triangles) {
      RC_ASSERT(signed_area(flat[a], flat[b], flat[c]) > -1e-12);
      sum += signed_area(flat[a], flat[b], flat[c]);
    }
    RC_ASSERT(std::abs(sum - area(flat)) < 1e-10);
  }));
}

TEST_CASE("triangulate_polygon: flat, crossing and huge polygons end") {
  CHECK(cut(std::vector<Point>(7, Point(1, 2, 3))).size() == 5);
  std::vector<Point> pentagram;
  for (int i = 0; i < 5; ++i)
    pentagram.emplace_back(std::cos(i * 0.8 * std::numbers::pi), std::sin(i * 0.8 * std::numbers::pi), 0);
  CHECK(cut(pentagram).size() == 3);
  std::vector<Point> zigzag;
  for (int i = 0; i < 2000; ++i) zigzag.emplace_back(i, i % 2 ? 2 : 0, 0);
  CHECK(cut(zigzag).size() == 1998);
  zigzag.resize(io::most_concave_corners + 1, Point(0, -1, 0));
  CHECK_THROWS_AS(cut(zigzag), geometry::ContentError);
}
