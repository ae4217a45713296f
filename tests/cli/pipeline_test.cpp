// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

/// A level sheet of n x n squares, 1 m wide, and one ridge across it.
struct Sheet {
  ScratchDirectory scratch;
  std::string mesh = scratch / "sheet.obj", strokes = scratch / "strokes.json",
              wrinkled = scratch / "wrinkled.ply";
  explicit Sheet(int n = 12) {
    std::string text;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        text += "v " + std::to_string(double(i) / n) + " 0 " + std::to_string(-double(j) / n) + "\n";
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int a = i * (n + 1) + j + 1, b = a + n + 1;
        text += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(b + 1) + " " +
                std::to_string(a + 1) + "\n";
      }
    write_text(mesh, text);
    write_text(strokes,
               R"({"strokes":[{"name":"fold","height":0.03,"points":[[0.2,0,-0.52],[0.8,0,-0.47]]}]})");
  }
  json wrinkle(const std::string& more = "") {
    const Run run = run_furrow("wrinkle --json " + mesh + " " + strokes + " -o " + wrinkled + " " + more);
    INFO(run.err);
    REQUIRE(run.exit_code == 0);
    return json::parse(run.out);
  }
};

}  // namespace

TEST_CASE("pipeline: wrinkle reports what it did and writes what simulate needs") {
  Sheet sheet;
  const json report = sheet.wrinkle();
  CHECK(report["inserted"].get<int>() > 5);
  CHECK(report["inverted_faces"] == 0);
  CHECK(report["line_edges_missing"].empty());
  CHECK(report["rest_area_after"].get<double>() > report["rest_area_before"].get<double>());
  CHECK(report["total_mass"].get<double>() == Approx(0.15 * report["rest_area_after"].get<double>()));
  CHECK(report["lines"][0]["name"] == "fold");
  CHECK(report["lines"][0]["crest_height"].get<double>() == Approx(0.03).epsilon(0.03));
  const std::string ply = read_text(sheet.wrinkled);
  for (const char* word : {"property double x", "property int line", "property double mass", "element edge",
                           "property int vertex1", "property int vertex2", "property double rest_length",
                           "comment furrow wrinkle"})
    CHECK(ply.find(word) != std::string::npos);
}

TEST_CASE("pipeline: flat rest adds no cloth, drawn rest does") {
  Sheet sheet;
  const json flat = sheet.wrinkle("--rest flat");
  CHECK(flat["rest_area_after"].get<double>() ==
        Approx(flat["rest_area_before"].get<double>()).epsilon(1e-12));
}

TEST_CASE(
    "pipeline: a wrinkled mesh without gravity stays as drawn, and its lines are measured against what they "
    "were") {
  Sheet sheet;
  sheet.wrinkle();
  const std::string out = sheet.scratch / "still.ply";
  const Run run = run_furrow("simulate --json " + sheet.wrinkled + " -o " + out +
                             " --membrane paper --gravity 0 --seconds 0.05");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json report = json::parse(run.out);
  CHECK(report["lines"][0]["kept"].get<double>() == Approx(1).margin(1e-6));
  CHECK(report["strain"]["max"].get<double>() < 1e-9);
  CHECK(report["self_intersections"] == 0);
}

TEST_CASE("pipeline: two runs, and runs with one and two threads, write the same bytes") {
  Sheet sheet;
  sheet.wrinkle();
  std::string first;
  for (const char* threads : {"1", "2", "2"}) {
    const std::string out = sheet.scratch / (std::string("hung") + threads + ".ply");
    REQUIRE(run_furrow("simulate -q " + sheet.wrinkled + " -o " + out +
                       " --seconds 0.1 --pin-box 0,-1,-1,0,1,0 --threads " + threads)
                .exit_code == 0);
    if (first.empty()) first = read_text(out);
    CHECK(read_text(out) == first);
  }
}

