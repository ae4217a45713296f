// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/bake.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/sheet.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

const std::set<std::string> maps{"s_displacement.png", "s_maps.json", "s_normal.png"};

/// A sheet whose texture is the sheet itself, a little inside of the unit square.
io::MeshFile textured_sheet(double edge) {
  io::MeshFile file;
  file.mesh = geometry::equilateral_sheet(0.4, 0.4, edge);
  auto texture = geometry::ensure_map(file.mesh, geometry::attribute::texture);
  for (geometry::Halfedge h : file.mesh->halfedges()) {
    const geometry::Point p = file.mesh->point(file.mesh->target(h));
    if (!file.mesh->is_border(h)) texture[h] = {0.5 + 2.2 * p.x(), 0.06 + 2.2 * p.y()};
  }
  return file;
}

/// Waves of a finer sheet, for the maps of a coarse one; in memory.
jobs::BakeJob waves(double height = 0.01) {
  io::MeshFile high = textured_sheet(0.04);
  tests::lift(high.mesh, [&](double x, double) { return height * std::cos(20 * x); });
  jobs::BakeJob job;
  job.low = textured_sheet(0.2);
  job.high = high;
  job.options.size = 48;
  job.options.padding = 2;
  return job;
}

}  // namespace

TEST_CASE("bake: meshes in memory come to the bits of their files") {
  const fs::path folder = tests::empty_folder("bake_memory"), from_files = folder / "files";
  fs::create_directory(from_files);
  tests::Recorder recorder;
  jobs::BakeJob in_memory = waves();
  in_memory.prefix = folder / "s";
  in_memory.check = 2;
  jobs::BakeJob of_files = in_memory;
  io::write_mesh(folder / "low.ply", tests::mesh_of(in_memory.low));
  io::write_mesh(folder / "high.ply", tests::mesh_of(in_memory.high));
  of_files.low = folder / "low.ply";
  of_files.high = folder / "high.ply";
  of_files.prefix = from_files / "s";
  of_files.applied = from_files / "applied.ply";
  const jobs::BakeReport a = jobs::bake(in_memory, recorder), b = jobs::bake(of_files, recorder);
  CHECK(a.ran);
  CHECK(a.maps.largest == Approx(0.01).epsilon(0.1));
  CHECK(a.maps.displacement.texels == b.maps.displacement.texels);
  CHECK(a.maps.normal.texels == b.maps.normal.texels);
  REQUIRE(a.check);
  REQUIRE(b.check);
  CHECK(a.check->deviations.size() == 4);
  CHECK(tests::positions(a.check->applied) == tests::positions(b.check->applied));
  CHECK(tests::positions(io::read_mesh(of_files.applied)) == tests::positions(b.check->applied));
  jobs::Json json_a = to_json(a), json_b = to_json(b);
  CHECK(json_a.at("written").size() == 3);
  for (jobs::Json* json : {&json_a, &json_b}) json->erase("written");
  CHECK(json_a == json_b);
  for (const std::string name : {"s_displacement.png", "s_normal.png"})
    CHECK(tests::bytes_of(folder / name) == tests::bytes_of(from_files / name));
  CHECK(recorder.warnings.empty());
}

TEST_CASE("bake: charts that overlap are warned of, and nothing is written without a prefix") {
  tests::Recorder recorder;
  jobs::BakeJob job = waves();
  for (jobs::MeshInput* input : {&job.low, &job.high}) {
    geometry::Mesh& mesh = std::get<io::MeshFile>(*input).mesh;
    auto texture = *geometry::find_map(mesh, geometry::attribute::texture);
    for (geometry::Halfedge h : mesh.halfedges())
      if (!mesh.is_border(h)) texture[h][1] = std::abs(texture[h][1] - 0.5);
  }
  const jobs::BakeReport report = jobs::bake(job, recorder);
  CHECK(recorder.warned_of("charts_overlap"));
  CHECK(report.maps.overlapping > 100);
  CHECK(report.written.empty());
}

