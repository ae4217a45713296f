// SPDX-License-Identifier: GPL-3.0-or-later
#include <rapidcheck.h>

#include <catch2/catch.hpp>
#include <limits>
#include <string>

#include "tests/io/picture/scenes.h"

namespace furrow::tests {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("render: a scene that cannot be drawn is refused") {
  const io::RenderScene good{{square({0, 0, 0}, 1, pure_red)}, {}};
  const io::RenderOptions options = from_the_front(4, 4);
  const auto refused = [&](const auto& spoil, const char* reason) {
    io::RenderScene scene = good;
    spoil(scene);
    CHECK_THROWS_AS(io::render(scene, options), std::invalid_argument);
    CHECK_THROWS_WITH(io::render(scene, options), Catch::Contains(reason));
  };
  CHECK_NOTHROW(io::render(good, options));
  refused([](auto& s) { s.meshes.clear(); }, "empty");
  refused([](auto& s) { s.meshes[0].triangles.clear(); }, "empty");
  refused([](auto& s) { s.meshes.push_back({}); }, "mesh 1 is empty");
  refused([](auto& s) { s.meshes[0].vertices[2][1] = nan; }, "mesh 0, point 2");
  refused([](auto& s) { s.meshes[0].vertices[1][0] = 1e300; }, "1e9 m");
  refused([](auto& s) { s.meshes[0].triangles[0][1] = 4; }, "vertex 4 of 4");
  refused([](auto& s) { s.meshes[0].triangles[0][1] = -1; }, "vertex -1");
  refused([](auto& s) { s.meshes[0].vertex_colours.resize(3); }, "3 colours");
  refused([](auto& s) { s.meshes[0].colour[1] = 1.5f; }, "colour");
  refused([](auto& s) { s.lines.push_back({{{0, 0, 0}, {0, nan, 0}}, pure_red}); }, "line 0, point 1");
  refused([](auto& s) { s.lines.push_back({{}, {0, float(nan), 0}}); }, "line 0: colour");
  refused([](auto& s) { s.meshes[0].vertices.assign(4, {1, 1, 1}); }, "no extent");
}

TEST_CASE("render: an option out of its range is refused by its name") {
  const io::RenderScene scene{{square({0, 0, 0}, 1, pure_red)}, {}};
  const auto refused = [&](const auto& spoil, const char* reason) {
    io::RenderOptions options = from_the_front(4, 4);
    spoil(options);
    CHECK_THROWS_AS(io::render(scene, options), std::invalid_argument);
    CHECK_THROWS_WITH(io::render(scene, options), Catch::Contains(reason));
  };
  refused([](auto& o) { o.width = 0; }, "width 0");
  refused([](auto& o) { o.height = 20000; }, "height 20000");
  refused([](auto& o) { o.threads = 0; }, "threads 0");
  refused([](auto& o) { o.line_radius_pixels = nan; }, "line_radius_pixels");
  refused([](auto& o) { o.line_radius = 0; }, "line_radius");
  refused([](auto& o) { o.line_radius = 100; }, "line_radius");
  refused([](auto& o) { o.quality = io::Quality(9); }, "quality 9");
  refused([](auto& o) { o.camera->field_of_view_deg = 170; }, "field_of_view_deg 170");
  refused([](auto& o) { o.camera->eye = o.camera->target; }, "one place");
  refused([](auto& o) { o.camera->up = {0, 0, 2}; }, "up");
  refused([](auto& o) { o.camera->up = {0, 0, 0}; }, "up");
  refused([](auto& o) { o.camera->eye[0] = nan; }, "camera: a coordinate");
  refused([](auto& o) { o.camera->eye[0] = 1e300; }, "diagonals away");
  refused([](auto& o) { o.camera.reset(), o.view.margin = 0.7; }, "margin");
}

TEST_CASE("render: a scene of nothing but degenerate triangles is an empty picture") {
  io::RenderMesh needle;
  needle.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  needle.triangles = {{0, 1, 2}};
  const io::Image image = io::render({{needle}, {}}, from_the_front(9, 4));
  for (int y = 0; y < 9; ++y) CHECK(pixel(image, 4, y) == background_pixel(y, 9));
}

TEST_CASE("render: any triangles and lines of finite points are drawn, no ray becomes NaN") {
  CHECK(rc::check([] {
    const auto coordinate =
        rc::gen::oneOf(rc::gen::element(0.0, 1.0, -1.0, 1e-12, 1e9, -1e9, 1e-300),
                       rc::gen::map(rc::gen::inRange(-999, 999), [](int i) { return i * 1e-3; }));
    const int count = *rc::gen::inRange(3, 12);
    io::RenderScene scene;
    io::RenderMesh mesh;
    mesh.style = *rc::gen::element(io::Style::cloth, io::Style::body);
    for (int i = 0; i < count; ++i) mesh.vertices.push_back({*coordinate, *coordinate, *coordinate});
    const auto corner = rc::gen::inRange(0, count);
    for (int i = 0; i < 12; ++i) mesh.triangles.push_back({*corner, *corner, *corner});
    mesh.triangles.push_back({0, 1, 2});
    scene.lines.push_back({{mesh.vertices[0], mesh.vertices[1], mesh.vertices[2]}, pure_blue});
    scene.meshes.push_back(mesh);
    io::RenderOptions options;
    options.width = options.height = 6;
    options.quality = io::Quality::draft;
    options.threads = 1;
    try {
      const io::Image image = io::render(scene, options);
      RC_ASSERT(image.rgb == io::render(scene, options).rgb);
    } catch (const std::invalid_argument& error) {
      const std::string reason = error.what();
      RC_LOG() << reason;
      RC_ASSERT(reason.find("no extent") != std::string::npos ||
                reason.find("one place") != std::string::npos);
    }
  }));
}

TEST_CASE("render: a camera inside of the scene, and lines behind it, are drawn without fault") {
  io::RenderScene scene{{sphere(1, 12)}, {}};
  scene.lines.push_back({{{0, 0, -5}, {0, 0, 5}}, pure_blue});
  scene.lines.push_back({{{0.3, 0, 0}}, pure_blue});
  scene.lines.push_back({{{0.3, 0, 0}, {0.3, 0, 0}}, pure_blue});
  io::RenderOptions options = from_the_front(16, 4);
  options.camera = io::Camera{{0.1, 0, 0}, {0.1, 0, -1}, {0, 1, 0}, 90};
  const io::Image image = io::render(scene, options);
  CHECK(pixel(image, 0, 0) != background_pixel(0, 16));
}

}  // namespace
}  // namespace furrow::tests
