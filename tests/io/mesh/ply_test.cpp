// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <set>

#include "geometry/mesh/vertex_attributes.h"
#include "tests/geometry/mesh/filled_attributes.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/test_meshes.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;
using io::MeshFormat;

namespace {

/// Halfedges without a face have nothing to say.
template <class K, class V>
void check_same_map(const Mesh& a, const Mesh& b, const PropertyName<K, V>& name) {
  INFO(name.name);
  const auto p = find_map(a, name), q = find_map(b, name);
  REQUIRE(p.has_value() == q.has_value());
  if (!p) return;
  std::size_t differ = 0;
  for (const K key : keys_of<K>(a)) {
    if constexpr (std::is_same_v<K, Halfedge>)
      if (a.is_border(key)) continue;
    differ += !same(V((*p)[key]), V((*q)[key]));
  }
  CHECK(differ == 0);
}
void check_same_maps(const Mesh& a, const Mesh& b) {
  for_each_attribute([&](const auto& attribute) { check_same_map(a, b, attribute); });
}

const char* const file_head = "ply\nformat ascii 1.0\n";
const char* const triangle_ply =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\n";
const char* const triangle_rows = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string error_of_ply(const std::string& text) {
  return content_error([&] { read_from(text, MeshFormat::ply); });
}

template <class T>
void put_big(std::string& bytes, T value) {
  auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (std::endian::native == std::endian::little) std::ranges::reverse(raw);
  bytes.append(raw.data(), raw.size());
}

}  // namespace

TEST_CASE("PLY: mesh, maps, names and comments come back with the same bits") {
  const io::MeshFile file = decorated_grid(5);
  const io::MeshFile back = read_from(written(file, MeshFormat::ply), MeshFormat::ply);
  const Mesh &a = file.mesh, &b = back.mesh;
  REQUIRE(same_positions(a, b));
  REQUIRE(corners_of(a) == corners_of(b));
  REQUIRE(a.number_of_edges() == b.number_of_edges());
  check_same_maps(a, b);
  const auto p = struts(a), q = struts(b);
  REQUIRE(p.size() == 2);
  REQUIRE(q.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(p[i].a == q[i].a);
    CHECK(p[i].b == q[i].b);
    CHECK(same_bits(p[i].rest_length, q[i].rest_length));
    CHECK(same_bits(p[i].stiffness, q[i].stiffness));
  }
  CHECK(back.group_names == file.group_names);
  CHECK(back.material_names == file.material_names);
  CHECK(back.comments == file.comments);
  CHECK(back.warnings.empty());
  CHECK_FALSE(back.repairs.any());
  CHECK(written(back, MeshFormat::ply) == written(file, MeshFormat::ply));
}

TEST_CASE("PLY: every attribute of the register has its columns and comes back with the same bits") {
  io::MeshFile file = read_from(cube_obj, MeshFormat::obj);
  fill_attributes(file.mesh);
  file.comments = {"furrow state {}"};
  const std::string bytes = written(file, MeshFormat::ply);
  const std::string first = bytes.substr(0, bytes.find("end_header"));
  // The order that files have always had; a new attribute goes to the end of its element.
  const std::string wanted =
      "element vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
      "property double red\nproperty double green\nproperty double blue\nproperty double alpha\n"
      "property int line\nproperty double mass\nproperty double vx\nproperty double vy\nproperty double vz\n"
      "property double force_jump_x\nproperty double force_jump_y\nproperty double force_jump_z\n"
      "property double contact_x\nproperty double contact_y\nproperty double contact_z\n"
      "property double contact_level\nproperty double rest_x\nproperty double rest_y\nproperty double "
      "rest_z\nproperty int joined\n"
      "element face 12\nproperty list uchar int vertex_indices\nproperty list uchar double texcoord\n"
      "property int group\nproperty int material\nproperty int lining\nproperty double warp_x\n"
      "property double warp_y\nproperty double warp_z\nproperty int rides\nproperty int generation\nproperty "
      "double "
      "rest_length_01\n"
      "property double rest_length_12\nproperty double rest_length_20\n"
      "property list uchar double texcoord_2\n"
      "element edge 18\nproperty int vertex1\nproperty int vertex2\nproperty double rest_length\n"
      "property double bending_rest_length\nproperty double rest_angle\nproperty double stiffness\n"
      "property double bending_stiffness\nproperty double hinge_stiffness\nproperty double tension\n"
      "property int bending_count\nproperty uchar line_edge\nproperty uchar diagonal\nproperty double "
      "press\n";
  CHECK(first.substr(first.find("element vertex")) == wanted);
  const io::MeshFile back = read_from(bytes, MeshFormat::ply);
  for_each_attribute([&](const auto& attribute) { CHECK(find_map(back.mesh, attribute).has_value()); });
  check_same_maps(file.mesh, back.mesh);
  CHECK(written(back, MeshFormat::ply) == bytes);
}

