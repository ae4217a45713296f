// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "hung_patch.h"
#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

/// A patch that hangs by an edge, with two rounds of one ridge each.
std::string write_hung_scene(const ScratchDirectory& scratch) {
  write_text(scratch / "a.json",
             R"({"strokes": [{"name": "a", "points": [[-0.03, 0.003, 0.02], [0.03, 0.003, 0.02]]}]})");
  write_text(scratch / "b.json",
             R"({"strokes": [{"name": "b", "points": [[-0.03, 0.003, -0.02], [0.03, 0.003, -0.02]]}]})");
  const std::string path = scratch / "hung.toml";
  write_text(path, "[garment]\nmesh = \"" FURROW_SOURCE_DIR
                   "/meshes/validation/patch.obj\"\n"
                   R"(
[[lines]]
strokes = "a.json"
rule = "safe"
height = 0.004
[[lines]]
strokes = "b.json"
rule = "safe"
height = 0.004
)" + std::string(hung_patch) +
                       "drag = 4\n");
  return path;
}

}  // namespace

TEST_CASE("keep: the state goes on with the lines as drawn, all rounds of time 0 in it, at rest", "[long]") {
  const ScratchDirectory scratch;
  const std::string scene = write_hung_scene(scratch), state = scratch / "kept.ply";
  const std::string law = GENERATE("", " --bending-law plate");
  const Run run = run_furrow("keep --json --run 1 " + scene + law + " --save-state " + state);
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json report = json::parse(run.out);
  CHECK(report["residual"] < 1e-8);
  REQUIRE(report["lines"].size() == 2);
  for (const json& line : report["lines"]) CHECK(line["verdict"] == "held");
  const Run on = run_furrow("simulate --json --state " + state + " --seconds 0.1 -o " + (scratch / "on.ply"));
  INFO(on.err);
  REQUIRE(on.exit_code == 0);
  const json after = json::parse(on.out);
  REQUIRE(after["lines"].size() == 2);
  for (const json& line : after["lines"]) CHECK(line["kept"].get<double>() == Approx(1).margin(1e-6));
}

TEST_CASE("keep: a garment without a line is refused, as in the studio, and nothing is written") {
  const ScratchDirectory scratch;
  write_text(scratch / "sheet.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0.1 0.1 0\nf 1 2 4\nf 1 4 3\n");
  const Run told = run_furrow("keep --run 0.05 --pin-vertices 2,3 " + (scratch / "sheet.obj") + " -o " +
                              (scratch / "k.PLY") + " --save-state " + (scratch / "s.ply"));
  CHECK(told.exit_code == 2);
  CHECK(told.err ==
        "error: there is no line to keep: draw one with furrow wrinkle, or name strokes in the scene's "
        "[[lines]]\n");
  CHECK_FALSE(std::filesystem::exists(scratch / "k.PLY"));
  CHECK_FALSE(std::filesystem::exists(scratch / "s.ply"));
}

TEST_CASE("keep: no output replaces what is read") {
  const ScratchDirectory scratch;
  const std::string scene = write_hung_scene(scratch), strokes = read_text(scratch / "a.json");
  for (const std::string& flags : {" --picture " + (scratch / "a.json"), " --save-state " + scene})
    CHECK(run_furrow("keep --run 0.1 " + scene + flags).exit_code == 2);
  CHECK(read_text(scratch / "a.json") == strokes);
}

TEST_CASE("keep: with --whole what gives way between the lines is pressed, and reported", "[release]") {
  const ScratchDirectory scratch;
  const std::string scene = write_hung_scene(scratch);
  const std::string law = GENERATE("", " --bending-law plate");
  const auto keep = [&](const std::string& flags) {
    const Run run = run_furrow("keep --json --run 0.05 --gust 0 " + scene + law + flags);
    INFO(run.err);
    REQUIRE((run.exit_code == 0 || run.exit_code == 4));
    return json::parse(run.out);
  };
  CHECK_FALSE(keep(" --whole").contains("rest_of_garment"));  // it holds as it is
  const json soft = keep(" --rigidity 1e-8"), whole = keep(" --rigidity 1e-8 --whole");
  CHECK_FALSE(soft.contains("rest_of_garment"));
  REQUIRE(whole.contains("rest_of_garment"));
  CHECK(whole["rest_of_garment"]["press"] >= 10);
  CHECK(whole["negative_eigenvalues"] == 0);
  CHECK(run_furrow("keep --run 0.05 --whole --no-help " + scene).exit_code == 2);
}
