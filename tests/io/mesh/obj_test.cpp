// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "tests/io/base/io_test_helpers.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;
using io::MeshFormat;

namespace {

const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

io::MeshFile obj(const std::string& text, const io::ReadOptions& options = {}) {
  return read_from(text, MeshFormat::obj, options);
}
std::string error_of_obj(const std::string& text) {
  return content_error([&] { obj(text); });
}

}  // namespace

TEST_CASE("OBJ: quads are cut 0-1-2, 0-2-3 and counted") {
  const io::MeshFile file = obj(cube_obj);
  CHECK(file.repairs.triangulated_faces == 6);
  CHECK_FALSE(file.repairs.any());
  const auto corners = corners_of(file.mesh);
  CHECK(std::vector(corners.begin(), corners.begin() + 6) == std::vector<std::size_t>{0, 3, 2, 0, 2, 1});
  CHECK(CGAL::is_closed(*file.mesh));
}

TEST_CASE("OBJ: the same cube in many spellings") {
  const io::MeshFile expected = obj(cube_obj);
  std::string crlf, cr;
  for (const char c : cube_obj) crlf += c == '\n' ? "\r\n" : std::string(1, c), cr += c == '\n' ? '\r' : c;
  std::string negative = cube_obj.substr(0, cube_obj.find('f'));
  negative += "f -8 -5 -6 -7\nf -4 -3 -2 -1\nf -8 -7 -3 -4\nf -7 -6 -2 -3\nf -6 -5 -1 -2\nf -5 -8 -4 -1\n";
  std::string continued = cube_obj;
  continued.replace(continued.find("f 4 1 5 8"), 9, "f 4 \\\n1\\\r\n \\\n5 8");
  const auto first_face = cube_obj.find('f');
  const std::string faces_first = cube_obj.substr(first_face) + cube_obj.substr(0, first_face);
  for (const std::string& text :
       {crlf, cr, "\xEF\xBB\xBF" + cube_obj, cube_obj.substr(0, cube_obj.size() - 1), negative, continued,
        faces_first, "  \t" + cube_obj + "\n\n#end"}) {
    const io::MeshFile file = obj(text);
    CHECK(same_positions(file.mesh, expected.mesh));
    CHECK(corners_of(file.mesh) == corners_of(expected.mesh));
  }
}

TEST_CASE("OBJ: numbers are read in double, and malformed ones are errors") {
  const io::MeshFile file = obj("v +1.5 -2.e1 .1\nv 1e-400 0.1234567890123456789 1E2\nv 0 1 0\nf 1 2 3\n");
  CHECK(file.mesh->point(Vertex(0)) == Point(1.5, -20, 0.1));
  CHECK(file.mesh->point(Vertex(1)) == Point(0, 0.1234567890123456789, 100));
  for (const char* bad :
       {"1,5", "abc", "0x10", "1e", "--1", "+-1", "1.#IND", "1e999", "nan", "-inf", "1e10", "1_0"}) {
    INFO(bad);
    CHECK(error_of_obj(three + "v 0 " + bad + " 0\nf 1 2 3\n").starts_with("test:4: "));
  }
}

TEST_CASE("OBJ: errors name the line") {
  CHECK(
      error_of_obj(three + "f 1 2 4\n").starts_with("test:4: a corner names a vertex beyond the last of 3"));
  CHECK(error_of_obj(three + "f 0 1 2\n").starts_with("test:4: index 0"));
  CHECK(error_of_obj(three + "\n\nf 1 2 -4\n").starts_with("test:6: index -4"));
  CHECK(error_of_obj(three + "f 1 2\n").starts_with("test:4: a face has fewer than three corners"));
  CHECK(error_of_obj(three + "f 1 2 x\n").starts_with("test:4: 'x' is not a whole number"));
  CHECK(error_of_obj(three + "f 1 2 3.5\n").starts_with("test:4: '3.5' is not a whole number"));
  CHECK(error_of_obj(three + "vt 0 0\nf 1/1 2/1 3/2\n")
            .starts_with("test:5: a corner names a texture coordinate"));
  CHECK(error_of_obj(three + "f 1 2 3\nl 1 9\n").starts_with("test:5: a line names a vertex beyond"));
  CHECK(error_of_obj("v 1 2\n").starts_with("test:1: a vertex has 2 numbers"));
  CHECK(error_of_obj("v 1 2 3 4 5\n").starts_with("test:1: a vertex has 5 numbers"));
  CHECK(error_of_obj("") == "test: no faces; a mesh with at least one triangle is needed");
  CHECK(error_of_obj(three).starts_with("test: no faces"));
  CHECK(error_of_obj(three + "f 1 1 2\n").starts_with("test: no faces but degenerate ones"));
  CHECK(error_of_obj(std::string("v\0 \0001\0", 6)).find("UTF-16") != std::string::npos);
  CHECK(error_of_obj("\xFF\xFEv").find("UTF-16") != std::string::npos);
}

