// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/tile.h"

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/io/picture/scenes.h"

namespace furrow::tests {
namespace {

using Eigen::Vector3d;

constexpr double key_radius = 0.3;

/// All that a tile needs.
struct Studio {
  io::PreparedScene scene;
  io::RayScene rays;
  io::Shader shader;
  io::Eye eye;
  Studio(const io::RenderScene& shown, const io::RenderOptions& options, int bundles)
      : scene(io::prepare(shown, options)),
        rays(scene),
        shader(scene, rays, bundles, key_radius),
        eye(scene, rays, shader, options) {}

  io::Seen seen(double x, double y) const { return eye.look(x, y).surface.value(); }
};

/// Deep folds of cloth, a ball that throws a shadow on them, and a line over all.
io::RenderScene folds() {
  io::RenderScene scene{
      {grid(30, 90,
            [](double u, double v) {
              return io::Position{u - 0.5, v - 0.5, 0.05 * std::sin(8 * std::numbers::pi * u + v)};
            }),
       sphere(0.12, 24)},
      {{{{-0.4, -0.35, 0.1}, {0.4, -0.2, 0.1}}, io::ridge_colour}}};
  for (auto& p : scene.meshes[1].vertices) p = {p[0] - 0.1, p[1] + 0.15, p[2] + 0.2};
  return scene;
}

int level(double light) { return int(std::lround(255 * io::srgb(std::clamp(light, 0.0, 1.0)))); }

/// A pixel for which 6 × 6 lines of sight cast all rays of their own.
Vector3d by_brute_force(const Studio& studio, int column, int row, const Vector3d& background) {
  constexpr int side = 6;
  Vector3d sum = Vector3d::Zero();
  for (int b = 0; b < side; ++b)
    for (int a = 0; a < side; ++a) {
      const io::Look look = studio.eye.look(column + (a + 0.5) / side, row + (b + 0.5) / side);
      sum += look.surface ? studio.shader.light(*look.surface, studio.shader.shares(*look.surface))
                          : look.line.value_or(background);
    }
  return sum / (side * side);
}

TEST_CASE("tile: a picture of shared rays is that of many rays at each place", "[release]") {
  const io::RenderScene scene = folds();
  io::RenderOptions options = from_the_front(100, 2.2);  // two tiles each way
  options.quality = io::Quality::normal;
  const io::Image image = io::render(scene, options);
  const Studio studio(scene, options, 16);
  double squares = 0;
  int worst = 0;
  for (int row = 0; row < 100; row += 3)
    for (int column = 0; column < 100; ++column) {
      const io::Colour c = io::background_colour(row, 100);
      const Vector3d expected = by_brute_force(
          studio, column, row, {io::linear_light(c[0]), io::linear_light(c[1]), io::linear_light(c[2])});
      for (int i = 0; i < 3; ++i) {
        const int off = std::abs(pixel(image, column, row)[i] - level(expected[i]));
        squares += off * off;
        worst = std::max(worst, off);
      }
    }
  CHECK(std::sqrt(squares / (34 * 100 * 3)) < 1.5);
  CHECK(worst < 45);  // one line of sight of 16 that misses the dark line
}

TEST_CASE("tile: soft shadows and dark folds have no grain, and nothing stands out", "[release]") {
  io::RenderScene scene = folds();
  scene.lines.clear();
  io::RenderOptions options = from_the_front(320, 2.2);
  options.quality = io::Quality::normal;
  const io::Image image = io::render(scene, options);
  // Over the cloth, and beside the ball: where neighbours on both sides are alike, a pixel is their mean.
  double squares = 0;
  int count = 0, darkest = 255, worst = 0;
  for (int y = 170; y < 280; ++y)
    for (int x = 60; x < 260; ++x) {
      const int left = pixel(image, x - 1, y)[1], here = pixel(image, x, y)[1],
                right = pixel(image, x + 1, y)[1], above = pixel(image, x, y - 1)[1],
                below = pixel(image, x, y + 1)[1];
      if (std::abs(left - right) > 8 || std::abs(above - below) > 8) continue;  // an edge
      const int off = std::abs(4 * here - left - right - above - below);
      squares += off * off / 16.0;
      worst = std::max(worst, off);
      darkest = std::min(darkest, here);
      ++count;
    }
  CHECK(count > 15000);
  CHECK(darkest < 90);
  CHECK(std::sqrt(squares / count) < 0.5);
  CHECK(worst < 12);
}

TEST_CASE("tile: a line thinner than a pixel is seen wherever it runs") {
  io::RenderScene scene{{square({0, 0, 0}, 0.9, io::body_colour)},
                        {{{{0.0105, -0.5, 0.1}, {0.0105, 0.5, 0.1}}, pure_blue}}};
  io::RenderOptions options = from_the_front(100, 4);
  options.line_radius_pixels = 0.2;
  options.quality = io::Quality::normal;
  const io::Image image = io::render(scene, options);
  for (int y = 35; y < 65; ++y) {
    int least = 255;
    for (int x = 45; x < 55; ++x) least = std::min(least, pixel(image, x, y)[0]);
    CHECK(least < pixel(image, 40, y)[0] - 10);
  }
}

/// How sharply neighbours above and below differ from a pixel of a strip that lies 0.2 before a sheet of its
/// colour, at its most.
int sharpest_of_strip(double height) {
  io::RenderScene scene{{square({0, 0, 0}, 1, io::cloth_colour)}, {}};
  io::RenderMesh& cloth = scene.meshes[0];
  for (const auto& [x, y] : {std::pair(-0.4, 0.0), {0.4, 0.0}, {0.4, 0.02}, {-0.4, 0.02}})
    cloth.vertices.push_back({x, y + height, 0.2});
  cloth.triangles.insert(cloth.triangles.end(), {{4, 5, 6}, {4, 6, 7}});
  cloth.style = io::Style::cloth;
  io::RenderOptions options = from_the_front(240, 4);
  options.thickness = 0.006;
  options.quality = io::Quality::normal;
  const io::Image image = io::render(scene, options);
  int sharpest = 0;
  for (int row = 110; row < 130; ++row)
    sharpest = std::max(sharpest, std::abs(2 * pixel(image, 120, row)[1] - pixel(image, 120, row - 1)[1] -
                                           pixel(image, 120, row + 1)[1]));
  return sharpest;
}

TEST_CASE("tile: the border of cloth before cloth of its colour is seen wherever it runs", "[release]") {
  for (int i = 0; i < 8; ++i) {
    CAPTURE(i);
    CHECK(sharpest_of_strip(0.001 * i) >= 4);
  }
}

TEST_CASE("shade: of a light that is partly below the horizon comes what stands above") {
  const io::RenderOptions options = from_the_front(60, 4);
  const Vector3d key = Vector3d(-0.75, 0.58, 0.36).normalized();
  const Vector3d u = key.unitOrthogonal(), v = key.cross(u);
  double full = 0;
  for (int degrees = 0; degrees <= 120; degrees += 4) {
    // A square that is turned about an axis across the key light, and always seen.
    const Vector3d away = (Vector3d::UnitZ() - key.z() * key).normalized();
    const double angle = degrees * std::numbers::pi / 180;
    const Vector3d normal = std::cos(angle) * key + std::sin(angle) * away;
    const Vector3d a = 0.5 * normal.unitOrthogonal(), b = normal.cross(a);
    io::RenderMesh mesh;
    for (const Vector3d& p : {Vector3d(-a - b), Vector3d(a - b), Vector3d(a + b), Vector3d(-a + b)})
      mesh.vertices.push_back({p.x(), p.y(), p.z()});
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.style = io::Style::body;
    const Studio studio({{mesh}, {}}, options, 4);
    double sum = 0;
    constexpr int rings = 60, turns = 120;
    for (int i = 0; i < rings; ++i)
      for (int j = 0; j < turns; ++j) {
        const double r = key_radius * std::sqrt((i + 0.5) / rings), turn = 2 * std::numbers::pi * j / turns;
        sum +=
            std::max(0.0, normal.dot((key + r * std::cos(turn) * u + r * std::sin(turn) * v).normalized()));
      }
    sum /= rings * turns;
    if (degrees == 0) full = studio.seen(30, 30).key / sum;
    CHECK(studio.seen(30, 30).key / full == Approx(sum).margin(0.003));
  }
}

TEST_CASE("shade: a sheet that covers half of the sky takes half of its light") {
  io::RenderScene scene{
      {square({0, 0, 0}, 1, io::body_colour), square({1.3, 0, 0.05}, 1.25, io::body_colour)}, {}};
  io::RenderOptions options = from_the_front(200, 4);
  options.thickness = 0;
  const Studio studio(scene, options, 8);
  const auto column = [](double x) { return 100 + 100 * x / (4 * std::tan(15 * std::numbers::pi / 180)); };
  const io::LightShares beside = studio.shader.shares(studio.seen(column(0.0499), 100));
  CHECK(beside.sky == Approx(1 - 0.85 / 2).margin(0.02));  // a part comes back from what hides it
  CHECK(beside.key == Approx(1));                          // it shines from the other side
  const io::LightShares far = studio.shader.shares(studio.seen(column(-0.9), 100));
  CHECK(far.sky == Approx(1).margin(0.01));
  scene.meshes[1] = square({-1.2, 0, 0.05}, 1.25, io::body_colour);
  const Studio shaded(scene, options, 8);
  CHECK(shaded.shader.shares(shaded.seen(column(0.051), 100)).key < 0.01);
}

}  // namespace
}  // namespace furrow::tests
