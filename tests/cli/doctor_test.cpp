// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow::tests;
using Catch::Contains;

namespace {

const std::string our_meshes = FURROW_SOURCE_DIR "/meshes/";

/// Two triangles of a square, each with corners of its own.
const std::string loose_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n";

nlohmann::json examined(const std::string& arguments) {
  const Run run = run_furrow("doctor --json " + arguments);
  INFO(arguments << "\n" << run.err);
  REQUIRE((run.exit_code == 0 || run.exit_code == 4));
  return nlohmann::json::parse(run.out);
}

}  // namespace

TEST_CASE("doctor: the program says what is wrong, shows where, mends it and exits with 4 or 0") {
  const ScratchDirectory scratch;
  const std::string mesh = scratch / "soup.obj", mended = scratch / "mended.obj", png = scratch / "p.png";
  write_text(mesh, loose_square);
  const Run found = run_furrow("doctor " + mesh + " --picture " + png + " --size 80,80");
  CHECK(found.exit_code == 4);
  CHECK_THAT(found.out, Contains("furrow doctor --repair joins them"));
  CHECK_THAT(found.out, Contains("\nnext: furrow doctor " + mesh + " --repair -o mended.obj"));
  CHECK_THAT(found.out, !Contains("well: false"));
  CHECK(std::filesystem::file_size(png) > 100);
  const Run repaired = run_furrow("doctor " + mesh + " --repair -o " + mended);
  CHECK(repaired.exit_code == 0);
  CHECK(examined(mended)["well"] == true);
  CHECK(examined(mended)["vertices"] == 4);
  CHECK(run_furrow("doctor " + mesh + " -o " + mended).exit_code == 2);
  CHECK(run_furrow("doctor " + mesh + " --repair -o " + mesh).exit_code == 2);
}

TEST_CASE("doctor: panels 10 um apart are told with count, place and remedy, and joined, in motion, too") {
  const ScratchDirectory scratch;
  const std::string mesh = scratch / "panels.obj", mended = scratch / "mended.obj";
  std::string text;
  for (const double x : {0., 1.00001})
    for (int i = 0; i <= 5; ++i)
      text += "v " + std::to_string(x) + " " + std::to_string(0.2 * i) + " 0\nv " + std::to_string(x + 1) +
              " " + std::to_string(0.2 * i) + " 0\n";
  for (const int first : {1, 13})
    for (int i = first; i < first + 10; i += 2)
      text += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 3) + " " +
              std::to_string(i + 2) + "\n";
  write_text(mesh, text);
  const Run found = run_furrow("doctor " + mesh);
  CHECK(found.exit_code == 4);
  CHECK_THAT(found.out,
             Contains("found: 6 vertices of seams lie up to 0.01 mm from the other side (a seam is joined "
                      "within 1/100 of its edges, here 2 mm): what meets there is not joined; the first at "
                      "(1.000, 0.000, 0.000) m; furrow doctor --repair joins them"));
  const Run hung =
      run_furrow("simulate " + mesh + " --pin-loop top --seconds 0.001 -o " + (scratch / "hung.ply"));
  CHECK_THAT(hung.err, Contains("seams joined that its file leaves open: 6 vertices, up to 0.01 mm"));
  CHECK_THAT(hung.err, Contains("--set garment.join=false leaves them open"));
  write_text(scratch / "lines.json",
             R"({"strokes": [{"name": "a", "height": 0.02, "points": [[0.3, 0.5, 0], [0.7, 0.5, 0]]}]})");
  const std::string draw = "wrinkle " + mesh + " " + (scratch / "lines.json") + " -o " + (scratch / "w.ply");
  CHECK_THAT(run_furrow(draw).err, Contains("--set garment.join=false leaves them open"));
  CHECK_THAT(run_furrow(draw + " --set garment.join=false").err, !Contains("seams joined"));
  CHECK_THAT(run_furrow(draw + " --set unit=cm").err, Contains("--set unit: goes with"));
  const Run mistaken = run_furrow(draw + " --set material.density=1");
  CHECK(mistaken.exit_code == 2);
  CHECK_THAT(mistaken.err, Contains("--set material.density: goes with --rest keep or --settle"));
  CHECK(run_furrow("doctor " + mesh + " --repair -o " + mended).exit_code == 0);
  CHECK(examined(mended)["well"] == true);
  CHECK(examined(mended)["components"] == 1);
}

TEST_CASE("doctor: our garments on our bodies are well, and each job says so by saying nothing", "[long]") {
  for (const char* garment : {"skirt.obj", "shirt.obj", "sheet.obj"}) {
    const nlohmann::json report = examined(our_meshes + garment + " --body " + our_meshes + "mannequin.obj");
    INFO(report.dump(1));
    CHECK(report["well"] == true);
  }
  CHECK(examined(our_meshes + "mannequin.obj --as-body")["well"] == true);
  const std::string body = our_meshes + "mannequin.obj";
  const Run said = run_furrow("doctor " + our_meshes + "skirt.obj --body " + body);
  CHECK_THAT(said.out, Contains("well: no faults found\n"));
  CHECK_THAT(said.out, Contains("(width, height, depth)"));
  CHECK_THAT(said.out, Contains("next: furrow drape " + our_meshes + "skirt.obj --body " + body));
}

TEST_CASE("doctor: garments and bodies of other makers are given no false alarm", "[release]") {
  const std::filesystem::path folder = shared_dir() / "meshes/pairs";
  if (!std::filesystem::exists(folder)) {
    WARN("skipped: no shared data");
    return;
  }
  for (const auto& person : std::filesystem::directory_iterator(folder)) {
    const std::filesystem::path body = person.path() / "body.obj";
    if (!std::filesystem::exists(body)) continue;
    for (const auto& garment : std::filesystem::directory_iterator(person.path())) {
      if (garment.path().extension() != ".obj" || garment.path() == body) continue;
      const std::string of_file = garment.path().string(), on = body.string();
      const nlohmann::json right = examined(of_file + " --body " + on);
      INFO(of_file << ": " << right.dump(1));
      for (const auto& ailment : right["found"]) CHECK(ailment["code"] == "holes");  // suits have some
      bool exchanged = false;
      const nlohmann::json wrong = examined(on + " --body " + of_file);
      for (const auto& ailment : wrong["found"]) exchanged = exchanged || ailment["code"] == "exchanged";
      CHECK(exchanged);
    }
  }
}
