// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow::tests;
using Catch::Contains;

namespace {

const std::string sheet = FURROW_SOURCE_DIR "/meshes/sheet.obj";
const std::string mannequin = FURROW_SOURCE_DIR "/meshes/mannequin.obj";

/// An error of one line, no signal, and nothing written.
void check_refused(const std::string& arguments, int exit_code, const std::string& what) {
  const ScratchDirectory scratch;
  const Run run = run_furrow(arguments + " -o " + (scratch / "out.ply"));
  INFO(arguments << "\n" << run.err);
  CHECK(run.exit_code == exit_code);
  CHECK_THAT(run.err, Contains("error: ") && Contains(what));
  CHECK(std::filesystem::is_empty(scratch.path()));
}

}  // namespace

TEST_CASE("gate: steps, frames, tolerances and densities that would run for ever are refused with a way out",
          "[long]") {
  const std::string simulate = "simulate " + sheet + " --pin-loop top ";
  check_refused(simulate + "--dt 1e-9", 2, "take a longer --dt");
  check_refused(simulate + "--dt 1e-9", 2, "--force goes on all the same");
  check_refused(simulate + "--integrator leapfrog --density 1e-12", 2, "cloth is light for its stiffness");
  const Run field = run_furrow("sdf " + mannequin + " --tolerance 1e-9");
  CHECK(field.exit_code == 2);
  CHECK_THAT(field.err, Contains("raise the tolerance to"));
  const ScratchDirectory scratch;
  const Run frames = run_furrow(simulate + "--fps 1e9 --animation " + (scratch / "a.pc2"));
  CHECK(frames.exit_code == 2);
  CHECK_THAT(frames.err, Contains("--fps 1e+09: the animation would have"));
  CHECK(std::filesystem::is_empty(scratch.path()));
}

TEST_CASE("gate: a body in the wrong unit is asked about by the unit's name") {
  check_refused("drape " + sheet + " --body " + mannequin + " --unit mm", 3, "say --unit m");
}

TEST_CASE("gate: sdf takes the --body-unit that its message advises", "[long]") {
  const std::string call = "sdf " + mannequin + " --unit mm --tolerance 0.01";
  const Run run = run_furrow(call);
  CHECK(run.exit_code == 3);
  CHECK_THAT(run.err, Contains("--body-unit"));
  CHECK(run_furrow(call + " --body-unit m").exit_code == 0);
}

TEST_CASE("gate: a garment without area is refused by its file's name, with exit 3", "[long]") {
  const ScratchDirectory scratch;
  const std::string line = scratch / "line.obj", stroke = scratch / "s.json";
  write_text(line, "v 0 0 0\nv 0.5 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 2 4 3\n");
  write_text(stroke, R"({"strokes": [{"name": "a", "height": 0.01, "points": [[0, 0, 0], [1, 0, 0]]}]})");
  for (const std::string& command :
       {"wrinkle " + line + " " + stroke, "simulate " + line + " --pin-vertices 0",
        "drape " + line + " --body " + mannequin})
    check_refused(command, 3, "line.obj: none of its faces has an area");
}

