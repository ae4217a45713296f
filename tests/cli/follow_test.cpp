// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "run_furrow.h"
#include "run_json.h"

using namespace furrow::tests;
using Catch::Contains;

TEST_CASE("follow: a shirt goes along with the mannequin as it grows, and comes back as a GLB with keys",
          "[long]") {
  const ScratchDirectory scratch;
  const std::string mannequin = source_file("meshes/mannequin.obj"), shirt = source_file("meshes/shirt.obj");
  REQUIRE(run_furrow("body " + mannequin + " --waist 0.80 -o " + (scratch / "wide.obj")).exit_code == 0);
  REQUIRE(run_furrow("body " + mannequin + " --chest 1.0 -o " + (scratch / "broad.obj")).exit_code == 0);
  const std::string call = "follow " + shirt + " --body " + mannequin + " --body-keys " +
                           (scratch / "wide.obj") + " --body-keys " + (scratch / "broad.obj") +
                           " --mixes 10 -o " + (scratch / "out.glb");
  const json report = report_of(call);
  REQUIRE(report.at("keys").size() == 2);
  CHECK(report["keys"][0]["name"] == "wide");
  for (const json& key : report["keys"]) CHECK(key["poke_at_full"] < 0.001);
  CHECK(report["mixes_most"] < 0.003);
  const Run told = run_furrow(call);
  CHECK_THAT(told.out,
             Contains("2 shape keys: the farthest moves the garment by") && Contains("10 random mixtures"));
  // The GLB is a body with keys for what follows it in turn.
  const json again = report_of("follow " + shirt + " --body " + (scratch / "out.glb") + " --mixes 0 -o " +
                               (scratch / "c.ply"));
  CHECK(again.at("keys").size() == 2 + report.at("correctives").size());
  CHECK(run_furrow("follow " + shirt + " --body " + mannequin + " -o " + (scratch / "d.glb")).exit_code == 3);
  CHECK(run_furrow(call + " --gap -1").exit_code == 2);
}
