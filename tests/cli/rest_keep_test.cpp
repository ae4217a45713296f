// SPDX-License-Identifier: GPL-3.0-or-later
// --rest keep of `wrinkle`, `simulate` and scene files: the drawn shape bears its weight.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/mesh/mesh.h"
#include "hung_patch.h"
#include "io/mesh/mesh_file.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::tests;
using nlohmann::json;

namespace {

const std::string patch = FURROW_SOURCE_DIR "/meshes/validation/patch.obj";  // 0.1 m wide, in the x-z plane
const std::string material = " --membrane triangles --stretch 100 --bending-law hinge --rigidity 1e-4";
const std::string plate = " --membrane triangles --stretch 100 --bending-law plate --rigidity 1e-4";
const std::string down = " --gravity 0,0,-9.81";
const std::string pins = " --pin-box -1,-1,0.0499,1,1,1";
const std::string moving =
    " --set pins.0.motion.keyframes='[{time = 0}, {time = 1, translation = [1, 0, 0]}]'";

json run_json(const std::string& arguments) {
  const Run run = run_furrow(arguments + " --json");
  INFO(arguments);
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  return json::parse(run.out);
}

void refuses(const std::string& arguments, int code, const std::string& words) {
  const Run run = run_furrow(arguments);
  INFO(arguments);
  CHECK(run.exit_code == code);
  CHECK_THAT(run.err, Catch::Contains(words));
}

std::string write_strokes(const ScratchDirectory& scratch, const std::string& name, double z) {
  const std::string at = std::to_string(z), path = scratch / (name + ".json");
  write_text(path, "{\"strokes\": [{\"name\": \"" + name +
                       "\", \"height\": 0.004, \"points\": [[-0.03, 0.003, " + at + "], [0.03, 0.003, " + at +
                       "]]}]}");
  return path;
}

/// A patch that hangs by an edge, with a kept ridge at 0 and another at a later time.
std::string write_kept_scene(const ScratchDirectory& scratch) {
  write_strokes(scratch, "a", 0.02);
  write_strokes(scratch, "b", -0.02);
  const std::string path = scratch / "kept.toml";
  write_text(path, "[garment]\nmesh = \"" + patch + "\"\n" + R"(
[[lines]]
strokes = "a.json"
rule = "safe"
rest = "keep"
[[lines]]
strokes = "b.json"
rule = "safe"
rest = "keep"
time = 0.05
)" + hung_patch + "[simulation]\nseconds = 0.1\n");
  return path;
}

double farthest(const std::string& a, const std::string& b) {
  const io::MeshFile first = io::read_mesh(a), second = io::read_mesh(b);
  REQUIRE(first.mesh->number_of_vertices() == second.mesh->number_of_vertices());
  double most = 0;
  for (const geometry::Vertex v : first.mesh->vertices())
    most = std::max(most, std::sqrt(CGAL::squared_distance(first.mesh->point(v), second.mesh->point(v))));
  return most;
}

}  // namespace

TEST_CASE("rest keep: lines of a scene stay as drawn, at time 0 and later, and tell how they stand") {
  const ScratchDirectory scratch;
  const std::string law = GENERATE("", " --bending-law plate");
  CAPTURE(law);
  const json report =
      run_json("simulate " + write_kept_scene(scratch) + law + " -o " + (scratch / "end.ply"));
  CHECK(report["kept"]["residual"] < 1e-8);
  CHECK(report["kept"]["stable"] == true);
  CHECK(report["kept"]["negative_eigenvalues"] == 0);
  CHECK(report["kept"]["max_angle"] > 0);
  CHECK(report["kept"]["max_strain"] > 0);
  REQUIRE(report["rounds"].size() == 2);
  CHECK_FALSE(report["rounds"][0].contains("kept"));
  CHECK(report["rounds"][1]["kept"]["residual"] < 0.01);  // the new line makes it swing about its pins
  CHECK(report["rounds"][1]["kept"]["max_angle"] > 0);
  CHECK(report["rounds"][1]["moving"]["largest_force_jump"] > 0);
  REQUIRE(report["lines"].size() == 2);
  for (const json& line : report["lines"]) CHECK(line["kept"].get<double>() == Approx(1).margin(1e-3));
  const json drawn =
      run_json("simulate " + (scratch / "kept.toml") + " --set lines.0.rest=drawn --set lines.1.rest=drawn" +
               law + " -o " + (scratch / "d.ply"));
  CHECK_FALSE(drawn.contains("kept"));
  CHECK(std::abs(drawn["lines"][0]["kept"].get<double>() - 1) > 5e-3);
}

TEST_CASE("rest keep: a run that was stopped before and after the drawing gives the same bits", "[long]") {
  const ScratchDirectory scratch;
  const std::string law = GENERATE("", " --bending-law plate");
  const std::string scene = write_kept_scene(scratch), whole = scratch / "whole.ply",
                    end = scratch / "end.ply";
  run_json("simulate " + scene + law + " -o " + whole);
  std::string state = scene;
  for (const char* time : {"0.03", "0.05", "0.07"}) {
    const std::string next = scratch / (std::string(time) + ".ply");
    run_json("simulate " + (state == scene ? scene + law : "--state " + state) + " --stop-at " + time +
             " --save-state " + next);
    state = next;
  }
  run_json("simulate --state " + state + " -o " + end);
  CHECK(read_text(end) == read_text(whole));
}

