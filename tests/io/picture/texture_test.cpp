// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <limits>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "io/picture/checker_texture.h"
#include "io/picture/render_scene.h"
#include "tests/io/picture/scenes.h"
#include "tests/test_meshes.h"

namespace furrow::tests {
namespace {

/// 64 x 64 pixels: red above left, green above right, blue below.
std::shared_ptr<const io::Image> quarters() {
  io::Image image{64, 64, {}};
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) {
      const bool top = row < 32, left = column < 32;
      for (bool on : {top && left, top && !left, !top}) image.rgb.push_back(on ? 230 : 25);
    }
  return std::make_shared<io::Image>(std::move(image));
}

/// A square of half side 1 that shows the whole texture upright.
io::RenderScene shown(const std::array<double, 2>& offset = {0, 0}) {
  io::RenderMesh mesh = square({0, 0, 0}, 1, io::Colour{0.5f, 0.5f, 0.5f});
  mesh.texture = quarters();
  for (const auto& t : mesh.triangles) {
    std::array<std::array<double, 2>, 3> corners;
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 2; ++k) corners[i][k] = (mesh.vertices[t[i]][k] + 1) / 2 + offset[k];
    mesh.texture_coordinates.push_back(corners);
  }
  return {{mesh}, {}};
}

}  // namespace

TEST_CASE("texture: a texture lies on the mesh as its coordinates say, v upwards, and repeats") {
  for (const std::array<double, 2> offset : {std::array{0., 0.}, std::array{-3., 7.}}) {
    const io::Image image = io::render(shown(offset), from_the_front(80, 5));
    CHECK(is_reddish(pixel(image, 30, 30)));
    CHECK(is_greenish(pixel(image, 50, 30)));
    CHECK(is_bluish(pixel(image, 30, 50)));
    CHECK(is_bluish(pixel(image, 50, 50)));
  }
}

TEST_CASE(
    "texture: a triangle without coordinates keeps the mesh's colour, degenerate ones take none along") {
  io::RenderScene scene = shown();
  io::RenderMesh& mesh = scene.meshes[0];
  mesh.texture_coordinates[1][2][0] = std::numeric_limits<double>::quiet_NaN();  // the upper left triangle
  mesh.triangles.insert(mesh.triangles.begin(), {0, 0, 1});
  mesh.texture_coordinates.insert(mesh.texture_coordinates.begin(), mesh.texture_coordinates[0]);
  const io::Image image = io::render(scene, from_the_front(80, 5));
  const auto grey = pixel(image, 28, 28);
  CHECK(std::abs(grey[0] - grey[2]) < 12);
  CHECK(is_greenish(pixel(image, 54, 34)));
  CHECK(is_bluish(pixel(image, 50, 54)));
}

TEST_CASE("texture: a mesh's coordinates go by its corners, so a seam is sharp") {
  geometry::Mesh mesh = tests::grid(2, 2, 2, 2);
  auto texture = geometry::ensure_map(mesh, geometry::attribute::texture);
  for (auto& p : mesh.points()) p = geometry::Point(p.x() - 1, p.y() - 1, 0);
  for (geometry::Face f : mesh.faces()) {
    double x = 0;
    for (auto v : mesh.vertices_around_face(mesh.halfedge(f))) x += mesh.point(v).x();
    for (auto h : mesh.halfedges_around_face(mesh.halfedge(f)))
      texture[h] = {x < 0 ? 0.2 : 0.8, 0.8};  // all red to the left, all green to the right
  }
  io::RenderMesh drawn = io::render_mesh_from(mesh, io::Style::body, quarters());
  REQUIRE(drawn.texture_coordinates.size() == 8);
  const io::Image image = io::render({{drawn}, {}}, from_the_front(80, 5));
  for (int row : {25, 40, 55}) {
    CHECK(is_reddish(pixel(image, 37, row)));
    CHECK(is_greenish(pixel(image, 42, row)));
  }
  CHECK_THROWS_AS(io::render_mesh_from(tests::grid(1, 1), io::Style::cloth, quarters()),
                  geometry::ContentError);
}

TEST_CASE("texture: a texture that does not fit is refused") {
  io::RenderScene scene = shown();
  scene.meshes[0].texture_coordinates.pop_back();
  CHECK_THROWS_AS(io::render(scene, from_the_front(8, 5)), std::invalid_argument);
  scene = shown();
  scene.meshes[0].texture = std::make_shared<io::Image>(io::Image{2, 2, {1, 2, 3}});
  CHECK_THROWS_AS(io::render(scene, from_the_front(8, 5)), std::invalid_argument);
}

TEST_CASE("texture: the checker's squares differ from their neighbours and carry a dark label") {
  const io::Image image = io::checker_texture(400, 10);
  REQUIRE(image.rgb.size() == 3u * 400 * 400);
  const auto brightness = [&](int column, int row) {
    const auto p = pixel(image, column, row);
    return p[0] + p[1] + p[2];
  };
  for (int i = 0; i < 10; ++i)
    for (int j = 0; j < 10; ++j) {
      const int here = brightness(40 * i + 4, 40 * j + 4);
      if (i < 9) CHECK(std::abs(here - brightness(40 * i + 44, 40 * j + 4)) > 100);
      int dark = 0;
      for (int x = 8; x < 32; ++x)
        for (int y = 12; y < 28; ++y) dark += brightness(40 * i + x, 40 * j + y) < 200;
      CHECK(dark > 5);
    }
  CHECK_THROWS_AS(io::checker_texture(100, 26), std::invalid_argument);
  CHECK_THROWS_AS(io::checker_texture(400, 0), std::invalid_argument);
}

}  // namespace furrow::tests