TEST_CASE("PLY: copies of a vertex carry its columns, parts of a face those of the face") {
  const io::MeshFile file = read_from(
      std::string(file_head) +
          "element vertex 6\nproperty float x\nproperty float y\nproperty float z\nproperty int line\n"
          "property double mass\nproperty double rest_x\nproperty double rest_y\nproperty double rest_z\n"
          "element face 3\nproperty list uchar int vertex_indices\nproperty int generation\nend_header\n"
          "0 0 0 7 0.5 1 2 3\n1 0 0 8 0.25 nan nan nan\n0 1 0 -1 nan 4 5 6\n0 -1 0 -1 0.1 0 0 0\n"
          "0 0 1 -1 0.1 0 0 0\n1 0 1 -1 0.1 0 0 0\n3 0 1 2 0\n3 1 0 3 1\n4 0 1 5 4 2\n",
      MeshFormat::ply);
  REQUIRE(file.repairs.duplicated_vertices > 0);
  const auto line = *find_map(file.mesh, attribute::line);
  const auto mass = *find_map(file.mesh, attribute::mass);
  const auto rest = *find_map(file.mesh, attribute::rest_position);
  std::size_t copies = 0;
  for (const Vertex v : file.mesh->vertices()) {
    if (file.mesh->point(v) != file.mesh->point(Vertex(0))) continue;
    ++copies;
    CHECK(line[v] == 7);
    CHECK(mass[v] == 0.5);
    CHECK(rest[v] == RestPosition{1, 2, 3});
  }
  CHECK(copies >= 2);
  const auto generation = *find_map(file.mesh, attribute::generation);
  std::vector<int> generations;
  for (const Face f : file.mesh->faces()) generations.push_back(generation[f]);
  CHECK(generations == std::vector<int>{0, 1, 2, 2});
}

TEST_CASE("PLY: edge values are found by their vertices after flips and removals") {
  io::MeshFile file = decorated_grid(4);
  Mesh& mesh = file.mesh;
  auto rest = *find_map(mesh, attribute::rest_length);
  std::size_t flipped = 0;
  for (const Edge e : mesh.edges()) {
    const Halfedge h = mesh.halfedge(e);
    if (mesh.is_border(e) || flipped == 3 || rest[e] < 1.03) continue;
    const Vertex c = mesh.target(mesh.next(h)), d = mesh.target(mesh.next(mesh.opposite(h)));
    if (mesh.halfedge(c, d) != Mesh::null_halfedge()) continue;
    CGAL::Euler::flip_edge(h, mesh);
    rest[e] = 5 + static_cast<double>(flipped++);
  }
  REQUIRE(flipped == 3);
  CGAL::Euler::remove_face(mesh.halfedge(Face(0)), mesh);
  REQUIRE(mesh.has_garbage());
  const io::MeshFile back = read_from(written(file, MeshFormat::ply), MeshFormat::ply);
  REQUIRE(back.mesh->number_of_faces() == mesh.number_of_faces());
  REQUIRE(back.mesh->number_of_edges() == mesh.number_of_edges());
  const auto by_ends = [](const Mesh& m) {
    std::set<std::tuple<Point, Point, double>> all;
    for (const Edge e : m.edges()) {
      const Point p = m.point(m.vertex(e, 0)), q = m.point(m.vertex(e, 1));
      all.emplace(std::min(p, q), std::max(p, q), (*find_map(m, attribute::rest_length))[e]);
    }
    return all;
  };
  CHECK(by_ends(back.mesh) == by_ends(mesh));
}

