// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/mesh/follow.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/vertex_attributes.h"
#include "physics/base/progress.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
namespace fs = std::filesystem;
using geometry::Vector;

namespace {

constexpr double radius = 0.3;

/// A ball with keys: "tall" along y, and two bumps side by side that together are more than either.
io::MeshFile body() {
  io::MeshFile file;
  file.mesh = tests::icosphere(4, radius);
  std::vector<Vector> tall, left, right;
  for (const geometry::Point& p : file.mesh->points()) {
    const auto bump = [&](double z) {
      const double off = std::sqrt(CGAL::squared_distance(p, geometry::Point(0.29, 0, z))) / 0.06;
      return 0.15 * std::exp(-off * off) * (p - CGAL::ORIGIN);
    };
    tall.emplace_back(0, 0.2 * p.y(), 0);
    left.push_back(bump(-0.05)), right.push_back(bump(0.05));
  }
  geometry::set_shape_key(file.mesh, "tall", tall);
  geometry::set_shape_key(file.mesh, "left", left);
  geometry::set_shape_key(file.mesh, "right", right);
  return file;
}

jobs::FollowJob job_on_ball() {
  io::MeshFile garment;
  garment.mesh = tests::icosphere(3, radius + 0.004);
  jobs::FollowJob job;
  job.garment = garment;
  job.body = body();
  job.mixes = 20;
  return job;
}

}  // namespace

TEST_CASE("follow: a garment gets the keys of its body, which keep it out, alone and mixed") {
  jobs::FollowJob job = job_on_ball();
  tests::Recorder recorder;
  const jobs::FollowReport report = jobs::follow(job, recorder);
  std::vector<std::string> names = geometry::shape_key_names(report.garment.mesh);
  REQUIRE(names.size() >= 3);
  CHECK(std::vector(names.begin(), names.begin() + 3) == std::vector<std::string>{"tall", "left", "right"});
  CHECK(names.size() == 3 + report.correctives.size());
  for (const jobs::FollowedKey& key : report.keys) {
    CHECK(key.vertices > 0);
    CHECK(key.poke_at_half < 2e-4);
    CHECK(key.poke_at_full < 2e-4);
  }
  CHECK(report.keys[0].farthest == Approx(0.06).epsilon(0.1));
  std::size_t still = 0;  // of the key of one bump: sparse
  for (const Vector& move : geometry::shape_key(report.garment.mesh, "left"))
    still += move == Vector(0, 0, 0);
  CHECK(still > report.garment.mesh->num_vertices() / 2);
  CHECK(report.mixes.size() == 20);
  CHECK(report.mixes_at(1) < 0.003);
  CHECK(jobs::follow(job, recorder).mixes == report.mixes);  // the same again
}

TEST_CASE("follow: pairs that come through together get a key of their own") {
  jobs::FollowJob job = job_on_ball();
  job.poke = 1e-9;  // every pair that comes through at all
  jobs::Listener nobody;
  const jobs::FollowReport report = jobs::follow(job, nobody);
  for (const jobs::FollowedKey& made : report.correctives) {
    CHECK(made.name.find('*') != std::string::npos);
    CHECK(made.poke_at_full < 2e-4);
    CHECK_FALSE(geometry::shape_key(report.garment.mesh, made.name).empty());
  }
  job.poke = 10;
  CHECK(jobs::follow(job, nobody).correctives.empty());
}

TEST_CASE("follow: keys of other files are named after them, and only keys that are asked for are followed") {
  const fs::path folder = tests::empty_folder("follow_files");
  jobs::FollowJob job = job_on_ball();
  io::MeshFile heavy = body();
  for (const geometry::Vertex v : heavy.mesh->vertices())
    heavy.mesh->point(v) = CGAL::ORIGIN + 1.1 * (heavy.mesh->point(v) - CGAL::ORIGIN);
  io::write_mesh(folder / "heavy.ply", heavy);
  job.body_keys = {folder / "heavy.ply"};
  job.keys = {"tall"};
  job.mixes = 0;
  job.output = folder / "out.ply";
  jobs::Listener nobody;
  jobs::follow(job, nobody);
  const io::MeshFile written = io::read_mesh(folder / "out.ply");
  CHECK(geometry::shape_key_names(written.mesh) == std::vector<std::string>{"tall", "heavy"});
  job.output = folder / "out.obj";
  CHECK_THROWS_WITH(jobs::follow(job, nobody), Catch::Contains("has no place for shape keys"));
  job.output.clear();
  job.keys = {"wide"};
  CHECK_THROWS_WITH(jobs::follow(job, nobody), Catch::Contains("has no shape key 'wide'"));
  job.keys.clear();
  io::MeshFile other;
  other.mesh = tests::icosphere(2, radius);
  job.body_keys = {other};
  CHECK_THROWS_AS(jobs::follow(job, nobody), geometry::ContentError);
  job.body_keys.clear();
  job.body = other;
  CHECK_THROWS_WITH(jobs::follow(job, nobody), Catch::Contains("has no shape keys to follow"));
}

TEST_CASE("follow: it can be cancelled, and writes nothing then") {
  const fs::path folder = tests::empty_folder("follow_cancelled");
  jobs::FollowJob job = job_on_ball();
  job.output = folder / "out.glb";
  tests::Recorder recorder(5);
  CHECK_THROWS_AS(jobs::follow(job, recorder), physics::Cancelled);
  CHECK(fs::is_empty(folder));
}
