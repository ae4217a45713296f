// SPDX-License-Identifier: GPL-3.0-or-later
// Ctrl-C at any moment of what takes long: the program ends by itself, and leaves a whole file or a sentence.
#include <catch2/catch.hpp>
#include <filesystem>

#include "geometry/mesh/mesh.h"
#include "io/mesh/mesh_file.h"
#include "journey.h"

using namespace furrow::tests;

TEST_CASE("journeys: Ctrl-C ends every long command with a whole file or a sentence", "[release]") {
  const Journey here;
  here.bring("meshes/tunic.obj");
  here.bring_body_of_tunic("she.obj");
  write_text("line.json", R"({"strokes": [{"name": "one", "height": 0.01, "vertices": [0, 40]}]})");
  const std::string words = GENERATE(
      "drape tunic.obj --body she.obj --subdivide 3", "wrinkle tunic.obj line.json --settle --body she.obj",
      "simulate tunic.obj --body she.obj --seconds 60", "transfer tunic.obj tunic.obj --rest-shape tunic.obj",
      "doctor tunic.obj --body she.obj", "drape tunic.obj --body she.obj --self-contact on --starts 9");
  const std::string after = GENERATE("0.2", "0.4", "0.8", "2");
  std::filesystem::remove("out.ply");
  const bool writes = words.rfind("doctor", 0) != 0;
  const Run run = run_furrow(words + (writes ? " -o out.ply" : ""),
                             "timeout --signal=INT --preserve-status --kill-after=20 " + after);
  CAPTURE(words, after, run.exit_code, run.err);
  CHECK((run.exit_code == 0 || run.exit_code == 4 || run.exit_code == 130));
  if (std::filesystem::exists("out.ply"))
    CHECK(furrow::io::read_mesh("out.ply").mesh->number_of_faces() > 0);
  else
    CHECK((!writes || !run.err.empty()));
}
