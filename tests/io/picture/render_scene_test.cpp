// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_scene.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "geometry/insert/insert_along_stroke.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "io/picture/render_preview.h"

namespace furrow::tests {
namespace {

using geometry::Mesh;
using geometry::Point;
using geometry::Vertex;

/// (n+1)² vertices, row by row, each square cut from lower left to upper right.
Mesh grid_mesh(int n) {
  Mesh mesh;
  for (int i = 0; i <= n; ++i) {
    for (int j = 0; j <= n; ++j) mesh.add_vertex(Point(j, i, 0));
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vertex a(i * (n + 1) + j), b(a + 1), c(b + n + 1), d(a + n + 1);
      mesh.add_face(a, b, c);
      mesh.add_face(a, c, d);
    }
  }
  return mesh;
}

const io::LineColours panel_colours;

std::size_t count(const std::vector<io::RenderLine>& lines, const io::Colour& colour) {
  return std::size_t(
      std::count_if(lines.begin(), lines.end(), [&](const auto& l) { return l.colour == colour; }));
}

TEST_CASE("render_scene: a mesh is drawn with its vertices, faces and colours, without removed vertices") {
  Mesh mesh = grid_mesh(2);
  mesh.remove_vertex(mesh.add_vertex(Point(9, 9, 9)));
  io::RenderMesh drawn = io::render_mesh_from(mesh);
  CHECK(drawn.vertices.size() == 9);
  REQUIRE(drawn.triangles.size() == 8);
  auto first = drawn.triangles[0];
  std::rotate(first.begin(), std::min_element(first.begin(), first.end()), first.end());
  CHECK(first == std::array<int, 3>{0, 1, 4});
  CHECK(drawn.vertex_colours.empty());
  CHECK(drawn.colour == io::cloth_colour);
  CHECK(io::render_mesh_from(mesh, io::Style::body).colour == io::body_colour);

  auto colour = geometry::ensure_map(mesh, geometry::attribute::color);
  CHECK(io::render_mesh_from(mesh).vertex_colours.empty());  // all white: nobody set any
  colour[Vertex(4)] = {0.5, 0.25, 0, 1};
  drawn = io::render_mesh_from(mesh);
  REQUIRE(drawn.vertex_colours.size() == 9);
  CHECK(drawn.vertex_colours[4] == io::Colour{0.5f, 0.25f, 0});
}

TEST_CASE("render_scene: a face that is no triangle is a content error") {
  Mesh mesh;
  const Vertex a = mesh.add_vertex(Point(0, 0, 0)), b = mesh.add_vertex(Point(1, 0, 0)),
               c = mesh.add_vertex(Point(1, 1, 0)), d = mesh.add_vertex(Point(0, 1, 0));
  mesh.add_face(a, b, c, d);
  CHECK_THROWS_AS(io::render_mesh_from(mesh), geometry::ContentError);
}

TEST_CASE("render_scene: line edges take the colour of their line's sign") {
  Mesh mesh = grid_mesh(3);
  CHECK(io::render_lines_from(mesh, {}).empty());
  auto line = geometry::ensure_map(mesh, geometry::attribute::line);
  auto marked = geometry::ensure_map(mesh, geometry::attribute::line_edge);
  for (int row : {0, 2, 3}) {
    for (int j = 0; j < 4; ++j) line[Vertex(4 * row + j)] = row;
    for (int j = 0; j < 3; ++j) {
      marked[mesh.edge(mesh.halfedge(Vertex(4 * row + j), Vertex(4 * row + j + 1)))] = true;
    }
  }
  const auto lines = io::render_lines_from(mesh, {0.01, 0, -0.02});
  CHECK(lines.size() == 9);
  CHECK(count(lines, panel_colours.ridge) == 3);
  CHECK(count(lines, panel_colours.valley) == 3);
  CHECK(count(lines, panel_colours.other) == 3);  // line 3 has no height
  for (const auto& l : lines) {
    REQUIRE(l.points.size() == 2);
    CHECK(l.points[0][1] == l.points[1][1]);
    CHECK(l.colour == (l.points[0][1] == 0   ? panel_colours.ridge
                       : l.points[0][1] == 2 ? panel_colours.valley
                                             : panel_colours.other));
  }
  CHECK_THROWS_AS(io::render_lines_from(mesh, {std::numeric_limits<double>::quiet_NaN()}),
                  std::invalid_argument);
}

TEST_CASE("render_scene: without marked edges the vertices of one line are joined, but not across a corner") {
  Mesh mesh = grid_mesh(2);
  auto line = geometry::ensure_map(mesh, geometry::attribute::line);
  for (int v : {0, 1, 4, 7}) line[Vertex(v)] = 0;  // right, then up, up: 0-4 is a diagonal of a square
  const auto lines = io::render_lines_from(mesh, {1});
  CHECK(lines.size() == 3);
  for (const auto& l : lines) {
    CHECK(std::abs(l.points[0][0] - l.points[1][0]) + std::abs(l.points[0][1] - l.points[1][1]) == 1);
  }
}

TEST_CASE(
    "render_scene: at a crossing an edge keeps the colour of the line that runs through its other end") {
  Mesh mesh = grid_mesh(2);
  auto line = geometry::ensure_map(mesh, geometry::attribute::line);
  auto marked = geometry::ensure_map(mesh, geometry::attribute::line_edge);
  for (int v : {3, 4, 5}) line[Vertex(v)] = 0;
  for (int v : {1, 7}) line[Vertex(v)] = 1;  // the crossing, 4, belongs to line 0
  for (int v : {1, 3, 5, 7}) {
    const auto h = mesh.halfedge(Vertex(v), Vertex(4));
    REQUIRE(h != Mesh::null_halfedge());
    marked[mesh.edge(h)] = true;
  }
  const auto lines = io::render_lines_from(mesh, {1, -1});
  CHECK(lines.size() == 4);
  CHECK(count(lines, panel_colours.ridge) == 2);
  CHECK(count(lines, panel_colours.valley) == 2);
}

TEST_CASE("render_scene: strokes are drawn on the surface, face by face, a closed one to its start") {
  Mesh mesh = grid_mesh(8);
  for (Vertex v : mesh.vertices())
    mesh.point(v) = Point(mesh.point(v).x(), mesh.point(v).y(), 0.3 * std::abs(mesh.point(v).x() - 4));
  // The stroke's chord runs through the air over the valley at x = 4; its line does not.
  geometry::Stroke open{"a", 0.01, {Point(1.1, 3.3, 0.87), Point(6.9, 3.4, 0.87)}, false, {}};
  geometry::Stroke closed{
      "b", -0.01, {Point(1.1, 1.2, 0.87), Point(3.1, 1.3, 0.27), Point(2.2, 2.6, 0.54)}, true, {}};
  std::vector<std::string> warnings;
  const auto lines = io::render_lines_from(mesh, {open, closed}, warnings);
  CHECK(warnings.empty());
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].colour == panel_colours.ridge);
  CHECK(lines[1].colour == panel_colours.valley);
  CHECK(lines[0].points.size() > 15);
  for (const auto& line : lines)
    for (const auto& p : line.points) CHECK(p[2] == Approx(0.3 * std::abs(p[0] - 4)).margin(1e-9));
  const auto &first = lines[1].points.front(), &last = lines[1].points.back();
  CHECK(std::hypot(first[0] - last[0], first[1] - last[1]) < 1e-9);
}

