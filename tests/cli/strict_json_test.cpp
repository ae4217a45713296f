// SPDX-License-Identifier: GPL-3.0-or-later
// Every report is JSON that a strict reader takes: no NaN, no infinity.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run_furrow.h"
#include "tests/test_paths.h"

using namespace furrow::tests;
using nlohmann::json;

namespace {

std::string of(const char* path) { return (source_dir() / path).string(); }

/// Throws for what is no JSON.
json report_of(const std::string& arguments) {
  const Run run = run_furrow(arguments + " --json");
  INFO(arguments << "\n" << run.err << run.out);
  REQUIRE(run.exit_code == 0);
  return json::parse(run.out);
}

}  // namespace

TEST_CASE("strict JSON: every command's report is read") {
  ScratchDirectory scratch;
  const std::string sheet = of("meshes/sheet.obj"), body = " --body " + of("meshes/mannequin.obj"),
                    strokes = of("meshes/strokes/round_bulge.json"), skirt = of("meshes/skirt.obj");
  const auto out = [&](const char* name) { return " -o " + (scratch / name); };
  report_of("info " + sheet);
  report_of("subdivide " + sheet + " --loop 1" + out("fine.ply"));
  report_of("smooth " + (scratch / "fine.ply") + out("smooth.ply"));
  report_of("wrinkle " + sheet + " " + strokes + out("w.ply"));
  report_of("sdf" + body.substr(7) + " --tolerance 0.01" + out("body.sdf"));
  report_of("drape " + skirt + body + " --subdivide 0 --band top=0.95" + out("worn.ply"));
  report_of("fit " + (scratch / "worn.ply") + body);
  report_of("transfer " + sheet + " " + (scratch / "w.ply") + out("back.obj"));
  const std::string textured = of("meshes/panelled.obj");
  report_of("bake " + textured + " " + textured + out("baked") + " --size 64");
  report_of("render " + sheet + " --size 200,200 --quality draft" + out("p.png"));
  report_of("strokes " + strokes);
  for (const char* integrator : {"leapfrog", "backward-euler", "xpbd", "rk4"}) {
    const json r = report_of("simulate " + (scratch / "w.ply") +
                             " --pin-vertices 0,5 --seconds 0.005 --integrator " + integrator + out("s.ply"));
    const bool has_limit = r["dt_limit"].is_number();
    CHECK(has_limit == (integrator == std::string("leapfrog") || integrator == std::string("rk4")));
    CHECK(has_limit == !r.contains("dt_limit_why"));
  }
}
