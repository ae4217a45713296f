// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "geometry/stroke/place_view_stroke.h"
#include "tests/io/picture/scenes.h"

namespace furrow::tests {
namespace {

double luminance(const std::array<int, 3>& p) { return 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2]; }

/// A sheet that faces the camera, with waves along x of the given amplitude and length [m].
io::RenderMesh waves(double amplitude, double length) {
  return grid(20, 100, [&](double u, double v) {
    return io::Position{u - 0.5, v - 0.5, amplitude * std::sin(2 * std::numbers::pi * u / length)};
  });
}

/// Standard deviation of the luminance in the middle of a picture.
double contrast(const io::Image& image) {
  double sum = 0, sum2 = 0;
  int count = 0;
  for (int y = image.height / 4; y < 3 * image.height / 4; ++y) {
    for (int x = image.width / 4; x < 3 * image.width / 4; ++x, ++count) {
      const double l = luminance(pixel(image, x, y));
      sum += l;
      sum2 += l * l;
    }
  }
  return std::sqrt(std::max(0.0, sum2 / count - sum / count * (sum / count)));
}

TEST_CASE("render: the silhouette of a sphere has the area of its cone of sight") {
  const double radius = 1, distance = 5;
  const io::RenderOptions options = from_the_front(300, distance);
  const io::Image image = io::render({{sphere(radius)}, {}}, options);
  int seen = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) seen += pixel(image, x, y) != background_pixel(y, image.height);
  }
  const double edge =
      radius / std::sqrt(distance * distance - radius * radius) / std::tan(15 * std::numbers::pi / 180);
  // A pixel counts as seen if only its border is: half a pixel more all around, within the 1 % asked for.
  const double expected = std::numbers::pi * std::pow(edge * image.height / 2 + 0.5, 2);
  CHECK(seen == Approx(expected).epsilon(0.01));
}

TEST_CASE("render: the corners of a picture have the colour of the background") {
  const io::Image image = io::render({{sphere(1)}, {}}, from_the_front(64, 6));
  CHECK(image.width == 64);
  CHECK(image.rgb.size() == 3u * 64 * 64);
  for (int x : {0, 63}) {
    for (int y : {0, 63}) CHECK(pixel(image, x, y) == background_pixel(y, 64));
  }
  CHECK(io::background_colour(0, 64)[0] > io::background_colour(63, 64)[0]);
}

TEST_CASE("render: the nearer of two surfaces is seen, in whatever order they come") {
  const io::RenderMesh near = square({0, 0, 0.5}, 0.3, pure_red), far = square({0, 0, 0}, 0.6, pure_green);
  const io::Image a = io::render({{near, far}, {}}, from_the_front(61, 4));
  const io::Image b = io::render({{far, near}, {}}, from_the_front(61, 4));
  CHECK(is_reddish(pixel(a, 30, 30)));
  CHECK(is_greenish(pixel(a, 30, 44)));
  CHECK(is_reddish(pixel(b, 30, 30)));
  CHECK(is_greenish(pixel(b, 30, 44)));
}

TEST_CASE("render: right is right and up is up") {
  const io::RenderScene scene{{square({0.5, 0, 0}, 0.2, pure_red), square({0, 0.5, 0}, 0.2, pure_green)}, {}};
  const io::Image image = io::render(scene, from_the_front(60, 4));
  const int off = int(0.5 / (4 * std::tan(15 * std::numbers::pi / 180)) * 30);
  CHECK(is_reddish(pixel(image, 30 + off, 30)));
  CHECK(is_greenish(pixel(image, 30, 30 - off)));
  CHECK(pixel(image, 30 - off, 30) == background_pixel(30, 60));
  CHECK(pixel(image, 30, 30 + off) == background_pixel(30 + off, 60));
}

