// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/refine/bake_maps.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/tangent_frames.h"
#include "geometry/refine/apply_displacement.h"
#include "geometry/refine/subdivide.h"
#include "geometry/refine/surface_deviation.h"
#include "geometry/refine/texture_raster.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

template <class Place>
Mesh textured(Mesh mesh, const Place& place) {
  auto texture = ensure_map(mesh, attribute::texture);
  for (Halfedge h : mesh.halfedges())
    if (!mesh.is_border(h)) texture[h] = place(mesh.point(mesh.target(h)));
  return mesh;
}

/// A unit square's middle 0.8 x 0.8 of texture.
Mesh flat(int n) {
  return textured(grid(n, n), [](const Point& p) {
    return TextureCoordinate{0.1 + 0.8 * p.x(), 0.1 + 0.8 * p.y()};
  });
}

double length(const Vector& v) { return std::sqrt(v.squared_length()); }
double largest_difference(const std::array<float, 3>& a, const std::array<double, 3>& b) {
  return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

}  // namespace

TEST_CASE("bake_maps: tangent frames of a plane follow the texture, a mirrored one has the other sign") {
  for (double mirror : {1.0, -1.0}) {
    const Mesh mesh = textured(jittered(5, 5, 0.2, 2), [&](const Point& p) {
      return TextureCoordinate{mirror * (p.x() + 0.5 * p.y()), 2 * p.y()};  // sheared: u grows along x
    });
    const TangentFrames frames = tangent_frames(mesh);
    for (Face f : mesh.faces())
      for (const CornerFrame& c : frames[f.idx()]) {
        CHECK(length(c.normal - Vector(0, 0, 1)) < 1e-14);
        CHECK(length(c.tangent - Vector(mirror, 0, 0)) < 1e-14);
        CHECK(c.sign == mirror);
      }
    const InnerFrame inner = frame_inside(frames[0], {0.2, 0.3, 0.5});
    CHECK(length(inner.bitangent - Vector(0, 1, 0)) < 1e-14);  // towards growing v in both
    CHECK(length(orthonormal(inner).bitangent - Vector(0, 1, 0)) < 1e-14);
  }
}

TEST_CASE("bake_maps: tangents are not averaged over a seam, normals are") {
  Mesh mesh = flat(4);
  auto texture = *find_map(mesh, attribute::texture);
  for (Face f : mesh.faces()) {  // the right half lies turned by 90 degrees in the texture
    const Point middle = position_of(mesh, {f, {1. / 3, 1. / 3, 1. / 3}});
    if (middle.x() < 0.5) continue;
    for (Halfedge h : halfedges_of(mesh, f)) texture[h] = {texture[h][1], 2 - texture[h][0]};
  }
  lift(mesh, [](double x, double) { return 0.3 * std::abs(x - 0.5); });
  const TangentFrames frames = tangent_frames(mesh);
  for (Face f : mesh.faces()) {
    const bool right = position_of(mesh, {f, {1. / 3, 1. / 3, 1. / 3}}).x() > 0.5;
    const auto corners = corners_of(mesh, f);
    for (int i = 0; i < 3; ++i) {
      const CornerFrame& c = frames[f.idx()][i];
      CHECK(std::abs(c.normal * c.tangent) < 1e-14);
      CHECK(std::abs(length(c.tangent) - 1) < 1e-14);
      if (mesh.point(corners[i]).x() != 0.5) continue;
      CHECK(length(c.normal - Vector(0, 0, 1)) < 0.06);
      CHECK(length(c.tangent - (right ? Vector(0, 1, 0) : Vector(1, 0, 0))) < 0.06);
    }
  }
}