TEST_CASE("rest keep: wrinkle makes what simulate then leaves as it is", "[release]") {
  const ScratchDirectory scratch;
  const std::string cloth = GENERATE(material, plate);
  const std::string a = write_strokes(scratch, "a", 0.02), kept = scratch / "kept.ply",
                    end = scratch / "end.ply";
  const json report =
      run_json("wrinkle " + patch + " " + a + " --rest keep" + cloth + down + pins + " -o " + kept);
  CHECK(report["kept"]["residual"] < 1e-8);
  CHECK(report["kept"]["stable"] == true);
  run_json("simulate " + kept + cloth + down + pins + " --seconds 0.2 -o " + end);
  CHECK(farthest(kept, end) < 1e-6);
  const std::string drawn = scratch / "drawn.ply", moved = scratch / "moved.ply";
  run_json("wrinkle " + patch + " " + a + " -o " + drawn);
  run_json("simulate " + drawn + cloth + down + pins + " --seconds 0.2 -o " + moved);
  CHECK(farthest(drawn, moved) > 1e-5);
  const json again =
      run_json("simulate " + drawn + " --rest keep" + cloth + down + pins + " --seconds 0.2 -o " + moved);
  CHECK(again["lines"][0]["kept"].get<double>() == Approx(1).margin(1e-6));
  CHECK(farthest(moved, kept) < 1e-6);
}

TEST_CASE("rest keep: lines drawn into a state take material and pins from it, and nothing fades in",
          "[long]") {
  const ScratchDirectory scratch;
  const std::string cloth = GENERATE(material, plate);
  const std::string b = write_strokes(scratch, "b", -0.02), state = scratch / "state.ply",
                    more = scratch / "more.ply";
  run_json("simulate " + patch + " --rest keep" + cloth + down + pins +
           " --seconds 1 --stop-at 0.02 --save-state " + state);
  const json report = run_json("wrinkle --state " + state + " " + b + " --rest keep -o " + more);
  CHECK(report["kept"]["residual"] < 0.01);
  const json on = run_json("simulate --state " + more + " --seconds 0.2 -o " + (scratch / "end.ply"));
  CHECK(on["lines"][0]["kept"].get<double>() == Approx(1).margin(2e-3));
  refuses("wrinkle --state " + state + " " + b + " --rest keep --fabric denim -o " + more, 2,
          "--fabric: --state has material, pins and body");
}

TEST_CASE("rest keep: cloth without lines that is relaxed stays where it is, with and without weight") {
  const ScratchDirectory scratch;
  const std::string end = scratch / "end.ply";
  for (const std::string& gravity : {std::string(" --gravity 0"), down}) {
    const json report = run_json("simulate " + patch + " --rest keep" + material + pins + gravity +
                                 " --seconds 0.1 -o " + end);
    CHECK(farthest(patch, end) < 1e-9);
    if (gravity != down) CHECK(report["kept"]["max_strain"] < 1e-9);
    if (gravity != down) CHECK(report["kept"]["max_angle"] < 1e-9);
  }
}

TEST_CASE("rest keep: cloth on a body is balanced by what the body bears") {
  const ScratchDirectory scratch;
  const json report =
      run_json("simulate " FURROW_SOURCE_DIR
               "/scenes/validation/incline_holds.toml --rest keep --fabric denim --friction 0.58"
               " --seconds 0.1 -o " +
               (scratch / "end.ply"));
  CHECK(report["kept"]["residual"] < 1e-8);
  CHECK(report["kept"]["touching"] > 50);
  CHECK(report["kept"]["stable"] == true);
  CHECK(report["kinetic_energy"] < 1e-8);
}

TEST_CASE("rest keep: what it needs and what it refuses is told") {
  const ScratchDirectory scratch;
  const std::string a = write_strokes(scratch, "a", 0.02), out = " -o " + (scratch / "o.ply");
  refuses("wrinkle " + patch + " " + a + " --rest keep" + pins + out, 2, "--fabric");
  refuses("wrinkle " + patch + " " + a + " --fabric denim" + out, 2, "--fabric: goes with --rest keep");
  refuses("wrinkle " + patch + " " + a + pins + out, 2, "--pin-box: goes with --rest keep");
  refuses("simulate " + patch + " --membrane paper --rest keep" + pins + out, 2, "needs hinges");
  refuses("simulate " + patch + " --rest drawn" + material + down + pins + out, 2, "none of stored, keep");
  refuses("simulate " + patch + " --rest keep" + material + down + pins + moving + out, 2, "stand still");
  const std::string scene = write_kept_scene(scratch), state = scratch / "s.ply";
  refuses("simulate " + scene + " --set material.bending_law=cross" + out, 3,
          "lines.0.rest = \"keep\" needs hinges");
  run_json("simulate " + scene + " --stop-at 0.02 --save-state " + state);
  refuses("simulate --state " + state + " --rest keep" + out, 2, "furrow keep --state");
  refuses("simulate --state " + state + moving + out, 3, "stand still");  // a round is still to come
  const std::string all = scratch / "all.ply";
  run_json("simulate " + scene + " --save-state " + all);
  CHECK(run_furrow("simulate --state " + all + moving + " --seconds 0.2" + out).exit_code == 0);
}

TEST_CASE("rest keep: a shape that nothing balances is warned of, with a way out") {
  const ScratchDirectory scratch;
  const std::string a = write_strokes(scratch, "a", 0.02);
  const Run run = run_furrow("wrinkle " + patch + " " + a + " --rest keep" + material + down +
                             " --pin-vertices 0 -o " + (scratch / "o.ply"));
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err, Catch::Contains("furrow keep finds out"));
}
