// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/draw/stroke_list.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/sheet.h"
#include "jobs/chain/wrinkle.h"
#include "jobs/mesh/info.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"

using namespace furrow;
namespace fs = std::filesystem;

TEST_CASE("strokes: those of a file are those of the PLY that was wrinkled with them") {
  const fs::path folder = tests::empty_folder("stroke_list");
  tests::Recorder recorder;
  const jobs::Context context{{}, recorder};
  jobs::WrinkleJob draw;
  io::MeshFile sheet;
  sheet.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.03);
  draw.garment = sheet;
  std::ofstream(folder / "a.json")
      << R"({"strokes": [{"name": "a", "points": [[-0.1, 0.2, 0], [0.1, 0.2, 0]]}]})";
  draw.strokes = folder / "a.json";
  draw.output = folder / "wrinkled.ply";
  const io::MeshFile wrinkled = jobs::wrinkle(draw, recorder).garment;
  io::write_mesh(folder / "plain.ply", sheet);
  auto list = jobs::read_stroke_list(folder / "a.json", context);
  CHECK(jobs::to_json(jobs::read_stroke_list(folder / "wrinkled.ply", context)) == jobs::to_json(list));
  CHECK_THROWS_AS(jobs::read_stroke_list(folder / "plain.ply", context), geometry::ContentError);
  const jobs::Json rows = jobs::to_json(list, jobs::lay_on(list, sheet, context));
  CHECK(rows.at(0).at("length") == 0.2);
  CHECK(rows.at(0).at("length_on_garment").get<double>() == Approx(0.2));
  CHECK(rows.at(0).at("parts") == 1);
  list[0].stroke.width = 0.1;
  CHECK_FALSE(jobs::to_json(list).at(0).contains("sharpness"));  // which one that is depends on the rule
  list[0].stroke.sharpness = 0.3;
  CHECK(jobs::to_json(list).at(0).at("sharpness") == 0.3);
  list[0].stroke.width = -1;
  CHECK_THROWS_AS(jobs::check_shapes(list), std::invalid_argument);
  CHECK(jobs::info(wrinkled).at("lines") == jobs::Json{"a"});
  CHECK(jobs::info(sheet).at("faces") == sheet.mesh->number_of_faces());
}