TEST_CASE("render: a wide picture does not stretch what it shows") {
  io::RenderOptions options = from_the_front(60, 4);
  const io::Image tall = io::render({{square({0, 0, 0}, 0.5, pure_red)}, {}}, options);
  options.width = 100;
  const io::Image wide = io::render({{square({0, 0, 0}, 0.5, pure_red)}, {}}, options);
  int same = 0;
  for (int x = 0; x < 60; ++x) {
    same += (pixel(tall, x, 30) == background_pixel(30, 60)) ==
            (pixel(wide, x + 20, 30) == background_pixel(30, 60));
  }
  CHECK(same == 60);
}

TEST_CASE(
    "render: the same picture comes from one thread and from two, and again, and in any unit of length") {
  io::RenderScene scene{{waves(0.02, 0.2), sphere(0.3, 24)}, {}};
  scene.lines.push_back({{{-0.4, -0.3, 0.3}, {0.4, 0.3, 0.3}}, pure_red});
  io::RenderOptions options;
  options.width = 90;
  options.height = 70;
  options.threads = 1;
  const io::Image one = io::render(scene, options);
  CHECK(io::render(scene, options).rgb == one.rgb);
  options.threads = 2;
  CHECK(io::render(scene, options).rgb == one.rgb);
  options.threads = 7;
  CHECK(io::render(scene, options).rgb == one.rgb);
  for (auto& mesh : scene.meshes) {
    for (auto& p : mesh.vertices) p = {1024 * p[0], 1024 * p[1], 1024 * p[2]};
  }
  options.thickness *= 1024;
  for (auto& p : scene.lines[0].points) p = {1024 * p[0], 1024 * p[1], 1024 * p[2]};
  CHECK(io::render(scene, options).rgb == one.rgb);
}

TEST_CASE("render: a line is seen on and before a surface and hidden behind it") {
  const io::RenderMesh sheet = square({0, 0, 0}, 0.5, pure_green);
  const auto middle = [&](double z, std::optional<double> radius) {
    io::RenderOptions options = from_the_front(61, 4);
    options.line_radius = radius;
    const io::RenderLine line{{{-0.9, 0, z}, {0, 0, z}, {0.9, 0, z}}, pure_blue};
    const io::Image image = io::render({{sheet}, {line}}, options);
    CHECK(is_bluish(pixel(image, 5, 30)));  // beside the sheet it is always seen
    CHECK(is_greenish(pixel(image, 30, 22)));
    return pixel(image, 30, 30);
  };
  for (const std::optional<double> radius : {std::optional<double>(), std::optional(0.04)}) {
    CHECK(is_bluish(middle(0.2, radius)));
    CHECK(is_bluish(middle(0, radius)));
    CHECK(is_greenish(middle(-0.2, radius)));
  }
}

TEST_CASE("render: a line's tube is as wide as asked for, in pixels or metres") {
  const auto rows = [](double pixels, std::optional<double> radius) {
    io::RenderOptions options = from_the_front(101, 4);
    options.line_radius_pixels = pixels;
    options.line_radius = radius;
    const io::RenderLine line{{{-0.5, 0, 0.3}, {0.5, 0, 0.3}}, pure_blue};
    const io::Image image = io::render({{square({0, 0, 0}, 0.7, pure_green)}, {line}}, options);
    int count = 0;
    for (int y = 0; y < 101; ++y) count += is_bluish(pixel(image, 50, y));
    return count;
  };
  CHECK(std::abs(rows(5, {}) - 10) <= 1);
  CHECK(std::abs(rows(10, {}) - 20) <= 1);
  const double pixel_size = 2 * 3.7 * std::tan(15 * std::numbers::pi / 180) / 101;  // at the line's depth
  CHECK(std::abs(rows(1, 8 * pixel_size) - 16) <= 1);
}

