// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/rewrite_obj_vertices.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::tests;
using geometry::Point;

TEST_CASE("rewrite_obj_vertices: only coordinates change, every other byte stays") {
  const std::string text =
      "# v 9 9 9\r\nmtllib a.mtl\r\n  v\t1.50  2 -3e0 1 0 0\r\nvn 0 0 1\r\nv 0 \\\r\n 1 0 # note\r\n"
      "v 7 8 9 1.0\ng skirt\nusemtl silk\nf 1//1 2//1 3//1\nl 1 2";
  const std::vector<Point> positions{{1.5, 0.25, -3}, {0, 1, -0.5}, {7, 8, 9}};
  CHECK(io::rewrite_obj_vertices(text, "a.obj", positions) ==
        "# v 9 9 9\r\nmtllib a.mtl\r\n  v\t1.50  0.25 -3e0 1 0 0\r\nvn 0 0 1\r\nv 0 \\\r\n 1 -0.5 # note\r\n"
        "v 7 8 9 1.0\ng skirt\nusemtl silk\nf 1//1 2//1 3//1\nl 1 2");
}

TEST_CASE("rewrite_obj_vertices: a material library is named from the folder that the text is for") {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in");
  std::filesystem::create_directories(folder / "out");
  std::ofstream(folder / "in/a b.mtl") << "newmtl silk\n";
  std::ofstream(folder / "in/c.mtl") << "newmtl wool\n";
  const std::string text =
      "mtllib  a b.mtl \r\nmtllib gone.mtl c.mtl\nmtllib\nmtllib c.mtl \\\nd.mtl\nv 0 0 0\n";
  const auto moved = [&](const char* to) {
    return io::rewrite_obj_vertices(text, "a.obj", std::vector<Point>{{1, 0, 0}}, {}, folder / "in",
                                    folder / to);
  };
  CHECK(moved("out") ==
        "mtllib  ../in/a b.mtl \r\nmtllib gone.mtl ../in/c.mtl\nmtllib\nmtllib c.mtl \\\nd.mtl\nv 1 0 0\n");
  std::string at_home = text;
  at_home.replace(at_home.find("v 0"), 3, "v 1");
  CHECK(moved("in") == at_home);
}

TEST_CASE("rewrite_obj_vertices: unit and axes of the file, and what does not fit is refused") {
  const std::vector<Point> positions{{0.01, 0.02, 0.03}};
  CHECK(io::rewrite_obj_vertices("\xEF\xBB\xBFv 0 0 0\n", "a.obj", positions, {0.01, io::Axis::z}) ==
        "\xEF\xBB\xBFv 1 -3 2\n");
  CHECK(content_error([&] {
          io::rewrite_obj_vertices("v 0 0 0\nv 1 1 1\n", "a.obj", positions);
        }).find("a.obj: has more vertices") == 0);
  CHECK(content_error([&] { io::rewrite_obj_vertices("v 0 0\n", "a.obj", positions); }) ==
        "a.obj: vertex 1 has no three numbers");
  CHECK(io::rewrite_obj_vertices("", "a.obj", {}).empty());
}

TEST_CASE("rewrite_obj_vertices: a file of quads reads back as what it was, moved") {
  std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1 4/1\n";
  io::MeshFile file = read_from(text, io::MeshFormat::obj);
  std::vector<Point> positions;
  for (const auto v : file.mesh.vertices())
    positions.push_back(file.mesh.point(v) + geometry::Vector(0, 0, 1. / 3));
  const io::MeshFile back =
      read_from(io::rewrite_obj_vertices(text, "a.obj", positions), io::MeshFormat::obj);
  CHECK(back.repairs.triangulated_faces == 1);
  for (const auto v : back.mesh.vertices()) CHECK(back.mesh.point(v) == positions[v]);
}