TEST_CASE("render_scene: a stroke that lies nowhere near is drawn as it is, with a warning, in its parts") {
  geometry::Stroke far{"far", 0.01, {Point(1, 1, 5), Point(2, 1, 5), Point(4, 4, 5), Point(5, 4, 5)},
                       false, {},   {2}};
  std::vector<std::string> warnings;
  const auto lines = io::render_lines_from(grid_mesh(8), {far}, warnings);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].points.size() == 2);
  CHECK(lines[1].points.front() == io::Position{4, 4, 5});
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("stroke \"far\"") != std::string::npos);
}

TEST_CASE("render_scene: a preview highlights the changed triangles, dots new vertices and colours lines") {
  Mesh mesh = grid_mesh(8);
  const std::size_t before = mesh.num_vertices();
  geometry::Stroke ridge{"", 0.01, {Point(1.1, 2.3, 0), Point(6.7, 2.4, 0)}, false, {}};
  const auto report = geometry::insert_along_stroke(mesh, ridge, 0).report;
  const io::PreviewColours colours;
  const io::RenderScene scene = io::preview_scene(mesh, report.changed_faces, before, {0.01});
  const auto& triangles = scene.meshes[0].triangle_colours;
  REQUIRE(triangles.size() == mesh.number_of_faces());
  CHECK(std::size_t(std::count(triangles.begin(), triangles.end(), colours.selected)) ==
        report.changed_faces.size());
  std::size_t dots = 0;
  for (const auto& line : scene.lines) dots += line.points.size() == 1;
  CHECK(dots == report.inserted);
  CHECK(count(scene.lines, colours.lines.ridge) == io::render_lines_from(mesh, {0.01}).size());
  CHECK(count(scene.lines, colours.edge) > report.changed_faces.size());
}

TEST_CASE("render_scene: a preview of a fine mesh has thin edges, so that its triangles are seen") {
  struct Widths {
    double edge = 0, dot = 0;  // in tubes of the picture
  };
  const auto widths = [](int n) {
    Mesh mesh = grid_mesh(n);
    for (Vertex v : mesh.vertices())
      mesh.point(v) = Point(mesh.point(v).x() / n, mesh.point(v).y() / n, 0);  // the same square for each
    const std::size_t before = mesh.num_vertices();
    geometry::Stroke ridge{"", 0.01, {Point(0.111, 0.233, 0), Point(0.67, 0.304, 0)}, false, {}};
    const auto report = geometry::insert_along_stroke(mesh, ridge, 0).report;
    Widths widths;
    for (const auto& line : io::preview_scene(mesh, report.changed_faces, before, {0.01}).lines) {
      if (line.points.size() == 1) widths.dot = line.width;
      if (line.colour == io::PreviewColours().edge) widths.edge = line.width;
    }
    return widths;
  };
  const Widths coarse = widths(8), fine = widths(60), finest = widths(400);
  CHECK(coarse.edge == 0.35);
  CHECK(coarse.dot == 1.6);
  CHECK(fine.edge < 0.35);
  // Of a triangle's area 4 r / (sqrt(3) / 2 a) is under its edges, where a is a side, here 10 tubes long.
  CHECK(fine.edge * 4 / 0.87 / 10 < 0.2);
  CHECK(fine.edge > 0.08);
  CHECK(fine.dot < 1.6);
  CHECK(finest.edge == 0);  // left out
  CHECK(finest.dot == 0.3);
}

}  // namespace
}  // namespace furrow::tests
