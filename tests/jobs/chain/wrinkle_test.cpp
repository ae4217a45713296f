// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/chain/wrinkle.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "geometry/mesh/edge_metric.h"
#include "geometry/mesh/sheet.h"
#include "geometry/mesh/struts.h"
#include "io/mesh/mesh_file.h"
#include "jobs/draw/recorded_drawing.h"
#include "jobs/mesh/transfer.h"
#include "jobs/rest/drape.h"
#include "physics/base/progress.h"
#include "tests/jobs/job_folders.h"
#include "tests/jobs/recorder.h"
#include "tests/test_meshes.h"

using namespace furrow;
namespace fs = std::filesystem;

namespace {

/// A sheet with a ridge across it, in memory.
jobs::WrinkleJob ridged_sheet(double height = 0.01) {
  jobs::WrinkleJob job;
  io::MeshFile sheet;
  sheet.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.03);
  job.garment = sheet;
  io::DrawnStroke ridge;
  ridge.stroke.name = "ridge";
  ridge.stroke.height = height;
  ridge.stroke.points = {{-0.1, 0.2, 0}, {0.1, 0.2, 0}};
  job.strokes = std::vector{ridge};
  return job;
}

/// The same of silk, which comes to rest, hung by its upper edge.
jobs::WrinkleJob hung_silk() {
  jobs::WrinkleJob job = ridged_sheet();
  job.settle.emplace();
  io::set_value(job.settle->settings, "pins.0", io::Json{{"box", {-1, 0.399, -1, 1, 1, 1}}}, "test");
  io::set_value(job.settle->settings, "material.preset", "silk", "test");
  return job;
}

void write_strokes(const fs::path& path) {
  std::ofstream(path)
      << R"({"strokes": [{"name": "ridge", "height": 0.01, "points": [[-0.1, 0.2, 0], [0.1, 0.2, 0]]}]})";
}

}  // namespace

TEST_CASE("wrinkle: a garment and strokes in memory come to the bits of their files") {
  const fs::path folder = tests::empty_folder("wrinkle_memory");
  tests::Recorder recorder;
  const jobs::WrinkleJob in_memory = ridged_sheet();
  jobs::WrinkleJob of_files = in_memory;
  io::write_mesh(folder / "sheet.ply", std::get<io::MeshFile>(in_memory.garment));
  write_strokes(folder / "ridge.json");
  of_files.garment = folder / "sheet.ply";
  of_files.strokes = folder / "ridge.json";
  of_files.output = folder / "ridged.ply";
  const jobs::WrinkleReport a = jobs::wrinkle(in_memory, recorder), b = jobs::wrinkle(of_files, recorder);
  CHECK(a.drawn.round.report.lines.size() == 1);
  CHECK(a.garment.mesh->number_of_vertices() >
        std::get<io::MeshFile>(in_memory.garment).mesh->number_of_vertices());
  CHECK(tests::positions(a.garment) == tests::positions(b.garment));
  CHECK(to_json(a) == to_json(b));
  CHECK(tests::positions(io::read_mesh(folder / "ridged.ply")) == tests::positions(b.garment));
  CHECK(recorder.warnings.empty());
}

TEST_CASE("wrinkle: an OBJ in another folder names the material library from there, that of transfer, too") {
  const fs::path folder = tests::empty_folder("wrinkle_library");
  tests::Recorder recorder;
  for (const char* name : {"in", "out"}) fs::create_directory(folder / name);
  std::ofstream(folder / "in/cloth.mtl") << "newmtl silk\n";
  jobs::WrinkleJob job = ridged_sheet();
  io::MeshFile sheet = std::get<io::MeshFile>(job.garment);
  sheet.material_libraries = {"cloth.mtl"};
  io::write_mesh(folder / "in/sheet.obj", sheet);
  job.garment = folder / "in/sheet.obj";
  const auto written_to = [&](const char* name) {
    job.output = folder / name;
    jobs::wrinkle(job, recorder);
    return io::read_mesh(job.output).material_libraries;
  };
  using Names = std::vector<std::string>;
  CHECK(written_to("in/ridged.obj") == Names{"cloth.mtl"});
  CHECK(written_to("out/ridged.obj") == Names{"../in/cloth.mtl"});
  CHECK(written_to("out/ridged.ply").empty());
  jobs::TransferJob transfer;
  transfer.original = folder / "in/sheet.obj";
  transfer.wrinkled = folder / "out/ridged.ply";
  transfer.output = folder / "out/moved.obj";
  jobs::transfer(transfer, recorder);
  CHECK(io::read_mesh(transfer.output).material_libraries == Names{"../in/cloth.mtl"});
}