TEST_CASE("pipeline: the sheet comes to rest on a box, no vertex inside it by exact distance", "[long]") {
  Sheet sheet;
  write_text(sheet.scratch / "box.obj",
             "v -0.5 -0.5 -1.5\nv 1.5 -0.5 -1.5\nv 1.5 -0.5 0.5\nv -0.5 -0.5 0.5\n"
             "v -0.5 -0.02 -1.5\nv 1.5 -0.02 -1.5\nv 1.5 -0.02 0.5\nv -0.5 -0.02 0.5\n"
             "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
  sheet.wrinkle();
  const Run run = run_furrow("simulate --json " + sheet.wrinkled + " -o " + (sheet.scratch / "lying.ply") +
                             " --body " + (sheet.scratch / "box.obj") + " --seconds 0.3");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json report = json::parse(run.out);
  CHECK(report["vertices_inside"] == 0);
  CHECK(report["contacts"].get<int>() > 50);
  CHECK(report["contact_gap"].get<double>() >= 0.003);
}

TEST_CASE("pipeline: an interrupted simulation writes the state it reached and exits with 130") {
  // `timeout` sends the signal to the process and to its group: two that follow each other are one.
  const std::string more = GENERATE("", " sleep 0.002; kill -INT $p;");
  Sheet sheet;
  const std::string out = sheet.scratch / "part.ply", code = sheet.scratch / "code",
                    err = sheet.scratch / "err";
  const std::string command =
      "simulate " + sheet.mesh + " -o " + out + " --seconds 100000 --progress 0.05 2>" + err +
      " & p=$!; while kill -0 $p && ! grep -q simulating " + err +
      " 2>/dev/null; do sleep 0.05; done; kill -INT $p;" + more + " wait $p; echo $? >" + code + "; true";
  const Run run = run_furrow(command);
  CHECK(read_text(code) == "130\n");
  CHECK(run_furrow("info " + out).exit_code == 0);
  CHECK_FALSE(std::filesystem::exists(out + ".tmp"));
}

TEST_CASE("pipeline: a step above the limit diverges when it is forced, and nothing is written") {
  Sheet sheet;
  const std::string out = sheet.scratch / "gone.ply";
  const Run run = run_furrow("simulate " + sheet.mesh + " -o " + out +
                             " --pin-vertices 0,12 --dt 0.02 --force-dt --seconds 5");
  CHECK(run.exit_code == 4);
  CHECK(run.err.rfind("error: ", 0) == 0);
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("pipeline: render writes a picture, and a strip of several") {
  Sheet sheet;
  sheet.wrinkle();
  REQUIRE(run_furrow("render -q " + sheet.wrinkled + " -o " + (sheet.scratch / "one.png") + " --size 200,150")
              .exit_code == 0);
  CHECK(read_text(sheet.scratch / "one.png").rfind("\x89PNG", 0) == 0);
  REQUIRE(run_furrow("render -q --strip " + sheet.mesh + " " + sheet.wrinkled + " -o " +
                     (sheet.scratch / "strip.png") + " --size 200,150 --captions before,after")
              .exit_code == 0);
  CHECK(read_text(sheet.scratch / "strip.png").rfind("\x89PNG", 0) == 0);
}

TEST_CASE("pipeline: a field that sdf keeps serves another run, and another body gets its own") {
  Sheet sheet;
  const std::string body = sheet.scratch / "tetra.obj", other = sheet.scratch / "other.obj",
                    cache = sheet.scratch / "cache";
  const auto fields = [&] {
    return std::ranges::count_if(std::filesystem::directory_iterator(cache),
                                 [](const auto& file) { return file.path().extension() == ".field"; });
  };
  write_text(body, "v 0 -1 0\nv 1 -1 0\nv 0 -1 -1\nv 0 -0.1 0\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n");
  write_text(other, "v 0 -2 0\nv 1 -1 0\nv 0 -1 -1\nv 0 -0.1 0\nf 1 2 4\nf 2 3 4\nf 3 1 4\nf 1 3 2\n");
  REQUIRE(run_furrow("sdf -q " + body + " --cache " + cache).exit_code == 0);
  CHECK(fields() == 1);
  const std::string call = "simulate -q --seconds 0.01 " + sheet.mesh + " --cache " + cache + " -o " +
                           (sheet.scratch / "o.ply") + " --body ";
  CHECK(run_furrow(call + body).exit_code == 0);
  CHECK(fields() == 1);
  CHECK(run_furrow(call + other).exit_code == 0);
  CHECK(fields() == 2);
}

TEST_CASE(
    "pipeline: a second round of lines keeps the ids, records, mean rest lengths and density of the first") {
  Sheet sheet;
  sheet.wrinkle("--density 0.3");
  const std::string second = sheet.scratch / "second.json", both = sheet.scratch / "both.ply";
  write_text(second, R"({"strokes":[{"name":"more","height":-0.02,"points":[[0.2,0,-0.2],[0.8,0,-0.2]]}]})");
  const Run run = run_furrow("wrinkle --json " + sheet.wrinkled + " " + second + " -o " + both);
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  const json report = json::parse(run.out);
  CHECK(report["lines"][0]["id"] == 1);
  CHECK(report["total_mass"].get<double>() == Approx(0.3 * report["rest_area_after"].get<double>()));
  const auto record = [](const std::string& path) {
    const std::string ply = read_text(path);
    const std::size_t at = ply.find("furrow wrinkle ") + 15;
    return json::parse(ply.substr(at, ply.find('\n', at) - at));
  };
  CHECK(record(both)["r_avg_structural"] == record(sheet.wrinkled)["r_avg_structural"]);
  CHECK(record(both)["lines"].size() == 2);
  const Run still =
      run_furrow("simulate --json --gravity 0 --seconds 0.02 " + both + " -o " + (sheet.scratch / "o.ply"));
  REQUIRE(still.exit_code == 0);
  const json lines = json::parse(still.out)["lines"];
  REQUIRE(lines.size() == 2);
  CHECK(lines[0]["name"] == "fold");
  CHECK(lines[1]["name"] == "more");
  // The second line lies in the slope of the first: a flip across it keeps its length on the cloth, not in
  // space.
  CHECK(json::parse(still.out)["strain"]["max"].get<double>() < 3e-4);
}

TEST_CASE("pipeline: the same stroke twice gives the height of the second, and the mesh can be simulated") {
  Sheet sheet;
  write_text(sheet.strokes,
             R"({"strokes":[{"height":0.03,"points":[[0.2,0,-0.52],[0.8,0,-0.47]]},
                            {"height":0.01,"points":[[0.2,0,-0.52],[0.8,0,-0.47]]}]})");
  const json report = sheet.wrinkle("--rule safe");
  CHECK(report["lines"][1]["drawn_height"].get<double>() == Approx(0.01).margin(1e-3));
  const Run run =
      run_furrow("simulate --json --seconds 0.01 " + sheet.wrinkled + " -o " + (sheet.scratch / "o.ply"));
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
}