TEST_CASE("PLY: a mesh without maps gets no properties and no edge element") {
  io::MeshFile cube = read_from(cube_obj, MeshFormat::obj);
  const auto header_of = [&] {
    const std::string bytes = written(cube, MeshFormat::ply);
    return bytes.substr(0, bytes.find("end_header"));
  };
  CHECK(header_of().find("property uchar diagonal") != std::string::npos);  // its faces have four corners
  auto diagonal = *find_map(cube.mesh, attribute::diagonal);
  cube.mesh->remove_property_map(diagonal);
  const std::string header = header_of();
  for (const char* absent : {"edge", "strut", "rest_length", "line", "mass", "red", "group", "texcoord"})
    CHECK(header.find(absent) == std::string::npos);
  CHECK(header.find("property double z") != std::string::npos);
}

TEST_CASE("PLY: colours that are whole 255ths are written as bytes and come back") {
  const std::string obj = "v 0 0 0 0 0.2 1\nv 1 0 0 1 1 1\nv 0 1 0 0.6 0.4 0.8\nf 1 2 3\n";
  const io::MeshFile file = read_from(obj, MeshFormat::obj);
  const std::string bytes = written(file, MeshFormat::ply);
  CHECK(bytes.find("property uchar red") != std::string::npos);
  const io::MeshFile back = read_from(bytes, MeshFormat::ply);
  check_same_map(file.mesh, back.mesh, attribute::color);
}

TEST_CASE("PLY: lengths are written in the file's unit, masses stay kilograms") {
  const io::MeshFile file = decorated_grid(2);
  const std::string bytes = written(file, MeshFormat::ply, {.metres_per_unit = 0.25, .up = io::Axis::z});
  const io::MeshFile raw = read_from(bytes, MeshFormat::ply);
  const io::MeshFile back = read_from(bytes, MeshFormat::ply, {.metres_per_unit = 0.25, .up = io::Axis::z});
  CHECK((*find_map(raw.mesh, attribute::rest_length))[Edge(2)] ==
        4 * (*find_map(file.mesh, attribute::rest_length))[Edge(2)]);
  CHECK(raw.mesh->point(Vertex(3)) == Point(4 * file.mesh->point(Vertex(3)).x(),
                                            -4 * file.mesh->point(Vertex(3)).z(),
                                            4 * file.mesh->point(Vertex(3)).y()));
  CHECK(same_positions(back.mesh, file.mesh));
  check_same_map(file.mesh, back.mesh, attribute::rest_length);
  check_same_map(file.mesh, raw.mesh, attribute::mass);
}

TEST_CASE(
    "PLY: directions of the warp follow the file's axes, not its unit, and half a direction is refused") {
  io::MeshFile file;
  file.mesh = grid(1, 1);
  auto warp = ensure_map(file.mesh, attribute::warp);
  warp[Face(0)] = {0.1, 0.2, 0.3};
  const std::string bytes = written(file, MeshFormat::ply, {.metres_per_unit = 0.01, .up = io::Axis::z});
  const io::MeshFile raw = read_from(bytes, MeshFormat::ply);
  CHECK(same((*find_map(raw.mesh, attribute::warp))[Face(0)], RestPosition{0.1, -0.3, 0.2}));
  const io::MeshFile back = read_from(bytes, MeshFormat::ply, {.metres_per_unit = 0.01, .up = io::Axis::z});
  check_same_map(file.mesh, back.mesh, attribute::warp);
  const std::string faces = std::string(file_head) +
                            "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                            "element face 1\nproperty list uchar int vertex_indices\nproperty double warp_x\n"
                            "property double warp_y\nproperty double warp_z\nend_header\n"
                            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 ";
  CHECK_NOTHROW(read_from(faces + "nan nan nan\n", MeshFormat::ply));
  CHECK_THROWS_WITH(read_from(faces + "nan 1 0\n", MeshFormat::ply),
                    Catch::Contains("direction of the warp"));
}