TEST_CASE("wrinkle: a ridge and a valley side by side within their widths are told, others are not",
          "[long]") {
  const auto told = [](double apart, double second) {
    jobs::WrinkleJob job;
    io::MeshFile sheet;
    sheet.mesh = geometry::equilateral_sheet(0.4, 0.4, 0.01);
    job.garment = sheet;
    std::vector<io::DrawnStroke> strokes(2);
    for (int i = 0; i < 2; ++i) {
      strokes[i].stroke.name = i ? "valley" : "ridge";
      strokes[i].stroke.height = i ? second : 0.01;
      strokes[i].stroke.width = 0.06;
      const double y = 0.2 + i * apart;
      strokes[i].stroke.points = {{-0.1, y, 0}, {0.1, y, 0}};
    }
    job.strokes = strokes;
    tests::Recorder recorder;
    jobs::wrinkle(job, recorder);
    return std::any_of(recorder.warnings.begin(), recorder.warnings.end(), [](const jobs::Warning& w) {
      return w.text.find("cancel each other") != std::string::npos;
    });
  };
  CHECK(told(0.005, -0.01));
  CHECK(told(0.02, -0.01));
  CHECK_FALSE(told(0.1, -0.01));
  CHECK_FALSE(told(0.02, 0.01));
}

TEST_CASE("wrinkle: what a wrinkled file was made of draws the same lines again") {
  const fs::path folder = tests::empty_folder("wrinkle_again");
  tests::Recorder recorder;
  jobs::WrinkleJob job = ridged_sheet();
  io::write_mesh(folder / "sheet.obj", std::get<io::MeshFile>(job.garment));
  job.garment = folder / "sheet.obj";
  job.output = folder / "ridged.ply";
  const jobs::WrinkleReport first = jobs::wrinkle(job, recorder);
  const jobs::RecordedDrawing recorded = jobs::recorded_drawing(job.output, {{}, recorder});
  CHECK(recorded.garment == folder / "sheet.obj");
  CHECK_FALSE(recorded.was_kept);
  CHECK(recorded.options.find("--rule fold") != std::string::npos);
  job.garment = recorded.garment;
  job.strokes = recorded.strokes;
  job.output.clear();
  CHECK(tests::positions(jobs::wrinkle(job, recorder).garment) == tests::positions(first.garment));
  CHECK_THROWS_AS(jobs::recorded_drawing(folder / "sheet.obj", {{}, recorder}), std::invalid_argument);
}

TEST_CASE("wrinkle: a cancelled job leaves nothing", "[long]") {
  const fs::path folder = tests::empty_folder("wrinkle_cancelled");
  jobs::WrinkleJob job = ridged_sheet();
  job.output = folder / "ridged.ply";
  job.inserted = folder / "inserted.ply";
  tests::Recorder all;
  jobs::wrinkle(job, all);
  REQUIRE(all.asked >= 3);
  for (int at = 1; at <= all.asked; at += std::max(1, all.asked / 30)) {
    fs::remove(job.output);
    fs::remove(job.inserted);
    tests::Recorder recorder(at);
    CHECK_THROWS_AS(jobs::wrinkle(job, recorder), physics::Cancelled);
    CHECK(tests::names_in(folder).empty());
  }
}