TEST_CASE("pipeline: a wrinkled mesh that is refined again still has its springs and gets its masses",
          "[long]") {
  Sheet sheet;
  sheet.wrinkle();
  write_text(sheet.strokes, R"({"strokes":[{"points":[[0.3,0,-0.15],[0.7,0,-0.15]]}]})");
  const std::string finer = sheet.scratch / "finer.ply";
  for (const std::string& how :
       {"--strokes " + sheet.strokes, std::string("--all"), std::string("--subdivide 1")}) {
    INFO(how);
    REQUIRE(run_furrow("subdivide -q " + sheet.wrinkled + " " + how + " -o " + finer).exit_code == 0);
    const Run run = run_furrow("simulate --json --gravity 0 --seconds 0.001 " + finer + " -o " +
                               (sheet.scratch / "o.ply"));
    INFO(run.err);
    CHECK(run.exit_code == 0);
  }
}

TEST_CASE("pipeline: a PLY in centimetres says so, and is read as such without a flag") {
  Sheet sheet;
  const std::string cm = sheet.scratch / "cm.ply";
  write_text(sheet.scratch / "cm.obj", "v 0 0 0\nv 100 0 0\nv 100 100 0\nv 0 100 0\nf 1 2 3 4\n");
  write_text(sheet.strokes, R"({"strokes":[{"height":0.1,"points":[[60,40,0]]}]})");
  REQUIRE(run_furrow("wrinkle -q --rule safe --iterations 0 --unit cm " + (sheet.scratch / "cm.obj") + " " +
                     sheet.strokes + " -o " + cm)
              .exit_code == 0);
  const json report = json::parse(run_furrow("info --json " + cm).out);
  CHECK(report["bounding_box"]["max"][0].get<double>() == Approx(1));
}

TEST_CASE("pipeline: what cannot be written is said before the work is done") {
  Sheet sheet;
  CHECK(
      run_furrow("simulate --seconds 100000 " + sheet.mesh + " -o " + (sheet.scratch / "o.gltf")).exit_code ==
      2);
  CHECK(run_furrow("simulate --seconds 100000 " + sheet.mesh + " -o " + (sheet.scratch / "no/o.ply"))
            .exit_code == 1);
  CHECK(run_furrow("simulate --body none.obj " + sheet.mesh + " -o " + (sheet.scratch / "o.ply")).exit_code ==
        3);
  const std::string err = sheet.scratch / "err";
  run_furrow("smooth " + sheet.mesh + " -o - >/dev/full 2>" + err + "; true");
  CHECK(read_text(err).find("error: standard output") != std::string::npos);
}
