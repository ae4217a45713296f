// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/vertex_attributes.h"
#include "io/base/byte_order.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/io/mesh/seam.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;
using nlohmann::json;

namespace {

std::string error_of_glb(const std::string& bytes) {
  TemporaryFolder folder;
  spit(folder / "a.glb", bytes);
  return content_error([&] { io::read_mesh(folder / "a.glb"); });
}

void check_seam(const io::MeshFile& file) {
  const Mesh& mesh = file.mesh;
  REQUIRE(mesh.number_of_faces() == 2);
  CHECK(mesh.number_of_vertices() == 4);
  CHECK(file.repairs.merged_vertices == 2);
  CHECK(mesh.point(Vertex(3)) == Point(0, 2, 5 + 2 * static_cast<double>(0.1F)));
  CHECK(file.group_names == std::vector<std::string>{"sleeve"});
  CHECK(file.material_names == std::vector<std::string>{"silk"});
  CHECK((*find_map(mesh, attribute::texture))[mesh.halfedge(Vertex(1), Vertex(2))] ==
        TextureCoordinate{0.25, 0.75});
  CHECK((*find_map(mesh, attribute::texture))[mesh.halfedge(Vertex(0), Vertex(2))] ==
        TextureCoordinate{0.5, 0.75});
  REQUIRE(file.warnings.size() == 1);
  CHECK(file.warnings[0].find("single precision") != std::string::npos);
}

}  // namespace

TEST_CASE("glTF: GLB and glTF with a buffer file are read, seams closed, transforms applied") {
  TemporaryFolder folder;
  Seam seam;
  spit(folder / "a.glb", seam.glb());
  check_seam(io::read_mesh(folder / "a.glb"));
  seam.scene["buffers"][0]["uri"] = "a.bin";
  spit(folder / "a.bin", seam.buffer);
  spit(folder / "a.gltf", seam.scene.dump());
  check_seam(io::read_mesh(folder / "a.gltf"));
}

TEST_CASE("glTF: a mirrored node's faces are turned") {
  Seam seam;
  seam.scene["nodes"][0]["scale"] = {-2, 2, 2};
  TemporaryFolder folder;
  spit(folder / "a.glb", seam.glb());
  const io::MeshFile file = io::read_mesh(folder / "a.glb");
  const Mesh& mesh = file.mesh;
  for (const Face f : mesh.faces()) {
    std::vector<Point> p;
    for (const Vertex v : mesh.vertices_around_face(mesh.halfedge(f))) p.push_back(mesh.point(v));
    CHECK(CGAL::cross_product(p[1] - p[0], p[2] - p[0]).z() > 0);
  }
}

TEST_CASE("glTF: skin weights become attributes by the joints' names") {
  const io::MeshFile file = SkinnedSeam().read();
  const auto list = vertex_attributes(file.mesh);
  REQUIRE(list.size() == 2);
  CHECK(list[0].name == "weight_upper_arm");
  CHECK(list[1].name == "weight_hand");
  REQUIRE(file.mesh->number_of_vertices() == 4);
  for (const Vertex v : file.mesh->vertices()) {
    const bool first = v.idx() < 3;  // merged points keep the weights of the first
    CHECK(list[0].values[v] == (first ? 0.25 : 1));
    CHECK(list[1].values[v] == (first ? 0.75 : 0));
  }
}

TEST_CASE("glTF: a skinned mesh lies where its joints bind it, whatever its node says") {
  const Point raw(0, 1, static_cast<double>(0.1F));
  SkinnedSeam bound({{{0, -1, 0}, {0, -1.5F, 0}}});  // its node says: twice as large, and 5 m away
  bound.scene["nodes"][1]["translation"] = {0, 1, 0};
  bound.scene["nodes"][2]["translation"] = {0, 0.5, 0};
  const io::MeshFile file = bound.read();
  CHECK(file.mesh->point(Vertex(3)) == raw);
  CHECK(file.warnings.size() == 1);  // single precision

  // an armature in centimetres that lies on its back
  bound.scene["nodes"].push_back({{"name", "armature"},
                                  {"children", {1}},
                                  {"scale", {0.01, 0.01, 0.01}},
                                  {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}});
  bound.scene["scenes"][0]["nodes"][1] = 3;
  const Point lying = bound.read().mesh->point(Vertex(3));
  CHECK(lying.x() == Approx(0).margin(1e-6));
  CHECK(lying.y() == Approx(0.001).margin(1e-6));
  CHECK(lying.z() == Approx(-0.01).margin(1e-6));
}

