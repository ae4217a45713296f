// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/quality.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "jobs/chain/wrinkle.h"
#include "physics/base/progress.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_paths.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

constexpr double ridge_height = 0.012, ridge_width = 0.08;

io::MeshFile plain_sheet() {
  io::MeshFile file;
  file.mesh = geometry::equilateral_sheet(0.6, 0.5, 0.02);
  return file;
}

std::vector<io::DrawnStroke> one_ridge() {
  io::DrawnStroke drawn;
  drawn.stroke.name = "ridge";
  drawn.stroke.height = ridge_height;
  drawn.stroke.width = ridge_width;
  drawn.stroke.points = {{0.013, -0.03, 0}, {0.02, 0.25, 0}, {0.013, 0.53, 0}};
  return {drawn};
}

jobs::WrinkleReport sheet_wrinkled(geometry::InsertionRule rule, const jobs::MeshInput& garment,
                                   const fs::path& output = {}) {
  jobs::WrinkleJob job;
  job.garment = garment;
  job.strokes = one_ridge();
  job.options.insertion.rule = rule;
  job.output = output;
  tests::Recorder recorder;
  return jobs::wrinkle(job, recorder);
}

const jobs::QualityMeasure& measure_of(const jobs::QualityReport& report, const std::string& id) {
  for (const jobs::QualityMeasure& m : report.measures)
    if (m.id == id) return m;
  throw std::logic_error("no measure " + id);
}

jobs::QualityReport quality_of(const jobs::QualityJob& job) {
  tests::Recorder recorder;
  return jobs::quality(job, recorder);
}

}  // namespace

TEST_CASE("quality: a fold of rule fold meets its targets, one of rule safe misses them, both by name") {
  for (const bool smooth : {true, false}) {
    CAPTURE(smooth);
    jobs::QualityJob job;
    job.mesh =
        sheet_wrinkled(smooth ? geometry::InsertionRule::fold : geometry::InsertionRule::safe, plain_sheet())
            .garment;
    job.base = plain_sheet();
    job.strokes = one_ridge();
    const jobs::QualityReport report = quality_of(job);
    INFO(to_json(report).dump(1));
    CHECK(report.lines_from == "file");
    CHECK(report.base_from == "file");
    REQUIRE(report.measures.size() == 9);
    CHECK(report.lines.at(0).crest_height.value() == Approx(ridge_height).epsilon(0.1));
    for (const char* id : {"B1", "B2", "B3", "B5"}) {
      CAPTURE(id);
      REQUIRE(measure_of(report, id).value);
      CHECK(measure_of(report, id).line == "ridge");
      CHECK(measure_of(report, id).at_most);
      if (smooth && id != std::string("B3")) CHECK(measure_of(report, id).met());
      if (smooth) CHECK(measure_of(report, id).value.value() <= 0.012);
    }
    CHECK(measure_of(report, "B2").met() == smooth);
    CHECK(report.met() == std::all_of(report.measures.begin(), report.measures.end(),
                                      [](const jobs::QualityMeasure& m) { return m.met(); }));
    CHECK(measure_of(report, "B9").value.value() ==
          Approx(static_cast<double>(report.whole.vertices) / plain_sheet().mesh->number_of_vertices()));
  }
}

TEST_CASE("quality: a wrinkled PLY tells its strokes and its garment, or where it lay, until it has moved") {
  const fs::path folder = tests::empty_folder("quality");
  io::write_mesh(folder / "sheet.ply", plain_sheet());
  sheet_wrinkled(geometry::InsertionRule::fold, folder / "sheet.ply", folder / "w.ply");
  jobs::QualityJob job;
  job.mesh = folder / "w.ply";
  const jobs::QualityReport with_garment = quality_of(job);
  CHECK(with_garment.base_from == "garment");
  CHECK(with_garment.lines_from == "record");
  fs::remove(folder / "sheet.ply");
  const jobs::QualityReport alone = quality_of(job);
  CHECK(alone.base_from == "rest_positions");
  CHECK_FALSE(alone.before);
  for (const char* id : {"B1", "B2", "B3", "B4", "B5"}) {
    CAPTURE(id);
    CHECK(measure_of(alone, id).value.value() ==
          Approx(measure_of(with_garment, id).value.value()).epsilon(0.15).margin(5e-4));
  }
  CHECK(measure_of(alone, "B9").why != "");

  io::MeshFile moved = io::read_mesh(folder / "w.ply");
  for (geometry::Vertex v : moved.mesh->vertices())
    moved.mesh->point(v) = moved.mesh->point(v) + geometry::Vector(0, 0, 0.05);
  job.mesh = moved;
  const jobs::QualityReport hung = quality_of(job);
  CHECK(hung.lines.empty());
  CHECK(measure_of(hung, "B1").why.find("has moved") != std::string::npos);
  CHECK(measure_of(hung, "B6").value.value() == Approx(with_garment.whole.angle_defect));
}