TEST_CASE("gate: collapsed meshes are refused by name by render, transfer and as a frame of a body",
          "[long]") {
  const ScratchDirectory scratch;
  const std::string point = scratch / "point.obj", line = scratch / "line.obj";
  write_text(point, "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
  write_text(line, "v 0 0 0\nv 0.5 0 0\nv 1 0 0\nf 1 2 3\n");
  const Run picture = run_furrow("render " + point + " -o " + (scratch / "p.png"));
  CHECK(picture.exit_code == 3);
  CHECK_THAT(picture.err, Contains("point.obj: all its vertices lie at one point"));
  check_refused("transfer " + line + " " + sheet, 3, "line.obj: none of its faces has an area");
  check_refused("transfer " + sheet + " " + line, 3, "line.obj: none of its faces has an area");
  check_refused("transfer " + sheet + " " + mannequin, 3, "mannequin.obj: transfer: ");
  const std::string faces = "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  write_text(scratch / "b_0001.obj", "v 0 0 0\nv 0.3 0 0\nv 0 0.3 0\nv 0 0 0.3\n" + faces);
  write_text(scratch / "b_0002.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nv 0 0 0\n" + faces);
  const Run frames =
      run_furrow("simulate " + sheet + " --pin-loop top --seconds 0.08 --body " + (scratch / "b_0001.obj") +
                 " --body-frames " + (scratch / "b_####.obj") + " -o " + (scratch / "o.ply"));
  INFO(frames.err);
  CHECK(frames.exit_code == 3);
  CHECK_THAT(frames.err, Contains("frame 1: none of the body's faces has an area"));
  CHECK_FALSE(std::filesystem::exists(scratch / "o.ply"));
}

TEST_CASE("gate: strokes between vertices on collapsed faces, and deep records, end without a signal") {
  const ScratchDirectory scratch;
  const std::string stroke = scratch / "s.json", minimal = scratch / "m.obj";
  write_text(stroke, R"({"strokes": [{"name": "a", "height": 0.01, "vertices": [0, 1]}]})");
  write_text(minimal, "v 0 0 0\nv 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\nf 4 5 3\n");
  check_refused("wrinkle " + minimal + " " + stroke, 3, "which is degenerate (it has no area)");
  const std::string deep(300000, '[');
  write_text(scratch / "deep.ply",
             "ply\nformat ascii 1.0\ncomment furrow wrinkle {\"strokes\":" + deep +
                 "\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                 "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Run run = run_furrow("info " + (scratch / "deep.ply"));
  CHECK(run.exit_code == 3);
  CHECK_THAT(run.err, Contains("deep.ply: the comment 'furrow wrinkle' is damaged: it is nested more than"));
}

TEST_CASE("gate: names that are not UTF-8 are shown, and a state refuses them before the run") {
  const ScratchDirectory scratch;
  write_text(scratch / "latin.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng \xe9toffe\nusemtl \xe9toffe\nf 1 2 3\n");
  const Run info = run_furrow("info " + (scratch / "latin.obj"));
  CHECK(info.exit_code == 0);
  CHECK(info.err.empty());
  CHECK_THAT(info.out, Contains("toffe"));
  CHECK(nlohmann::json::parse(run_furrow("info --json " + (scratch / "latin.obj")).out)["groups"].size() ==
        1);
  const std::string ball = scratch / "b\xe9.obj", state = scratch / "s.ply";
  std::filesystem::copy_file(mannequin, ball);
  const Run run = run_furrow("simulate " + sheet + " --body '" + ball + "' --save-state " + state);
  CHECK(run.exit_code == 2);
  CHECK_THAT(run.err, Contains("not UTF-8") && Contains("rename"));
  CHECK_FALSE(std::filesystem::exists(state));
}

TEST_CASE("gate: a height larger than the garment is asked about, and drawn with --force") {
  const ScratchDirectory scratch;
  write_text(scratch / "s.json",
             R"({"strokes": [{"name": "a", "height": 10, "points": [[-0.1, 0, 0], [0.1, 0, 0]]}]})");
  const std::string wrinkle = "wrinkle " + sheet + " " + (scratch / "s.json") + " --max-distance 9";
  check_refused(wrinkle, 3, "stroke 'a': its height is 10");
  check_refused(wrinkle, 3, "write 0.01 for 10");
  const Run run = run_furrow(wrinkle + " --force -o " + (scratch / "o.ply"));
  CHECK(run.exit_code == 0);
  CHECK_THAT(run.err, Contains("stroke 'a': its height is 10"));
}

TEST_CASE("gate: the files that once crashed the program end with an exit code", "[long]") {
  const std::filesystem::path folder = shared_dir() / "defects";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: no shared data");
    return;
  }
  const ScratchDirectory scratch;
  const auto ends = [&](const std::string& arguments) {
    const Run run = run_furrow(arguments);
    INFO(arguments << "\n" << run.err);
    CHECK(run.exit_code < 126);
    CHECK(run.exit_code != 1);
  };
  const auto in = [&](const char* name) { return (folder / name).string() + " "; };
  const std::string out = "-o " + (scratch / "o.ply");
  ends("wrinkle " + in("r8b_minimal.obj") + in("r8_stroke.json") + out);
  ends("wrinkle " + in("r8_zero_length.obj") + in("r8_stroke.json") + out);
  ends("wrinkle " + in("r8c_sheet_zero.obj") + in("r8c_stroke.json") + out);
  for (const char* name : {"r1_deep_record.ply", "r3_latin1.obj", "g_dag.gltf", "g_sparse.gltf",
                           "glb-slow.glb", "r_glb_1GB.glb"})
    ends("info " + in(name));
  ends("simulate --state " + in("r1b_deep_state.ply") + out);
  ends("simulate " + in("r2_deep_keys.toml") + out);
}
