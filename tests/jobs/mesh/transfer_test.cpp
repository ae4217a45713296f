// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/transfer.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/measures.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "jobs/chain/wrinkle.h"
#include "physics/base/progress.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

/// A sheet and what a ridge made of it, in memory.
jobs::TransferJob transfer_of_ridge(double height = 0.02) {
  io::MeshFile sheet;
  sheet.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.03);
  io::DrawnStroke ridge;
  ridge.stroke.name = "ridge";
  ridge.stroke.height = height;
  ridge.stroke.points = {{-0.1, 0.2, 0}, {0.1, 0.2, 0}};
  jobs::WrinkleJob draw;
  draw.garment = sheet;
  draw.strokes = std::vector{ridge};
  jobs::Listener nobody;
  jobs::TransferJob job;
  job.original = sheet;
  job.wrinkled = jobs::wrinkle(draw, nobody).garment;
  return job;
}

double highest(const io::MeshFile& file) {
  double z = 0;
  for (const geometry::Point& p : file.mesh->points()) z = std::max(z, p.z());
  return z;
}

}  // namespace

TEST_CASE("transfer: meshes in memory come to the bits of their files") {
  const fs::path folder = tests::empty_folder("transfer_memory");
  tests::Recorder recorder;
  const jobs::TransferJob in_memory = transfer_of_ridge();
  jobs::TransferJob of_files = in_memory;
  io::write_mesh(folder / "sheet.ply", tests::mesh_of(in_memory.original));
  io::write_mesh(folder / "ridged.ply", tests::mesh_of(in_memory.wrinkled));
  of_files.original = folder / "sheet.ply";
  of_files.wrinkled = folder / "ridged.ply";
  of_files.output = folder / "moved.ply";
  const jobs::TransferReport a = jobs::transfer(in_memory, recorder), b = jobs::transfer(of_files, recorder);
  CHECK(a.moved.copied == tests::mesh_of(in_memory.original).mesh->number_of_vertices());
  CHECK(a.moved.unchanged < a.moved.copied);
  CHECK(highest(a.result) > 0.003);
  CHECK(tests::positions(a.result) == tests::positions(b.result));
  CHECK(to_json(a) == to_json(b));
  CHECK(tests::positions(io::read_mesh(folder / "moved.ply")) == tests::positions(b.result));
  CHECK(recorder.warnings.empty());
}