TEST_CASE("texture_raster: each texel's face holds its middle, overlaps and the outside are counted") {
  const Mesh mesh = flat(7);
  const TextureRaster raster = rasterize_texture(mesh, 50);
  CHECK(raster.covered == 1600);
  CHECK(raster.overlapping == 0);
  CHECK(raster.out_of_range == 0);
  const auto texture = *find_map(mesh, attribute::texture);
  for (int row = 0; row < 50; ++row)
    for (int column = 0; column < 50; ++column) {
      const int face = raster.face[row * 50 + column];
      const bool inside = row >= 5 && row < 45 && column >= 5 && column < 45;
      CHECK((face >= 0) == inside);
      if (face < 0) continue;
      const FacePoint at{Face(face),
                         texture_barycentrics(mesh, texture, Face(face), texel_middle(50, column, row))};
      const Point p = position_of(mesh, at);
      CHECK(p.x() == Approx(((column + 0.5) / 50 - 0.1) / 0.8));
      CHECK(p.y() == Approx((1 - (row + 0.5) / 50 - 0.1) / 0.8));
    }
  Mesh two = flat(2);
  append(two, grid(2, 2));
  auto all = *find_map(two, attribute::texture);
  for (Halfedge h : two.halfedges())
    all[h] = {2 * two.point(two.target(h)).x() - 0.5, two.point(two.target(h)).y()};
  const TextureRaster folded = rasterize_texture(two, 20);
  CHECK(folded.overlapping > 300);
  CHECK(folded.out_of_range == 16);
  CHECK_THROWS_AS(rasterize_texture(grid(1, 1), 8), ContentError);
  CHECK_THROWS_AS(rasterize_texture(two, 0), std::invalid_argument);
}

TEST_CASE("bake: a tilted plane over a flat one, known in every texel, beyond the border too") {
  const Mesh low = flat(3);
  Mesh high = flat(3);
  midpoint_subdivide(high, 1);
  for (Vertex v : high.vertices()) {
    const Point p = high.point(v);
    high.point(v) = {p.x() + 0.01, p.y(), 0.05 * p.x() + 0.2 * p.y()};
  }
  const auto maps = bake_maps(low, high, {40, 3});
  REQUIRE(maps);
  CHECK(maps->covered == 32 * 32);
  CHECK(maps->unmatched == 0);
  CHECK(maps->overlapping == 0);
  const double norm = std::sqrt(0.05 * 0.05 + 0.2 * 0.2 + 1);
  for (int row = 0; row < 40; ++row)
    for (int column = 0; column < 40; ++column) {
      const int outside = std::max({4 - row, row - 35, 4 - column, column - 35});
      const auto &d = maps->displacement.texels[row * 40 + column],
                 &n = maps->normal.texels[row * 40 + column];
      const TextureCoordinate uv = texel_middle(40, column, row);
      const double x = (uv[0] - 0.1) / 0.8, y = (uv[1] - 0.1) / 0.8;
      if (outside <= 1) CHECK(largest_difference(d, {0.01, 0, 0.05 * x + 0.2 * y}) < 1e-7);
      if (outside <= 3) CHECK(largest_difference(n, {-0.05 / norm, -0.2 / norm, 1 / norm}) < 1e-6);
      if (outside > 3) CHECK(d == std::array<float, 3>{0, 0, 0});
    }
}