TEST_CASE("glTF: a skeleton in another pose than it was bound in is told") {
  SkinnedSeam posed({{{0, -1, 0}, {0, -1.5F, 0}}});
  posed.scene["nodes"][1]["translation"] = {0, 1, 0};
  posed.scene["nodes"][2]["translation"] = {0.3, 0.5, 0};
  const io::MeshFile file = posed.read();
  CHECK(file.mesh->point(Vertex(3)) == Point(0, 1, static_cast<double>(0.1F)));
  REQUIRE(file.warnings.size() == 2);
  CHECK(file.warnings[1].find("sleeve: its skeleton stands in another pose") != std::string::npos);
}

TEST_CASE("glTF: bad files are content errors that name the file") {
  CHECK(error_of_glb("").find("a.glb: the file is empty") != std::string::npos);
  CHECK(error_of_glb("not a mesh").find("a.glb: ") != std::string::npos);
  CHECK(content_error([] { io::read_mesh("/nowhere/a.glb"); }).find("No such file") != std::string::npos);
  Seam bad_index;
  bad_index.buffer[120] = 77;
  CHECK(error_of_glb(bad_index.glb()).find("a.glb: ") != std::string::npos);
  Seam infinite;
  infinite.buffer.replace(0, 4, std::string("\x00\x00\x80\x7f", 4));
  CHECK(error_of_glb(infinite.glb()).find("a.glb: ") != std::string::npos);
  Seam beyond;
  beyond.scene["accessors"][0]["count"] = 2000000000;
  CHECK(error_of_glb(beyond.glb()).find("a.glb: ") != std::string::npos);
}

TEST_CASE("glTF: damaged files are read or refused, this process lives on") {
  const std::string valid = Seam().glb();
  TemporaryFolder folder;
  std::size_t refused = 0, files = 0;
  for (std::size_t at = 5; at < valid.size(); at += 61) {
    std::string changed = valid;
    changed[at] = static_cast<char>(changed[at] ^ 0x55);
    for (const std::string& bytes : {changed, valid.substr(0, at)}) {
      spit(folder / "a.glb", bytes);
      ++files;
      try {
        const io::MeshFile file = io::read_mesh(folder / "a.glb");
        CHECK(file.mesh->is_valid(false));
      } catch (const ContentError&) {
        ++refused;
      }
    }
  }
  CHECK(refused >= files / 2);
}

TEST_CASE("gltf: buffers are read from the file's folder and below, not from elsewhere") {
  TemporaryFolder folder;
  const std::filesystem::path inner = folder / "in";
  std::filesystem::create_directories(inner / "below");
  Seam seam;
  spit(folder / "outside.bin", seam.buffer);
  spit(inner / "own.bin", seam.buffer);
  spit(inner / "below" / "deep.bin", seam.buffer);
  std::filesystem::create_symlink(folder / "outside.bin", inner / "link.bin");
  const auto write = [&](const std::string& uri) {
    seam.scene["buffers"] = json::array({{{"byteLength", seam.buffer.size()}, {"uri", uri}}});
    spit(inner / "a.gltf", seam.scene.dump());
    return inner / "a.gltf";
  };
  for (const char* uri : {"own.bin", "below/deep.bin", "below/../own.bin"})
    check_seam(io::read_mesh(write(uri)));
  const std::string absolute = (folder / "outside.bin").string();
  for (const std::string& uri : {std::string("../outside.bin"), std::string("link.bin"), absolute,
                                 std::string("/dev/zero"), std::string("below")}) {
    INFO(uri);
    const std::string error = content_error([&] { io::read_mesh(write(uri)); });
    CHECK_THAT(error, Catch::StartsWith((inner / "a.gltf").string() + ": it names '") &&
                          Catch::Contains("lay the file there"));
  }
}