TEST_CASE("OBJ: the last line of a continued statement is the one that an error names") {
  CHECK(error_of_obj(three + "f 1 \\\n2 \\\nx\n").starts_with("test:6: 'x'"));
}

TEST_CASE("OBJ: texture coordinates belong to corners, groups and materials to faces") {
  const io::MeshFile file = obj("mtllib a.mtl\n" + three +
                                "v 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1 0\nvt 0.5 0.5\nvn 0 0 1\n"
                                "g left sleeve\nusemtl silk\nf 1/1/1 2/2/1 3/3/1\no back\nusemtl wool\n"
                                "f 2/4/1 4/-2/1 3//1\nusemtl silk\ng\n");
  CHECK(file.group_names == std::vector<std::string>{"left sleeve", "back"});
  CHECK(file.material_names == std::vector<std::string>{"silk", "wool"});
  CHECK(file.material_libraries == std::vector<std::string>{"a.mtl"});
  const Mesh& mesh = file.mesh;
  CHECK((*find_map(mesh, attribute::group))[Face(1)] == 1);
  CHECK((*find_map(mesh, attribute::material))[Face(1)] == 1);
  const auto texture = *find_map(mesh, attribute::texture);
  CHECK(texture[mesh.halfedge(Vertex(0), Vertex(1))] == TextureCoordinate{1, 0});
  CHECK(texture[mesh.halfedge(Vertex(2), Vertex(1))] == TextureCoordinate{0.5, 0.5});
  CHECK(texture[mesh.halfedge(Vertex(1), Vertex(3))] == TextureCoordinate{0, 1});
  CHECK(std::isnan(texture[mesh.halfedge(Vertex(3), Vertex(2))][0]));
  CHECK(file.warnings.empty());
}

TEST_CASE("OBJ: a mesh without textures, groups or colours gets no such maps") {
  const io::MeshFile file = obj("vt 0 0\n" + cube_obj);
  CHECK_FALSE(find_map(file.mesh, attribute::texture));
  CHECK_FALSE(find_map(file.mesh, attribute::group));
  CHECK_FALSE(find_map(file.mesh, attribute::material));
  CHECK_FALSE(find_map(file.mesh, attribute::color));
}

TEST_CASE("OBJ: two-point lines that share vertices are chained, loops are closed") {
  const io::MeshFile file = obj(three +
                                "v 0 0 1\nv 1 0 1\nv 2 0 1\nv 3 0 1\nv 9 0 0\nv 9 1 0\nv 9 0 1\nf 1 2 3\n"
                                "l 6 5\nl 4 5\nl 8 9\nl 9 10\nl 7 6\nl 10 8\nl 1 2 3 1\nl 1 3/1 2\n");
  REQUIRE(file.polylines.size() == 4);
  const auto vertices = [&](int i) { return file.polylines[i].vertices; };
  CHECK((vertices(0) == std::vector<std::size_t>{0, 1, 2} && file.polylines[0].closed));
  CHECK((vertices(1) == std::vector<std::size_t>{0, 2, 1} && !file.polylines[1].closed));
  CHECK((vertices(2) == std::vector<std::size_t>{3, 4, 5, 6} && !file.polylines[2].closed));
  CHECK((vertices(3) == std::vector<std::size_t>{7, 8, 9} && file.polylines[3].closed));
  CHECK(file.polylines[2].points[1] == Point(1, 0, 1));
  CHECK(file.repairs.isolated_vertices == 7);
}

