// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/stroke/place_texture_stroke.h"

#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/face_point.h"
#include "tests/geometry/stroke/point_distance.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

/// A sheet of 1 m x 1 m whose texture coordinates are given by the place and the face's middle.
Mesh textured(const std::function<TextureCoordinate(const Point&, const Point&)>& at, unsigned seed = 3) {
  Mesh mesh = jittered(16, 16, 0.2, seed);
  // The middle column of vertices is straight, so that charts can be parted there.
  for (Vertex v : mesh.vertices())
    if (std::abs(mesh.point(v).x() - 0.5) < 0.02) mesh.point(v) = Point(0.5, mesh.point(v).y(), 0);
  auto texture = ensure_map(mesh, attribute::texture);
  for (Face f : mesh.faces()) {
    const auto c = corners_of(mesh, f);
    const Point middle = CGAL::centroid(mesh.point(c[0]), mesh.point(c[1]), mesh.point(c[2]));
    for (Halfedge h : halfedges_of(mesh, f)) texture[h] = at(mesh.point(mesh.target(h)), middle);
  }
  return mesh;
}

Mesh one_chart() {
  return textured([](const Point& p, const Point&) {
    return TextureCoordinate{2 * p.x() - 3, 0.5 * p.y() + 0.1};
  });
}
/// Cut at x = 0.5: the right half lies 1 to the right in the texture.
Mesh two_charts() {
  return textured([](const Point& p, const Point& m) {
    return TextureCoordinate{m.x() < 0.5 ? p.x() : p.x() + 1, p.y()};
  });
}
/// The right half lies mirrored on the left.
Mesh mirrored() {
  return textured([](const Point& p, const Point& m) {
    return TextureCoordinate{m.x() < 0.5 ? p.x() : 1 - p.x(), p.y()};
  });
}

PlacedStroke place_in_texture(const Mesh& mesh, const std::vector<TextureCoordinate>& points,
                              bool closed = false, const TextureChoice& choice = {}) {
  return place_texture_stroke(mesh, points, closed, choice, "fold");
}
}  // namespace

TEST_CASE("place_texture_stroke: drawn in the texture, a stroke lies where the texture lies") {
  CHECK(rc::check([] {
    const Mesh mesh = one_chart();
    std::vector<Point> points;
    std::vector<TextureCoordinate> drawn;
    for (int i = *rc::gen::inRange(1, 6); i > 0; --i) {
      const double x = 0.04 + 0.92 * *rc::gen::inRange(0, 1000) / 1000.,
                   y = 0.04 + 0.92 * *rc::gen::inRange(0, 1000) / 1000.;
      points.emplace_back(x, y, 0);
      drawn.push_back({2 * x - 3, 0.5 * y + 0.1});
    }
    const PlacedStroke placed = place_in_texture(mesh, drawn);
    RC_ASSERT(placed.warnings.empty());
    RC_ASSERT(placed.breaks.empty());
    std::size_t at = 0;
    for (std::size_t i = 0; i < points.size(); ++i, ++at) {
      for (; at < placed.points.size() && distance(placed.points[at], points[i]) > 3e-5; ++at) {
        RC_ASSERT(i > 0);
        const Vector along = points[i] - points[i - 1], off = placed.points[at] - points[i - 1];
        RC_ASSERT(std::sqrt(CGAL::cross_product(along, off).squared_length() / along.squared_length()) <
                  1e-4);
      }
      RC_ASSERT(at < placed.points.size());
    }
  }));
}

