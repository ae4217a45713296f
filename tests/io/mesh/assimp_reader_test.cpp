// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "geometry/mesh/vertex_attributes.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/io/mesh/seam.h"

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
  REQUIRE(file.mesh.number_of_vertices() == 4);
  for (const Vertex v : file.mesh.vertices()) {
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
  CHECK(file.mesh.point(Vertex(3)) == raw);
  CHECK(file.warnings.size() == 1);  // single precision

  // an armature in centimetres that lies on its back
  bound.scene["nodes"].push_back({{"name", "armature"},
                                  {"children", {1}},
                                  {"scale", {0.01, 0.01, 0.01}},
                                  {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}});
  bound.scene["scenes"][0]["nodes"][1] = 3;
  const Point lying = bound.read().mesh.point(Vertex(3));
  CHECK(lying.x() == Approx(0).margin(1e-6));
  CHECK(lying.y() == Approx(0.001).margin(1e-6));
  CHECK(lying.z() == Approx(-0.01).margin(1e-6));
}

TEST_CASE("glTF: a skeleton in another pose than it was bound in is told") {
  SkinnedSeam posed({{{0, -1, 0}, {0, -1.5F, 0}}});
  posed.scene["nodes"][1]["translation"] = {0, 1, 0};
  posed.scene["nodes"][2]["translation"] = {0.3, 0.5, 0};
  const io::MeshFile file = posed.read();
  CHECK(file.mesh.point(Vertex(3)) == Point(0, 1, static_cast<double>(0.1F)));
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
        CHECK(file.mesh.is_valid(false));
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
