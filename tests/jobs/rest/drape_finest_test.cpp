// SPDX-License-Identifier: GPL-3.0-or-later
// A garment that is refined where it folds.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/mesh/parts.h"
#include "geometry/mesh/preconditions.h"
#include "geometry/refine/local_refinement.h"
#include "io/mesh/mesh_file.h"
#include "jobs/base/seam_ties.h"
#include "physics/base/cancel_scope.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/jobs/rest/across_ball.h"

using namespace furrow;
using tests::across_ball;
namespace fs = std::filesystem;

namespace {

jobs::DrapeJob finely_across_ball(double finest = 0.012) {
  jobs::DrapeJob job = across_ball();
  job.settings.finest = finest;
  return job;
}

void add_button(geometry::Mesh& mesh, double x, double y, double z) {
  const auto a = mesh.add_vertex({x, y, z}), b = mesh.add_vertex({x, y, z + 0.02});
  mesh.add_face(a, b, mesh.add_vertex({x + 0.02, y, z}));
}

double between(const geometry::Mesh& mesh, std::size_t a, std::size_t b) {
  const auto at = [&](std::size_t i) { return mesh.point(geometry::Vertex(geometry::Vertex::size_type(i))); };
  return std::sqrt(CGAL::squared_distance(at(a), at(b)));
}

}  // namespace

TEST_CASE(
    "drape: with finest it rests, original vertices keep their index, and the report says what was saved",
    "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = finely_across_ball();
  const std::size_t given = job.scene.memory.meshes["sheet"].mesh->number_of_vertices();
  const fs::path folder = tests::empty_folder("drape_finest");
  job.output = folder / "worn.ply";
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  const jobs::Draped& d = report.garments.at(0);
  INFO(to_json(report).dump(1));
  CHECK(d.succeeds());
  const std::size_t vertices = d.file.mesh->number_of_vertices();
  CHECK(vertices > given);
  CHECK(vertices < d.report.uniform_vertices);
  CHECK(to_json(d).at("local").at("uniform_vertices") == d.report.uniform_vertices);
  CHECK(tests::positions(io::read_mesh(job.output)) == tests::positions(d.file));
  CHECK_FALSE(geometry::uniform_indices(d.file.mesh));
  for (int threads : {1, 2}) {
    tests::set(job, "simulation.threads", threads);
    CHECK(tests::positions(jobs::drape(job, recorder).garments.at(0).file) == tests::positions(d.file));
  }
}

TEST_CASE("drape: with finest, loose parts go with the cloth, or are dropped", "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = finely_across_ball();
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  const std::size_t cloth = sheet.number_of_vertices();
  add_button(sheet, 0.02, 0.12, 0.02);
  add_button(sheet, 0.4, 0.1, 0);
  jobs::DrapeJob riding = job;
  io::set_value(job.scene.settings, "garment.attach", false, "the test");
  const jobs::Draped held = jobs::drape(job, recorder).garments.at(0);
  INFO(to_json(held).dump(1));
  REQUIRE(held.loose.size() == 2);
  CHECK(to_json(held).at("loose").at("done") == "held");
  CHECK(between(held.file.mesh, cloth, cloth + 1) < 0.02);  // as Loop's masks leave it
  job.settings.loose = jobs::LooseUse::drop;
  const jobs::Draped dropped = jobs::drape(job, recorder).garments.at(0);
  CHECK(geometry::find_parts(dropped.file.mesh).list.size() + 2 ==
        geometry::find_parts(held.file.mesh).list.size());
  const jobs::Draped ridden = jobs::drape(riding, recorder).garments.at(0);
  CHECK(recorder.warned_of("parts_attached"));
  CHECK(ridden.loose.size() < 2);
  CHECK(between(ridden.file.mesh, cloth, cloth + 1) < 0.02);
  CHECK(ridden.file.mesh->point(geometry::Vertex(geometry::Vertex::size_type(cloth))).y() >
        0.1);  // on the ball
}

TEST_CASE("drape: finest where it cannot be is refused, or said", "[long]") {
  tests::Recorder recorder;
  jobs::DrapeJob job = finely_across_ball();
  job.subdivide = 1;
  CHECK_THROWS_WITH(jobs::drape(job, recorder), Catch::Contains("`finest` stands in place of `subdivide`"));
  job.subdivide = {};
  job.scene.memory.meshes["coat"] = job.scene.memory.meshes.at("sheet");
  job.over = {"coat"};
  CHECK_THROWS_WITH(jobs::drape(job, recorder), Catch::Contains("`finest` is for one garment"));
  job.over = {};
  CHECK_FALSE(recorder.warned_of("refined_everywhere"));
  geometry::Mesh& sheet = job.scene.memory.meshes["sheet"].mesh;
  const auto tied = geometry::Vertex(geometry::Vertex::size_type(sheet.number_of_vertices()));
  const geometry::Point at = sheet.point(geometry::Vertex(0));
  add_button(sheet, at.x(), at.y(), at.z() + 1e-6);
  jobs::set_seam_ties(sheet, {{geometry::Vertex(0), tied}}, {});
  CHECK_FALSE(jobs::drape(job, recorder).garments.at(0).report.local());
  CHECK(recorder.warned_of("refined_everywhere"));
}

TEST_CASE("drape: with finest, cancelled anywhere it ends with a level that it has come to, or with none",
          "[long]") {
  int with_a_level = 0;
  tests::AfterField all;
  jobs::drape(finely_across_ball(), all);
  for (int k = 1; k < 20; ++k) try {
      tests::AfterField listener(all.asked * k / 20);
      const jobs::Draped d = jobs::drape(finely_across_ball(), listener).garments.at(0);
      INFO(k);
      CHECK(d.outcome() == "interrupted");
      CHECK(d.file.mesh->number_of_vertices() == d.report.levels.back().vertices);
      CHECK_NOTHROW(geometry::check_mesh(d.file.mesh, "test"));
      ++with_a_level;
    } catch (const physics::Cancelled&) {
    }
  CHECK(with_a_level > 0);
}
