// SPDX-License-Identifier: GPL-3.0-or-later
// What scenes promise beyond the garment at the end: the same run as flags, animations, moved bodies, states.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/border_loops.h"
#include "geometry/mesh/property_names.h"
#include "io/animation/animation_file.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/state_file.h"
#include "run_furrow.h"
#include "tests/test_meshes.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;
using physics::Vec3;

namespace {

const std::string meshes = FURROW_SOURCE_DIR "/meshes/validation/";

/// The patch on the turning slab with a line, in a folder of its own.
struct Turning {
  ScratchDirectory scratch;
  std::string scene = scratch / "scene.toml", strokes = scratch / "lines.json";
  explicit Turning(const std::string& more = "") {
    write_text(
        strokes,
        R"({"strokes": [{"name": "a b", "height": 0.004, "points": [[-0.03, 0.003, -0.03], [0.03, 0.003, 0.01]]}]})");
    write_text(scene, R"(
title = "it's a 'test'"
[garment]
mesh = ")" + meshes + R"(patch.obj"
[[lines]]
strokes = "lines.json"
[body]
mesh = ")" + meshes + R"(slab.obj"
motion.spin = {axis = [0, 1, 0], rate = 3.0, ramp = 0.02}
[[pins]]
vertices = [0]
motion.spin = {axis = [0, 1, 0], rate = 3.0, ramp = 0.02}
[material]
stiffness = 200
bending = 1
friction = 0.7
[forces]
gusts = [{time = 0, factor = 0.5}, {time = 0.05, factor = 1}]
wind = [0.3, 0, 0]
[simulation]
seconds = 0.1
)" + more);
  }
  json run(const std::string& arguments) {
    const Run run = run_furrow("simulate --json " + arguments);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return json::parse(run.out);
  }
};

}  // namespace

TEST_CASE("scene outputs: the flags that a scene's report names do the same, byte for byte", "[release]") {
  Turning t;
  const std::string one = t.scratch / "one.ply", two = t.scratch / "two.ply";
  const json report = t.run(t.scene + " -o " + one);
  std::string flags = report["flags"];
  REQUIRE(flags.substr(0, 9) == "simulate ");
  flags = flags.substr(9);
  const std::size_t output = flags.find(one);
  REQUIRE(output != std::string::npos);
  const json again = t.run(flags.replace(output, one.size(), two));
  CHECK((read_text(one) == read_text(two)));
  CHECK(again["lines"] == report["lines"]);
}

TEST_CASE(
    "scene outputs: an animation has the frames of the run, the last of them at its end, and the body is "
    "where it went",
    "[long]") {
  Turning t;
  const std::string end = t.scratch / "end.ply", body = t.scratch / "body.ply", pc2 = t.scratch / "run.pc2";
  t.run(t.scene + " -o " + end + " --animation " + pc2 + " --fps 50 --save-body " + body);
  const auto last = bridge::positions_of(io::read_mesh(end).mesh);
  const auto frames = io::open_frames(pc2, last.size(), {});
  REQUIRE(frames->frames() == 6);
  const auto shown = frames->positions(5);
  for (std::size_t i = 0; i < last.size(); ++i) CHECK((shown[i] - last[i]).norm() < 1e-6);

  const auto before = bridge::positions_of(io::read_mesh(meshes + "slab.obj").mesh);
  const auto after = bridge::positions_of(io::read_mesh(body).mesh);
  const Eigen::AngleAxisd turn(3.0 * (0.1 - 0.01), Vec3::UnitY());
  for (std::size_t i = 0; i < before.size(); ++i) CHECK((after[i] - turn * before[i]).norm() < 1e-12);
}

TEST_CASE(
    "scene outputs: a body that rises as frames lifts the cloth, and the report says what its frames cost",
    "[release]") {
  const ScratchDirectory scratch;
  const io::MeshFile slab = io::read_mesh(meshes + "slab.obj");
  for (int frame = 0; frame < 3; ++frame) {
    io::MeshFile moved = slab;
    for (auto v : moved.mesh->vertices()) {
      const auto p = moved.mesh->point(v);
      moved.mesh->point(v) = {p.x(), p.y() + 0.01 * frame, p.z()};
    }
    io::write_mesh(scratch / ("rise_" + std::to_string(frame) + ".obj"), moved);
  }
  const std::string end = scratch / "end.ply";
  const std::string collider = GENERATE(as<std::string>{}, "", "--set body.collider=depth-maps");
  const Run run = run_furrow("simulate --json " + meshes + "patch.obj --body " + meshes + "slab.obj " +
                             collider + " --body-frames '" + (scratch / "rise_#.obj") +
                             "' --body-fps 10 --seconds 0.2 --gap 0.01 --stiffness 100 -o " + end);
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json report = json::parse(run.out);
  CHECK(report["body_frames"]["built"] == 3);
  CHECK(report["body_frames"]["seconds"].get<double>() > 0);
  CHECK(report["vertices_inside"] == 0);
  const double gap = report["contact_gap"];
  for (const Vec3& x : bridge::positions_of(io::read_mesh(end).mesh)) {
    CHECK(x.y() > 0.02 + gap - 2e-4);
    CHECK(x.y() < 0.02 + gap + 2e-3);
  }
}

