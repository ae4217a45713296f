// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;
using io::MeshFormat;

namespace {

io::MeshFile stl(const std::string& bytes) { return read_from(bytes, MeshFormat::stl); }
std::string error_of_stl(const std::string& bytes) {
  return content_error([&] { stl(bytes); });
}

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\nouter loop\nvertex " + a + "\nvertex " + b + "\nvertex " + c +
         "\nendloop\nendfacet\n";
}

}  // namespace

TEST_CASE("STL: a mesh of float positions comes back, vertices in the order of the corners") {
  const io::MeshFile cube = read_from(cube_obj, MeshFormat::obj);
  const io::MeshFile back = stl(written(cube, MeshFormat::stl));
  CHECK(back.mesh->number_of_vertices() == 8);
  CHECK(back.mesh->number_of_faces() == 12);
  CHECK(back.repairs.merged_vertices == 36 - 8);
  CHECK(CGAL::is_closed(*back.mesh));
  CHECK(back.mesh->point(Vertex(1)) == Point(0, 1, 0));
  CHECK(written(back, MeshFormat::stl) == written(cube, MeshFormat::stl));
}

TEST_CASE("STL: solids of text become groups, only exactly equal positions are merged") {
  const std::string text = "solid left\n" + facet("0 0 0", "1 0 0", "0 1 0") +
                           "endsolid left\nsolid empty\nendsolid\n" + "solid right\n" +
                           facet("1 0 0", "1 1 0", "-0 1 0") +
                           facet("1.0000000000000002 0 0", "3 0 0", "3 1 0") + "endsolid right\n";
  const io::MeshFile file = stl(text);
  CHECK(file.group_names == std::vector<std::string>{"left", "right"});
  CHECK((*find_map(file.mesh, attribute::group))[Face(2)] == 1);
  CHECK(file.mesh->number_of_vertices() == 7);
  CHECK(file.repairs.merged_vertices == 2);
}

TEST_CASE("STL: a binary file that begins with solid is read as binary") {
  std::string bytes = written(read_from(cube_obj, MeshFormat::obj), MeshFormat::stl);
  bytes.replace(0, 5, "solid");
  CHECK(stl(bytes).mesh->number_of_faces() == 12);
}

TEST_CASE("STL: errors name the line or the face") {
  const std::string good = "solid\n" + facet("0 0 0", "1 0 0", "0 1 0");
  CHECK(error_of_stl(good + "endsolid\n") == "(none)");
  CHECK(error_of_stl(good).find("no 'endsolid'") != std::string::npos);
  CHECK(
      error_of_stl("solid\n" + facet("0 0 0", "1 x 0", "0 1 0")).starts_with("test:5: 'x' is not a number"));
  CHECK(error_of_stl("solid\nfacet normal 0 0 1\nloop\n")
            .starts_with("test:3: 'loop' where 'outer' should stand"));
  CHECK(error_of_stl("").find("shorter than the header") != std::string::npos);
  std::string bytes = written(read_from(cube_obj, MeshFormat::obj), MeshFormat::stl);
  CHECK(error_of_stl(bytes.substr(0, bytes.size() - 1)).find("announces 12 triangles, the file holds 11") !=
        std::string::npos);
  bytes.replace(84 + 50 + 12, 4, std::string("\x00\x00\xc0\x7f", 4));
  CHECK(error_of_stl(bytes).starts_with("test: face 1: a coordinate is not finite"));
}
