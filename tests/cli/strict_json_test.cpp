// SPDX-License-Identifier: GPL-3.0-or-later
// Every report is JSON that a strict reader takes, and is as its schema says, jobs/report.schema.json.
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "run_json.h"

using namespace furrow::tests;
using nlohmann::json;

TEST_CASE("strict JSON: every command's report is read, and is as its schema says", "[long]") {
  ScratchDirectory scratch;
  const std::string sheet = source_file("meshes/sheet.obj"),
                    body = " --body " + source_file("meshes/mannequin.obj"),
                    strokes = source_file("meshes/strokes/round_bulge.json"),
                    skirt = source_file("meshes/skirt.obj");
  const auto out = [&](const char* name) { return " -o " + (scratch / name); };
  report_of("info " + sheet);
  report_of("subdivide " + sheet + " --subdivide 1" + out("fine.ply"));
  report_of("subdivide " + sheet + " --strokes " + strokes + out("lined.ply"));
  report_of("smooth " + (scratch / "fine.ply") + out("smooth.ply"));
  report_of("wrinkle " + sheet + " " + strokes + out("folds.ply"));
  report_of("quality " + (scratch / "folds.ply"));
  CHECK(report_of("wrinkle " + sheet + " " + strokes + " --rule safe" + out("w.ply"))["written"] ==
        json::array({scratch / "w.ply"}));
  report_of("info " + (scratch / "w.ply"));
  report_of("quality " + (scratch / "w.ply"));
  report_of("quality " + sheet + " --base " + sheet);
  report_of("wrinkle " + sheet + " " + strokes + " --rule safe --rest keep --fabric denim --pin-loop top" +
            out("k.ply"));
  CHECK(report_of("keep " + (scratch / "w.ply") + " --pin-loop top --fabric denim --run 0.05 --gust 0" +
                  out("kept.ply") + " --save-state " + (scratch / "ks.ply"))["written"] ==
        json::array({scratch / "kept.ply", scratch / "ks.ply"}));
  report_of("sdf" + body.substr(7) + " --tolerance 0.01 --at 0,1,0.3 --cache " + (scratch / "cache"));
  report_of("drape " + skirt + body + " --subdivide 0 --band top=0.95" + out("worn.ply"));
  report_of("drape " + skirt + body + " --subdivide 0 --made-for " + source_file("meshes/mannequin.obj") +
            out("brought.ply"));
  std::ofstream(scratch / "one.json")
      << "{\"strokes\": [{\"name\": \"fold\", \"height\": 0.02, \"width\": 0.06, "
         "\"points\": [[0, 0.784, 0.1669], [0, 0.492, 0.182]]}]}";
  report_of("wrinkle " + skirt + " " + (scratch / "one.json") + body +
            " --subdivide 0 --pin-loop top --settle --made-for " + source_file("meshes/mannequin.obj") +
            out("drawn_and_brought.ply"));
  report_of("drape " + (scratch / "w.ply") + " --pin-loop top --self-contact on" + out("hangs.ply"));
  report_of("drape " + (scratch / "w.ply") + " --pin-loop top --plain --self-contact on --max-iterations 5" +
                out("plain.ply"),
            4);
  report_of("wrinkle " + sheet + " " + strokes + " --rule safe --settle --pin-loop top --smoothed " +
            (scratch / "drawn.ply") + out("rests.ply"));
  report_of("simulate " + (scratch / "drawn.ply") +
            " --settle --seconds 0 --fabric cotton --pin-loop top --settled " + (scratch / "settled.ply") +
            out("moved.ply"));
  report_of("drape " + skirt + body +
            " --subdivide 0 --band top=0.95 --fabrics cotton,silk --size 200,200 "
            "--quality draft --picture " +
            (scratch / "c.png"));
  report_of("fit " + (scratch / "worn.ply") + body);
  report_of("fit --compare " + (scratch / "worn.ply") + " " + (scratch / "worn.ply") + body);
  report_of("transfer " + sheet + " " + (scratch / "w.ply") + out("back.obj"));
  const std::string textured = source_file("meshes/panelled.obj");
  report_of("bake " + textured + " " + textured + out("baked") + " --texels 64 --check 1");
  report_of("body");
  report_of("body --waist 0.7" + out("body.obj"));
  report_of("fabric list");
  report_of("fabric show cotton-twill --rings 10 --picture " + (scratch / "f.png"));
  report_of("fabric drape silk --rings 10");
  std::ofstream(scratch / "fast.toml") << "[fast]\nW = 180\nC_warp = 20\nC_weft = 16\nE100_warp = 3\n"
                                          "E100_weft = 5\nEB5 = 4\n";
  report_of("fabric fit " + (scratch / "fast.toml") + " --rings 10 --drape 0.6" + out("mine.toml"));
  report_of("render " + sheet + " --size 200,200 --quality draft" + out("p.png"));
  report_of("strokes " + strokes + " --garment " + sheet);
  report_of("strokes " + (scratch / "w.ply") + out("s.json"));
  report_of("chart " + source_file("scenes/validation/free_fall.toml") + " --set simulation.seconds=0.02");
  for (const char* integrator : {"leapfrog", "xpbd", "rk4", "implicit", "tr-bdf2"}) {
    const json r = report_of("simulate " + (scratch / "w.ply") +
                             " --pin-vertices 0,5 --seconds 0.005 --integrator " + integrator + out("s.ply"));
    const bool has_limit = r["dt_limit"].is_number();
    CHECK(has_limit == (integrator == std::string("leapfrog") || integrator == std::string("rk4")));
    CHECK(has_limit == !r.contains("dt_limit_why"));
  }
  report_of("simulate " + skirt + body + " --seconds 0.005 --pin-loop top --animation " +
            (scratch / "a.glb") + " --save-state " + (scratch / "st.ply") + out("s.ply"));
  report_of("simulate " + source_file("scenes/validation/free_fall.toml") +
            " --set simulation.seconds=0.01 --accuracy 5%");
}

