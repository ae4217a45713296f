// SPDX-License-Identifier: GPL-3.0-or-later
// Garments brought from the body that they were made for.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "geometry/figure/shape_body.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/refine/subdivide.h"
#include "geometry/rest/rest_metric.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/rest/drape.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

/// Our shirt, made for our mannequin, on a taller and wider one that stands elsewhere.
jobs::DrapeJob on_another(const std::string& garment) {
  jobs::DrapeJob job;
  auto& meshes = job.scene.memory.meshes;
  for (const std::string name : {"mannequin.obj", garment.c_str()})
    meshes[name] = io::read_mesh(tests::source_dir() / "meshes" / name);
  meshes["tall.obj"] = meshes["mannequin.obj"];
  geometry::Mesh& tall = meshes["tall.obj"].mesh;
  geometry::shape_body(tall, {1.86, 0.92, 0, 0});
  for (const geometry::Vertex v : tall.vertices())
    tall.point(v) = tall.point(v) + geometry::Vector(0.7, 0, -0.3);
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"" + garment + "\"\n", "test");
  const auto set = [&](const std::string& path, const io::Json& value) {
    io::set_value(job.scene.settings, path, value, "the test");
  };
  set("body.mesh", "tall.obj");
  set("body.tolerance", 0.004);
  set("garment.allow_crossings", 20);
  job.settings.self_contact = jobs::SelfContactUse::off;
  job.settings.made_for = "mannequin.obj";
  job.subdivide = 0;
  return job;
}

std::vector<double> lengths_at_rest(geometry::Mesh mesh) {
  const auto rest = geometry::ensure_rest_lengths(mesh);
  std::vector<double> lengths;
  for (const geometry::Edge e : mesh.edges()) lengths.push_back(rest[e]);
  return lengths;
}

}  // namespace

TEST_CASE("placing: a garment is brought from its own body to another one, and rests there in its own size",
          "[release]") {
  for (const int levels : {0, 1}) {
    jobs::DrapeJob job = on_another("skirt.obj");
    job.subdivide = levels;
    geometry::Mesh as_given = job.scene.memory.meshes.at("skirt.obj").mesh;
    tests::Recorder recorder;
    const jobs::DrapeJobReport report = jobs::drape(job, recorder);
    const jobs::Draped& d = report.garments[0];
    CHECK(d.succeeds());
    REQUIRE(d.placed);
    CHECK(d.placed->made_for == "mannequin.obj");
    CHECK(d.placed->height_scale == Approx(1.86 / 1.70).epsilon(0.01));
    CHECK(d.placed->mean_move > 0.7);
    CHECK(d.placed->inside_share < 0.1);
    CHECK(*d.placed->limbs[0].turn < 4);
    CHECK_FALSE(recorder.warned_of("pose_differs"));
    if (levels > 0) geometry::loop_subdivide(as_given, levels);
    CHECK(lengths_at_rest(d.file.mesh) == lengths_at_rest(as_given));
    const jobs::Json told = to_json(report)["placed"];
    CHECK(told["turned"]["left_leg"].get<double>() < 4);
    CHECK(told["made_for"] == "mannequin.obj");
  }
}

TEST_CASE("placing: on its own body a garment comes to the rest that it has without being brought",
          "[release]") {
  jobs::DrapeJob job = on_another("skirt.obj");
  io::set_value(job.scene.settings, "body.mesh", "mannequin.obj", "the test");
  tests::Recorder recorder;
  const jobs::DrapeJobReport brought = jobs::drape(job, recorder);
  job.settings.made_for.clear();
  const jobs::DrapeJobReport lay = jobs::drape(job, recorder);
  CHECK_FALSE(lay.garments[0].placed);
  const geometry::Mesh &a = brought.garments[0].file.mesh, &b = lay.garments[0].file.mesh;
  double farthest = 0;
  for (const geometry::Vertex v : a.vertices())
    farthest = std::max(farthest, std::sqrt((a.point(v) - b.point(v)).squared_length()));
  CHECK(farthest < 1e-3);
}

TEST_CASE("placing: lines are drawn where the garment lies, and brought with it before they come to rest",
          "[release]") {
  const jobs::DrapeJob brought = on_another("skirt.obj");
  jobs::WrinkleJob job;
  job.garment = brought.scene.memory.meshes.at("skirt.obj");
  io::DrawnStroke ridge;
  ridge.stroke.name = "front";
  ridge.stroke.height = 0.015;
  for (const geometry::Point& p : std::get<io::MeshFile>(job.garment).mesh->points())
    if (std::abs(p.x()) < 0.012 && p.z() > 0 && p.y() < 0.8) ridge.stroke.points.push_back(p);
  std::ranges::sort(ridge.stroke.points, std::greater<>(), [](const auto& p) { return p.y(); });
  job.strokes = std::vector{ridge};
  const fs::path mannequin = tests::source_dir() / "meshes/mannequin.obj";
  job.made_for = mannequin;
  tests::Recorder recorder;
  CHECK_THROWS_WITH(jobs::wrinkle(job, recorder),
                    Catch::Contains("`made_for`") && Catch::Contains("`settle`"));
  job.settle = brought.scene;
  const jobs::WrinkleReport report = jobs::wrinkle(job, recorder);
  REQUIRE(report.rest);
  REQUIRE(report.rest->placed);
  CHECK(report.rest->rests());
  CHECK(report.rest->placed->height_scale == Approx(1.86 / 1.70).epsilon(0.01));
  CHECK(report.drawn.round.report.lines.size() == 1);
  double x = 0;
  for (const geometry::Point& p : report.garment.mesh->points()) x += p.x();
  CHECK(x / double(report.garment.mesh->number_of_vertices()) == Approx(0.7).margin(0.02));
  CHECK(to_json(report)["at_rest"].contains("placed"));
  job.settle->settings.root->erase("body");
  io::set_value(job.settle->settings, "pins.0.loop", "top", "the test");
  CHECK_THROWS_WITH(jobs::wrinkle(job, recorder), Catch::Contains("name the other one with `body`"));
}

TEST_CASE("placing: what cannot be brought is refused, and what lies in the body is told what helps") {
  jobs::DrapeJob job = on_another("skirt.obj");
  tests::Recorder recorder;
  job.scene.memory.meshes["ball.obj"].mesh = tests::icosphere(3, 0.8);
  job.settings.made_for = "ball.obj";
  CHECK_THROWS_WITH(jobs::drape(job, recorder), Catch::StartsWith("ball.obj: the body has no"));
  CHECK_THROWS_WITH(jobs::drape(job, recorder), Catch::Contains("`made_for`"));
  job = on_another("skirt.obj");
  job.scene.settings.root->erase("body");
  io::set_value(job.scene.settings, "pins.0.loop", "top", "the test");
  CHECK_THROWS_AS(jobs::drape(job, recorder), std::invalid_argument);
}
