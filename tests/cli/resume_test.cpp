// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cstdio>
#include <random>

#include "geometry/mesh/sheet.h"
#include "io/mesh/mesh_file.h"
#include "tests/cli/run_furrow.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::tests;

namespace {

void write(const std::string& path, const geometry::Mesh& mesh) {
  io::MeshFile file;
  file.mesh = mesh;
  io::write_mesh(path, file);
}

/// A sheet that falls on a ball with friction, turns with it, and gets lines before and on the way.
class FallingSheet {
 public:
  FallingSheet() {
    geometry::Mesh sheet = grid(10, 10, 0.5, 0.5);
    for (auto v : sheet.vertices()) {
      const geometry::Point p = sheet.point(v);
      sheet.point(v) = {p.x() - 0.25, 0.012, 0.25 - p.y()};
    }
    write(scratch / "sheet.ply", sheet);
    write(scratch / "ball.ply", icosphere(3, 0.15, {0.02, -0.15, 0}));
    write_text(
        scratch / "first.json",
        R"({"strokes": [{"name": "ridge", "height": 0.02, "points": [[-0.2, 0.012, -0.2], [-0.15, 0.012, 0.2]]}]})");
    write_text(
        scratch / "second.json",
        R"({"strokes": [{"name": "late", "height": -0.01, "points": [[0.1, -0.03, -0.1], [0.12, -0.03, 0.15]]}]})");
    write_text(scratch / "scene.toml", R"(
[garment]
mesh = "sheet.ply"
[[lines]]
strokes = "first.json"
rule = "safe"
[[lines]]
strokes = "second.json"
rule = "safe"
time = 0.07
[body]
mesh = "ball.ply"
tolerance = 0.006
motion.spin = {axis = [0, 1, 0], rate = 2.0, ramp = 0.1}
[material]
stiffness = 100
bending = 1
friction = 0.4
[[pins]]
box = [-0.26, -1, -0.26, -0.24, 1, 0.26]
motion.keyframes = [{time = 0}, {time = 0.16, translation = [0.02, 0, 0]}]
[forces]
wind = [0.5, 0, 0]
[simulation]
seconds = 0.16
)");
  }

  /// The bytes of the garment at the end.
  std::string run(const std::string& arguments) {
    const Run run = run_furrow("simulate " + arguments + " -q -o " + (scratch / "end.ply"));
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return read_text(scratch / "end.ply");
  }

  ScratchDirectory scratch;
};

}  // namespace

TEST_CASE("resume: a simulation stopped anywhere goes on as if it had not been stopped", "[release]") {
  FallingSheet sheet;
  const std::string scene = sheet.scratch / "scene.toml", state = sheet.scratch / "state.ply";
  const std::string whole = sheet.run(scene + " --threads 1");
  REQUIRE(sheet.run(scene + " --threads 2") == whole);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> time(0.001, 0.159);
  for (int i = 0; i < 20; ++i) {
    const std::string stop = std::to_string(time(random));
    const int threads = i % 2 + 1;
    CAPTURE(stop, threads);
    const Run first = run_furrow("simulate " + scene + " -q --stop-at " + stop + " --save-state " + state +
                                 " --threads " + std::to_string(threads));
    REQUIRE(first.exit_code == 0);
    REQUIRE(sheet.run("--state " + state + " --threads " + std::to_string(3 - threads)) == whole);
  }
}

TEST_CASE("resume: a simulation stopped twice, and one whose state went to another folder, end the same",
          "[release]") {
  FallingSheet sheet;
  const std::string scene = sheet.scratch / "scene.toml", one = sheet.scratch / "one.ply";
  const std::string whole = sheet.run(scene);
  std::filesystem::create_directory(sheet.scratch.path() / "kept");
  const std::string two = sheet.scratch / "kept/two.ply";
  REQUIRE(run_furrow("simulate " + scene + " -q --stop-at 0.05 --save-state " + one).exit_code == 0);
  REQUIRE(run_furrow("simulate -q --state " + one + " --stop-at 0.1 --save-state " + two).exit_code == 0);
  CHECK(sheet.run("--state " + two) == whole);
  CHECK(sheet.run(scene + " --state " + two) == whole);
}

