// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are packed here by the libraries' other halves.
#include <draco/compression/encode.h>
#include <meshoptimizer.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "geometry/mesh/vertex_attributes.h"
#include "io/base/byte_order.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/io/mesh/glb_parts.h"
#include "tests/io/mesh/seam.h"
#include "tests/test_paths.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

constexpr std::size_t vertices = 6;  // of a seam

void require(Seam& seam, const char* extension) {
  seam.scene["extensionsUsed"] = seam.scene["extensionsRequired"] = {extension};
}

std::string bytes_of(const Seam& seam, std::size_t view) {
  const json& v = seam.scene["bufferViews"][view];
  return seam.buffer.substr(v["byteOffset"].get<std::size_t>(), v["byteLength"].get<std::size_t>());
}

/// Its one primitive's attributes and faces, exactly, in Draco's data; weights as normalised bytes.
SkinnedSeam packed_by_draco() {
  SkinnedSeam seam;
  draco::Mesh mesh;
  mesh.set_num_points(vertices);
  json ids;
  const auto add = [&](const char* name, draco::GeometryAttribute::Type kind, int width, draco::DataType type,
                       std::size_t size, const std::string& data) {
    draco::GeometryAttribute attribute;
    attribute.Init(kind, nullptr, std::int8_t(width), type, false, std::int64_t(size), 0);
    const int id = mesh.AddAttribute(attribute, true, vertices);
    for (std::uint32_t v = 0; v < vertices; ++v)
      mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(v), &data[v * size]);
    ids[name] = mesh.attribute(id)->unique_id();
  };
  std::string weights;
  for (std::size_t v = 0; v < vertices; ++v)
    for (const int w : {v < 3 ? 64 : 255, v < 3 ? 191 : 0, 0, 0}) weights += char(w);
  add("POSITION", draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32, 12, bytes_of(seam, 0));
  add("TEXCOORD_0", draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32, 8, bytes_of(seam, 1));
  add("JOINTS_0", draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8, 4, bytes_of(seam, 3));
  add("WEIGHTS_0", draco::GeometryAttribute::GENERIC, 4, draco::DT_UINT8, 4, weights);
  for (std::uint32_t f = 0; f < 2; ++f)
    mesh.AddFace({draco::PointIndex(3 * f), draco::PointIndex(3 * f + 1), draco::PointIndex(3 * f + 2)});
  draco::Encoder encoder;
  encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
  draco::EncoderBuffer out;
  REQUIRE(encoder.EncodeMeshToBuffer(mesh, &out).ok());
  json& primitive = seam.scene["meshes"][0]["primitives"][0];
  const std::size_t view = add_view(seam, {out.data(), out.size()});
  primitive["extensions"] = {{"KHR_draco_mesh_compression", {{"bufferView", view}, {"attributes", ids}}}};
  for (std::size_t a = 0; a < 5; ++a) seam.scene["accessors"][a].erase("bufferView");
  seam.scene["accessors"][4].update({{"componentType", 5121}, {"normalized", true}});
  require(seam, "KHR_draco_mesh_compression");
  return seam;
}