TEST_CASE("bake_maps: a curved mesh with a seam comes back by its map, frames and all") {
  // A tube with its seam at angle 0; the high one has bulges in all three directions.
  const auto tube = [] {
    Mesh mesh = cylinder(0.2, 0.8, 20, 16);
    auto texture = ensure_map(mesh, attribute::texture);
    for (Face f : mesh.faces()) {
      const Point middle = position_of(mesh, {f, {1. / 3, 1. / 3, 1. / 3}});
      const double from = std::atan2(middle.z(), middle.x());
      for (Halfedge h : halfedges_of(mesh, f)) {
        const Point& p = mesh.point(mesh.target(h));
        double angle = std::atan2(p.z(), p.x());
        if (angle - from > std::numbers::pi) angle -= 2 * std::numbers::pi;
        if (from - angle > std::numbers::pi) angle += 2 * std::numbers::pi;
        texture[h] = {0.5 - 0.9 * angle / (2 * std::numbers::pi), 0.05 + 0.9 * p.y() / 0.8};
      }
    }
    return mesh;
  };
  const Mesh low = tube();
  Mesh high = tube();
  midpoint_subdivide(high, 1);
  for (Vertex v : high.vertices()) {
    const Point p = high.point(v);
    const double wave = 0.02 * std::sin(9 * p.y()) * std::cos(3 * std::atan2(p.z(), p.x()));
    high.point(v) = {p.x() * (1 + 5 * wave) + 0.5 * wave, p.y() + wave, p.z() * (1 + 5 * wave)};
  }
  SurfaceDeviation last{1, 1, 1, 0};
  for (int size : {64, 256}) {
    const auto maps = bake_maps(low, high, {size, 4});
    REQUIRE(maps);
    CHECK(maps->overlapping == 0);
    CHECK(maps->unmatched == 0);
    Mesh applied = low;
    apply_displacement(applied, maps->displacement, 1);
    CHECK(applied.number_of_vertices() == high.number_of_vertices());
    double worst = 0;
    for (Vertex v : applied.vertices())
      worst = std::max(worst, CGAL::squared_distance(applied.point(v), high.point(v)));
    CHECK(std::sqrt(worst) < 0.15 / size);  // of up to 30 mm; the error is at the kinks between faces
    const SurfaceDeviation deviation = surface_deviation(applied, high);
    CHECK(deviation.median < last.median);
    last = deviation;
  }
  CHECK(last.median < 6e-5);
  CHECK(surface_deviation(low, high).median > 2e-3);
}

TEST_CASE("bake: stopped, refused") {
  const Mesh low = flat(2), high = flat(4);
  int calls = 0;
  CHECK_FALSE(bake_maps(low, high, {128, 8}, [&](double share) {
    CHECK(share >= 0);
    CHECK(share <= 1);
    return ++calls < 5;
  }));
  CHECK(calls == 5);
  CHECK_THROWS_AS(bake_maps(low, high, {0, 0}), std::invalid_argument);
  CHECK_THROWS_AS(bake_maps(low, high, {8, -1}), std::invalid_argument);
  CHECK_THROWS_WITH(bake_maps(grid(2, 2), high, {8, 1}), Catch::Contains("low mesh has no texture"));
  const auto far = [](const Point& p) { return TextureCoordinate{p.x() + 3, p.y()}; };
  CHECK_THROWS_WITH(bake_maps(textured(grid(2, 2), far), high, {8, 1}), Catch::Contains("unit square"));
  const auto small = [](const Point& p) { return TextureCoordinate{0.1 * p.x(), 0.1 * p.y()}; };
  CHECK_THROWS_WITH(bake_maps(low, textured(grid(2, 2), small), {64, 1}), Catch::Contains("less than half"));
  Mesh mesh = low;
  CHECK_THROWS_AS(apply_displacement(mesh, {4, {}}, 1), std::invalid_argument);
  Mesh plain = grid(2, 2);
  CHECK_THROWS_AS(apply_displacement(plain, {1, {{0, 0, 0}}}, 1), ContentError);
  CHECK(mesh.number_of_vertices() == 9);
}

TEST_CASE("surface_deviation: that of parallel squares is their distance, by area") {
  const Mesh square = grid(10, 10);
  Mesh step = grid(10, 10);
  lift(step, [](double, double) { return 0.25; });
  const SurfaceDeviation even = surface_deviation(square, step);
  CHECK(even.median == Approx(0.25));
  CHECK(even.largest == Approx(0.25));
  CHECK(even.area == Approx(1));
  CHECK(surface_deviation(square, square).largest < 1e-15);
  Mesh corner = grid(10, 10);  // a tenth lies higher
  lift(corner, [](double x, double) { return x > 0.95 ? 0.3 : 0.0; });
  const SurfaceDeviation part = surface_deviation(corner, square);
  CHECK(part.median < 1e-15);
  CHECK(part.p95 > 0.1);
  const std::vector<Face> one{Face(0)};
  CHECK(surface_deviation(corner, square, one).area == Approx(0.005));
  CHECK_THROWS_AS(surface_deviation(Mesh(), square), ContentError);
}
