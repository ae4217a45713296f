// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/garment_list.h"

#include <catch2/catch.hpp>

#include "geometry/mesh/errors.h"
#include "io/scene/scene_file.h"

using namespace furrow;

namespace {

std::vector<io::Scene> garment_list_scenes(const std::string& text) {
  std::vector<io::Scene> scenes;
  for (const io::TomlDocument& d : io::scenes_by_garment(io::parse_toml(text, "a/s.toml")))
    scenes.push_back(io::read_scene(d, "a"));
  return scenes;
}

void check_garment_list_fault(const std::string& text, const std::string& words) {
  try {
    garment_list_scenes(text);
    FAIL("nothing was refused; expected: " << words);
  } catch (const geometry::ContentError& e) {
    INFO(e.what());
    CHECK(std::string(e.what()).find(words) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("garment_list: each garment has a scene, the innermost first, with all else in common") {
  const auto scenes = garment_list_scenes(
      "[[garment]]\nmesh = \"coat.obj\"\nlayer = 7\nthickness = 0.002\ntouch = false\n[[garment]]\nmesh = "
      "\"vest.obj\"\n"
      "layer = 1\nsubdivide = 1\n[material]\ncloth_friction = 0.5\n");
  REQUIRE(scenes.size() == 2);
  CHECK(scenes[0].garment == "a/vest.obj");
  CHECK(scenes[0].layer == 1);
  CHECK(scenes[0].subdivide == 1);
  CHECK_FALSE(scenes[0].thickness);
  CHECK(scenes[1].garment == "a/coat.obj");
  CHECK(scenes[1].thickness == 0.002);
  CHECK_FALSE(scenes[1].touch);
  CHECK(scenes[0].touch);
  CHECK(scenes[1].subdivide == 0);
  for (const io::Scene& s : scenes) CHECK(s.simulation.self.friction == 0.5);
  const auto unsorted = garment_list_scenes("[[garment]]\nmesh = \"b.obj\"\n[[garment]]\nmesh = \"a.obj\"\n");
  REQUIRE(unsorted.size() == 2);
  CHECK(unsorted[0].garment == "a/b.obj");
  CHECK(garment_list_scenes("[[garment]]\nmesh = \"b.obj\"\n").size() == 1);
  CHECK(garment_list_scenes("[garment]\nmesh = \"b.obj\"\n")[0].garment == "a/b.obj");
  CHECK(garment_list_scenes("title = \"none\"\n").size() == 1);
}

TEST_CASE("garment_list: faults name the line of the garment that has them") {
  const std::string two = "[[garment]]\nmesh = \"a.obj\"\nlayer = 1\n[[garment]]\nmesh = \"b.obj\"\n";
  check_garment_list_fault(two, "s.toml:4:1: garment.layer: some garments have one");
  check_garment_list_fault(two + "layer = 1\n", "s.toml:6:1: garment.layer = 1 is that of another garment");
  check_garment_list_fault(two + "layer = -2\n", "s.toml:6:1: garment.layer = -2 must be a whole number");
  check_garment_list_fault(two + "layer = 2\nthickness = 1\n", "s.toml:7:1: garment.thickness = 1 must be");
  check_garment_list_fault(two + "layer = 2\nwide = 1\n", "s.toml:7:1: there is no setting 'garment.wide'");
  check_garment_list_fault("[[garment]]\nmesh = \"a.obj\"\n[[garment]]\nmesh = \"a.obj\"\n",
                           "s.toml:4:1: garment.mesh = \"a.obj\" is another garment's, too");
  check_garment_list_fault("[[garment]]\nmesh = \"a.obj\"\n[[garment]]\n",
                           "s.toml:3:1: garment.mesh is missing");
  const std::string list = "[[garment]]\nmesh = \"a.obj\"\n";
  CHECK_THROWS_WITH(io::read_scene(io::parse_toml(list, "s.toml"), ""),
                    Catch::Contains("`furrow drape` alone takes several"));
}