/// A view's elements, which it names from now on, packed by meshoptimizer.
void pack_view(Seam& seam, std::size_t number, std::size_t stride, const std::string& mode,
               const std::string& filter = "NONE") {
  std::string elements = bytes_of(seam, number);
  const std::size_t count = elements.size() / stride;
  if (filter == "EXPONENTIAL")  // a mantissa of 24 bits and an exponent of 8, here always -20
    for (std::size_t i = 0; i < elements.size(); i += 4) {
      const auto value = io::read_in_order<float>(&elements[i], std::endian::little);
      const auto mantissa = static_cast<std::uint32_t>(std::lround(std::ldexp(double(value), 20)));
      std::string word;
      put_bytes(word, (mantissa & 0xffffffU) | 0xec000000U);
      elements.replace(i, 4, word);
    }
  std::vector<unsigned char> packed(4096);
  if (mode == "ATTRIBUTES") {
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), elements.data(), count, stride));
  } else {
    std::vector<unsigned> indices;
    for (std::size_t i = 0; i < count; ++i)
      indices.push_back(io::read_in_order<std::uint16_t>(&elements[i * stride], std::endian::little));
    packed.resize(mode == "INDICES"
                      ? meshopt_encodeIndexSequence(packed.data(), packed.size(), indices.data(), count)
                      : meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), count));
  }
  REQUIRE(!packed.empty());
  json from = seam.scene["bufferViews"][add_view(seam, std::string(packed.begin(), packed.end()))];
  from.update({{"byteStride", stride}, {"count", count}, {"mode", mode}, {"filter", filter}});
  json& view = seam.scene["bufferViews"][number];
  view = {{"buffer", 1}, {"byteOffset", 0}, {"byteLength", count * stride}};
  view["extensions"] = {{"EXT_meshopt_compression", from}};
}