TEST_CASE("transfer: a seam with vertices amid its edges holds in every job, and its file keeps its faces") {
  const fs::path folder = tests::empty_folder("transfer_seam");
  const std::string faces = "f 1 2 3\nf 1 3 4\nf 2 6 5\nf 6 7 5\nf 5 7 3\n";
  std::ofstream(folder / "yoke.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0.5 0\nv 2 0 0\nv 2 1 0\n" +
                                            faces;
  io::DrawnStroke ridge;
  ridge.stroke.name = "across";
  ridge.stroke.height = 0.1;
  ridge.stroke.points = {{0.5, 0.7, 0}, {1.5, 0.7, 0}};
  tests::Recorder recorder;
  jobs::WrinkleJob draw;
  draw.garment = folder / "yoke.obj";
  draw.strokes = std::vector{ridge};
  jobs::TransferJob job;
  job.original = folder / "yoke.obj";
  job.wrinkled = jobs::wrinkle(draw, recorder).garment;
  job.output = folder / "ridged.obj";
  CHECK(geometry::measure(tests::mesh_of(job.wrinkled).mesh).components == 1);
  CHECK(recorder.warned_of("seams_joined"));
  const jobs::TransferReport report = jobs::transfer(job, recorder);
  CHECK(report.moved.copied == 7);
  CHECK(report.moved.interpolated == 0);
  CHECK(tests::bytes_of(folder / "ridged.obj").find(faces) != std::string::npos);
  CHECK(recorder.warned_of("slits"));  // the fold bends the seam, and the file's faces are not split there
}

TEST_CASE("transfer: polygons stay whole from OBJ to OBJ, and are warned of elsewhere") {
  const fs::path folder = tests::empty_folder("transfer_polygons");
  tests::Recorder recorder;
  std::ofstream(folder / "quad.obj") << "# drawn by hand\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  std::ofstream(folder / "raised.obj") << "v 0 0 0.5\nv 1 0 0.5\nv 1 1 0.5\nv 0 1 0.5\nf 1 2 3 4\n";
  jobs::TransferJob job;
  job.original = folder / "quad.obj";
  job.wrinkled = folder / "raised.obj";
  job.rest = folder / "quad.obj";
  job.output = folder / "moved.obj";
  const jobs::TransferReport report = jobs::transfer(job, recorder);
  REQUIRE(report.obj_text);
  CHECK(tests::bytes_of(job.output) == *report.obj_text);
  CHECK(report.obj_text->find("# drawn by hand") != std::string::npos);
  CHECK(report.obj_text->find("f 1 2 3 4") != std::string::npos);
  CHECK_FALSE(recorder.warned_of("polygons_cut"));
  CHECK_FALSE(recorder.warned_of("slits"));
  job.output = folder / "moved.ply";
  CHECK_FALSE(jobs::transfer(job, recorder).obj_text);
  CHECK(recorder.warned_of("polygons_cut"));
}

TEST_CASE("transfer: a cancelled job leaves nothing") {
  const fs::path folder = tests::empty_folder("transfer_cancelled");
  jobs::TransferJob job = transfer_of_ridge();
  job.output = folder / "moved.ply";
  tests::Recorder all;
  jobs::transfer(job, all);
  REQUIRE(all.asked >= 2);
  for (int at = 1; at <= all.asked; at += std::max(1, all.asked / 30)) {
    fs::remove(job.output);
    tests::Recorder recorder(at);
    CHECK_THROWS_AS(jobs::transfer(job, recorder), physics::Cancelled);
    CHECK(tests::names_in(folder).empty());
  }
}

TEST_CASE("transfer: a job that cannot be is refused before anything is written") {
  const fs::path folder = tests::empty_folder("transfer_refused");
  tests::Recorder recorder;
  const jobs::TransferJob good = transfer_of_ridge();
  io::write_mesh(folder / "sheet.ply", tests::mesh_of(good.original));
  const std::string sheet = tests::bytes_of(folder / "sheet.ply");
  jobs::TransferJob job = good;
  job.original = job.output = folder / "sheet.ply";
  CHECK_THROWS_AS(jobs::transfer(job, recorder), std::invalid_argument);
  job = good;
  job.rest = job.output = folder / "sheet.ply";
  CHECK_THROWS_AS(jobs::transfer(job, recorder), std::invalid_argument);
  job = good;
  job.output = folder / "moved.gltf";
  CHECK_THROWS_AS(jobs::transfer(job, recorder), std::invalid_argument);
  job.output = folder / "nowhere" / "moved.ply";
  CHECK_THROWS_AS(jobs::transfer(job, recorder), std::runtime_error);
  job.output = folder / "moved.ply";
  job.options.max_distance = 0;
  CHECK_THROWS_AS(jobs::transfer(job, recorder), std::invalid_argument);
  job.options = {};
  job.rest = good.original;  // which has fewer vertices than the wrinkled mesh
  CHECK_THROWS_AS(jobs::transfer(job, recorder), geometry::ContentError);
  job.rest.reset();
  job.wrinkled = good.original;  // which knows no rest
  CHECK_THROWS_AS(jobs::transfer(job, recorder), geometry::ContentError);
  CHECK(tests::names_in(folder) == std::set<std::string>{"sheet.ply"});
  CHECK(tests::bytes_of(folder / "sheet.ply") == sheet);
}

TEST_CASE("transfer: two jobs at once in one process give the bits of single runs") {
  tests::Recorder recorder;
  const jobs::TransferJob one = transfer_of_ridge(0.02), two = transfer_of_ridge(-0.03);
  const jobs::TransferReport single_one = jobs::transfer(one, recorder),
                             single_two = jobs::transfer(two, recorder);
  jobs::TransferReport both_one, both_two;
  std::thread other([&] {
    tests::Recorder own;
    both_two = jobs::transfer(two, own);
  });
  both_one = jobs::transfer(one, recorder);
  other.join();
  CHECK(tests::positions(both_one.result) == tests::positions(single_one.result));
  CHECK(tests::positions(both_two.result) == tests::positions(single_two.result));
  CHECK(tests::positions(both_one.result) != tests::positions(both_two.result));
}

TEST_CASE("transfer: the report names the corners of the faces that cross, and none where nothing does") {
  io::MeshFile file;
  const auto triangle = [&](geometry::Point a, geometry::Point b, geometry::Point c) {
    file.mesh->add_face(file.mesh->add_vertex(a), file.mesh->add_vertex(b), file.mesh->add_vertex(c));
  };
  triangle({5, 0, 0}, {6, 0, 0}, {5, 1, 0});  // far from the others
  triangle({-1, -1, 0}, {1, -1, 0}, {0, 1, 0});
  triangle({0, 0, -1}, {0.1, 0, 1}, {-0.1, 0, 1});  // through that one
  jobs::TransferJob job;
  job.original = job.wrinkled = file;
  job.rest = file;
  tests::Recorder recorder;
  const jobs::Json crossed = to_json(jobs::transfer(job, recorder)).at("crossings");
  CHECK(crossed.at("pairs") == 1);
  CHECK(crossed.at("corners") == jobs::Json({3, 4, 5, 6, 7, 8}));
  for (int v = 6; v < 9; ++v) file.mesh->point(geometry::Vertex(v)) += geometry::Vector(0, 0, 3);
  job.original = job.wrinkled = file;
  job.rest = file;
  CHECK_FALSE(to_json(jobs::transfer(job, recorder)).at("crossings").contains("corners"));
}

TEST_CASE("transfer: where the body comes through the mesh is reported with its depth, and warned of") {
  tests::Recorder recorder;
  const auto on_ball = [](double edge) {  // 3 mm off a ball of 10 cm, by vertices
    io::MeshFile file;
    file.mesh = geometry::equilateral_sheet(0.16, 0.16, edge);
    for (geometry::Point& p : file.mesh->points()) p = {p.x(), p.y() - 0.08, 0};
    return file;
  };
  const auto bent = [](io::MeshFile file) {
    auto rest = geometry::ensure_map(file.mesh, geometry::attribute::rest_position);
    for (const geometry::Vertex v : file.mesh->vertices()) {
      const geometry::Point p = file.mesh->point(v);
      rest[v] = {p.x(), p.y(), p.z()};
      const double length = std::sqrt(p.x() * p.x() + p.y() * p.y() + 0.01);
      file.mesh->point(v) = {0.103 * p.x() / length, 0.103 * p.y() / length, 0.103 * 0.1 / length};
    }
    return file;
  };
  jobs::TransferJob job;
  job.wrinkled = bent(on_ball(0.01));
  io::MeshFile ball;
  ball.mesh = tests::icosphere(4, 0.1);
  for (const double edge : {0.01, 0.08}) {
    job.original = on_ball(edge);
    job.body.reset();
    CHECK(to_json(jobs::transfer(job, recorder)).at("end").at("body").is_null());
    CHECK_FALSE(recorder.warned_of("body_comes_through"));
    job.body = ball;
    const jobs::TransferReport report = jobs::transfer(job, recorder);
    REQUIRE(report.end.body);
    CHECK((report.end.body->pierced_faces > 0) == (edge > 0.05));
    CHECK((report.end.body->depth > 0.002) == (edge > 0.05));
    CHECK(report.end.body->vertices_inside == 0);
    CHECK(recorder.warned_of("body_comes_through") == (edge > 0.05));
  }
}