TEST_CASE("glTF: a file that is none is refused in words of our own") {
  const TemporaryFolder folder;
  for (const std::string& bytes : {std::string("no glTF at all"), std::string("glTX\2\0\0\0\14\0\0\0", 12)}) {
    spit(folder / "broken.glb", bytes);
    const std::string error = content_error([&] { io::read_mesh(folder / "broken.glb"); });
    CHECK(error.find("broken.glb: ") != std::string::npos);
    CHECK(error.find("it is no glTF of version 2, or is damaged where it begins") != std::string::npos);
    CHECK(error.find("suitable reader") == std::string::npos);
  }
}

namespace {

/// Stores an attribute of floats as integers: of the component type, normalised or not, times `scale` before.
void store_as_integers(Seam& seam, const char* attribute, int type, bool normalized, double scale = 1) {
  json& accessor =
      seam.scene["accessors"]
                [seam.scene["meshes"][0]["primitives"][0]["attributes"][attribute].get<std::size_t>()];
  const std::size_t from = seam.scene["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"],
                    width = accessor["type"] == "VEC2"   ? 2
                            : accessor["type"] == "VEC3" ? 3
                                                         : 4,
                    at = seam.buffer.size(), stride = type < 5122 ? 4 : 8;
  const double most = type == 5120 ? 127 : type == 5121 ? 255 : type == 5122 ? 32767 : 65535;
  for (std::size_t v = 0; v < 6; ++v) {
    for (std::size_t k = 0; k < width; ++k) {
      const double value =
          io::read_in_order<float>(&seam.buffer[from + 4 * (v * width + k)], std::endian::little);
      const auto number = static_cast<std::uint16_t>(std::lround(value * scale * (normalized ? most : 1)));
      type < 5122 ? put_bytes(seam.buffer, static_cast<std::uint8_t>(number))
                  : put_bytes(seam.buffer, number);
    }
    seam.buffer.resize(at + stride * (v + 1));
  }
  accessor["bufferView"] = seam.scene["bufferViews"].size();
  accessor["componentType"] = type;
  accessor["normalized"] = normalized;
  seam.scene["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", at}, {"byteLength", 6 * stride}, {"byteStride", stride}});
  seam.scene["buffers"][0]["byteLength"] = seam.buffer.size();
}

/// How far apart two meshes of the same faces are at most: vertices, texture coordinates, weights.
std::array<double, 3> differences(const io::MeshFile& a, const io::MeshFile& b) {
  REQUIRE(a.mesh->number_of_vertices() == b.mesh->number_of_vertices());
  REQUIRE(a.mesh->number_of_faces() == b.mesh->number_of_faces());
  std::array<double, 3> most{};
  for (const Vertex v : a.mesh->vertices())
    most[0] = std::max(most[0], std::sqrt(CGAL::squared_distance(a.mesh->point(v), b.mesh->point(v))));
  const auto ta = *find_map(a.mesh, attribute::texture), tb = *find_map(b.mesh, attribute::texture);
  for (const Halfedge h : a.mesh->halfedges())
    for (std::size_t k = 0; k < 2 && !a.mesh->is_border(h); ++k)
      most[1] = std::max(most[1], std::abs(ta[h][k] - tb[h][k]));
  const auto wa = vertex_attributes(a.mesh), wb = vertex_attributes(b.mesh);
  REQUIRE(wa.size() == wb.size());
  for (std::size_t i = 0; i < wa.size(); ++i) {
    REQUIRE(wa[i].name == wb[i].name);
    for (const Vertex v : a.mesh->vertices())
      most[2] = std::max(most[2], std::abs(wa[i].values[v] - wb[i].values[v]));
  }
  return most;
}

}  // namespace

TEST_CASE("glTF: integers are read as the numbers that they stand for, normalised or not") {
  const io::MeshFile floats = SkinnedSeam().read();
  for (const auto& [type, step] : {std::pair(5121, 1 / 255.), {5123, 1 / 65535.}}) {
    SkinnedSeam seam;
    store_as_integers(seam, "WEIGHTS_0", type, true);
    store_as_integers(seam, "TEXCOORD_0", type, true);
    const auto [points, textures, weights] = differences(seam.read(), floats);
    CHECK(points == 0);
    CHECK(textures <= step / 2 + 1e-7);
    CHECK(weights <= step / 2 + 1e-7);
  }
  for (const int type : {5120, 5121, 5122, 5123}) {
    SkinnedSeam seam;
    const bool is_signed = type == 5120 || type == 5122;
    store_as_integers(seam, "POSITION", type, is_signed, is_signed ? 1 : 100);
    // a skinned mesh lies where its joints put it
    seam.scene["nodes"][1]["scale"] = std::vector(3, is_signed ? 1 : 0.01);
    seam.scene["extensionsUsed"] = seam.scene["extensionsRequired"] = {"KHR_mesh_quantization"};
    CHECK(differences(seam.read(), floats)[0] <= (type == 5121 || type == 5120 ? 0.01 : 1e-4));
  }
}