SkinnedSeam packed_by_meshopt(const std::string& of_indices) {
  SkinnedSeam seam({{{0, -1, 0}, {0, -1.5F, 0}}});
  pack_view(seam, 0, 12, "ATTRIBUTES", "EXPONENTIAL");
  pack_view(seam, 1, 8, "ATTRIBUTES");
  pack_view(seam, 2, 2, of_indices);
  pack_view(seam, 3, 4, "ATTRIBUTES");
  pack_view(seam, 4, 16, "ATTRIBUTES");
  pack_view(seam, 5, 64, "ATTRIBUTES");
  seam.scene["buffers"].push_back(
      {{"byteLength", 128}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  require(seam, "EXT_meshopt_compression");
  return seam;
}

/// Both have the same faces, texture coordinates and weights; places and weights within these.
void check_alike(const io::MeshFile& a, const io::MeshFile& b, double place, double weight) {
  REQUIRE(a.mesh->number_of_vertices() == b.mesh->number_of_vertices());
  REQUIRE(a.mesh->number_of_faces() == b.mesh->number_of_faces());
  for (const Vertex v : a.mesh->vertices())
    CHECK(std::sqrt(CGAL::squared_distance(a.mesh->point(v), b.mesh->point(v))) <= place);
  const auto ta = *find_map(a.mesh, attribute::texture), tb = *find_map(b.mesh, attribute::texture);
  for (const Halfedge h : a.mesh->halfedges()) {
    CHECK(a.mesh->target(h) == b.mesh->target(h));
    if (!a.mesh->is_border(h)) CHECK(ta[h] == tb[h]);
  }
  const auto wa = vertex_attributes(a.mesh), wb = vertex_attributes(b.mesh);
  REQUIRE(wa.size() == wb.size());
  for (std::size_t i = 0; i < wa.size(); ++i)
    for (const Vertex v : a.mesh->vertices()) CHECK(std::abs(wa[i].values[v] - wb[i].values[v]) <= weight);
}

std::string error_of(const Seam& seam) {
  TemporaryFolder folder;
  spit(folder / "a.glb", seam.glb());
  return content_error([&] { io::read_mesh(folder / "a.glb"); });
}

/// Some of its bytes changed, those of the packed data among them: it is read or refused, and we live on.
void check_damaged(const Seam& seam, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  TemporaryFolder folder;
  for (int i = 0; i < 60; ++i) {
    Seam changed = seam;
    for (int k = 0; k < 3; ++k)
      changed.buffer[132 + random() % (seam.buffer.size() - 132)] = static_cast<char>(random());
    spit(folder / "a.glb", changed.glb());
    try {
      const io::MeshFile file = io::read_mesh(folder / "a.glb");
      CHECK(file.mesh->is_valid(false));
    } catch (const ContentError&) {
    }
  }
}

}  // namespace

TEST_CASE("glTF: what Draco packed is read as it was, skin and all") {
  const io::MeshFile file = packed_by_draco().read();
  check_alike(file, SkinnedSeam().read(), 0, 0.5 / 255);
  TemporaryFolder folder;
  io::write_mesh(folder / "b.glb", file);
  const Glb written(slurp(folder / "b.glb"));
  check_glb(written);
  CHECK(!written.scene.contains("extensionsRequired"));
  CHECK(written.scene["materials"][0]["name"] == "silk");
}

TEST_CASE("glTF: what meshoptimizer packed is read as it was, with its filters and its bind matrices") {
  const io::MeshFile plain = SkinnedSeam({{{0, -1, 0}, {0, -1.5F, 0}}}).read(),
                     file = packed_by_meshopt("INDICES").read(),
                     triangles = packed_by_meshopt("TRIANGLES").read();
  check_alike(file, plain, 1e-6, 0);
  CHECK(triangles.mesh->number_of_faces() == plain.mesh->number_of_faces());
  TemporaryFolder folder;
  io::write_mesh(folder / "b.glb", file);
  const Glb written(slurp(folder / "b.glb"));
  check_glb(written);
  const std::vector<float> matrices =
      written.numbers<float>(written.scene["skins"][0]["inverseBindMatrices"]);
  CHECK(matrices[13] == -1.F);
  CHECK(matrices[16 + 13] == -1.5F);
}

TEST_CASE("glTF: packed data that are damaged are refused, this process lives on") {
  check_damaged(packed_by_draco(), 1);
  check_damaged(packed_by_meshopt("INDICES"), 2);
  check_damaged(packed_by_meshopt("TRIANGLES"), 3);
  for (const auto& [key, value] :
       std::initializer_list<std::pair<const char*, json>>{{"byteStride", 0},
                                                           {"byteStride", 3},
                                                           {"byteStride", 400},
                                                           {"count", 0},

                                                           {"count", std::uint64_t{1} << 62},
                                                           {"mode", "SOMETHING"},
                                                           {"mode", "INDICES"},
                                                           {"filter", "QUATERNION"},
                                                           {"byteLength", 1 << 20},
                                                           {"buffer", 9},
                                                           {"filter", "NOTHING"}}) {
    SkinnedSeam seam = packed_by_meshopt("INDICES");
    seam.scene["bufferViews"][0]["extensions"]["EXT_meshopt_compression"][key] = value;
    INFO(key << " " << value);
    CHECK(error_of(seam).find("a.glb: ") != std::string::npos);
  }
  SkinnedSeam nameless = packed_by_draco();
  nameless.scene["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"]["attributes"]
                ["POSITION"] = 77;
  CHECK(error_of(nameless).find("no attribute for POSITION") != std::string::npos);
}

TEST_CASE("glTF: packed files of other programs are read as their plain twin") {
  if (!have_shared()) {
    WARN("skipped: no shared data");
    return;
  }
  const std::filesystem::path wild = shared_dir() / "wild";
  const io::MeshFile plain = io::read_mesh(wild / "plain_vpf.glb");
  for (const char* name : {"plain_draco.glb", "plain_meshopt.glb"}) {
    const io::MeshFile file = io::read_mesh(wild / name);
    CHECK(file.mesh->number_of_vertices() == plain.mesh->number_of_vertices());
    CHECK(file.mesh->number_of_faces() == plain.mesh->number_of_faces());
    CHECK(file.material_names.size() == 2);
    CHECK(file.mesh->number_of_vertices() + file.mesh->number_of_faces() - file.mesh->number_of_edges() == 0);
    CGAL::Bbox_3 box, of_plain;
    for (const Point& p : file.mesh->points()) box += p.bbox();
    for (const Point& p : plain.mesh->points()) of_plain += p.bbox();
    for (int k = 0; k < 3; ++k) {
      CHECK(std::abs(box.min(k) - of_plain.min(k)) < 2e-4);
      CHECK(std::abs(box.max(k) - of_plain.max(k)) < 2e-4);
    }
  }
}