TEST_CASE("place_texture_stroke: it goes on over a seam where the next point lies on the other chart") {
  const Mesh mesh = two_charts();
  const PlacedStroke placed = place_in_texture(mesh, {{0.2, 0.5}, {1.8, 0.5}});
  CHECK(placed.breaks.empty());
  CHECK(placed.warnings.empty());
  for (std::size_t i = 0; i < placed.points.size(); ++i) {
    CHECK(placed.points[i].y() == Approx(0.5).margin(1e-4));
    if (i > 0) CHECK(placed.points[i].x() > placed.points[i - 1].x());
  }
  CHECK(placed.points.size() > 16);
  // Closed over both charts and back.
  const PlacedStroke loop = place_in_texture(mesh, {{0.2, 0.3}, {1.8, 0.3}, {1.8, 0.7}, {0.2, 0.7}}, true);
  CHECK(loop.closed);
  CHECK(loop.breaks.empty());
}

TEST_CASE("place_texture_stroke: charts that no seam joins part the stroke, with a warning") {
  Mesh mesh = one_chart();
  Mesh other = grid(16, 16);
  const auto first = mesh.number_of_vertices();
  for (Vertex v : other.vertices()) other.point(v) = other.point(v) + Vector(5, 0, 0);
  append(mesh, other);
  auto texture = ensure_map(mesh, attribute::texture);
  for (Face f : mesh.faces())
    for (Halfedge h : halfedges_of(mesh, f))
      if (mesh.target(h).idx() >= first)
        texture[h] = {mesh.point(mesh.target(h)).x() - 5, mesh.point(mesh.target(h)).y()};
  const PlacedStroke placed = place_in_texture(mesh, {{-2, 0.3}, {0.5, 0.3}});
  REQUIRE(placed.breaks.size() == 1);
  REQUIRE(placed.warnings.size() == 1);
  CHECK(placed.warnings[0].find("parts it before point 1") != std::string::npos);
  CHECK(placed.points[placed.breaks[0] - 1].x() > 1.0);  // over the border of the first sheet
  CHECK(placed.points[placed.breaks[0]].x() < 5.0);      // and from beyond that of the second
  CHECK(placed.points.back().x() == Approx(5.5).margin(1e-4));
}

TEST_CASE("place_texture_stroke: of mirrored halves the choice is the lowest face, or group, or near") {
  Mesh mesh = mirrored();
  auto group = ensure_map(mesh, attribute::group);
  for (Face f : mesh.faces()) group[f] = position_of(mesh, {f, {1. / 3, 1. / 3, 1. / 3}}).x() < 0.5 ? 0 : 1;
  const std::vector<TextureCoordinate> drawn{{0.1, 0.2}, {0.4, 0.9}};
  const auto side = [&](const TextureChoice& choice) {
    return place_in_texture(mesh, drawn, false, choice).points.front().x();
  };
  const PlacedStroke plain = place_in_texture(mesh, drawn);
  CHECK(plain.points.front().x() == Approx(0.1).margin(1e-4));
  REQUIRE(plain.warnings.size() == 1);
  CHECK(plain.warnings[0].find("lies at 2 places") != std::string::npos);
  CHECK(side({1, {}}) == Approx(0.9).margin(1e-4));
  CHECK(side({0, {}}) == Approx(0.1).margin(1e-4));
  CHECK(side({{}, Point(0.95, 0.2, 0)}) == Approx(0.9).margin(1e-4));
  for (const Point& p : place_in_texture(mesh, drawn, false, {1, {}}).points) CHECK(p.x() > 0.5);
  CHECK_THROWS_WITH(side({7, {}}), Catch::Contains("no face of the stroke's group"));
}

TEST_CASE("place_texture_stroke: what lies on no chart is refused by stroke and point") {
  const Mesh mesh = one_chart();
  CHECK_THROWS_WITH(place_in_texture(mesh, {{-2, 0.3}, {7, 0.3}}),
                    Catch::StartsWith("stroke \"fold\", point 1: (7.000000, 0.300000) lies outside"));
  CHECK_THROWS_AS(place_in_texture(mesh, {{-2, NAN}}), ContentError);
  CHECK_THROWS_AS(place_in_texture(mesh, {}), ContentError);
  CHECK_THROWS_WITH(place_in_texture(grid(2, 2), {{0, 0}}), Catch::Contains("no texture coordinates"));
}