TEST_CASE("wrinkle: a job that cannot be is refused before anything is written") {
  const fs::path folder = tests::empty_folder("wrinkle_refused");
  tests::Recorder recorder;
  jobs::WrinkleJob job = ridged_sheet();
  io::write_mesh(folder / "sheet.obj", std::get<io::MeshFile>(job.garment));
  write_strokes(folder / "ridge.json");
  const std::string sheet = tests::bytes_of(folder / "sheet.obj");
  job.garment = folder / "sheet.obj";
  job.strokes = folder / "ridge.json";
  job.inserted = folder / "sheet.obj";
  CHECK_THROWS_AS(jobs::wrinkle(job, recorder), std::invalid_argument);
  job.inserted.clear();
  job.output = folder / "ridge.json";
  CHECK_THROWS_AS(jobs::wrinkle(job, recorder), std::invalid_argument);
  job.output = folder / "nowhere" / "out.ply";
  CHECK_THROWS_AS(jobs::wrinkle(job, recorder), std::runtime_error);
  job.output = folder / "out.ply";
  job.without = {"fold"};
  CHECK_THROWS(jobs::wrinkle(job, recorder));
  CHECK(tests::names_in(folder) == std::set<std::string>{"ridge.json", "sheet.obj"});
  CHECK(tests::bytes_of(folder / "sheet.obj") == sheet);
}

TEST_CASE("wrinkle: two jobs at once in one process give the bits of single runs") {
  tests::Recorder recorder;
  const jobs::WrinkleJob one = ridged_sheet(0.01), two = ridged_sheet(-0.02);
  const jobs::WrinkleReport single_one = jobs::wrinkle(one, recorder),
                            single_two = jobs::wrinkle(two, recorder);
  jobs::WrinkleReport both_one, both_two;
  std::thread other([&] {
    tests::Recorder own;
    both_two = jobs::wrinkle(two, own);
  });
  both_one = jobs::wrinkle(one, recorder);
  other.join();
  CHECK(tests::positions(both_one.garment) == tests::positions(single_one.garment));
  CHECK(tests::positions(both_two.garment) == tests::positions(single_two.garment));
  CHECK(tests::positions(both_one.garment) != tests::positions(both_two.garment));
}

TEST_CASE("wrinkle: with settle a line lasts, pressed where silk gives way, and the file notes its press") {
  tests::Recorder recorder;
  jobs::WrinkleJob job = hung_silk();
  const jobs::WrinkleReport held = jobs::wrinkle(job, recorder);
  REQUIRE(held.rest);
  INFO(to_json(held)["at_rest"]["lines"].dump(1));
  CHECK(held.rest->outcome() == "at rest");
  CHECK(held.rest->lines.at(0).kept.value() == Approx(1).margin(0.04));
  CHECK(held.rest->lines.at(0).press == 10);
  const auto record = io::find_wrinkle_record(held.garment);
  REQUIRE(record);
  CHECK(record->lines.at(0).press == 10);
  job.hold = false;
  const jobs::WrinkleReport fallen = jobs::wrinkle(job, recorder);
  CHECK(fallen.rest->lines.at(0).kept.value() < 0.95);
  CHECK(fallen.rest->lines.at(0).press == 1);
}

TEST_CASE(
    "wrinkle: a line of height 0 has no height to keep, is not pressed, and nothing is said to be lost") {
  tests::Recorder recorder;
  jobs::WrinkleJob job = hung_silk();
  std::get<std::vector<io::DrawnStroke>>(job.strokes)[0].stroke.height = 0;
  const jobs::WrinkleReport flat = jobs::wrinkle(job, recorder);
  REQUIRE(flat.rest);
  CHECK(flat.rest->outcome() == "at rest");
  CHECK(!flat.rest->lines.at(0).kept);
  CHECK(flat.rest->lines.at(0).press == 1);
  CHECK(!recorder.warned_of("lines_lost"));
}

TEST_CASE("wrinkle: a line with a press of its own is not pressed twice, and rests as one that got it") {
  tests::Recorder recorder;
  jobs::WrinkleJob job = hung_silk();
  const jobs::WrinkleReport once = jobs::wrinkle(job, recorder);
  std::get<std::vector<io::DrawnStroke>>(job.strokes)[0].stroke.press = 10;
  const jobs::WrinkleReport again = jobs::wrinkle(job, recorder);
  CHECK(again.rest->lines.at(0).press == 10);
  CHECK(tests::positions(again.garment) == tests::positions(once.garment));
}