TEST_CASE("PLY: text and big-endian bytes of other programs are read") {
  const std::string body =
      "comment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty short quality\n"
      "element face 1\nproperty uchar flags\nproperty list uchar uint vertex_index\n"
      "property list uchar float texcoord\nelement extra 2\nproperty list int double stuff\nend_header\n";
  std::string text = file_head + body +
                     "0 0 0 255 0 51 7\n1 0 0 0 0 0 7\n1 1 0 0 0 0 7\n0 1 0.5 0 0 0 7\n"
                     "9 4 0 1 2 3 8 0 0 1 0 1 1 0 0.5\n2 1.5 2.5\n0\n";
  std::string big = "ply\nformat binary_big_endian 1.0\n" + body;
  const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5F}};
  for (int v = 0; v < 4; ++v) {
    for (const float x : points[v]) put_big(big, x);
    for (const int c : {255, 0, 51}) put_big(big, static_cast<std::uint8_t>(v == 0 ? c : 0));
    put_big(big, std::int16_t{7});
  }
  put_big(big, std::uint8_t{9}), put_big(big, std::uint8_t{4});
  for (std::uint32_t i = 0; i < 4; ++i) put_big(big, i);
  put_big(big, std::uint8_t{8});
  for (const float t : {0.F, 0.F, 1.F, 0.F, 1.F, 1.F, 0.F, 0.5F}) put_big(big, t);
  put_big(big, std::int32_t{2}), put_big(big, 1.5), put_big(big, 2.5), put_big(big, std::int32_t{0});
  for (const std::string& bytes : {text, big}) {
    const io::MeshFile file = read_from(bytes, MeshFormat::ply);
    CHECK(corners_of(file.mesh) == std::vector<std::size_t>{0, 1, 2, 0, 2, 3});
    CHECK(file.mesh->point(Vertex(3)) == Point(0, 1, 0.5));
    CHECK((*find_map(file.mesh, attribute::color))[Vertex(0)] == Color{1, 0, 0.2, 1});
    CHECK(file.repairs.triangulated_faces == 1);
    const Halfedge h = file.mesh->halfedge(Vertex(2), Vertex(3));
    CHECK((*find_map(file.mesh, attribute::texture))[h] == TextureCoordinate{0, 0.5});
    CHECK(file.comments == std::vector<std::string>{"made by hand"});
    REQUIRE(file.warnings.size() == 2);
    CHECK(file.warnings[0].find("flags") != std::string::npos);
    CHECK(file.warnings[1].find("extra") != std::string::npos);
  }
}

TEST_CASE("PLY: texture coordinates of vertices go to the corners") {
  const std::string text = std::string(file_head) +
                           "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty "
                           "float s\nproperty float t\n"
                           "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
                           "0 0 0 0.5 0.25\n1 0 0 0.75 0\n0 1 0 0 1\n3 0 1 2\n";
  const io::MeshFile file = read_from(text, MeshFormat::ply);
  const Halfedge h = file.mesh->halfedge(Vertex(2), Vertex(0));
  CHECK((*find_map(file.mesh, attribute::texture))[h] == TextureCoordinate{0.5, 0.25});
}

TEST_CASE("PLY: vertices carry their texture coordinates for Blender, unless a seam gives them two") {
  io::MeshFile file;
  file.mesh = grid(2, 2);
  auto texture = ensure_map(file.mesh, attribute::texture);
  for (const Halfedge h : file.mesh->halfedges()) {
    const Point& p = file.mesh->point(file.mesh->target(h));
    texture[h] = {p.x() / 3, p.y() / 7};
  }
  const std::string bytes = written(file, MeshFormat::ply);
  CHECK(bytes.find("property double z\nproperty double s\nproperty double t\nelement face") != bytes.npos);
  const io::MeshFile back = read_from(bytes, MeshFormat::ply);
  check_same_maps(file.mesh, back.mesh);
  CHECK(vertex_attributes(back.mesh).empty());
  CHECK(back.warnings.empty());
  CHECK(written(back, MeshFormat::ply) == bytes);
  // What a program sees that knows the columns of vertices alone.
  std::string blind = bytes;
  for (std::size_t at; (at = blind.find("texcoord")) != blind.npos;) blind.replace(at, 8, "textures");
  const io::MeshFile seen = read_from(blind, MeshFormat::ply);
  check_same_map(file.mesh, seen.mesh, attribute::texture);
  for (const TextureCoordinate& other : {TextureCoordinate{0.5, 0.5}, attribute::texture.default_value}) {
    io::MeshFile seam = file;
    (*find_map(seam.mesh, attribute::texture))[seam.mesh->halfedge(Face(3))] = other;
    CHECK(written(seam, MeshFormat::ply).find("property double s") == std::string::npos);
  }
  io::MeshFile clash = file;
  ensure_vertex_attribute(clash.mesh, "t");
  CHECK(written(clash, MeshFormat::ply).find("property double s") == std::string::npos);
}