TEST_CASE("quality: cloth that moved is known by its places, though lines run all over it") {
  jobs::WrinkleJob wide;
  wide.garment = plain_sheet();
  std::vector<io::DrawnStroke> ridge = one_ridge();
  ridge[0].stroke.width = 0.5;  // no cloth is a width away from it
  wide.strokes = ridge;
  wide.options.insertion.rule = geometry::InsertionRule::fold;
  tests::Recorder recorder;
  const io::MeshFile drawn = jobs::wrinkle(wide, recorder).garment;
  jobs::QualityJob job;
  job.mesh = drawn;
  CHECK(quality_of(job).lines.size() == 1);
  io::MeshFile moved = drawn;
  // It sags along itself, and out of its plane at the hem.
  for (geometry::Vertex v : moved.mesh->vertices()) {
    const auto& p = moved.mesh->point(v);
    moved.mesh->point(v) = {p.x(), 0.97 * p.y(), p.z() + 0.05 * p.y() * p.y()};
  }
  job.mesh = moved;
  const jobs::QualityReport hung = quality_of(job);
  CHECK(hung.lines.empty());
  CHECK(measure_of(hung, "B1").why.find("has moved") != std::string::npos);
}

TEST_CASE("quality: cloth that was only drawn on has not moved, though low folds cover a coarse garment") {
  io::MeshFile
      tube;  // its facets lie 2.5 mm off a round one; folds stand beside their place by their normals
  constexpr int around = 16, rings = 12;
  for (int j = 0; j < rings; ++j)
    for (int i = 0; i < around; ++i) {
      const double a = 2 * 3.14159265358979 * (i + 0.5 * (j % 2)) / around;
      tube.mesh->add_vertex({(0.12 + 0.02 * (j % 3)) * std::cos(a), 0.04 * j, 0.12 * std::sin(a)});
    }
  const auto at = [](int i, int j) {
    return geometry::Vertex(static_cast<geometry::Vertex::size_type>(j * around + i % around));
  };
  for (int j = 0; j + 1 < rings; ++j)
    for (int i = 0; i < around; ++i) {
      const int odd = j % 2;
      tube.mesh->add_face(at(i, j), at(i + odd, j + 1), at(i + 1, j));
      tube.mesh->add_face(at(i + 1 - odd, j), at(i, j + 1), at(i + 1, j + 1));
    }
  REQUIRE(tube.mesh->number_of_faces() == 2 * around * (rings - 1));
  jobs::WrinkleJob job;
  job.garment = tube;
  std::vector<io::DrawnStroke> folds;
  for (int i = 0; i < 3; ++i) {
    io::DrawnStroke fold;
    fold.stroke.name = "fold " + std::to_string(i);
    fold.stroke.height = 0.005;
    fold.stroke.width = 0.25;
    const double y = 0.08 + 0.12 * i;
    fold.stroke.points = {{-0.1, y, 0.08}, {0, y + 0.01, 0.12}, {0.1, y, 0.08}};
    folds.push_back(fold);
  }
  job.strokes = folds;
  job.options.insertion.rule = geometry::InsertionRule::fold;
  tests::Recorder recorder;
  jobs::QualityJob drawn;
  drawn.mesh = jobs::wrinkle(job, recorder).garment;
  const jobs::QualityReport report = quality_of(drawn);
  INFO(to_json(report)["measures"].dump(1));
  CHECK(report.lines.size() == 3);
}

TEST_CASE("quality: knobs and thin faces that a garment may have had before its folds are no verdict") {
  io::MeshFile spiked = plain_sheet();
  for (geometry::Vertex v : spiked.mesh->vertices())
    spiked.mesh->point(v) = spiked.mesh->point(v) + geometry::Vector(0, 0, v.idx() % 3 == 0 ? 0.01 : 0);
  jobs::QualityJob job;
  job.mesh = spiked;
  const jobs::QualityReport unknown = quality_of(job);
  const jobs::QualityMeasure& knobs = measure_of(unknown, "B6");
  REQUIRE(knobs.value.value() > 40);
  CHECK_FALSE(knobs.at_most);
  CHECK(knobs.met());
  CHECK(knobs.why.find("`base`") != std::string::npos);
  job.base = plain_sheet();
  const jobs::QualityReport known = quality_of(job);
  CHECK_FALSE(measure_of(known, "B6").met());
  CHECK(measure_of(known, "B6").why.empty());
}