TEST_CASE("wrinkle: with settle the drawn sheet comes to rest in cotton, as drape lets it") {
  const fs::path folder = tests::empty_folder("wrinkle_settle");
  tests::Recorder recorder;
  jobs::WrinkleJob job = ridged_sheet();
  job.settle.emplace();
  job.hold = false;
  job.smoothed = folder / "drawn.ply";
  job.output = folder / "rests.ply";
  CHECK_THROWS_WITH(jobs::wrinkle(job, recorder), Catch::Contains("`pin_loop`") && Catch::Contains("`body`"));
  io::set_value(job.settle->settings, "pins.0", io::Json{{"box", {-1, 0.399, -1, 1, 1, 1}}}, "test");
  const jobs::WrinkleReport report = jobs::wrinkle(job, recorder);
  REQUIRE(report.rest);
  INFO(to_json(report)["at_rest"].dump(1));
  CHECK(report.rest->outcome() == "at rest");
  CHECK(report.failures.empty());
  CHECK(tests::positions(io::read_mesh(folder / "rests.ply")) == tests::positions(report.garment));
  jobs::DrapeJob drape;
  drape.scene.settings = job.settle->settings;
  io::set_value(drape.scene.settings, "garment.mesh", (folder / "drawn.ply").string(), "test");
  const jobs::DrapeJobReport draped = jobs::drape(drape, recorder);
  CHECK(tests::positions(draped.garments.at(0).file) == tests::positions(report.garment));
  const auto record = io::find_wrinkle_record(io::read_mesh(folder / "rests.ply"));
  REQUIRE(record);
  CHECK(record->material.find("cotton") != std::string::npos);
  CHECK(record->lines.size() == 1);
}

TEST_CASE(
    "wrinkle: with settle a garment of long edges is refined before its lines are drawn, unless told not "
    "to",
    "[release]") {
  tests::Recorder refining, leaving;
  jobs::WrinkleJob job = ridged_sheet();
  job.settle.emplace();
  geometry::Mesh& sheet = std::get<io::MeshFile>(job.garment).mesh;
  sheet = geometry::equilateral_sheet(0.4, 0.4, 0.05);
  for (geometry::Point& p : sheet.points()) p = {p.x(), 0.105, p.y() - 0.2};
  auto& strokes = std::get<std::vector<io::DrawnStroke>>(job.strokes);
  strokes[0].stroke.points = {{-0.1, 0.105, 0.02}, {0.1, 0.105, 0.02}};
  job.settle->memory.meshes["ball"].mesh = tests::icosphere(2, 0.1);
  io::set_value(job.settle->settings, "body.mesh", "ball", "test");
  io::set_value(job.settle->settings, "body.tolerance", 0.0005, "test");
  job.subdivide = 0;
  const jobs::WrinkleReport coarse = jobs::wrinkle(job, leaving);
  CHECK(coarse.rest->floats());
  CHECK_FALSE(leaving.warned_of("refined_first"));
  job.subdivide.reset();
  const jobs::WrinkleReport fine = jobs::wrinkle(job, refining);
  INFO(to_json(fine)["at_rest"].dump(1));
  CHECK(refining.warned_of("refined_first"));
  CHECK(fine.rest->refinements > 0);
  CHECK_FALSE(fine.rest->floats());
  CHECK(fine.garment.mesh->number_of_vertices() > coarse.garment.mesh->number_of_vertices());
  CHECK(io::find_wrinkle_record(fine.garment)->garment.empty());
  job.subdivide = 5;
  CHECK_THROWS_WITH(jobs::wrinkle(job, leaving),
                    Catch::Contains("`subdivide` takes a whole number in [0, 4], not 5"));
}

TEST_CASE("wrinkle: with settle a thread gathers its line, and the ridge beside it stands", "[release]") {
  jobs::WrinkleJob job = hung_silk();
  auto& strokes = std::get<std::vector<io::DrawnStroke>>(job.strokes);
  strokes.front().stroke.points = {{-0.1, 0.1, 0}, {0.1, 0.1, 0}};
  io::DrawnStroke thread;
  thread.stroke.name = "thread";
  thread.stroke.height = 0;
  thread.stroke.gather = 0.8;
  thread.stroke.points = {{-0.15, 0.2, 0}, {0.15, 0.2, 0}};
  strokes.push_back(thread);
  tests::Recorder recorder;
  const jobs::WrinkleReport report = jobs::wrinkle(job, recorder);
  REQUIRE(report.rest);
  CHECK(report.rest->outcome() == "at rest");
  CHECK(report.rest->end.crossings == 0);
  REQUIRE(report.rest->lines.size() == 2);
  const jobs::LineReport& gathered = report.rest->lines[1];
  REQUIRE(gathered.gathered);
  CHECK(*gathered.gathered == Approx(0.8).epsilon(0.02));
  CHECK(gathered.press == 1);
  CHECK(!gathered.kept);
  CHECK(!report.rest->lines[0].gathered);
  REQUIRE(report.rest->lines[0].kept);
  CHECK(*report.rest->lines[0].kept > 0.8);
  CHECK(!recorder.warned_of("line_not_gathered"));
  CHECK(io::gathered_lines(*io::find_wrinkle_record(report.garment)) == std::vector<int>{1});
}