TEST_CASE("PLY: errors name the line, or the element in binary files") {
  const std::string head = file_head, triangle = triangle_ply, rows = triangle_rows;
  CHECK(error_of_ply("plu\n").starts_with("test:1: "));
  CHECK(error_of_ply(head + "element vertex x\n").starts_with("test:3: 'x' is not a whole number"));
  CHECK(error_of_ply(head + "element vertex 1\nproperty flot x\n").starts_with("test:4: 'flot' is no type"));
  CHECK(error_of_ply(head + triangle).find("cut short") != std::string::npos);
  CHECK(error_of_ply(head + triangle + triangle + "end_header\n").find("second element") !=
        std::string::npos);
  CHECK(
      error_of_ply(head + triangle + "end_header\n0 0 0\n1 0 0\n0 1 zero\n").starts_with("test:12: 'zero'"));
  CHECK(error_of_ply(head + triangle + "end_header\n0 0 0\n1 inf 0\n0 1 0\n3 0 1 2\n")
            .starts_with("test:11: vertex 1: "));
  CHECK(error_of_ply(head + triangle + "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n").find("face 0") !=
        std::string::npos);
  const std::string edge =
      "element edge 1\nproperty int vertex1\nproperty int vertex2\nproperty double rest_length\n";
  CHECK(error_of_ply(head + triangle + edge + "end_header\n" + rows + "0 1 0.5\n") == "(none)");
  CHECK(error_of_ply(head + triangle + edge + "end_header\n" + rows + "0 1 -0.5\n")
            .starts_with("test:18: edge 0: a rest"));
  CHECK(error_of_ply(head + triangle + edge + "end_header\n" + rows + "0 7 0.5\n")
            .find("between vertices 0 and 7") != std::string::npos);
  std::string bytes = written(decorated_grid(2), MeshFormat::ply);
  bytes.resize(bytes.size() - 1);
  CHECK(error_of_ply(bytes).starts_with("test: strut 1: the file is cut short"));
}

TEST_CASE("PLY: hostile stiffnesses, rest angles, struts and lengths of triangles are refused") {
  const std::string head = std::string(file_head) + triangle_ply, rows = triangle_rows;
  const auto edge = [&](const std::string& column, const std::string& value) {
    return error_of_ply(head +
                        "element edge 1\nproperty int vertex1\nproperty int vertex2\nproperty double " +
                        column + "\nend_header\n" + rows + "0 1 " + value + "\n");
  };
  for (const char* column : {"stiffness", "bending_stiffness", "hinge_stiffness"}) {
    CHECK(edge(column, "0") == "(none)");
    CHECK(edge(column, "nan") == "(none)");
    for (const char* bad : {"-1", "inf"})
      CHECK(edge(column, bad).find("edge 0: a stiffness must be >= 0 and finite") != std::string::npos);
  }
  CHECK(edge("rest_angle", "4").find("edge 0: a rest angle must be in [-pi, pi]") != std::string::npos);
  const auto strut = [&](const std::string& values) {
    return error_of_ply(head +
                        "element strut 1\nproperty int vertex1\nproperty int vertex2\n"
                        "property double rest_length\nproperty double stiffness\nend_header\n" +
                        rows + values + "\n");
  };
  CHECK(strut("2 0 0.5 3") == "(none)");
  for (const auto& [values, what] : {std::pair("0 3 0.5 3", "strut 0: names vertex 3 of 3"),
                                     {"0 -1 0.5 3", "no index of a vertex"},
                                     {"1 1 0.5 3", "one vertex"},
                                     {"0 1 0 3", "a rest length must be > 0"},
                                     {"0 1 nan 3", "a strut needs"},
                                     {"0 1 0.5 -3", "a stiffness must be"},
                                     {"0 1 0.5 nan", "a strut needs"}})
    CHECK(strut(values).find(what) != std::string::npos);
  const auto triangle = [&](const std::string& values) {
    return error_of_ply(head +
                        "property double rest_length_01\nproperty double rest_length_12\n"
                        "property double rest_length_20\nend_header\n0 0 0\n1 0 0\n0 1 0\n" +
                        values + "\n");
  };
  CHECK(triangle("3 0 1 2 1 1.4 1") == "(none)");
  CHECK(triangle("3 0 1 2 nan nan nan") == "(none)");
  CHECK(triangle("3 0 1 2 1 -1.4 1").find("face 0: a rest length must be > 0") != std::string::npos);
}