TEST_CASE("glTF: a skin without inverse bind matrices has identities") {
  SkinnedSeam seam;
  const io::MeshFile given = seam.read();
  seam.scene["skins"][0].erase("inverseBindMatrices");
  CHECK(differences(seam.read(), given) == std::array<double, 3>{});
}

TEST_CASE("glTF: an extension that is needed and not read is refused by its name, with what undoes it") {
  const auto error_with = [](const char* name) {
    Seam seam;
    seam.scene["extensionsUsed"] = seam.scene["extensionsRequired"] = {name};
    return error_of_glb(seam.glb());
  };
  CHECK(error_with("KHR_meshopt_compression")
            .ends_with("it needs the extension KHR_meshopt_compression, which is not read; undo it by "
                       "gltf-transform cp packed.glb plain.glb"));
  CHECK(
      error_with("EXT_mesh_gpu_instancing").ends_with("which is not read; export the file again without it"));
  for (const char* name : {"KHR_texture_transform", "KHR_materials_unlit", "KHR_lights_punctual"})
    CHECK(error_with(name) == "(none)");
}

TEST_CASE("glTF: the shape that its keys show is read, and told") {
  SkinnedSeam seam = with_key(SkinnedSeam());
  const Point before = seam.read().mesh->point(Vertex(3));
  CHECK(seam.read().warnings.size() == 1);
  const auto shows = [&](double share) {
    const io::MeshFile file = seam.read();
    CHECK(std::sqrt(CGAL::squared_distance(file.mesh->point(Vertex(3)), before + Vector(0, share / 2, 0))) <
          1e-6);
    CHECK(file.mesh->point(Vertex(1)) == Point(1, 0, 0));
    REQUIRE(file.warnings.size() == 2);
    CHECK(file.warnings[1].find("shows shape keys ('Long'); its shape with them is read") !=
          std::string::npos);
  };
  seam.scene["meshes"][0]["weights"] = {0.5};
  shows(0.5);
  seam.scene["nodes"][0]["weights"] = {1.0};
  shows(1);
  seam.scene["nodes"][0]["weights"] = {0.0};
  CHECK(seam.read().warnings.size() == 1);
  seam.scene["nodes"][0]["weights"] = {1.0};
  seam.scene["accessors"].back()["count"] = 5;
  CHECK(error_of_glb(seam.glb()).find("a.glb: an accessor names an element") != std::string::npos);
  seam.scene["accessors"].back()["count"] = 7;
  CHECK(error_of_glb(seam.glb()).find("a shape key has not the vertices of its mesh") != std::string::npos);
  seam.scene["accessors"].back()["count"] = 2000000000;
  CHECK(error_of_glb(seam.glb()).find("too many elements") != std::string::npos);
}

TEST_CASE("glTF: an avatar of VRM is read as the GLB that it is and goes back as one") {
  TemporaryFolder folder;
  SkinnedSeam seam;
  CHECK_THROWS_WITH(io::write_mesh(folder / "b.vrm", seam.read()),
                    Catch::Contains("none was read for; let the name end in .glb"));
  CHECK(!std::filesystem::exists(folder / "b.vrm"));
  for (const char* name : {"VRM", "VRMC_vrm"}) {
    seam.scene["extensions"] = {{name, {{"humanoid", json::object()}, {"meshAnnotations", {{{"mesh", 0}}}}}}};
    spit(folder / "a.vrm", seam.glb());
    const io::MeshFile read = io::read_mesh(folder / "a.vrm");
    CHECK(differences(read, seam.read()) == std::array<double, 3>{});
    CHECK(io::write_mesh(folder / "b.vrm", read).empty());
    const std::string written = slurp(folder / "b.vrm");
    CHECK(written.find(seam.scene["extensions"].dump()) != written.npos);
    CHECK(differences(io::read_mesh(folder / "b.vrm"), read) == std::array<double, 3>{});
  }
}

