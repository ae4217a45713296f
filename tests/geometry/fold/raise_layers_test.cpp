// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/raise_layers.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/self_intersections.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using Catch::Detail::Approx;

namespace {

/// A sheet of 0.4 m x 0.4 m in z = 0, and others of so many cells a side at these heights [m].
Mesh layers(const std::vector<std::pair<double, int>>& others) {
  Mesh mesh = furrow::tests::grid(40, 40, 0.4, 0.4);
  for (const auto& [z, n] : others) {
    Mesh layer = furrow::tests::grid(n, n, 0.4, 0.4);
    for (const Vertex v : layer.vertices()) layer.point(v) = layer.point(v) + Vector(0, 0, z);
    furrow::tests::append(mesh, layer);
  }
  return mesh;
}

/// The sheet's own ridge of 20 mm, 100 mm wide, along y.
Stroke ridge(double height = 0.02) {
  Stroke stroke;
  stroke.name = "ridge";
  stroke.points = {{0.2, 0.05, -0.001}, {0.2, 0.35, -0.001}};
  stroke.height = height;
  stroke.width = 0.1;
  return stroke;
}

std::size_t crossings_of(const Mesh& mesh) { return self_intersections(mesh).size(); }

}  // namespace

TEST_CASE("raise_layers: layers over a ridge go along in their order, and what lies under it stays") {
  Mesh mesh = layers({{0.003, 40}, {0.008, 40}, {-0.004, 40}});
  const Mesh before = mesh;
  REQUIRE(crossings_of(mesh) == 0);
  const WrinkleReport report = wrinkle(mesh, std::vector{ridge()});
  CHECK(crossings_of(mesh) == 0);
  double most = 0, off = 0;
  for (std::size_t i = 0; i < 41 * 41; ++i) {
    const auto moved = [&](std::size_t layer) {
      const Vertex v(Vertex::size_type(layer * 41 * 41 + i));
      CHECK(mesh.point(v).x() == Approx(before.point(v).x()).margin(1e-3));
      return mesh.point(v).z() - before.point(v).z();
    };
    most = std::max(most, moved(1));
    off = std::max(off, std::abs(moved(1) - moved(2)));
    CHECK(moved(3) == 0);
  }
  CHECK(most == Approx(0.02).epsilon(0.05));
  CHECK(off < 0.003);  // the upper one is not everywhere as near as the ridge is high
  REQUIRE(report.warnings.size() == 1);
  CHECK(report.warnings[0].find("of cloth that lies over lines are raised with them, by up to 20") !=
        std::string::npos);
}

TEST_CASE("raise_layers: a coarse layer rises until its faces clear the ridge") {
  Mesh mesh = layers({{0.004, 5}});  // edges of 80 mm over a ridge of 100
  wrinkle(mesh, std::vector{ridge()});
  CHECK(crossings_of(mesh) == 0);
}

TEST_CASE("raise_layers: a valley leaves the layers over it, and a ridge those far off") {
  for (const auto& [height, z] : {std::pair(-0.02, 0.003), std::pair(0.02, 0.061)}) {
    Mesh mesh = layers({{z, 40}});
    const Mesh before = mesh;
    CHECK(wrinkle(mesh, std::vector{ridge(height)}).warnings.empty());
    for (std::size_t i = 41 * 41; i < before.num_vertices(); ++i)
      CHECK(mesh.point(Vertex(Vertex::size_type(i))) == before.point(Vertex(Vertex::size_type(i))));
  }
}

TEST_CASE("raise_layers: held vertices stay, and an upper layer's own ridge is raised, too") {
  Mesh mesh = layers({{0.003, 40}});
  const Vertex pinned(41 * 41 + 20 * 41 + 20);
  const Point at = mesh.point(pinned);
  Stroke upper = ridge(0.01);
  upper.name = "upper";
  for (auto& p : upper.points) p = Point(p.x(), p.y(), 0.004);
  WrinkleOptions options;
  options.held = {pinned};
  wrinkle(mesh, std::vector{ridge()}, options);
  CHECK(mesh.point(pinned) == at);
  mesh = layers({{0.003, 40}});
  wrinkle(mesh, std::vector{ridge(), upper});
  CHECK(crossings_of(mesh) == 0);
  double top = 0;
  for (const Vertex v : mesh.vertices()) top = std::max(top, mesh.point(v).z());
  CHECK(top == Approx(0.033).margin(0.001));
}