TEST_CASE(
    "strict JSON: a report names the vertices where cloth crosses cloth and the body, as its schema says") {
  const ScratchDirectory scratch;
  std::ofstream(scratch / "two.obj") << "v 2 1 0\nv -0.3 1 -0.3\nv 0.3 1 -0.3\nv 0 1 0.4\n"
                                        "v -0.3 0.8 0\nv 0.3 0.8 0\nv 0 1.2 0\nv 2 1.1 0\nv 2.1 1 0\n"
                                        "f 2 3 4\nf 5 6 7\nf 1 8 9\n";
  const json r = report_of("fit " + (scratch / "two.obj") + " --body " + source_file("meshes/mannequin.obj"));
  const json all_but_one_face{1, 2, 3, 4, 5, 6};
  CHECK(r["crossings"]["corners"] == all_but_one_face);
  CHECK(r["distance"]["pierced_corners"] == all_but_one_face);
}

TEST_CASE("strict JSON: each report of furrow batch is as its schema says") {
  const ScratchDirectory scratch;
  const std::string plan = scratch / "plan.toml";
  std::ofstream(plan) << "command = \"simulate\"\n[options]\nseconds = 0.005\n[cases]\ngarment = [\""
                      << source_file("meshes/hung_sheet.obj") << "\"]\n";
  report_of("batch gather " + plan, 4);
  const auto is_as = [&](const std::string& words, const char* name, int exit_code) {
    const Run run = run_furrow("batch " + words + " --json");
    INFO(words << "\n" << run.err << run.out);
    REQUIRE(run.exit_code == exit_code);
    CHECK(faults_of(parse_strictly(run.out), name) == "");
  };
  is_as("list " + plan, "batch_list", 0);
  is_as("slurm " + plan, "batch_slurm", 0);
  const json scripts = parse_strictly(run_furrow("batch slurm " + plan + " --json").out);
  is_as("task " + scripts["written"][0].get<std::string>() + " 1 2", "batch_task", 0);
  is_as("case " + (scratch / "r.json") + " --json -- info " + (scratch / "none.obj"), "batch_case", 1);
}

TEST_CASE("strict JSON: every command that has --json has a schema, and the schema is one file of its words",
          "[long]") {
  std::istringstream help(run_furrow("--help").out);
  bool listed = false;
  int found = 0;
  for (std::string line; std::getline(help, line);) {
    if (line.rfind("Subcommands:", 0) == 0) listed = true;
    std::smatch name;
    if (!listed || !std::regex_search(line, name, std::regex("^  ([a-z][a-z-]*)(\\s|$)"))) continue;
    if (run_furrow(name[1].str() + " --help").out.find("--json") == std::string::npos) continue;
    ++found;
    INFO(name[1]);
    CHECK(schema()["$defs"].contains(name[1].str()));
    CHECK(schema()["anyOf"].dump().find("\"#/$defs/" + name[1].str() + "\"") != std::string::npos);
  }
  CHECK(found >= 14);
  CHECK(schema()["$schema"] == "https://json-schema.org/draft/2020-12/schema");
}

TEST_CASE("strict JSON: the checker refuses what is not as the schema says") {
  const ScratchDirectory scratch;
  const json report = report_of("smooth " + source_file("meshes/sheet.obj") + " -o " + (scratch / "s.ply"));
  CHECK(faults_of(report, "smooth") == "");
  json other = report;
  other["vertixes"] = 3;
  CHECK(faults_of(other, "smooth") == ": has 'vertixes', which the schema does not know\n");
  other = report;
  other.erase("vertices");
  CHECK(faults_of(other, "smooth") == ": lacks \"vertices\"\n");
  other = report;
  other["vertices"] = "many";
  CHECK(faults_of(other, "smooth") == "/vertices: \"many\" is no \"integer\"\n");
  other["vertices"] = -1;
  CHECK(faults_of(other, "smooth") == "/vertices: -1 is below 0\n");
  other = report;
  other["schema"] = 2;
  CHECK(faults_of(other, "smooth") == "/schema: 2 is none of [1]\n");
  CHECK_THROWS(parse_strictly("{\"a\": NaN}"));
  CHECK_THROWS(parse_strictly("{\"a\": 1, \"a\": 2}"));
  CHECK_THROWS(parse_strictly("{\"a\": 1} 2"));
}
