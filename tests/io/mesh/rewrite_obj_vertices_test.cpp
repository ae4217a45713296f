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
      "v 7 8 9 1.0\ng skirt\nusemtl silk\nf 1 2 3\nl 1 2";
  const std::vector<Point> positions{{1.5, 0.25, -3}, {0, 1, -0.5}, {7, 8, 9}};
  CHECK(io::rewrite_obj_vertices(text, "a.obj", positions) ==
        "# v 9 9 9\r\nmtllib a.mtl\r\n  v\t1.50  0.25 -3e0 1 0 0\r\nvn 0 0 1\r\nv 0 \\\r\n 1 -0.5 # note\r\n"
        "v 7 8 9 1.0\ng skirt\nusemtl silk\nf 1 2 3\nl 1 2");
}

TEST_CASE("rewrite_obj_vertices: normals are made for what moved, in the file's groups of corners") {
  const std::string head = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 5 5\nv 6 5 5\nv 5 6 5\nvt 0 0\n",
                    faces = "f 1/1/1 2/1/1 3/1/1\nf 1//1 -5//1 4//-3\nf 5//3 6//3 7//3 # far\n";
  const std::string text = head + "vn 0 0 1\r\nvn  0.6 0.8 0\nvn 0.1 0 .99 \n" + faces;
  std::vector<Point> positions{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 5}, {6, 5, 5}, {5, 6, 5}};
  CHECK(io::rewrite_obj_vertices(text, "a.obj", positions) == text);  // nothing moved
  for (Point& p : positions)
    if (p.x() == 1) p = Point(1, p.y(), 1);  // the square lies askew now
  const std::string moved = io::rewrite_obj_vertices(text, "a.obj", positions);
  CHECK(moved.find("vn -0.707107 0 0.707107\r\n") != std::string::npos);
  CHECK(moved.find("vn 0.1 0 .99\r\n") != std::string::npos);  // of the face that stayed
  CHECK(moved.find("f 5//5 6//6 7//7 # far\n") != std::string::npos);
  CHECK(moved.find("0.6 0.8 0") == std::string::npos);  // no corner had it
  CHECK(moved.find("f 1/1/1 2/1/2 3/1/3\nf 1//1 -5//3 4//4\n") != std::string::npos);
  const io::MeshFile back = read_from(moved, io::MeshFormat::obj);
  CHECK(back.mesh->number_of_faces() == 3);
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
  for (const auto v : file.mesh->vertices())
    positions.push_back(file.mesh->point(v) + geometry::Vector(0, 0, 1. / 3));
  const io::MeshFile back =
      read_from(io::rewrite_obj_vertices(text, "a.obj", positions), io::MeshFormat::obj);
  CHECK(back.repairs.triangulated_faces == 1);
  for (const auto v : back.mesh->vertices()) CHECK(back.mesh->point(v) == positions[v]);
}