TEST_CASE("render: cloth shows its back darker, a body does not") {
  io::RenderMesh cloth = square({0, 0, 0}, 0.5, io::cloth_colour);
  const auto luminances = [&](io::Style style) {
    cloth.style = style;
    io::RenderMesh back = cloth;
    for (auto& t : back.triangles) std::swap(t[1], t[2]);
    return std::pair(luminance(pixel(io::render({{cloth}, {}}, from_the_front(31, 4)), 15, 15)),
                     luminance(pixel(io::render({{back}, {}}, from_the_front(31, 4)), 15, 15)));
  };
  const auto [cloth_front, cloth_back] = luminances(io::Style::cloth);
  CHECK(cloth_back < 0.85 * cloth_front);
  const auto [body_front, body_back] = luminances(io::Style::body);
  CHECK(body_back == Approx(body_front).margin(1));
}

TEST_CASE("render: waves of half a centimetre are seen on a sheet of a metre, a flat sheet is even",
          "[release]") {
  io::RenderOptions options = from_the_front(120, 2.5);
  options.quality = io::Quality::normal;
  const io::Image cloth = io::render({{waves(0.005, 0.1)}, {}}, options);
  CHECK(contrast(io::render({{waves(0, 0.1)}, {}}, options)) < 1);
  CHECK(contrast(cloth) > 8);

  // On cloth the ridges are painted lighter than the valleys, since no light may rake over both sides of
  // each.
  io::RenderMesh mesh = waves(0.005, 0.1);
  mesh.style = io::Style::body;
  const auto ridge_over_valley = [](const io::Image& image) {
    return luminance(pixel(image, 62, 60)) - luminance(pixel(image, 57, 60));
  };
  CHECK(ridge_over_valley(cloth) > ridge_over_valley(io::render({{mesh}, {}}, options)) + 1.5);
}

TEST_CASE("render: a wire darkens the cloth near its edges, and nothing else") {
  io::RenderScene scene{{grid(8, 8,
                              [](double u, double v) {
                                return io::Position{u - 0.5, v - 0.5, 0.1 * u * v};
                              })},
                        {}};
  io::RenderOptions options = from_the_front(200, 2.5);
  const io::Image plain = io::render(scene, options);
  options.wire_pixels = 0.6;
  options.threads = 2;
  const io::Image wired = io::render(scene, options);
  options.threads = 5;
  CHECK(io::render(scene, options).rgb == wired.rgb);
  // A row of squares is 200 / (2 * 2.5 * tan(15 degrees)) / 8 = 19 pixels high.
  int darker = 0, same = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const double before = luminance(pixel(plain, x, y)), after = luminance(pixel(wired, x, y));
      REQUIRE(after <= before);
      darker += after < 0.9 * before;
      same += pixel(plain, x, y) == pixel(wired, x, y);
    }
  CHECK(darker > 2000);
  CHECK(same > 200 * 200 / 4);
  scene.meshes[0].style = io::Style::body;
  const io::Image body = io::render(scene, options);
  options.wire_pixels = 0;
  CHECK(io::render(scene, options).rgb == body.rgb);
}

TEST_CASE("render: cloth that nothing shades has no grain, at any quality") {
  const io::RenderScene scene{{square({0, 0, 0}, 0.9, io::cloth_colour)}, {}};
  for (const io::Quality quality : {io::Quality::draft, io::Quality::normal, io::Quality::fine}) {
    io::RenderOptions options = from_the_front(60, 4);
    options.quality = quality;
    CHECK(contrast(io::render(scene, options)) < 0.1);
  }
}

TEST_CASE("render: the key light's shadow has a soft edge from normal quality on", "[release]") {
  io::RenderScene scene{
      {square({0, 0, 0}, 1, io::body_colour), square({-0.15, 0.1, 0.05}, 0.2, io::body_colour)}, {}};
  const auto width_of_edge = [&](io::Quality quality) {  // pixels between dark and light, right of the shadow
    io::RenderOptions options = from_the_front(200, 4);
    options.quality = quality;
    const io::Image image = io::render(scene, options);
    std::vector<double> means;  // over rows, so that the grain of a draft does not count
    for (int x = 107; x < 190; ++x) {
      double sum = 0;
      for (int y = 90; y <= 110; ++y) sum += luminance(pixel(image, x, y)) / 21;
      means.push_back(sum);
    }
    const double lightest = *std::max_element(means.begin(), means.end());
    REQUIRE(*std::min_element(means.begin(), means.end()) < 0.7 * lightest);
    const auto between = std::count_if(means.begin(), means.end(),
                                       [&](double l) { return l > 0.75 * lightest && l < 0.97 * lightest; });
    return between;
  };
  CHECK(width_of_edge(io::Quality::normal) > 1.5 * width_of_edge(io::Quality::draft));
}