TEST_CASE("glTF: accessors of no known type are refused, whatever they are of") {
  for (std::size_t accessor = 0; accessor < 6; ++accessor)
    for (const auto& [key, value] : {std::pair<const char*, json>{"componentType", 5124},
                                     {"componentType", "float"},
                                     {"type", "VEC9"}}) {
      SkinnedSeam seam;
      seam.scene["accessors"][accessor][key] = value;
      INFO(accessor << key);
      CHECK(error_of_glb(seam.glb()).find("a.glb: ") != std::string::npos);
    }
}

TEST_CASE("glTF: strips and fans are triangles, and what has no indices takes its vertices in their order") {
  const auto turns_up = [](const io::MeshFile& file) {
    for (const Face f : file.mesh->faces()) {
      std::vector<Point> p;
      for (const Vertex v : file.mesh->vertices_around_face(file.mesh->halfedge(f)))
        p.push_back(file.mesh->point(v));
      if (CGAL::cross_product(p[1] - p[0], p[2] - p[0]).z() <= 0) return false;
    }
    return true;
  };
  for (const int mode : {5, 6}) {
    Seam seam;  // (0, 0), (1, 0), (1, 1), (0, 0), (1, 1), (0, 1)
    const std::string order =
        mode == 5 ? std::string("\0\0\1\0\5\0\2\0", 8) : std::string("\0\0\1\0\2\0\5\0", 8);
    seam.buffer.replace(120, 8, order);
    seam.scene["accessors"][2]["count"] = 4;
    seam.scene["meshes"][0]["primitives"][0]["mode"] = mode;
    TemporaryFolder folder;
    spit(folder / "a.glb", seam.glb());
    const io::MeshFile file = io::read_mesh(folder / "a.glb");
    CHECK(file.mesh->number_of_faces() == 2);
    CHECK(turns_up(file));
  }
  Seam seam;
  TemporaryFolder folder;
  seam.scene["meshes"][0]["primitives"][0].erase("indices");
  spit(folder / "a.glb", seam.glb());
  CHECK(io::read_mesh(folder / "a.glb").mesh->number_of_faces() == 2);
}

TEST_CASE("glTF: rigs whose joints have the same names keep their weights apart, each in its own place") {
  SkinnedSeam seam;
  json other = seam.scene["nodes"][0];
  other["skin"] = 1;
  seam.scene["nodes"].push_back(other);  // 3
  seam.scene["nodes"].push_back({{"name", "upper arm"}, {"children", {5}}, {"translation", {5, 0, 0}}});
  seam.scene["nodes"].push_back({{"name", "hand"}});
  seam.scene["skins"].push_back(seam.scene["skins"][0]);
  seam.scene["skins"][1]["joints"] = {4, 5};
  for (const int root : {3, 4}) seam.scene["scenes"][0]["nodes"].push_back(root);
  const io::MeshFile file = seam.read();
  CHECK(file.group_names == std::vector<std::string>{"sleeve", "sleeve (2)"});
  std::vector<std::string> names;
  for (const VertexAttribute& a : vertex_attributes(file.mesh)) names.push_back(a.name);
  CHECK(names == std::vector<std::string>{"weight_upper_arm", "weight_hand", "weight_upper_arm_(2)",
                                          "weight_hand_(2)"});
  REQUIRE(file.mesh->number_of_vertices() == 8);
  CHECK(file.mesh->point(Vertex(7)) - file.mesh->point(Vertex(3)) == Vector(5, 0, 0));
}

