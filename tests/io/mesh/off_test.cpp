// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;
using io::MeshFormat;

namespace {

io::MeshFile off(const std::string& text) { return read_from(text, MeshFormat::off); }
std::string error_of_off(const std::string& text) {
  return content_error([&] { off(text); });
}

}  // namespace

TEST_CASE("OFF: mesh and colours come back with the same bits") {
  const io::MeshFile file = decorated_grid(4);
  const io::MeshFile back = off(written(file, MeshFormat::off));
  CHECK(same_positions(file.mesh, back.mesh));
  CHECK(corners_of(file.mesh) == corners_of(back.mesh));
  for (const Vertex v : file.mesh->vertices())
    CHECK((*find_map(file.mesh, attribute::color))[v] == (*find_map(back.mesh, attribute::color))[v]);
  io::MeshFile plain = read_from(cube_obj, MeshFormat::obj);
  CHECK(written(plain, MeshFormat::off).starts_with("OFF\n8 12 0\n0 0 0\n"));
}

TEST_CASE("OFF: spellings of the header and of faces") {
  const std::string rows = "0 0 0\n1 0 0 # a comment\n\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  for (const char* head : {"OFF\n4 1 0\n", "OFF 4 1 0\n", "# made by hand\nOFF\n\n# counts\n4 1\n"}) {
    const io::MeshFile file = off(head + rows);
    CHECK(corners_of(file.mesh) == std::vector<std::size_t>{0, 1, 2, 0, 2, 3});
    CHECK(file.warnings.empty());
  }
  const io::MeshFile painted = off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 0.5 0 0\n");
  CHECK(painted.warnings.size() == 1);
}

TEST_CASE("OFF: normals, colours and texture coordinates of vertices") {
  const io::MeshFile file =
      off("STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 51 255 0.5 0.25\n"
          "1 0 0 0 0 1 0.0 0.5 1.0 1.0 0 1\n0 1 0 0 0 1 0 0 0 0 0 0\n3 0 1 2\n");
  const auto color = *find_map(file.mesh, attribute::color);
  CHECK(color[Vertex(0)] == Color{1, 0, 0.2, 1});
  CHECK(color[Vertex(1)] == Color{0, 0.5, 1, 1});
  const Halfedge h = file.mesh->halfedge(Vertex(2), Vertex(0));
  CHECK((*find_map(file.mesh, attribute::texture))[h] == TextureCoordinate{0.5, 0.25});
}

TEST_CASE("OFF: errors name the line, a header cannot announce more than the file holds") {
  CHECK(error_of_off("").find("no OFF file") != std::string::npos);
  CHECK(error_of_off("PLY\n").starts_with("test:1: the first word is not OFF"));
  CHECK(error_of_off("OFF BINARY\n").find("binary OFF") != std::string::npos);
  CHECK(error_of_off("OFF\n2000000000 6 0\n0 0 0\n").find("more than the file can hold") !=
        std::string::npos);
  CHECK(error_of_off("OFF\n1 900719925474099 0\n0 0 0\n").find("more than the file can hold") !=
        std::string::npos);
  CHECK(error_of_off("OFF\n3 -1 0\n").starts_with("test:2: a negative count"));
  CHECK(error_of_off("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n").starts_with("test:4: a number is missing"));
  CHECK(error_of_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n")
            .starts_with("test:6: a whole number is missing"));
  CHECK(error_of_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")
            .starts_with("test:6: a corner names a vertex beyond"));
  CHECK(error_of_off("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n").find("face 1 of 2: it is cut short") !=
        std::string::npos);
}