TEST_CASE("OBJ: lines without a face are a chain for those who ask for one, and an error that says so") {
  const std::string text = "v 0 0 0\nv 100 0 0\nv 0 0 50\nv 1 1 1\nl 1 2 3\n";
  CHECK(error_of_obj(text) ==
        "test: no faces, only lines: a chain, which `furrow simulate` moves; here a mesh with "
        "at least one triangle is needed");
  const io::MeshFile file = obj(text, {.metres_per_unit = 0.01, .up = io::Axis::z, .chains = true});
  CHECK(file.mesh->number_of_vertices() == 4);
  CHECK(file.mesh->number_of_faces() == 0);
  CHECK(file.mesh->point(Vertex(2)) == Point(0, 0.5, 0));
  REQUIRE(file.polylines.size() == 1);
  CHECK(file.polylines[0].vertices == std::vector<std::size_t>{0, 1, 2});
  CHECK_FALSE(file.repairs.any());
  for (const char* no_chain : {"v 0 0 0\nv 1 0 0\n", "v 0 0 0\nv 1 0 0\nf 1 2 1\nl 1 2\n"})
    CHECK_THROWS_AS(obj(no_chain, {.chains = true}), ContentError);
}

TEST_CASE("OBJ: unknown statements give one warning, known ones none") {
  const io::MeshFile file = obj("vn 0 0 1\ns off\nvp 0 1\np 1\nfoo 1 2\nbar\n" + cube_obj);
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0].starts_with("test:5: unknown statement 'foo'"));
}