TEST_CASE("glTF: a figure is chosen by the name of its node, of a node above it, or of its mesh") {
  Seam seam;
  seam.scene["meshes"].push_back(seam.scene["meshes"][0]);
  seam.scene["meshes"][1]["name"] = "Shell";
  seam.scene["nodes"].push_back({{"mesh", 1}, {"name", "cuff.001"}, {"translation", {9, 0, 0}}});
  seam.scene["nodes"].push_back({{"name", "Clothes"}, {"children", {1}}});
  seam.scene["scenes"][0]["nodes"].push_back(2);
  TemporaryFolder folder;
  spit(folder / "a.glb", seam.glb());
  const auto read = [&](const std::string& figure) { return io::read_mesh(folder / ("a.glb" + figure)); };
  CHECK(read("").mesh->number_of_faces() == 4);
  for (const char* figure : {"#cuff.001", "#Clothes", "#Shell"}) {
    CHECK(read(figure).group_names == std::vector<std::string>{"cuff.001"});
    CHECK(read(figure).mesh->point(Vertex(0)) == Point(9, 0, 0));
  }
  CHECK_THROWS_WITH(read("#collar"),
                    Catch::Contains("a.glb#collar: it has no figure 'collar'; it has 'sleeve', "
                                    "'cuff.001'"));
}

TEST_CASE("glTF: sparse integers are read, and those that cannot be refused, whatever contradicts itself") {
  SkinnedSeam sparse, far;
  store_as_integers(sparse, "TEXCOORD_0", 5123, true);
  std::string index, values;
  put_bytes(index, std::uint16_t{4});
  for (const double t : {1., 0.5}) put_bytes(values, static_cast<std::uint16_t>(std::lround(65535 * t)));
  const std::size_t at = add_view(sparse, index), given = add_view(sparse, values);
  sparse.scene["accessors"][1]["sparse"] = {{"count", 1},
                                            {"indices", {{"bufferView", at}, {"componentType", 5123}}},
                                            {"values", {{"bufferView", given}}}};
  const io::MeshFile read = sparse.read();
  const auto texture = *find_map(read.mesh, attribute::texture);
  int changed = 0;
  for (const Halfedge h : read.mesh->halfedges())
    if (!read.mesh->is_border(h)) changed += std::abs(texture[h][0] - 1) < 1e-6;
  CHECK(changed == 1);
  store_as_integers(far, "TEXCOORD_0", 5123, true);
  far.scene["accessors"][1]["count"] = 2000;
  CHECK(error_of_glb(far.glb()).find("an accessor reaches beyond its view") != std::string::npos);
  far.scene["accessors"][1]["type"] = "VEC7";
  CHECK(error_of_glb(far.glb()).find("a.glb: ") != std::string::npos);
}

TEST_CASE("glTF: files with integers from other programs are read as those with floats") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const std::filesystem::path wild = shared_dir() / "wild", second = shared_dir() / "defects/second";
  const io::MeshFile bytes = io::read_mesh(wild / "w_u8.glb"), words = io::read_mesh(wild / "uv_u16.glb"),
                     no_matrices = io::read_mesh(wild / "no_ibm.glb");
  const auto [points, textures, weights] = differences(bytes, words);
  CHECK(points == 0);
  CHECK(textures <= 1 / 65535.);
  CHECK(weights <= 3 / 255.);  // whole bytes that sum up to 255
  for (const VertexAttribute& a : vertex_attributes(bytes.mesh))
    for (const Vertex v : bytes.mesh->vertices())
      CHECK(std::abs(255 * a.values[v] - std::round(255 * a.values[v])) < 1e-4);
  CHECK(no_matrices.mesh->number_of_vertices() == words.mesh->number_of_vertices());
  CHECK(differences(no_matrices, words)[1] <= 1 / 65535.);
  const auto has_box = [](const io::MeshFile& file, const Point& low, const Point& high) {
    CGAL::Bbox_3 box;
    for (const Point& p : file.mesh->points()) box += p.bbox();
    CHECK(std::sqrt(CGAL::squared_distance(low, Point(box.xmin(), box.ymin(), box.zmin()))) < 0.01);
    CHECK(std::sqrt(CGAL::squared_distance(high, Point(box.xmax(), box.ymax(), box.zmax()))) < 0.01);
  };
  has_box(io::read_mesh(wild / "quant_int.glb"), {-0.26, 0.55, -0.23}, {0.26, 1.04, 0.21});
  has_box(io::read_mesh(wild / "plain_vpf.glb"), {-0.26, 0.55, -0.23}, {0.26, 1.04, 0.21});
  has_box(io::read_mesh(second / "quantized.glb"), {-0.2, 0.18, -0.2}, {0.2, 0.22, 0.2});
}
