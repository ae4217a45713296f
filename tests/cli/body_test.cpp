// SPDX-License-Identifier: GPL-3.0-or-later
// furrow body: a person's measurements, by the tape of furrow fit; and garments brought to such a body.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "run_furrow.h"

using namespace furrow::tests;
using nlohmann::json;

TEST_CASE("body: our mannequin becomes a person, whose girths furrow body and furrow fit tell alike") {
  const ScratchDirectory folder;
  const std::string anna = folder / "anna.obj", skirt = source_file("meshes/skirt.obj");
  const Run made =
      run_furrow("body --height 1.68 --chest 0.92 --waist 0.74 --hip 0.98 -o " + anna + " --json");
  REQUIRE(made.exit_code == 0);
  CHECK(json::parse(made.out)["farthest"].get<double>() <= 0.001);
  const json told = json::parse(run_furrow("body " + anna + " --json").out)["reached"];
  CHECK(told["height"].get<double>() == Approx(1.68).margin(0.001));
  CHECK(told["waist"].get<double>() == Approx(0.74).margin(0.001));
  const json fit = json::parse(run_furrow("fit " + skirt + " --body " + anna + " --json").out);
  int measured = 0;
  for (const json& ease : fit["ease"])
    for (const auto& [name, girth] : {std::pair("chest", 0.92), {"waist", 0.74}, {"hip", 0.98}})
      if (ease["section"] == name && ++measured)
        CHECK(ease["body_girth"].get<double>() == Approx(girth).margin(0.005));
  CHECK(measured == 3);
}

TEST_CASE("body: a call that cannot be meant is refused, and what is missed leaves with 4") {
  const ScratchDirectory folder;
  const std::string out = folder / "x.obj";
  CHECK(run_furrow("body --waist 0.74").exit_code == 2);
  CHECK(run_furrow("body -o " + out).exit_code == 2);
  CHECK(run_furrow("body --waist 2.9 -o " + out).exit_code == 2);
  CHECK(run_furrow("body " + source_file("meshes/skirt.obj") + " --waist 0.7 -o " + out).exit_code == 3);
  CHECK_FALSE(std::filesystem::exists(out));
  const Run missed = run_furrow("body --waist 0.92 -o " + out);
  CHECK(missed.exit_code == 4);
  CHECK(missed.err.find("error:") != std::string::npos);
}

TEST_CASE("drape: with --made-for our skirt is brought to a taller body, by the program and in a batch",
          "[release]") {
  const ScratchDirectory folder;
  const std::string tall = folder / "tall.obj", own = source_file("meshes/mannequin.obj"),
                    skirt = source_file("meshes/skirt.obj"), out = folder / "worn.ply";
  REQUIRE(run_furrow("body --height 1.85 -o " + tall + " -q").exit_code == 0);
  const std::string call = "drape " + skirt + " --made-for " + own + " --subdivide 0 -o " + out;
  const Run run = run_furrow(call + " --body " + tall);
  CHECK(run.exit_code == 0);
  CHECK(run.out.find("brought from " + own + ": height x 1.09, arms turned by ") != std::string::npos);
  CHECK(run_furrow(call + " --pin-loop top").exit_code == 2);
  const Run missing = run_furrow("drape " + skirt + " --made-for " + skirt + " --subdivide 0 -o " +
                                 (folder / "not.ply") + " --body " + tall);
  CHECK(missing.exit_code == 3);
  CHECK_FALSE(std::filesystem::exists(folder / "not.ply"));
  std::ofstream(folder / "plan.toml")
      << "mesh = \"obj\"\npicture = false\noutput = \"fits\"\n"
         "report = [\"outcome\", \"placed.height_scale\"]\n[options]\n"
         "made-for = \""
      << own << "\"\nsubdivide = 0\n[cases]\ngarment = [\"" << skirt << "\"]\nbody = [\"tall.obj\"]\n";
  const json lines = json::parse(run_furrow("batch list " + (folder / "plan.toml") + " --json").out)["lines"];
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].get<std::string>().find("--made-for " + own) != std::string::npos);
}
