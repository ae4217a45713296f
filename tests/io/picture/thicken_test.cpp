// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/thicken.h"

#include <Eigen/Dense>
#include <catch2/catch.hpp>

#include "tests/io/picture/scenes.h"

namespace furrow::tests {
namespace {

io::RenderMesh cloth_grid(int rows, int columns) {
  return grid(rows, columns, [](double u, double v) { return io::Position{u - 0.5, 0.05 * u * v, 0.5 - v}; });
}

io::PreparedMesh prepared(const io::RenderMesh& mesh, double thickness) {
  io::RenderOptions options = from_the_front(8, 4);
  options.thickness = thickness;
  return io::prepare({{mesh}, {}}, options).meshes.at(0);
}

TEST_CASE(
    "thicken: two copies stand half the thickness off the surface, and four quads round each border edge") {
  constexpr double thickness = 0.002;
  const io::RenderMesh mesh = cloth_grid(5, 7);
  const int vertices = 6 * 8, triangles = 2 * 5 * 7, border = 2 * (5 + 7);
  const io::PreparedMesh plain = prepared(mesh, 0), thick = prepared(mesh, thickness);
  CHECK(int(thick.triangles.size()) == 2 * triangles + 8 * border);
  CHECK(int(thick.vertices.size()) == 2 * vertices + 3 * border);
  CHECK(thick.first_inner == triangles);
  CHECK(thick.first_rim == 2 * triangles);
  CHECK(thick.corners.size() == thick.triangles.size());
  const double half = 0.5 * thickness * (plain.vertices[1] - plain.vertices[0]).norm() /
                      (Eigen::Vector3d(mesh.vertices[1][0], mesh.vertices[1][1], mesh.vertices[1][2]) -
                       Eigen::Vector3d(mesh.vertices[0][0], mesh.vertices[0][1], mesh.vertices[0][2]))
                          .norm();
  for (int v = 0; v < vertices; ++v) {
    CHECK((thick.vertices[v] - plain.vertices[v] - half * plain.normals[v]).norm() < 1e-12);
    CHECK((thick.vertices[v + vertices] - plain.vertices[v] + half * plain.normals[v]).norm() < 1e-12);
  }
  for (std::size_t v = 2 * vertices; v < thick.vertices.size(); ++v) {  // the half round
    double nearest = 1;
    for (const Eigen::Vector3d& p : plain.vertices)
      nearest = std::min(nearest, (p - thick.vertices[v]).norm());
    CHECK(nearest == Approx(half).epsilon(1e-9));
  }
}

/// Six times the volume inside; open or inside out, it would depend on where the origin is.
double volume6(const io::PreparedMesh& mesh, const Eigen::Vector3d& origin) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += (mesh.vertices[t[0]] - origin)
               .dot((mesh.vertices[t[1]] - origin).cross(mesh.vertices[t[2]] - origin));
  return sum;
}

TEST_CASE("thicken: the thick cloth is closed, faces outward and has the volume of area times thickness") {
  const io::PreparedMesh plain = prepared(cloth_grid(9, 9), 0), thick = prepared(cloth_grid(9, 9), 0.001);
  double area = 0;
  for (const auto& t : plain.triangles)
    area += (plain.vertices[t[1]] - plain.vertices[t[0]])
                .cross(plain.vertices[t[2]] - plain.vertices[t[0]])
                .norm() /
            2;
  const double depth = (thick.vertices[11] - thick.vertices[11 + 100]).norm();
  CHECK(volume6(thick, {0, 0, 0}) / 6 == Approx(area * depth).epsilon(0.01));
  CHECK(volume6(thick, {3, -2, 5}) == Approx(volume6(thick, {0, 0, 0})).epsilon(1e-9));
  CHECK(std::abs(volume6(plain, {3, -2, 5}) - volume6(plain, {0, 0, 0})) > 0.1);
}

TEST_CASE("thicken: without a thickness, and on a body, the triangles are those of the mesh") {
  io::RenderMesh mesh = cloth_grid(3, 3);
  const io::PreparedMesh plain = prepared(mesh, 0);
  CHECK(plain.triangles == mesh.triangles);
  CHECK(plain.vertices.size() == mesh.vertices.size());
  CHECK(plain.first_inner == -1);
  mesh.style = io::Style::body;
  CHECK(prepared(mesh, 0.002).triangles == mesh.triangles);
  CHECK(prepared(mesh, 0.002).first_inner == -1);
}

TEST_CASE("thicken: colours, triangle colours and texture coordinates go along") {
  io::RenderMesh mesh = cloth_grid(2, 2);
  mesh.vertex_colours.assign(mesh.vertices.size(), pure_red);
  mesh.triangle_colours.assign(mesh.triangles.size(), pure_blue);
  mesh.texture = std::make_shared<io::Image>(io::Image{1, 1, {10, 200, 10}});
  mesh.texture_coordinates.assign(mesh.triangles.size(), {{{0.1, 0.2}, {0.3, 0.4}, {0.5, 0.6}}});
  const io::PreparedMesh thick = prepared(mesh, 0.002);
  CHECK(thick.colours.size() == thick.vertices.size());
  CHECK(thick.bulges.size() == thick.vertices.size());
  CHECK(thick.triangle_colours.size() == thick.triangles.size());
  REQUIRE(thick.texture_coordinates.size() == thick.triangles.size());
  CHECK(thick.texture_coordinates[std::size_t(thick.first_inner)][1] == std::array<double, 2>{0.5, 0.6});
}

TEST_CASE("thicken: a hem seen edge-on has the width of its thickness in pixels") {
  const io::RenderMesh sheet = grid(4, 4, [](double u, double v) {
    return io::Position{u - 0.5, 0, 0.5 - v};
  });
  io::RenderOptions options = from_the_front(100, 2);
  options.camera->parallel_height = 0.02;  // 0.2 mm a pixel
  const auto rows = [&](double thickness) {
    options.thickness = thickness;
    const io::Image image = io::render({{sheet}, {}}, options);
    int count = 0;
    for (int y = 0; y < 100; ++y) count += pixel(image, 50, y) != background_pixel(y, 100);
    return count;
  };
  CHECK(rows(0.0016) == 8);
  CHECK(rows(0.004) == 20);
  CHECK(rows(0) <= 1);
  CHECK(rows(1) == Approx(5 * std::sqrt(2.0) / 200 * 1000).margin(2));  // at most 1/200 of the diagonal
}

/// Two squares that share an edge along x, the second turned up by an angle.
io::RenderMesh bent(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  return grid(2, 1, [a](double u, double v) {
    return v <= 0.5 ? io::Position{u, 2 * v - 1, 0}
                    : io::Position{u, (2 * v - 1) * std::cos(a), (2 * v - 1) * std::sin(a)};
  });
}

TEST_CASE("split_normals: an edge above 60 degrees keeps a normal for each side, one below does not") {
  CHECK(prepared(bent(55), 0).corners.empty());
  const io::PreparedMesh sharp = prepared(bent(65), 0);
  REQUIRE(sharp.corners.size() == sharp.triangles.size());
  for (std::size_t i = 0; i < sharp.triangles.size(); ++i) {
    const auto& t = sharp.triangles[i];
    const Eigen::Vector3d flat = (sharp.vertices[t[1]] - sharp.vertices[t[0]])
                                     .cross(sharp.vertices[t[2]] - sharp.vertices[t[0]])
                                     .normalized();
    for (int k = 0; k < 3; ++k) CHECK((sharp.normals[sharp.corners[i][k]] - flat).norm() < 1e-9);
  }
  io::RenderMesh body = bent(65);
  body.style = io::Style::body;
  CHECK(prepared(body, 0).corners.empty());
}

TEST_CASE("split_normals: where a pressed edge ends inside the cloth, the normal is one") {
  io::RenderMesh fan;  // six triangles about a vertex, of which one edge alone is sharp
  fan.vertices.push_back({0, 0, 0});
  for (int i = 0; i < 6; ++i) {
    const double a = i * std::numbers::pi / 3;
    fan.vertices.push_back(
        {std::cos(a), std::sin(a), std::array{1.4, -0.6, -1.0, -1.0, -1.0, -0.6}[std::size_t(i)]});
  }
  for (int i = 0; i < 6; ++i) fan.triangles.push_back({0, 1 + i, 1 + (i + 1) % 6});
  const io::PreparedMesh mesh = prepared(fan, 0);
  REQUIRE(!mesh.corners.empty());
  for (std::size_t i = 1; i < 6; ++i) CHECK(mesh.corners[i][0] == mesh.corners[0][0]);
  CHECK(mesh.corners[0][1] != mesh.corners[5][2]);  // the far end of the sharp edge, on the border
}

}  // namespace
}  // namespace furrow::tests