TEST_CASE("quality: a mesh without a record is measured along the lines that it carries, or as a whole") {
  io::MeshFile file = sheet_wrinkled(geometry::InsertionRule::fold, plain_sheet()).garment;
  io::MeshFile bare;
  bare.mesh = file.mesh;
  jobs::QualityJob job;
  job.mesh = bare;
  const jobs::QualityReport carried = quality_of(job);
  CHECK(carried.lines_from == "mesh");
  REQUIRE(carried.lines.size() == 1);
  CHECK(carried.lines[0].crest_height.value() == Approx(ridge_height).epsilon(0.02));
  CHECK(measure_of(carried, "B1").value.value() < 0.003);
  job.mesh = plain_sheet();
  const jobs::QualityReport whole = quality_of(job);
  CHECK(whole.lines_from == "none");
  CHECK(whole.base_from == "none");
  CHECK_FALSE(measure_of(whole, "B1").value);
  CHECK(measure_of(whole, "B6").value.value() == Approx(0).margin(1e-9));
  CHECK(measure_of(whole, "B7").value.value() > 25);
  CHECK(measure_of(whole, "B8").value);
  CHECK(whole.met());
}

TEST_CASE("quality: the worst places are where the cloth is knobbly") {
  io::MeshFile spiked = plain_sheet();
  geometry::Vertex tip;
  for (geometry::Vertex v : spiked.mesh->vertices())
    if (!tip.is_valid() || CGAL::squared_distance(spiked.mesh->point(v), geometry::Point(0.1, 0.2, 0)) <
                               CGAL::squared_distance(spiked.mesh->point(tip), geometry::Point(0.1, 0.2, 0)))
      tip = v;
  spiked.mesh->point(tip) = spiked.mesh->point(tip) + geometry::Vector(0, 0, 0.01);
  jobs::QualityJob job;
  job.mesh = spiked;
  const jobs::QualityReport report = quality_of(job);
  REQUIRE(!report.knobs.empty());
  CHECK(report.knobs[0].place == spiked.mesh->point(tip));
  CHECK(report.knobs[0].defect > 0);
  CHECK(report.defects.size() == spiked.mesh->num_vertices());
}

TEST_CASE("quality: wrong options, and a listener that cancels") {
  jobs::QualityJob job;
  job.mesh = plain_sheet();
  job.width = 0;
  tests::Recorder recorder;
  CHECK_THROWS_AS(jobs::quality(job, recorder), std::invalid_argument);
  job.width.reset();
  job.max_distance = -1;
  CHECK_THROWS_AS(jobs::quality(job, recorder), std::invalid_argument);
  job.max_distance.reset();
  tests::Recorder cancels(1);
  CHECK_THROWS_AS(jobs::quality(job, cancels), physics::Cancelled);
}

TEST_CASE("quality: the report of wrinkle tells it before the lines, drawn and smoothed, under every rule") {
  for (const auto rule :
       {geometry::InsertionRule::fold, geometry::InsertionRule::safe, geometry::InsertionRule::paper}) {
    const jobs::WrinkleReport report = sheet_wrinkled(rule, plain_sheet());
    const jobs::DrawnQuality& q = report.quality.value();
    INFO(to_json(report)["quality"].dump(1));
    CHECK_FALSE(q.before.crest_ripple);
    CHECK(q.before.angle_defect == Approx(0).margin(1e-9));
    REQUIRE(q.drawn.crest_ripple);
    REQUIRE(q.after.crest_ripple);
    CHECK(q.after.worst_line == "ridge");
    CHECK(q.after.min_angle_deg > 0);
    if (rule != geometry::InsertionRule::fold) continue;
    jobs::QualityJob job;  // the command's figures, over the garment itself
    job.mesh = report.garment;
    job.base = plain_sheet();
    job.strokes = one_ridge();
    const jobs::QualityReport found = quality_of(job);
    CHECK(q.after.angle_defect == Approx(found.whole.angle_defect));
    CHECK(q.after.crest_ripple.value() == Approx(measure_of(found, "B1").value.value()).margin(1e-3));
    CHECK(q.after.crest_ripple.value() <= 0.003);
    CHECK(q.after.lateral.value() <= 0.005);
    CHECK(q.after.angle_defect <= 40);
    CHECK(q.after.min_angle_deg >= 15);
  }
}

TEST_CASE("quality: the hem of the demo's skirt is as smooth as its target where ten steep folds run over it",
          "[long]") {
  jobs::WrinkleJob job;
  job.garment = tests::source_dir() / "meshes/skirt.obj";
  job.strokes = tests::source_dir() / "meshes/strokes/figure_skirt.json";
  tests::Recorder recorder;
  jobs::QualityJob judged;
  judged.mesh = jobs::wrinkle(job, recorder).garment;
  const jobs::QualityReport report = quality_of(judged);
  const jobs::QualityMeasure& hem = measure_of(report, "B8");
  CHECK(*hem.value <= 10);
  CHECK(hem.met());
  CHECK(measure_of(report, "B7").met());
}