TEST_CASE("OBJ: colours to 255 become colours to 1") {
  const io::MeshFile file = obj("v 0 0 0 255 0 51\nv 1 0 0 0 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK((*find_map(file.mesh, attribute::color))[Vertex(0)] == Color{1, 0, 0.2, 1});
  CHECK((*find_map(file.mesh, attribute::color))[Vertex(2)] == Color{1, 1, 1, 1});
  CHECK(file.warnings.size() == 1);
}

TEST_CASE("OBJ: unit and axis of the file are turned into ours and back") {
  const io::ReadOptions millimetres{.metres_per_unit = 0.5, .up = io::Axis::z};
  const io::MeshFile file = obj("v 2 4 6\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", millimetres);
  CHECK(file.mesh->point(Vertex(0)) == Point(1, 3, -2));
  const std::string text = written(file, MeshFormat::obj, {.metres_per_unit = 0.5, .up = io::Axis::z});
  CHECK(text.starts_with("# written by furrow\nv 2 4 6\n"));
  CHECK_THROWS_AS(obj(cube_obj, {.metres_per_unit = 0}), std::invalid_argument);
  CHECK_THROWS_AS(written(file, MeshFormat::obj, {.metres_per_unit = -1}), std::invalid_argument);
}

TEST_CASE("OBJ: what can be written comes back with the same bits") {
  io::MeshFile file = decorated_grid(4);
  file.material_libraries = {"cloth.mtl"};
  const io::MeshFile back = obj(written(file, MeshFormat::obj));
  CHECK(same_positions(file.mesh, back.mesh));
  CHECK(corners_of(file.mesh) == corners_of(back.mesh));
  CHECK(back.comments == file.comments);
  CHECK(back.material_libraries == file.material_libraries);
  const Mesh &a = file.mesh, &b = back.mesh;
  for (const Vertex v : a.vertices())
    CHECK((*find_map(a, attribute::color))[v] == (*find_map(b, attribute::color))[v]);
  for (const Face f : a.faces()) {
    const auto name = [f](const io::MeshFile& m) {
      const int g = (*find_map(m.mesh, attribute::group))[f];
      return g < 0 ? "" : m.group_names[g];
    };
    CHECK(name(file) == name(back));
    CHECK(file.material_names[(*find_map(a, attribute::material))[f]] ==
          back.material_names[(*find_map(b, attribute::material))[f]]);
    if (f == Face(3)) continue;  // a corner of it has no texture coordinate
    for (const Halfedge h : a.halfedges_around_face(a.halfedge(f)))
      CHECK((*find_map(a, attribute::texture))[h] == (*find_map(b, attribute::texture))[h]);
  }
  CHECK(std::isnan((*find_map(b, attribute::texture))[b.halfedge(Face(3))][0]));
  CHECK(written(back, MeshFormat::obj) == written(obj(written(back, MeshFormat::obj)), MeshFormat::obj));
}

TEST_CASE("OBJ: drawn lines of a mesh and free polylines are written as l elements") {
  io::MeshFile file = obj(cube_obj);
  file.polylines = {{{Point(5, 5, 5), Point(6, 5, 5), Point(6, 6, 5)}, {}, true}};
  io::MeshFile back = obj(written(file, MeshFormat::obj));
  REQUIRE(back.polylines.size() == 1);
  CHECK(back.polylines[0].points == file.polylines[0].points);
  CHECK(back.polylines[0].closed);
  CHECK(back.mesh->number_of_vertices() == 11);
  CHECK(obj(written(back, MeshFormat::obj)).mesh->number_of_vertices() == 11);
  auto line_edge = ensure_map(file.mesh, attribute::line_edge);
  const auto mark = [&](unsigned a, unsigned b) {
    line_edge[file.mesh->edge(file.mesh->halfedge(Vertex(a), Vertex(b)))] = true;
  };
  mark(0, 1), mark(2, 1), mark(2, 3);
  back = obj(written(file, MeshFormat::obj));
  REQUIRE(back.polylines.size() == 1);
  auto vertices = back.polylines[0].vertices;
  if (vertices.front() == 3) std::reverse(vertices.begin(), vertices.end());
  CHECK(vertices == std::vector<std::size_t>{0, 1, 2, 3});
  CHECK(back.mesh->number_of_vertices() == 8);
}

TEST_CASE("OBJ: a material library is named from the folder that the mesh is written to") {
  const TemporaryFolder folder;
  const auto put = [&](const std::string& name, const std::string& text) {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name) << text;
  };
  put("in/cloth.mtl", "newmtl silk\nmap_Kd silk.png\n");
  put("in/two words.mtl", "newmtl wool\n");
  put("in/shirt.obj", "mtllib cloth.mtl gone.mtl\nmtllib two words.mtl\nmtllib /gone/away.mtl\n" + three +
                          "usemtl silk\nf 1 2 3\n");
  std::filesystem::create_directories(folder / "out/deep");
  const io::MeshFile file = io::read_mesh(folder / "in/shirt.obj");
  REQUIRE(file.material_libraries.size() == 3);
  const auto libraries_at = [&](const char* name, const io::MeshFile& written) {
    io::write_mesh(folder / name, written);
    return io::read_mesh(folder / name).material_libraries;
  };
  using Names = std::vector<std::string>;
  CHECK(libraries_at("in/same.obj", file) == file.material_libraries);
  CHECK(libraries_at("out/deep/shirt.obj", file) ==
        Names{"../../in/cloth.mtl gone.mtl", "../../in/two words.mtl", "/gone/away.mtl"});
  const io::MeshFile again = io::read_mesh(folder / "out/deep/shirt.obj");
  CHECK(libraries_at("out/back.obj", again)[1] == "../in/two words.mtl");
  CHECK(libraries_at("in/home.obj", again) == file.material_libraries);
  io::MeshFile homeless = file;
  homeless.folder.clear();
  CHECK(libraries_at("out/homeless.obj", homeless) == file.material_libraries);
}

TEST_CASE("OBJ: positions that are not finite are not written") {
  io::MeshFile file = obj(cube_obj);
  file.mesh->point(Vertex(3)) = Point(0, unset_value, 0);
  std::ostringstream out;
  for (const auto format : {MeshFormat::obj, MeshFormat::ply, MeshFormat::off, MeshFormat::stl})
    CHECK_THROWS_AS(io::write_mesh(out, format, file), std::invalid_argument);
  CHECK(out.str().empty());
}
