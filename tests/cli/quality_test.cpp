// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "run_furrow.h"
#include "run_json.h"

using namespace furrow::tests;
using Catch::Contains;

namespace {

const std::string our_sheet = source_file("meshes/hung_sheet.obj"),
                  its_strokes = source_file("meshes/strokes/hung_sheet.json");

}  // namespace

TEST_CASE("quality: the program tells each measure beside its target, and what is missed with --check",
          "[long]") {
  const ScratchDirectory scratch;
  const std::string safe = scratch / "safe.ply", png = scratch / "knobs.png";
  REQUIRE(run_furrow("wrinkle " + our_sheet + " " + its_strokes + " --rule safe -o " + safe).exit_code == 0);
  const Run told = run_furrow("quality " + safe + " --picture " + png + " --size 80,80 --quality draft");
  INFO(told.out << told.err);
  CHECK(told.exit_code == 0);
  CHECK_THAT(told.out, Contains("of at most 0.3 %") && Contains("MISSED") && Contains("rad/m^2"));
  CHECK(std::count(told.out.begin(), told.out.end(), '\n') <= 10);
  CHECK(std::filesystem::file_size(png) > 100);
  CHECK(run_furrow("quality " + safe + " --check").exit_code == 4);
  CHECK(run_furrow("quality " + our_sheet + " --check").exit_code == 0);
  CHECK_THAT(run_furrow("quality " + our_sheet).out, Contains("B1, B2, B3, B4, B5") && Contains("--base"));
  CHECK(run_furrow("quality " + safe + " --picture " + safe).exit_code == 2);
  CHECK(run_furrow("quality " + (scratch / "none.ply")).exit_code == 3);
}

TEST_CASE("quality: a plain mesh is measured over a garment that is named, with strokes", "[long]") {
  const ScratchDirectory scratch;
  const std::string obj = scratch / "fold.obj";
  REQUIRE(run_furrow("wrinkle " + our_sheet + " " + its_strokes + " --rule fold --max-distance 0.5 -o " + obj)
              .exit_code == 0);
  const nlohmann::json report = succeed("quality " + obj + " --base " + our_sheet + " --strokes " +
                                        its_strokes + " --max-distance 0.5 --json");
  CHECK(report["base_from"] == "file");
  CHECK(report["lines_from"] == "file");
  CHECK(report["lines"].size() == 3);
  CHECK(report["measures"].size() == 9);
  CHECK(report["measures"][0]["value"].get<double>() <= 0.01);
  CHECK(report["measures"][1]["value"].get<double>() <= 0.005);
}
