// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/gather_lines.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "tests/test_meshes.h"

using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

Stroke gathered(std::vector<Coordinates<Point>> points, double share, bool closed = false) {
  Stroke stroke;
  stroke.name = "waist";
  stroke.height = 0;
  stroke.points = std::move(points);
  stroke.closed = closed;
  stroke.gather = share;
  return stroke;
}

Mesh sheet_with(double share, std::optional<double> width = {}) {
  Mesh mesh = equilateral_sheet(0.6, 0.4, 0.02);
  Stroke stroke = gathered({{-0.2, 0.2, 0}, {0.2, 0.2, 0}}, share);
  stroke.width = width;
  wrinkle(mesh, std::vector{stroke});
  return mesh;
}

constexpr int first_line[] = {0};

}  // namespace

TEST_CASE("gather_lines: a thread of so much of the line's length, with a stitch each half width") {
  const double width = GENERATE(0.04, 0.06);
  const Mesh mesh = sheet_with(0.7, width);
  const std::vector<GatherThread> threads = gather_threads(mesh, first_line);
  REQUIRE(threads.size() == 1);
  const GatherThread& thread = threads.front();
  CHECK(thread.struts.size() == std::size_t(std::lround(0.4 / (width / 2))));
  CHECK(thread.length == Approx(0.4).epsilon(1e-6));
  CHECK(thread.rest_length == Approx(0.7 * 0.4).epsilon(1e-6));
  CHECK(thread.draws());
  const auto line = find_map(mesh, attribute::line).value();
  for (const Strut& s : thread.struts) {
    CHECK((line[s.a] == 0 && line[s.b] == 0));
    CHECK(mesh.halfedge(s.a, s.b) == Mesh::null_halfedge());  // cloth between them has room to buckle
    CHECK(s.stiffness * s.rest_length == Approx(50));
  }
  for (Vertex v : mesh.vertices()) CHECK(mesh.point(v).z() == 0);  // nothing moves before it rests
}

TEST_CASE("gather_lines: without a width gathers are 40 mm wide, an eighth of a short line at most") {
  CHECK(gather_threads(sheet_with(0.7), first_line).front().struts.size() == 20);
  Mesh mesh = equilateral_sheet(0.3, 0.3, 0.01);
  wrinkle(mesh, std::vector{gathered({{-0.05, 0.15, 0}, {0.05, 0.15, 0}}, 0.5)});
  CHECK(gather_threads(mesh, first_line).front().struts.size() == 16);
}

TEST_CASE("gather_lines: round a tube the thread closes, and a later line leaves it whole") {
  const double radius = 0.1;
  Mesh tube = cylinder(radius, 0.3, 60, 30);
  std::vector<Coordinates<Point>> ring;
  double middle = 0;
  for (Vertex v : tube.vertices()) middle += tube.point(v).y() / double(tube.num_vertices());
  for (int i = 0; i < 48; ++i) {
    const double a = 2 * std::numbers::pi * i / 48;
    ring.push_back({radius * std::cos(a), middle + 1e-3, radius * std::sin(a)});
  }
  Stroke across;
  across.name = "across";
  across.points = {{radius, middle - 0.1, 0}, {radius, middle + 0.1, 0}};
  across.height = 0.01;
  wrinkle(tube, std::vector{gathered(ring, 0.8, true), across});
  const std::vector<GatherThread> threads = gather_threads(tube, first_line);
  REQUIRE(threads.size() == 1);
  std::map<Vertex, int> ends;
  for (const Strut& s : threads.front().struts) ++ends[s.a], ++ends[s.b];
  for (const auto& [v, count] : ends) CHECK(count == 2);
  CHECK(threads.front().struts.size() == std::size_t(std::lround(threads.front().length / 0.02)));
  CHECK(threads.front().length > 0.99 * 2 * std::numbers::pi * radius);
}

TEST_CASE("gather_lines: other struts stay, and threads that have yet to draw in come off and on again") {
  Mesh mesh = equilateral_sheet(0.6, 0.4, 0.02);
  const Strut own{Vertex(0), Vertex(5), 0.1, 7};
  set_struts(mesh, std::vector{own});
  wrinkle(mesh, std::vector{gathered({{-0.2, 0.2, 0}, {0.2, 0.2, 0}}, 0.7)});
  const std::vector<Strut> sewn = struts(mesh);
  CHECK(sewn.size() == 21);
  const std::vector<Strut> threads = cut_undrawn_threads(mesh, first_line);
  CHECK(threads.size() == 20);
  REQUIRE(struts(mesh).size() == 1);
  CHECK(struts(mesh).front().stiffness == 7);
  sew(mesh, threads);
  REQUIRE(struts(mesh).size() == sewn.size());
  for (std::size_t i = 0; i < sewn.size(); ++i)
    CHECK((struts(mesh)[i].a == sewn[i].a && struts(mesh)[i].b == sewn[i].b &&
           struts(mesh)[i].rest_length == sewn[i].rest_length));
  Mesh drawn = sheet_with(1);  // as long as it is
  CHECK(cut_undrawn_threads(drawn, first_line).empty());
  CHECK(gather_threads(drawn, first_line).size() == 1);
  CHECK(gather_threads(drawn, {}).empty());
}

TEST_CASE("gather_lines: a share out of its range is a fault of the stroke") {
  Stroke stroke = gathered({{0, 0, 0}, {1, 0, 0}}, 0.7);
  CHECK(shape_fault(stroke).empty());
  for (const double share : {0.0, 0.09, 1.01, double(NAN)}) {
    stroke.gather = share;
    CHECK_THAT(shape_fault(stroke), Catch::Contains("'gather'") && Catch::Contains("[0.1, 1]"));
  }
}