TEST_CASE("wrinkle: kept as drawn, a thread is no load, and draws its line in afterwards") {
  jobs::WrinkleJob job = hung_silk();
  job.keep = std::exchange(job.settle, std::nullopt);
  auto& stroke = std::get<std::vector<io::DrawnStroke>>(job.strokes).front().stroke;
  tests::Recorder recorder;
  const jobs::WrinkleReport plain = jobs::wrinkle(job, recorder);
  stroke.gather = 0.8;
  const jobs::WrinkleReport gathered = jobs::wrinkle(job, recorder);
  CHECK(tests::positions(gathered.garment) == tests::positions(plain.garment));
  CHECK(geometry::rest_lengths(gathered.garment.mesh) == geometry::rest_lengths(plain.garment.mesh));
  const std::vector<geometry::Strut> thread = geometry::struts(gathered.garment.mesh);
  CHECK(geometry::struts(plain.garment.mesh).empty());
  REQUIRE(thread.size() > 2);
  double length = 0;
  for (const geometry::Strut& s : thread) length += s.rest_length;
  CHECK(length < 0.85 * 0.2);
}

TEST_CASE("drape: a line that rest loses is warned of by its name") {
  tests::Recorder recorder;
  jobs::WrinkleJob drawn = ridged_sheet();
  jobs::DrapeJob job;
  job.scene.memory.meshes["ridged"] = jobs::wrinkle(drawn, recorder).garment;
  io::set_value(job.scene.settings, "garment.mesh", "ridged", "test");
  io::set_value(job.scene.settings, "pins.0", io::Json{{"box", {-1, 0.399, -1, 1, 1, 1}}}, "test");
  io::set_value(job.scene.settings, "forces.gravity", 1000, "test");  // draws the sheet taut
  const jobs::DrapeJobReport report = jobs::drape(job, recorder);
  INFO(to_json(report).dump(1));
  REQUIRE(report.garments.at(0).rests());
  REQUIRE(report.garments[0].lines.size() == 1);
  REQUIRE(*report.garments[0].lines[0].kept < 0.5);
  const auto lost = std::find_if(report.remarks.begin(), report.remarks.end(),
                                 [](const jobs::DrapeRemark& r) { return r.remark.code == "lines_lost"; });
  REQUIRE(lost != report.remarks.end());
  CHECK_FALSE(lost->fails);
  CHECK(lost->remark.text.find("'ridge'") != std::string::npos);
}

TEST_CASE("wrinkle: a fold wider than half of its garment is told, as its height was hardly meant") {
  for (const double height : {0.015, 0.15}) {
    jobs::WrinkleJob job = ridged_sheet();
    geometry::Mesh& sheet = std::get<io::MeshFile>(job.garment).mesh;
    sheet = geometry::equilateral_sheet(0.5, 0.4, 0.02);
    auto& strokes = std::get<std::vector<io::DrawnStroke>>(job.strokes);
    strokes[0].stroke.points = {{-0.15, 0.2, 0}, {0.15, 0.2, 0}};
    strokes[0].stroke.height = height;
    strokes[0].stroke.width.reset();
    job.options.insertion.rule = geometry::InsertionRule::fold;
    tests::Recorder recorder;
    jobs::wrinkle(job, recorder);
    const bool told =
        std::any_of(recorder.warnings.begin(), recorder.warnings.end(), [](const jobs::Warning& w) {
          return w.text.find("wide, on a garment of") != std::string::npos &&
                 w.text.find("heights are in metres") != std::string::npos;
        });
    CHECK(told == (height > 0.1));
  }
}
