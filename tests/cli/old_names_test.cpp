// SPDX-License-Identifier: GPL-3.0-or-later
// One meaning per name: options that were called otherwise work for a version, with a note.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "run_furrow.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

/// Both calls end alike and write the same file; the old one notes the new name, once, unless it is quiet.
void same(const std::string& old_call, const std::string& new_call, const std::string& file,
          const std::string& note) {
  INFO(old_call);
  const Run present = run_furrow(new_call);
  INFO(present.err);
  REQUIRE(present.exit_code == 0);
  CHECK(present.err.find("note:") == std::string::npos);
  const std::string bytes = read_text(file);
  REQUIRE(!bytes.empty());
  std::filesystem::remove(file);
  const Run old = run_furrow(old_call);
  CHECK(old.exit_code == 0);
  CHECK(old.err.rfind("note: " + note, 0) == 0);
  CHECK(old.err.find("note:", 1) == std::string::npos);
  CHECK(read_text(file) == bytes);
  CHECK(run_furrow(old_call + " -q").err.find("note:") == std::string::npos);
}

}  // namespace

TEST_CASE("old names: they do what the new ones do, and say so", "[long]") {
  const ScratchDirectory scratch;
  const std::string sheet = source_file("meshes/sheet.obj"),
                    lines = source_file("meshes/strokes/round_bulge.json"),
                    body = source_file("meshes/mannequin.obj"), ply = scratch / "o.ply",
                    png = scratch / "o.png";
  same("subdivide " + sheet + " --loop 1 -o " + ply, "subdivide " + sheet + " --subdivide 1 -o " + ply, ply,
       "--loop of furrow subdivide is --subdivide now");
  const std::string small = " --size 60,60 --quality draft";
  same("wrinkle " + sheet + " " + lines + " --preview " + png + small,
       "wrinkle " + sheet + " " + lines + " --picture " + png + small, png,
       "--preview of furrow wrinkle is --picture now");
  same("render " + sheet + " --parallel=1.2 -o " + png + small,
       "render " + sheet + " --orthographic 1.2 -o " + png + small, png,
       "--parallel of furrow render is --orthographic now");
  same("sdf " + body + " --tolerance 0.02 --slice " + png,
       "sdf " + body + " --tolerance 0.02 --picture " + png, png, "--slice of furrow sdf is --picture now");
  const std::string textured = source_file("meshes/panelled.obj"), prefix = scratch / "m";
  same("bake " + textured + " " + textured + " --size 32 -o " + prefix,
       "bake " + textured + " " + textured + " --texels 32 -o " + prefix, prefix + "_normal.png",
       "--size of furrow bake is --texels now");
  const std::string list = scratch / "s.json";
  REQUIRE(run_furrow("strokes " + lines + " --change 'ring 1.height=-0.02' --change 'ring 1.width=0.05' -o " +
                     list)
              .exit_code == 0);
  const std::string changed = read_text(list);
  const Run old =
      run_furrow("strokes " + lines + " --height 'ring 1=-0.02' --width='ring 1=0.05' -o " + list);
  CHECK(old.exit_code == 0);
  CHECK(old.err.rfind("note: --height of furrow strokes is --change NAME.height=VALUE now", 0) == 0);
  CHECK(old.err.find("\nnote: --width of furrow strokes is --change NAME.width=VALUE now") !=
        std::string::npos);
  CHECK(read_text(list) == changed);
}

TEST_CASE("old names: --tolerance is a length, and was an accuracy where it was a share", "[long]") {
  const ScratchDirectory scratch;
  const std::string scene =
      source_file("scenes/validation/free_fall.toml") + " --set simulation.seconds=0.02";
  const Run old = run_furrow("chart --json --tolerance 5% " + scene);
  CHECK(old.err.rfind("note: --tolerance of furrow chart is --accuracy now", 0) == 0);
  CHECK(json::parse(old.out)["tolerance"] == 0.05);
  const Run simulated = run_furrow("simulate --json --tolerance=5% " + scene);
  CHECK(simulated.err.rfind("note: --tolerance of furrow simulate is --accuracy now", 0) == 0);
  CHECK(json::parse(simulated.out).contains("choice"));
  const Run length = run_furrow("simulate --tolerance 0.002 " + scene);
  CHECK(length.err.find("note:") == std::string::npos);
}

TEST_CASE("old names: help, completion and manual pages have the new ones alone") {
  const std::string help = run_furrow("drape --help").out + run_furrow("bake --help").out;
  for (const char* gone : {"--compare ", "--iterations ", "--size INT", "--parallel "})
    CHECK(help.find(gone) == std::string::npos);
  CHECK(run_furrow("completion bash").out.find("--preview") == std::string::npos);
}

TEST_CASE("wrinkle: --width is that of strokes that name none, and --strokes names their file", "[long]") {
  const ScratchDirectory scratch;
  const std::string sheet = source_file("meshes/sheet.obj");
  write_text(scratch / "l.json", R"({"strokes": [{"name": "a", "points": [[-0.2,0.3,0],[0.2,0.3,0]]},
                                                 {"name": "b", "width": 0.1, "points": [[-0.2,0.7,0],[0.2,0.7,0]]}]})");
  const Run run = run_furrow("wrinkle --json " + sheet + " --strokes " + (scratch / "l.json") +
                             " --width 0.08 -o " + (scratch / "w.ply"));
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json lines = json::parse(run.out)["lines"];
  CHECK(lines[0]["width"] == 0.08);
  CHECK(lines[1]["width"] == 0.1);
  // Drawn again, its lines are as wide.
  const Run again = run_furrow("wrinkle --json " + (scratch / "w.ply") + " -o " + (scratch / "again.ply"));
  INFO(again.err);
  REQUIRE(again.exit_code == 0);
  CHECK(json::parse(again.out)["lines"] == lines);
  CHECK(run_furrow("wrinkle " + (scratch / "w.ply") + " --width 0.1 -o " + (scratch / "b.ply")).exit_code ==
        2);
  CHECK(run_furrow("wrinkle " + sheet + " " + (scratch / "l.json") + " --width 0 -o " + (scratch / "b.ply"))
            .exit_code == 2);
}