TEST_CASE("render: what lies close over a surface shades it") {
  const io::RenderMesh floor = grid(4, 4, [](double u, double v) {
    return io::Position{4 * u - 2, 0, 2 - 4 * v};
  });
  io::RenderMesh ball = sphere(0.3, 24);
  for (auto& p : ball.vertices) p[1] += 0.31;
  io::RenderOptions options = from_the_front(81, 4);
  options.quality = io::Quality::normal;  // four rays to the sky could miss the ball
  options.camera = io::Camera{{0, 2, 4}, {0, 0, 0}, {0, 1, 0}, 30};
  const io::Image alone = io::render({{floor}, {}}, options), with = io::render({{floor, ball}, {}}, options);
  const auto shaded = [&](int x, int y) {
    return luminance(pixel(with, x, y)) / luminance(pixel(alone, x, y));
  };
  CHECK(shaded(57, 40) < 0.75);  // right of the ball: it hides the key light
  CHECK(shaded(29, 40) < 0.97);  // left of it: it hides a part of the sky
  CHECK(shaded(10, 40) == Approx(1).margin(0.01));
}

TEST_CASE("render: degenerate triangles and vertices of no triangle change nothing") {
  const io::RenderMesh plain = square({0, 0, 0}, 0.5, pure_red);
  io::RenderMesh bad = plain;
  bad.triangles.push_back({0, 0, 1});
  bad.triangles.push_back({2, 2, 2});
  bad.vertices.push_back({70, 80, 90});
  io::RenderOptions options = from_the_front(40, 4);
  CHECK(io::render({{bad}, {}}, options).rgb == io::render({{plain}, {}}, options).rgb);
  options.camera.reset();
  CHECK(io::render({{bad}, {}}, options).rgb == io::render({{plain}, {}}, options).rgb);
}

TEST_CASE("render: vertex colours are blended over the triangles") {
  io::RenderMesh mesh = square({0, 0, 0}, 0.5, pure_blue);
  mesh.vertex_colours = {pure_red, pure_green, pure_red, pure_green};
  for (std::size_t i = 0; i < 4; ++i)
    mesh.vertex_colours[i] = mesh.vertices[i][0] < 0 ? pure_red : pure_green;
  const io::Image image = io::render({{mesh}, {}}, from_the_front(61, 4));
  CHECK(is_reddish(pixel(image, 18, 30)));
  CHECK(is_greenish(pixel(image, 42, 30)));
}

TEST_CASE("render: the automatic camera holds the framed meshes and one camera serves several scenes") {
  io::RenderMesh small = square({0, 0, 0}, 0.1, pure_red), large = square({0, 0, -1}, 3, pure_green);
  large.framed = false;
  io::RenderOptions options;
  options.width = options.height = 40;
  options.view.azimuth_deg = options.view.elevation_deg = 0;
  const io::Image image = io::render({{small, large}, {}}, options);
  CHECK(is_greenish(pixel(image, 1, 1)));  // fills the picture: it was not framed
  CHECK(is_reddish(pixel(image, 5, 20)));  // reaches the margin: it was
  const io::RenderScene first{{small}, {}}, second{{square({2, 0, 0}, 0.1, pure_red)}, {}};
  const std::array<io::RenderScene, 2> both{first, second};
  CHECK(io::automatic_camera(both, options).target[0] == Approx(1.0));
}