TEST_CASE("bake: a cancelled job leaves nothing, or whole maps") {
  const fs::path folder = tests::empty_folder("bake_cancelled");
  jobs::BakeJob job = waves();
  job.prefix = folder / "s";
  job.check = 1;
  tests::Recorder all;
  const jobs::BakeReport whole = jobs::bake(job, all);
  REQUIRE(whole.check);
  const std::string displacement = tests::bytes_of(folder / "s_displacement.png");
  int empty = 0, written = 0;
  for (int at = 1; at <= all.asked; at = at < 4 ? at + 1 : at + all.asked / 12) {
    fs::remove_all(folder);
    fs::create_directory(folder);
    tests::Recorder recorder(at);
    const jobs::BakeReport report = jobs::bake(job, recorder);
    CHECK(report.ran == report.cancelled);  // before the maps it did not run, after them it was cancelled
    CHECK(report.written.size() == (report.ran ? 3 : 0));
    CHECK(tests::names_in(folder) == (report.ran ? maps : std::set<std::string>{}));
    if (report.ran) CHECK(tests::bytes_of(folder / "s_displacement.png") == displacement);
    ++(report.ran ? written : empty);
  }
  CHECK(empty > 0);
  CHECK(written > 0);
}

TEST_CASE("bake: a job that cannot be is refused before anything is written") {
  const fs::path folder = tests::empty_folder("bake_refused");
  tests::Recorder recorder;
  const jobs::BakeJob good = waves();
  io::write_mesh(folder / "low.ply", tests::mesh_of(good.low));
  const std::string low = tests::bytes_of(folder / "low.ply");
  const auto refused = [&](const auto& spoil) {
    jobs::BakeJob job = good;
    job.prefix = folder / "s";
    spoil(job);
    CHECK_THROWS_AS(jobs::bake(job, recorder), std::invalid_argument);
  };
  refused([&](auto& job) { job.applied = folder / "applied.ply"; });
  refused([](auto& job) { job.prefix.clear(), job.check = 0; });
  refused([](auto& job) { job.check = -1; });
  refused([](auto& job) { job.check = 7; });
  refused([](auto& job) { job.options.size = 0; });
  refused([](auto& job) { job.options.padding = -1; });
  refused([&](auto& job) { job.check = 0, job.applied = folder / "s_normal.png"; });
  refused([&](auto& job) { job.low = folder / "low.ply", job.check = 0, job.applied = folder / "low.ply"; });
  jobs::BakeJob job = good;
  job.prefix = folder / "nowhere" / "s";
  CHECK_THROWS_AS(jobs::bake(job, recorder), std::runtime_error);
  job.prefix = folder / "s";
  tests::lift(std::get<io::MeshFile>(job.high).mesh, [](double, double) { return 1; });
  CHECK_THROWS_AS(jobs::bake(job, recorder), geometry::ContentError);
  job.high = good.high;
  std::get<io::MeshFile>(job.low).mesh = geometry::equilateral_sheet(0.4, 0.4, 0.2);  // without a texture
  CHECK_THROWS_AS(jobs::bake(job, recorder), geometry::ContentError);
  CHECK(tests::names_in(folder) == std::set<std::string>{"low.ply"});
  CHECK(tests::bytes_of(folder / "low.ply") == low);
}

TEST_CASE("bake: two jobs at once in one process give the bits of single runs") {
  tests::Recorder recorder;
  const jobs::BakeJob one = waves(0.01), two = waves(-0.02);
  const jobs::BakeReport single_one = jobs::bake(one, recorder), single_two = jobs::bake(two, recorder);
  jobs::BakeReport both_one, both_two;
  std::thread other([&] {
    tests::Recorder own;
    both_two = jobs::bake(two, own);
  });
  both_one = jobs::bake(one, recorder);
  other.join();
  CHECK(both_one.maps.displacement.texels == single_one.maps.displacement.texels);
  CHECK(both_two.maps.displacement.texels == single_two.maps.displacement.texels);
  CHECK(both_one.maps.displacement.texels != both_two.maps.displacement.texels);
}
