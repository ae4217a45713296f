// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/rest/loose_parts.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/parts.h"
#include "geometry/mesh/sheet.h"
#include "geometry/mesh/struts.h"
#include "geometry/refine/subdivide.h"
#include "io/scene/scene.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
using geometry::Vertex;

namespace {

Vertex vertex(std::size_t i) { return Vertex(Vertex::size_type(i)); }

/// A triangle of 2 cm at (x, y, z).
void add_scrap(geometry::Mesh& mesh, double x, double y, double z, double size = 0.02) {
  const Vertex a = mesh.add_vertex({x, y, z}), b = mesh.add_vertex({x, y, z + size});
  mesh.add_face(a, b, mesh.add_vertex({x + size, y, z}));
}

/// A sheet across a ball, a scrap 3 cm over its border, and one that lies in the air beside it.
jobs::DrapeJob with_scraps(double size = 0.02) {
  jobs::DrapeJob job;
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  sheet = geometry::equilateral_sheet(0.3, 0.3, 0.05);
  for (const Vertex v : sheet.vertices()) {
    const geometry::Point p = sheet.point(v);
    sheet.point(v) = {p.x(), 0.105, p.y() - 0.15};
  }
  add_scrap(sheet, 0.12, 0.135, 0.12, size);
  add_scrap(sheet, 0.4, 0.1, 0, size);
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(2, 0.1);
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"sheet\"\n", "test");
  io::set_value(job.scene.settings, "garment.attach", false, "the test");
  io::set_value(job.scene.settings, "body.mesh", "ball", "the test");
  io::set_value(job.scene.settings, "body.tolerance", 0.005, "the test");
  job.subdivide = 0;
  return job;
}

double apart(const geometry::Mesh& mesh, Vertex a, Vertex b) {
  return std::sqrt(CGAL::squared_distance(mesh.point(a), mesh.point(b)));
}

}  // namespace

TEST_CASE("loose_parts: they go with the nearest cloth as rigid bodies, on a refined garment, too") {
  for (const int refinements : {0, 1}) {
    geometry::Mesh given = geometry::equilateral_sheet(0.3, 0.3, 0.05);
    const std::size_t sheet = given.number_of_vertices();
    add_scrap(given, 0, 0.15, 0.01);
    geometry::Mesh draped = given;
    if (refinements) geometry::loop_subdivide(draped, refinements);
    const geometry::Mesh before = draped;
    // all but the scrap turns by a quarter about x, and goes up
    const geometry::Parts parts = geometry::find_parts(draped);
    const auto turned = [](const geometry::Point& p) { return geometry::Point(p.x(), -p.z(), p.y() + 1); };
    for (const Vertex v : draped.vertices())
      if (parts.of_vertex[v.idx()] == 0) draped.point(v) = turned(draped.point(v));
    const std::vector<int> seeds{int(sheet)};
    jobs::carry_loose_parts(draped, given, refinements, seeds);
    for (const Vertex v : draped.vertices())
      CHECK(CGAL::squared_distance(draped.point(v), turned(before.point(v))) < 1e-20);
  }
}

TEST_CASE(
    "loose_parts: what is dropped takes its struts and lines along, and the others keep their vertices") {
  io::MeshFile file;
  add_scrap(file.mesh, 0, 0, 0);
  add_scrap(file.mesh, 1, 0, 0);
  add_scrap(file.mesh, 2, 0, 0);
  geometry::set_struts(file.mesh, std::vector<geometry::Strut>{{vertex(0), vertex(1), 0.1, 1},
                                                               {vertex(0), vertex(8), 2, 1},
                                                               {vertex(4), vertex(5), 0.3, 1}});
  file.polylines = {{{}, {0, 7}, false}, {{}, {4, 5}, false}};
  const std::vector<int> seeds{4};
  jobs::drop_parts(file, seeds);
  CHECK(file.mesh->number_of_vertices() == 6);
  CHECK(file.mesh->number_of_faces() == 2);
  CHECK_FALSE(file.mesh->has_garbage());
  const std::vector<geometry::Strut> struts = geometry::struts(file.mesh);
  REQUIRE(struts.size() == 2);
  for (const geometry::Strut& s : struts)
    CHECK(std::abs(file.mesh->point(s.a).x() - file.mesh->point(s.b).x()) ==
          Approx(s.rest_length == 2 ? 2 : 0).margin(0.03));
  REQUIRE(file.polylines.size() == 1);
  CHECK(file.mesh->point(vertex(file.polylines[0].vertices[1])).x() >= 2);
}

TEST_CASE("drape: loose parts are held, dropped or let fall, and the report says so", "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = with_scraps();
  const std::size_t count = job.scene.memory.meshes["sheet"].mesh->number_of_vertices();
  const jobs::DrapeJobReport held = jobs::drape(job, recorder);
  INFO(to_json(held).dump(1));
  const jobs::Draped& d = held.garments[0];
  CHECK_FALSE(held.fails());
  CHECK(d.outcome().find("at rest, 2 of 3 parts loose") == 0);
  CHECK(d.file.mesh->number_of_vertices() == count);
  CHECK(apart(d.file.mesh, vertex(count - 1), vertex(count - 2)) == Approx(0.02 * std::sqrt(2)));
  CHECK(d.file.mesh->point(vertex(count - 6)).y() < 0.12);  // with the border that hangs down
  const io::Json told = to_json(held).at("loose");
  CHECK(told.at("pieces") == 2);
  CHECK(told.at("vertices") == 6);
  CHECK(told.at("done") == "held");
  job.settings.loose = jobs::LooseUse::drop;
  const jobs::DrapeJobReport dropped = jobs::drape(job, recorder);
  CHECK_FALSE(dropped.fails());
  CHECK(dropped.garments[0].file.mesh->number_of_vertices() == count - 6);
  CHECK(to_json(dropped).at("loose").at("done") == "dropped");
  job.settings.loose = jobs::LooseUse::fall;
  const jobs::DrapeJobReport fallen = jobs::drape(job, recorder);
  CHECK(fallen.fails());
  CHECK_FALSE(to_json(fallen).contains("loose"));
  CHECK(fallen.garments[0].file.mesh->point(vertex(count - 1)).y() < -0.2);
}

TEST_CASE("drape: a large part that nothing holds is a failure, unless it is dropped", "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = with_scraps(0.1);
  const jobs::DrapeJobReport held = jobs::drape(job, recorder);
  CHECK(held.garments[0].loose_parts.area_share > 0.05);
  CHECK(held.fails());
  job.settings.loose = jobs::LooseUse::drop;
  CHECK_FALSE(jobs::drape(job, recorder).fails());
}