TEST_CASE("render: triangle colours come before all others") {
  io::RenderScene scene{{square({0, 0, 0}, 0.9, pure_blue)}, {}};
  scene.meshes[0].vertex_colours.assign(4, pure_blue);
  scene.meshes[0].triangle_colours = {pure_red, pure_green};
  const io::Image image = io::render(scene, from_the_front(64, 4));
  CHECK(is_reddish(pixel(image, 44, 44)));
  CHECK(is_greenish(pixel(image, 20, 20)));
  scene.meshes[0].triangle_colours.pop_back();
  CHECK_THROWS_WITH(io::render(scene, from_the_front(8, 4)), Catch::Contains("1 colours for 2 triangles"));
}

TEST_CASE("render: one point is a ball, as wide as asked for") {
  io::RenderScene scene{{square({0, 0, 0}, 0.9, pure_blue)}, {{{{0, 0, 0}}, pure_red, 2.5}}};
  io::RenderOptions options = from_the_front(100, 4);
  options.line_radius_pixels = 4;
  const io::Image image = io::render(scene, options);
  int red = 0;
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 100; ++y) red += is_reddish(pixel(image, x, y));
  CHECK(red == Approx(3.14159 * 10 * 10).epsilon(0.06));
  CHECK(is_reddish(pixel(image, 50, 50)));
  scene.lines[0].width = 0;
  CHECK_THROWS_WITH(io::render(scene, options), Catch::Contains("line 0: width"));
}

TEST_CASE("render: parallel lines of sight show near and far alike, and as large as they are") {
  // Two squares of 0.4 m, one 2 m behind the other, in a picture 2 m high.
  io::RenderScene scene{{square({-0.5, 0, 1}, 0.2, pure_red), square({0.5, 0, -1}, 0.2, pure_green)}, {}};
  io::RenderOptions options = from_the_front(100, 4);
  options.camera->parallel_height = 2;
  const io::Image image = io::render(scene, options);
  int red = 0, green = 0;
  for (int x = 0; x < 100; ++x)
    for (int y = 0; y < 100; ++y)
      red += is_reddish(pixel(image, x, y)), green += is_greenish(pixel(image, x, y));
  CHECK(red == 400);
  CHECK(green == 400);
  CHECK(is_reddish(pixel(image, 25, 50)));
  CHECK(is_greenish(pixel(image, 75, 50)));
  options.camera->parallel_height = -1;
  CHECK_THROWS_WITH(io::render(scene, options), Catch::Contains("parallel_height"));
}

TEST_CASE("render: the line of sight through a pixel leads to what the picture shows there", "[release]") {
  io::RenderOptions options = from_the_front(100, 4);
  options.width = 140;
  options.camera = io::Camera{{0.3, 1, 4}, {0.1, 0.2, 0}, {0.2, 1, 0.1}, 35};
  options.quality = io::Quality::normal;
  for (const bool parallel : {false, true}) {
    if (parallel) options.camera->parallel_height = 2.5;
    for (const auto& [column, row] : {std::pair{30, 70}, {70, 12}, {128, 50}}) {
      const auto [origin, direction] = io::line_of_sight({*options.camera, 140, 100}, column, row);
      const auto p = origin + 3.5 * direction;
      io::RenderScene scene{{square({0, 0, -2}, 3, pure_blue)}, {{{{p.x(), p.y(), p.z()}}, pure_red, 2}}};
      const io::Image image = io::render(scene, options);
      double x = 0, y = 0, n = 0;
      for (int i = 0; i < 140; ++i)
        for (int j = 0; j < 100; ++j)
          if (is_reddish(pixel(image, i, j))) x += i, y += j, ++n;
      REQUIRE(n > 20);
      CHECK(x / n == Approx(column).margin(0.2));
      CHECK(y / n == Approx(row).margin(0.2));
    }
  }
}

}  // namespace
}  // namespace furrow::tests