TEST_CASE("resume: a state that does not fit is refused", "[long]") {
  FallingSheet sheet;
  const std::string state = sheet.scratch / "state.ply";
  REQUIRE(run_furrow("simulate " + (sheet.scratch / "scene.toml") + " -q --stop-at 0.1 --save-state " + state)
              .exit_code == 0);
  const std::string out = " -o " + (sheet.scratch / "o.ply");
  CHECK(run_furrow("simulate --state " + (sheet.scratch / "sheet.ply") + out).exit_code == 3);
  CHECK(run_furrow("simulate --state " + state + " " + (sheet.scratch / "sheet.ply") + out).exit_code == 2);
  CHECK(run_furrow("simulate --state " + state).exit_code == 2);
  CHECK(run_furrow("simulate --state " + state + out + " --set pins=[]").exit_code == 2);
  std::string bytes = read_text(state);
  write_text(state, bytes.substr(0, bytes.size() - 100));
  CHECK(run_furrow("simulate --state " + state + out).exit_code == 3);
  CHECK_FALSE(std::filesystem::exists(sheet.scratch / "o.ply"));
}

TEST_CASE("resume: what changes at a stop is noticed", "[long]") {
  FallingSheet sheet;
  const std::string state = sheet.scratch / "state.ply", out = " -q -o " + (sheet.scratch / "o.ply");
  REQUIRE(
      run_furrow("simulate " + (sheet.scratch / "scene.toml") + " -q --stop-at 0.05 --save-state " + state)
          .exit_code == 0);
  const auto same = [&] { return sheet.run("--state " + state); };
  SECTION("stiffer springs have a shorter step") {
    const Run run =
        run_furrow("simulate --state " + state + out + " --stiffness 20000 --allow-crossings 200");
    INFO(run.err);
    CHECK(run.exit_code == 0);
  }
  SECTION("a step above the limit is refused") {
    CHECK(run_furrow("simulate --state " + state + out + " --dt 0.1").exit_code == 2);
  }
  SECTION("another body is not known yet: nothing falls into it") {
    write(sheet.scratch / "near.ply", icosphere(3, 0.15, {0.02, -0.151, 0}));
    const Run run =
        run_furrow("simulate --json --state " + state + " -o " + (sheet.scratch / "o.ply") +
                   " --set body='{mesh=\"" + (sheet.scratch / "near.ply") + "\", tolerance=0.006}'");
    INFO(run.err);
    CHECK(run.out.find("\"vertices_inside\": 0") != std::string::npos);
  }
  SECTION("a density makes the cloth heavier") {
    const std::string before = same();
    CHECK(sheet.run("--state " + state + " --density 0.15") == before);
    CHECK(sheet.run("--state " + state + " --density 1") != before);
  }
  SECTION("pins that stop where they are do not jump") {
    CHECK(run_furrow("simulate --state " + state + out + " --set pins.0.motion.keyframes=[]").exit_code == 0);
  }
  SECTION("a time that is past stops at once") {
    const std::string again = sheet.scratch / "again.ply";
    REQUIRE(run_furrow("simulate -q --state " + state + " --stop-at 0.01 --save-state " + again).exit_code ==
            0);
    CHECK(sheet.run("--state " + again) == same());
  }
  SECTION("a setting does not move the paths of the others") {
    std::filesystem::create_directory(sheet.scratch.path() / "elsewhere");
    const Run run = run_furrow("simulate --state " + state + out + " --set lines.1.fade=0.2 --friction 0.1");
    INFO(run.err);
    CHECK(run.exit_code == 0);
  }
}

TEST_CASE("resume: no output replaces an input or another output", "[long]") {
  FallingSheet sheet;
  const std::string scene = sheet.scratch / "scene.toml", mesh = sheet.scratch / "sheet.ply";
  const std::string out = sheet.scratch / "o.ply", bytes = read_text(mesh);
  for (const std::string& more : {" -o " + out + " --save-state " + out, " -o " + out + " --inserted " + out,
                                  " -o " + out + " --inserted " + mesh, " -o " + (sheet.scratch / "ball.ply"),
                                  " -o " + (sheet.scratch / "first.json")}) {
    CAPTURE(more);
    CHECK(run_furrow("simulate -q " + scene + more).exit_code == 2);
  }
  CHECK(read_text(mesh) == bytes);
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE(
    "resume: fabrics, and every integrator that a scene can choose, go on as if they had not been stopped",
    "[release]") {
  FallingSheet sheet;
  const std::string state = sheet.scratch / "state.ply", scene = sheet.scratch / "scene.toml";
  const std::string more = GENERATE(
      " --set 'material={preset=\"jet-set\"}'", " --set material.membrane=van-gelder --bending-law cosine",
      " --membrane tension --tension 2e4 --bending-law cosine --set material.mass_rule=equal",
      " --integrator rk4", " --integrator xpbd --dt 0.001", " --integrator implicit",
      " --integrator tr-bdf2 --dt 0.01");
  CAPTURE(more);
  const std::string whole = sheet.run(scene + more + " --threads 1");
  REQUIRE(run_furrow("simulate " + scene + more + " -q --threads 2 --stop-at 0.1 --save-state " + state)
              .exit_code == 0);
  CHECK(sheet.run("--state " + state + " --threads 2") == whole);
}