TEST_CASE(
    "scene outputs: depth maps of a body that hides space from all sides are warned of, those of a slab are "
    "not") {
  const ScratchDirectory scratch;
  geometry::Mesh cage;  // six plates that do not touch, nothing between them
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.2, 0.2}) {
      std::array<geometry::Vertex, 8> v;
      for (int corner = 0; corner < 8; ++corner) {
        Vec3 x;
        for (int c = 0; c < 3; ++c) x[c] = (corner >> c & 1 ? 1 : -1) * (c == axis ? 0.01 : 0.18);
        x[axis] += side;
        v[std::size_t(corner)] = cage.add_vertex({x.x(), x.y(), x.z()});
      }
      for (const auto& q :
           {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        cage.add_face(v[std::size_t(q[0])], v[std::size_t(q[1])], v[std::size_t(q[2])]);
        cage.add_face(v[std::size_t(q[0])], v[std::size_t(q[2])], v[std::size_t(q[3])]);
      }
    }
  io::MeshFile file;
  file.mesh = cage;
  io::write_mesh(scratch / "cage.obj", file);
  const auto warned = [&](const std::string& body) {
    for (const char* frame : {"0", "1"})
      std::filesystem::copy_file(body, scratch / ("frame_" + std::string(frame) + ".obj"),
                                 std::filesystem::copy_options::overwrite_existing);
    const Run run = run_furrow("simulate " + meshes + "patch.obj --body " + body +
                               " --set body.collider=depth-maps --body-frames '" + (scratch / "frame_#.obj") +
                               "' --body-fps 10 --seconds 0.001 -o " + (scratch / "end.ply"));
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return run.err.find("% of the points beside the body for inside") != std::string::npos;
  };
  CHECK(warned(scratch / "cage.obj"));
  CHECK_FALSE(warned(meshes + "slab.obj"));
}

TEST_CASE("scene outputs: wrinkle --state draws into a stopped simulation, and the result goes on",
          "[release]") {
  Turning t;
  const std::string state = t.scratch / "state.ply", more = t.scratch / "more.ply",
                    end = t.scratch / "end.ply";
  t.run(t.scene + " --stop-at 0.05 --save-state " + state);
  write_text(
      t.scratch / "late.json",
      R"({"strokes": [{"name": "late", "height": -0.003, "points": [[-0.03, 0.003, 0.03], [0.03, 0.003, 0.035]]}]})");
  const Run drawn =
      run_furrow("wrinkle --json --state " + state + " " + (t.scratch / "late.json") + " -o " + more);
  INFO(drawn.err);
  REQUIRE(drawn.exit_code == 0);
  const json report = json::parse(drawn.out);
  CHECK(report["inserted"].get<int>() > 2);
  const io::SavedState before = io::read_state(state), after = io::read_state(more);
  CHECK(after.simulation.time == before.simulation.time);
  CHECK(after.file.mesh->number_of_vertices() ==
        before.file.mesh->number_of_vertices() + report["inserted"].get<std::size_t>());
  CHECK(after.simulation.compensation.force.size() == after.file.mesh->number_of_vertices());
  const json run = t.run("--state " + more + " -o " + end);
  CHECK(run["time"].get<double>() == Approx(0.1));
  CHECK(run["lines"].size() == 2);
  CHECK(run["lines"][1]["name"] == "late");
}

TEST_CASE("scene outputs: the scenes of the demo are read, and begin", "[scenes][release]") {
  for (const std::string name : {"bulge", "skirt", "folded_skirt", "shirt"}) {
    const ScratchDirectory scratch;
    CAPTURE(name);
    const std::string out = scratch / "out.ply";
    // The body is left out: its field takes longer than all the rest.
    const Run run = run_furrow("simulate --json " FURROW_SOURCE_DIR "/scenes/" + name +
                               ".toml --set body='{mesh=\"" + meshes +
                               "ball.obj\", motion={keyframes=[{time=0, translation=[5,0,0]}]}}' --stop-at "
                               "0.001 --set simulation.settle=false --set output='{mesh=\"" +
                               out + "\"}'");
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    const json report = json::parse(run.out);
    CHECK(report["lines"].size() >= 2);
    CHECK(io::read_mesh(out).mesh->number_of_vertices() > 1500);
  }
}

TEST_CASE("scene outputs: lines over the hem make it longer and wider") {
  const ScratchDirectory scratch;
  const std::string skirt = FURROW_SOURCE_DIR "/meshes/skirt.obj", wrinkled = scratch / "w.ply";
  const Run run = run_furrow(
      "wrinkle --json " + skirt +
      " " FURROW_SOURCE_DIR "/meshes/strokes/figure_skirt.json --rule safe --iterations 25 -o " + wrinkled);
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const auto hem = [](const std::string& path) {
    for (const auto& loop : geometry::border_loops(io::read_mesh(path).mesh))
      if (loop.mean_height < 0.7) return loop;
    FAIL("no hem in " + path);
    return geometry::BorderLoop{};
  };
  const auto before = hem(skirt), after = hem(wrinkled);
  CHECK(before.length == Approx(1.283).margin(0.005));
  CHECK(after.length > 1.3 * before.length);
  CHECK(after.mean_radius > 1.05 * before.mean_radius);
}
