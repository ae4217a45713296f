// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/cloth/fabric_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "geometry/mesh/errors.h"
#include "io/scene/scene_file.h"
#include "tests/jobs/job_folders.h"

using namespace furrow;
namespace fs = std::filesystem;

TEST_CASE("take_fabric_file: its settings stand in the preset's place, and what is said goes before them") {
  const fs::path folder = tests::empty_folder("fabric_file");
  std::ofstream(folder / "mine.toml") << "[material]\ndensity = 0.3\nstretch = 200\nrigidity = 2e-5\n"
                                         "membrane = \"triangles\"\nbending_law = \"hinge\"\n";
  io::TomlDocument document = io::parse_toml(
      "[garment]\nmesh = \"g.obj\"\n[material]\npreset = \"mine.toml\"\nrigidity = 1e-6\n", "s.toml");
  jobs::take_fabric_file(document, folder);
  const io::SceneMaterial m = io::read_scene(document, folder).material;
  CHECK(m.preset.empty());
  CHECK(m.density == 0.3);
  CHECK(m.stretch == 200.);
  CHECK(m.rigidity == 1e-6);
  CHECK(m.membrane == bridge::Membrane::triangles);
}

TEST_CASE(
    "take_fabric_file: a fabric's name is left alone, and a file without a fabric is refused by its name") {
  const fs::path folder = tests::empty_folder("fabric_file_faults");
  io::TomlDocument named = io::parse_toml("[material]\npreset = \"denim\"\n", "s.toml");
  const io::Json before = named.root;
  jobs::take_fabric_file(named, folder);
  CHECK(*named.root == before);
  const auto taken = [&](const std::string& text) {
    std::ofstream(folder / "mine.toml") << text;
    io::TomlDocument document;
    io::set_value(document, "material.preset", (folder / "mine.toml").string(), "`fabric`");
    jobs::take_fabric_file(document, "elsewhere");
    return document.root["material"];
  };
  CHECK(taken("[material]\npreset = \"silk\"\n")["preset"] == "silk");
  CHECK_THROWS_WITH(taken("[kes]\nW = 1\n"), Catch::Contains("mine.toml: there is no [material] in it"));
  CHECK_THROWS_WITH(taken("material = 3\n"), Catch::Contains("there is no [material] in it"));
  CHECK_THROWS_WITH(taken("[material]\npreset = \"other.toml\"\n"), Catch::Contains("names no other file"));
  CHECK_THROWS_AS(taken("[material\n"), geometry::ContentError);
}