TEST_CASE("PLY: lengths of a triangle stand for the edges between its corners, whichever way it winds") {
  // The second face winds against the first and is turned over.
  const io::MeshFile file =
      read_from(std::string(file_head) +
                    "element vertex 5\nproperty float x\nproperty float y\nproperty float z\nelement face 3\n"
                    "property list uchar int vertex_indices\nproperty double rest_length_01\n"
                    "property double rest_length_12\nproperty double rest_length_20\nend_header\n"
                    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 1 0\n3 0 1 2 101 112 120\n3 3 2 0 232 220 203\n"
                    "3 1 4 2 314 342 321\n",
                MeshFormat::ply);
  REQUIRE(file.repairs.reversed_faces == 1);
  const auto rest = *find_map(file.mesh, attribute::triangle_rest_length);
  for (const Halfedge h : file.mesh->halfedges()) {
    if (file.mesh->is_border(h)) continue;
    const int f = int(std::size_t(file.mesh->face(h))) + 1;
    const int a = int(std::size_t(file.mesh->source(h))), b = int(std::size_t(file.mesh->target(h)));
    CHECK((rest[h] == 100 * f + 10 * a + b || rest[h] == 100 * f + 10 * b + a));
  }
}

TEST_CASE("PLY: a header cannot announce more than the file holds") {
  const std::string head = file_head;
  CHECK(error_of_ply(
            head +
            "element vertex 2000000000\nproperty float x\nproperty float y\nproperty float z\nend_header\n")
            .find("more than the file can hold") != std::string::npos);
  const std::string bytes = std::string("ply\nformat binary_little_endian 1.0\n") + triangle_ply +
                            "property list int double huge\nend_header\n" + std::string(36, '\0') + "\3" +
                            std::string(12, '\0') + "\xff\xff\xff\x7f";
  CHECK(error_of_ply(bytes).starts_with("test: face 0: a list is longer than the file"));
}

TEST_CASE("PLY: a name of a group is an attribute where the group is not whole") {
  const std::string head =
      std::string(file_head) + "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string tail =
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 6\n3 0 1 2\n";
  const auto names_of = [&](const char* a, const char* b) {
    const std::string text = head + "property float " + a + "\nproperty float " + b + "\n" + tail;
    const io::MeshFile file = read_from(text, MeshFormat::ply);
    const io::MeshFile back = read_from(written(file, MeshFormat::ply), MeshFormat::ply);
    std::vector<std::string> names;
    for (const VertexAttribute& attribute : vertex_attributes(file.mesh)) names.push_back(attribute.name);
    CHECK(vertex_attributes(back.mesh).size() == names.size());
    return names;
  };
  using Names = std::vector<std::string>;
  for (const auto& [a, b] : {std::pair("t", "r"), {"u", "t"}, {"v", "a"}, {"rest_x", "nx"}, {"vx", "red"}})
    CHECK(names_of(a, b) == Names{a, b});
  CHECK(names_of("s", "t").empty());
  CHECK(names_of("v", "u").empty());
  CHECK(names_of("mass", "q") == Names{"q"});
}

TEST_CASE("PLY: an attribute with the name of another column is not written") {
  const std::string head = std::string(file_head) +
                           "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                           "property float rest_x\nelement face 1\nproperty list uchar int vertex_indices\n"
                           "end_header\n0 0 0 1\n1 0 0 2\n0 1 0 3\n3 0 1 2\n";
  io::MeshFile named = read_from(head, MeshFormat::ply);
  ensure_map(named.mesh, attribute::rest_position);
  CHECK(content_error([&] { written(named, MeshFormat::ply); }).find("'rest_x'") != std::string::npos);
}

TEST_CASE("PLY: strips of triangles are read, as scanners' files have them") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n5 5 5\n9 0 1 2 3 4 -1 3 5 4\n";
  const io::MeshFile file = read_from(text, io::MeshFormat::ply);
  CHECK(file.mesh->number_of_faces() == 4);
  CHECK(file.warnings.empty());
  for (const geometry::Face f : file.mesh->faces()) {
    std::vector<geometry::Point> p;
    for (const auto v : file.mesh->vertices_around_face(file.mesh->halfedge(f)))
      p.push_back(file.mesh->point(v));
    if (p[0].z() + p[1].z() + p[2].z() == 0) CHECK(CGAL::cross_product(p[1] - p[0], p[2] - p[0]).z() > 0);
  }
  std::string wrong = text;
  wrong.replace(wrong.find("-1 3"), 2, "-2");
  CHECK(content_error([&] { read_from(wrong, io::MeshFormat::ply); }).find("no index of a vertex") !=
        std::string::npos);
}
