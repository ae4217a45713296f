// SPDX-License-Identifier: GPL-3.0-or-later
// Which end of a drape is written, and what is known of it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/sheet.h"
#include "io/scene/scene.h"
#include "jobs/rest/drape.h"
#include "jobs/rest/drape_starts.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
using geometry::Point;
using geometry::Vertex;

namespace {

/// A garment on a ball of 15 cm, in memory.
jobs::DrapeJob job_on_ball(const geometry::Mesh& garment) {
  jobs::DrapeJob job;
  job.scene.memory.meshes["garment"].mesh = garment;
  job.scene.memory.meshes["ball"].mesh = tests::icosphere(3, 0.15);
  job.scene.settings = io::parse_toml("[garment]\nmesh = \"garment\"\n", "test");
  io::set_value(job.scene.settings, "body.mesh", "ball", "the test");
  io::set_value(job.scene.settings, "body.tolerance", 0.003, "the test");
  job.subdivide = 0;
  return job;
}

/// A ring that is narrower than the ball, its lower border at this height above the middle.
geometry::Mesh ring_at(double y) {
  geometry::Mesh ring = tests::cylinder(0.12, 0.06, 40, 4);
  for (Point& p : ring.points()) p = {p.x(), p.y() + y, p.z()};
  return ring;
}

geometry::Mesh sheet_that_ends_on_ball(double edge = 0.03) {
  geometry::Mesh sheet = geometry::equilateral_sheet(0.3, 0.3, edge);
  for (Point& p : sheet.points()) p = {p.x(), 0.155, p.y() - 0.15};
  return sheet;
}

void add_button(geometry::Mesh& mesh, const Point& at) {
  const Vertex a = mesh.add_vertex(at), b = mesh.add_vertex({at.x(), at.y(), at.z() + 0.01});
  mesh.add_face(a, b, mesh.add_vertex({at.x() + 0.01, at.y(), at.z()}));
}

bool fails_by(const jobs::DrapeJobReport& report, const std::string& code) {
  return std::any_of(report.remarks.begin(), report.remarks.end(),
                     [&](const jobs::DrapeRemark& r) { return r.fails && r.remark.code == code; });
}

double lowest(const geometry::Mesh& mesh) {
  double y = 1e9;
  for (const Vertex v : mesh.vertices()) y = std::min(y, mesh.point(v).y());
  return y;
}

}  // namespace

TEST_CASE("drape: what comes to rest far below where it was worn is no success", "[long]") {
  tests::Recorder recorder;
  const jobs::DrapeJobReport worn = jobs::drape(job_on_ball(ring_at(0.1)), recorder);
  INFO(to_json(worn).dump(1));
  CHECK_FALSE(worn.fails());
  CHECK(worn.garments[0].end.fallen() < 0.03);
  const jobs::DrapeJobReport dropped = jobs::drape(job_on_ball(ring_at(0.3)), recorder);
  const jobs::Draped& d = dropped.garments[0];
  INFO(to_json(dropped).dump(1));
  CHECK(d.report.levels.back().settle.converged);  // it rests on the ball, lower down
  CHECK(d.report.levels.back().settle.touching > 0);
  CHECK(d.end.fallen() == Approx(0.2).margin(0.03));
  CHECK_FALSE(d.rests());
  CHECK(d.outcome().find("falls") == 0);
  CHECK(dropped.fails());
  CHECK(fails_by(dropped, "fallen"));
  CHECK(to_json(dropped).at("end").at("parts_lost") == 1);
}

TEST_CASE("drape: a garment on itself is refused, and gravity beyond numbers is no rest") {
  tests::Recorder recorder;
  jobs::DrapeJob job = job_on_ball(ring_at(0.1));
  job.scene.memory.meshes["ball"] = job.scene.memory.meshes["garment"];
  CHECK_THROWS_AS(jobs::drape(job, recorder), geometry::ContentError);
  job = job_on_ball(ring_at(0.1));
  io::set_value(job.scene.settings, "forces.gravity", 1e300, "the test");
  const jobs::DrapeJobReport heavy = jobs::drape(job, recorder);
  INFO(to_json(heavy).dump(1));
  CHECK(heavy.garments[0].outcome().find("numerical failure") == 0);
  CHECK(heavy.fails());
  CHECK(fails_by(heavy, "numerical_failure"));
}

TEST_CASE("drape: parts that nothing holds are found on every level, with contact and without", "[long]") {
  tests::Recorder recorder;
  geometry::Mesh sheet = sheet_that_ends_on_ball();
  add_button(sheet, {0.35, 0.155, 0});
  add_button(sheet, {0, 0.155, 0.33});
  jobs::DrapeJob job = job_on_ball(sheet);
  io::set_value(job.scene.settings, "garment.attach", false, "the test");
  for (const int levels : {0, 1})
    for (const auto use : {jobs::SelfContactUse::on, jobs::SelfContactUse::off}) {
      job.subdivide = levels;
      job.settings.self_contact = use;
      const jobs::DrapeJobReport report = jobs::drape(job, recorder);
      INFO(to_json(report).dump(1));
      CHECK(report.garments[0].loose.size() == 2);
      CHECK(report.garments[0].rests());
      CHECK(lowest(report.garments[0].file.mesh) > -0.4);
      CHECK_FALSE(report.fails());
    }
}

TEST_CASE("drape: of several starts the better by the judge is taken, whatever its energy") {
  jobs::DrapeStart sound, crossed;
  jobs::EndFacts end;
  end.residual = 5e-4;
  sound.badness = jobs::badness_of(end, {});
  end.crossings = 12;
  crossed.badness = jobs::badness_of(end, {});
  sound.rests = crossed.rests = true;
  sound.energy.weight = 2, crossed.energy.weight = 1;
  CHECK(jobs::is_better(sound, crossed));
  CHECK_FALSE(jobs::is_better(crossed, sound));
  crossed.badness = sound.badness;
  CHECK(jobs::is_better(crossed, sound));
}
