// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/prepared_scene.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "tests/io/picture/scenes.h"

namespace furrow::tests {
namespace {

TEST_CASE("prepared_scene: a prepared sphere has diagonal 1, radial normals and even bulges") {
  io::RenderMesh mesh = sphere(3, 48);
  mesh.style = io::Style::cloth;
  for (auto& p : mesh.vertices) p = {p[0] + 7, p[1] - 2, p[2]};
  io::RenderOptions options = from_the_front(4, 40);
  options.thickness = 0;
  const auto prepared = io::prepare({{mesh}, {}}, options).meshes.at(0);
  const double radius = 1 / (2 * std::sqrt(3.0)), curvature = 2 / (100 * radius);
  int checked = 0;
  for (std::size_t v = 0; v < prepared.vertices.size(); ++v) {
    CHECK(prepared.vertices[v].norm() == Approx(radius).epsilon(1e-9));
    const bool on_seam = v % 97 < 2 || v % 97 > 94;  // one-sided neighbourhoods
    if (on_seam || std::abs(prepared.vertices[v].y()) > 0.8 * radius) continue;
    ++checked;
    CHECK((prepared.normals[v] - prepared.vertices[v] / radius).norm() < 0.01);
    CHECK(prepared.bulges[v] == Approx(curvature / (1 + curvature)).epsilon(0.03));
  }
  CHECK(checked > 1000);

  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  const auto hollow = io::prepare({{mesh}, {}}, options).meshes.at(0);
  CHECK(hollow.bulges[24 * 97 + 40] == Approx(-prepared.bulges[24 * 97 + 40]));
}

TEST_CASE("prepared_scene: the camera's frame is orthonormal and right-handed") {
  io::RenderOptions options = from_the_front(4, 4);
  options.camera = io::Camera{{1, 2, 3}, {-0.5, 0, 0.25}, {0.1, 1, 0.2}, 60};
  const auto camera = io::prepare({{sphere(1, 8)}, {}}, options).camera;
  Eigen::Matrix3d frame;
  frame << camera.right, camera.up, -camera.forward;
  CHECK((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm() < 1e-12);
  CHECK(frame.determinant() == Approx(1));
  CHECK(camera.up.y() > 0);
  CHECK(camera.slope == Approx(std::tan(std::numbers::pi / 6)));
}

TEST_CASE("prepared_scene: sRGB to linear light and back is the identity, with the standard's points") {
  for (int i = 0; i <= 255; ++i)
    CHECK(io::srgb(io::linear_light(i / 255.0)) == Approx(i / 255.0).margin(1e-6));
  CHECK(io::linear_light(0) == 0);
  CHECK(io::linear_light(1) == Approx(1));
  CHECK(io::linear_light(0.5) == Approx(0.21404).epsilon(1e-4));
}

}  // namespace
}  // namespace furrow::tests
