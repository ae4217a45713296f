// SPDX-License-Identifier: GPL-3.0-or-later
// The scenes with known answers, as everybody can run them: scenes/validation/*.toml.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bridge/arrays/convert.h"
#include "io/mesh/mesh_file.h"
#include "physics/body/moving_body.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;
using physics::Vec3;

namespace {

const std::string scenes = FURROW_SOURCE_DIR "/scenes/validation/";

struct Result {
  json report;
  std::vector<Vec3> before, after;
};

std::vector<Vec3> positions(const std::string& path) {
  return bridge::positions_of(io::read_mesh(path).mesh);
}

Result run_scene(const std::string& name, const std::string& more = "") {
  const ScratchDirectory scratch;
  const std::string end = scratch / "end.ply";
  const Run run = run_furrow("simulate --json " + scenes + name + ".toml -o " + end + " " + more);
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const char* mesh = name == "cantilever" ? "strip.obj" : "patch.obj";
  return {json::parse(run.out), positions(std::string(FURROW_SOURCE_DIR "/meshes/validation/") + mesh),
          positions(end)};
}

/// How far the vertices are from where `place` expects them [m].
template <class Place>
double farthest(const Result& result, Place place) {
  double distance = 0;
  for (std::size_t i = 0; i < result.before.size(); ++i)
    distance = std::max(distance, (result.after[i] - place(result.before[i])).norm());
  return distance;
}

/// Along the slab's upper face only: contact holds the height to a tenth of a micrometre.
Vec3 on_slab(Vec3 x) { return {x.x(), 0, x.z()}; }

}  // namespace

TEST_CASE("validation scenes: free_fall is g t^2 / 2 exactly, at any step", "[release]") {
  for (const char* dt : {"", "--dt 0.00005", "--dt 0.00003"}) {
    const Result r = run_scene("free_fall", dt);
    CHECK(farthest(r, [](const Vec3& x) { return Vec3(x - Vec3(0, 9.81 * 0.5 * 0.5 / 2, 0)); }) < 1e-11);
  }
}

TEST_CASE("validation scenes: incline has no creep just above tan a, and Coulomb's way below it",
          "[release]") {
  Result r = run_scene("incline_holds");
  for (std::vector<Vec3>* points : {&r.before, &r.after})
    for (Vec3& x : *points) x = on_slab(x);
  CHECK(farthest(r, [](const Vec3& x) { return x; }) < 1e-9);

  r = run_scene("incline_slides");
  for (std::vector<Vec3>* points : {&r.before, &r.after})
    for (Vec3& x : *points) x = on_slab(x);
  const double a = std::numbers::pi / 6, way = 9.81 * (std::sin(a) - 0.3 * std::cos(a)) * 0.3 * 0.3 / 2;
  CHECK(farthest(r, [&](const Vec3& x) { return Vec3(x + Vec3(way, 0, 0)); }) < 1e-9);
}

TEST_CASE("validation scenes: turntable takes cloth along below w^2 r = mu g and loses it above",
          "[release]") {
  const auto rotated = [](double rate) {
    physics::RigidMotion motion;
    motion.spin = physics::Spin{{0.2, 0, 0}, {0, 1, 0}, rate, 0, 0.5};
    const physics::Pose pose = physics::pose(motion, 1.5);
    return [pose](const Vec3& x) { return on_slab(pose.to_world(x)); };
  };
  Result r = run_scene("turntable_holds");
  for (Vec3& x : r.after) x = on_slab(x);
  CHECK(farthest(r, rotated(4)) < 1e-9);
  CHECK(farthest(r, [](const Vec3& x) { return on_slab(x); }) > 0.2);

  r = run_scene("turntable_slips");
  for (Vec3& x : r.after) x = on_slab(x);
  CHECK(farthest(r, rotated(5.5)) > 0.1);
}

TEST_CASE("validation scenes: drop_on_ball ends at rest on top, nothing inside", "[release]") {
  const Result r = run_scene("drop_on_ball");
  CHECK(r.report["vertices_inside"] == 0);
  CHECK(r.report["kinetic_energy"].get<double>() < 1e-7);
  Vec3 centre = Vec3::Zero();
  for (const Vec3& x : r.after) centre += x / double(r.after.size());
  CHECK(std::hypot(centre.x(), centre.z()) < 1e-3);
  for (const Vec3& x : r.after) CHECK((x - Vec3(0, -0.17, 0)).norm() > 0.15);
}

TEST_CASE(
    "validation scenes: cantilever has the heavy elastica's drop over reach within 1 %, by pins alone") {
  const Result r = run_scene("cantilever");
  CHECK(r.report["residual_force"].get<double>() < 5e-3);
  Vec3 tip = Vec3::Zero();
  for (std::size_t i = 0; i < r.before.size(); ++i)
    if (r.before[i].x() > 0.0999) tip += r.after[i];
  const double exact = 0.7001997155 / 0.6563537612;  // H/W at Gamma = 10, by shooting
  CHECK(std::abs(-tip.y() / tip.x() / exact - 1) < 0.01);
}
