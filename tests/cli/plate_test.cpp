// SPDX-License-Identifier: GPL-3.0-or-later
// Cloth whose bending is a plate, and cloth with threads, through keep, states, drawing more and transfer.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

const std::string flat_patch = FURROW_SOURCE_DIR "/meshes/validation/patch.obj";
const std::string hung_flags = " --pin-box -1,-1,0.0499,1,1,1 --gravity 0,0,-9.81";

json json_of(const std::string& arguments, int code = 0) {
  const Run run = run_furrow(arguments + " --json");
  INFO(arguments);
  INFO(run.err);
  REQUIRE(run.exit_code == code);
  return json::parse(run.out);
}

std::string write_ridge(const ScratchDirectory& scratch, const std::string& name, double z) {
  const std::string at = std::to_string(z), path = scratch / (name + ".json");
  write_text(path, R"({"strokes": [{"name": ")" + name + R"(", "height": 0.004, "points": [[-0.03, 0.003, )" +
                       at + "], [0.03, 0.003, " + at + "]]}]}");
  return path;
}

/// A patch with a ridge that hangs by its edge; more: lines of its table [material].
std::string write_hung_ridge(const ScratchDirectory& scratch, const std::string& more) {
  write_ridge(scratch, "a", 0.02);
  const std::string path = scratch / "hung.toml";
  write_text(path, "[garment]\nmesh = \"" + flat_patch +
                       "\"\n[[lines]]\nstrokes = \"a.json\"\nrule = \"safe\"\n"
                       "[[pins]]\nbox = [-1, -1, 0.0499, 1, 1, 1]\n[forces]\ngravity = [0, 0, -9.81]\n"
                       "[material]\nmembrane = \"triangles\"\ndrag = 4\n" +
                       more);
  return path;
}

void all_kept(const json& report, double within) {
  for (const json& line : report["lines"]) CHECK(line["kept"].get<double>() == Approx(1).margin(within));
}

const std::string plate_cloth = "stretch = 100\nbending_law = \"plate\"\nrigidity = 1e-4\n";
const std::string woven_cloth =
    "warp_stretch = 200\nweft_stretch = 100\nthread_shear = 20\nthread_poisson = 0.1\n"
    "warp_rigidity = 1e-4\nweft_rigidity = 5e-5\nbias_rigidity = 6e-5\nwarp = \"z\"\nbending_law = "
    "\"plate\"\n";

}  // namespace

TEST_CASE("plate: what keep held goes on from its mesh and its state, is drawn on, kept again, transferred",
          "[long]") {
  const ScratchDirectory scratch;
  const std::string material = GENERATE(plate_cloth, woven_cloth);
  CAPTURE(material);
  const std::string scene = write_hung_ridge(scratch, material), kept = scratch / "kept.ply",
                    state = scratch / "state.ply";
  const json report = json_of("keep --run 0.2 " + scene + " -o " + kept + " --save-state " + state);
  CHECK(report["residual"] < 1e-8);
  CHECK(report["stable"] == true);
  CHECK(report["lines"][0]["verdict"] == "held");
  all_kept(json_of("simulate " + kept + hung_flags + " --seconds 0.1 -o " + (scratch / "hung.ply")), 1e-6);

  const std::string whole = scratch / "whole.ply", half = scratch / "half.ply", end = scratch / "end.ply";
  all_kept(json_of("simulate --state " + state + " --seconds 0.1 -o " + whole), 1e-6);
  json_of("simulate --state " + state + " --seconds 0.1 --stop-at 0.04 --save-state " + half);
  json_of("simulate --state " + half + " --seconds 0.1 -o " + end);
  CHECK(read_text(end) == read_text(whole));

  const std::string more = scratch / "more.ply", again = scratch / "again.ply";
  json_of("wrinkle --state " + half + " " + write_ridge(scratch, "b", -0.02) + " --rule safe -o " + more);
  const json both = json_of("keep --run 0.2 --state " + more + " --save-state " + again);
  CHECK(both["residual"] < 1e-8);
  REQUIRE(both["lines"].size() == 2);
  for (const json& line : both["lines"]) CHECK(line["verdict"].get<std::string>().rfind("held", 0) == 0);
  all_kept(json_of("simulate --state " + again + " --seconds 0.1 -o " + end), 1e-6);

  const json moved = json_of("transfer " + flat_patch + " " + kept + " -o " + (scratch / "moved.obj"));
  CHECK(moved["max_distance"] < 1e-3);
}

TEST_CASE("plate: rest keep balances a fabric with threads, which a simulation then finds at rest") {
  const ScratchDirectory scratch;
  const std::string a = write_ridge(scratch, "a", 0.02), drawn = scratch / "drawn.ply";
  json_of("wrinkle " + flat_patch + " " + a + " --rule safe -o " + drawn);
  const json report = json_of("simulate " + drawn + " --rest keep --fabric black-denim --warp z" +
                              hung_flags + " --seconds 0.1 -o " + (scratch / "hung.ply"));
  CHECK(report["kept"]["residual"] < 1e-8);
  CHECK(report["kept"]["max_strain"] > 1e-5);
  all_kept(report, 1e-6);
}
