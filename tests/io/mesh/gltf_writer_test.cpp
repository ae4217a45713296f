// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "geometry/mesh/vertex_attributes.h"
#include "geometry/refine/subdivide.h"
#include "tests/io/base/io_test_helpers.h"
#include "tests/io/mesh/glb_parts.h"
#include "tests/io/mesh/seam.h"

using namespace furrow;
using namespace furrow::geometry;
using namespace furrow::tests;

namespace {

struct WrittenGlb {
  std::string bytes;
  std::vector<std::string> lost;
  Glb glb;
};

WrittenGlb glb_of(const io::MeshFile& file, const io::WriteOptions& options = {}) {
  std::ostringstream out;
  std::vector<std::string> lost = io::write_mesh(out, io::MeshFormat::gltf, file, options);
  Glb glb(out.str());
  check_glb(glb);
  return {out.str(), std::move(lost), std::move(glb)};
}

io::MeshFile read_glb(const std::string& bytes, const io::ReadOptions& options = {}) {
  TemporaryFolder folder;
  spit(folder / "a.glb", bytes);
  return io::read_mesh(folder / "a.glb", options);
}

bool tells(const std::vector<std::string>& lost, const std::string& words) {
  return std::ranges::any_of(lost, [&](const std::string& l) { return l.find(words) != l.npos; });
}

Eigen::Matrix4d local_transform(const json& node) {
  Eigen::Affine3d t = Eigen::Affine3d::Identity();
  if (node.contains("translation"))
    t.translate(Eigen::Vector3d(node["translation"][0], node["translation"][1], node["translation"][2]));
  if (node.contains("rotation")) {
    const json& r = node["rotation"];
    t.rotate(
        Eigen::Quaterniond(r[3].get<double>(), r[0].get<double>(), r[1].get<double>(), r[2].get<double>()));
  }
  if (node.contains("scale")) t.scale(Eigen::Vector3d(node["scale"][0], node["scale"][1], node["scale"][2]));
  return t.matrix();
}

Eigen::Matrix4d global_transform(const json& nodes, std::size_t node) {
  for (std::size_t p = 0; p < nodes.size(); ++p)
    for (const json& child : nodes[p].value("children", json::array()))
      if (child == node) return global_transform(nodes, p) * local_transform(nodes[node]);
  return local_transform(nodes[node]);
}

/// Where a viewer shows the vertices of a skinned mesh (glTF 2.0, 3.7.3.3), node `turned` rotated by 1 rad.
std::vector<Eigen::Vector3d> posed(const Glb& glb, std::size_t turned) {
  json nodes = glb.scene["nodes"];
  nodes[turned]["rotation"] = {0, 0, std::sin(0.5), std::cos(0.5)};
  const json& skin = glb.scene["skins"][0];
  const auto inverse = glb.numbers<float>(skin["inverseBindMatrices"]);
  const json& attributes = glb.primitive()["attributes"];
  const auto x = glb.numbers<float>(attributes["POSITION"]), w = glb.numbers<float>(attributes["WEIGHTS_0"]);
  const auto j = glb.numbers<std::uint16_t>(attributes["JOINTS_0"]);
  std::vector<Eigen::Vector3d> shown(x.size() / 3, Eigen::Vector3d::Zero());
  for (std::size_t v = 0; v < shown.size(); ++v)
    for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
      const Eigen::Map<const Eigen::Matrix4f> bind(&inverse[std::size_t{16} * j[k]]);
      const Eigen::Vector4d p(x[3 * v], x[3 * v + 1], x[3 * v + 2], 1);
      const std::size_t joint = skin["joints"][j[k]];
      shown[v] += w[k] * (global_transform(nodes, joint) * bind.cast<double>() * p).head<3>();
    }
  return shown;
}

/// A skin whose armature is in centimetres and lies on its back.
SkinnedSeam lying_skin() {
  SkinnedSeam skin({{{0, -1, 0}, {0, -1.5F, 0}}});
  skin.scene["nodes"][1]["translation"] = {0, 1, 0};
  skin.scene["nodes"][2]["translation"] = {0, 0.5, 0};
  skin.scene["nodes"].push_back({{"name", "armature"},
                                 {"children", {1}},
                                 {"scale", {0.01, 0.01, 0.01}},
                                 {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}});
  skin.scene["scenes"][0]["nodes"][1] = 3;
  return skin;
}

/// Adds an animation of node 0's translation, and one of the weights of shape keys.
void animate(Seam& seam) {
  const std::size_t view = seam.scene["bufferViews"].size(), at = seam.buffer.size();
  for (const float t : {0.F, 1.F, 1.F, 2.F, 3.F, 4.F, 5.F, 6.F}) put_bytes(seam.buffer, t);
  seam.scene["buffers"][0]["byteLength"] = seam.buffer.size();
  seam.scene["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 32}});
  const std::size_t a = seam.scene["accessors"].size();
  json times = {{"bufferView", view}, {"componentType", 5126}, {"count", 2}, {"type", "SCALAR"}};
  times["min"] = {0}, times["max"] = {1};
  seam.scene["accessors"].push_back(times);
  seam.scene["accessors"].push_back(
      {{"bufferView", view}, {"byteOffset", 8}, {"componentType", 5126}, {"count", 2}, {"type", "VEC3"}});
  json animation = {{"name", "sway"}};
  animation["samplers"] = json::array({{{"input", a}, {"output", a}}, {{"input", a}, {"output", a + 1}}});
  animation["channels"] = json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}},
                                       {{"sampler", 1}, {"target", {{"node", 0}, {"path", "translation"}}}}});
  seam.scene["animations"] = json::array({animation});
}

const json vrm = json::parse(R"({"specVersion": "1.0", "humanoid": {"humanBones": {"hips": {"node": 1}}},
  "expressions": {"preset": {"happy": {"isBinary": false,
    "morphTargetBinds": [{"node": 0, "index": 0, "weight": 1.0}]}}}})");

const std::string png_bytes = "\x89PNG\r\n\x1a\nnot much of a picture";

}  // namespace

TEST_CASE("glTF out: VRM stays, as nodes, meshes and shape keys keep their numbers") {
  SkinnedSeam seam = with_key(lying_skin());
  const json vrm0 = json::parse(R"({"firstPerson": {"meshAnnotations": [{"mesh": 0}]}, "blendShapeMaster":
    {"blendShapeGroups": [{"binds": [{"mesh": 0, "index": 0, "weight": 100}]}]}})");
  seam.scene["extensions"] = {{"VRMC_vrm", vrm}, {"VRM", vrm0}};
  seam.scene["extensionsUsed"] = {"VRM", "VRMC_vrm"};
  const WrittenGlb out = glb_of(read_glb(seam.glb()));
  CHECK(out.lost.empty());
  CHECK(out.glb.scene["extensions"] == seam.scene["extensions"]);
  CHECK(out.glb.scene["extensionsUsed"] == seam.scene["extensionsUsed"]);
  CHECK(out.glb.scene["meshes"][0]["primitives"][0]["targets"].size() == 1);
}

namespace {

/// How far the only key of a file of ours moves each vertex.
std::vector<float> moves_of(const Glb& glb, std::size_t mesh = 0) {
  const json& accessor =
      glb.scene["accessors"].at(glb.primitive(mesh)["targets"][0]["POSITION"].get<std::size_t>());
  std::vector<float> moves(3 * accessor["count"].get<std::size_t>(), 0);
  REQUIRE_FALSE(accessor.contains("bufferView"));  // few move
  const json& sparse = accessor["sparse"];
  const std::string at = glb.bytes_of_view(sparse["indices"]["bufferView"]),
                    values = glb.bytes_of_view(sparse["values"]["bufferView"]);
  for (std::size_t i = 0; i < sparse["count"]; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      moves.at(3 * Glb::integer(at, 4 * i) + k) =
          io::read_in_order<float>(&values[4 * (3 * i + k)], std::endian::little);
  return moves;
}

}  // namespace

TEST_CASE("glTF out: shape keys go back, and added vertices move with their neighbours") {
  const SkinnedSeam seam = with_key(lying_skin());
  io::MeshFile file = read_glb(seam.glb());
  const WrittenGlb out = glb_of(file);
  CHECK(out.lost.empty());
  CHECK(out.glb.scene["meshes"][0]["extras"] == seam.scene["meshes"][0]["extras"]);
  const auto x = out.glb.numbers<float>(out.glb.primitive()["attributes"]["POSITION"]);
  const std::vector<float> moves = moves_of(out.glb);
  for (std::size_t v = 0; v < x.size() / 3; ++v) {
    const bool moved = std::abs(x[3 * v]) < 1e-6F && std::abs(x[3 * v + 1] - 1) < 1e-6F;
    CHECK(moves[3 * v + 1] == Approx(moved ? 0.5 : 0).margin(1e-6));
    CHECK(std::abs(moves[3 * v]) + std::abs(moves[3 * v + 2]) < 1e-6F);
  }
  midpoint_subdivide(file.mesh, 1);
  const std::vector<float> finer = moves_of(glb_of(file).glb);
  std::map<long, int> found;  // in hundredths
  for (std::size_t v = 0; v < finer.size() / 3; ++v) ++found[std::lround(100 * finer[3 * v + 1])];
  CHECK(found[50] == 1);
  CHECK(found[25] == 2);  // the middles of its edges
  CHECK(found.size() == 3);
  for (VertexAttribute& a : vertex_attributes(file.mesh))
    if (a.name.starts_with("key_"))
      for (const Vertex v : file.mesh->vertices()) a.values[v] = 0;
  const WrittenGlb still = glb_of(file);  // a key that moves nothing is a key
  CHECK(still.glb.primitive()["targets"].size() == 1);
}

TEST_CASE("glTF out: a second UV map goes back, and has seams of its own") {
  Seam seam;
  std::string seconds;  // the edge that both triangles share has other places in them
  for (int v = 0; v < 6; ++v)
    for (const float c : {static_cast<float>(v) / 4, v < 3 ? 0.25F : 0.5F}) put_bytes(seconds, c);
  seam.scene["accessors"].push_back(
      {{"bufferView", add_view(seam, seconds)}, {"componentType", 5126}, {"count", 6}, {"type", "VEC2"}});
  json& attributes = seam.scene["meshes"][0]["primitives"][0]["attributes"];
  attributes["TEXCOORD_1"] = 3;
  const auto maps_of = [](const WrittenGlb& out) {
    const json& written = out.glb.primitive()["attributes"];
    const auto first = out.glb.numbers<float>(written["TEXCOORD_0"]),
               second = out.glb.numbers<float>(written["TEXCOORD_1"]);
    std::set<std::array<float, 4>> maps;
    for (std::size_t v = 0; v < first.size(); v += 2)
      maps.insert({first[v], first[v + 1], second[v], second[v + 1]});
    return maps;
  };
  std::set<std::array<float, 4>> wanted;
  for (int v = 0; v < 6; ++v)
    wanted.insert({static_cast<float>(v) / 8, 0.25F, static_cast<float>(v) / 4, v < 3 ? 0.25F : 0.5F});
  io::MeshFile file = read_glb(seam.glb());
  const WrittenGlb out = glb_of(file);
  CHECK(out.lost.empty());
  CHECK(maps_of(out) == wanted);
  attributes.erase("TEXCOORD_0");  // alone
  CHECK(read_glb(seam.glb()).mesh->number_of_faces() == 2);
  midpoint_subdivide(file.mesh, 1);
  for (const auto& at : maps_of(glb_of(file))) CHECK(at[2] == Approx(2 * at[0]));  // as in the file
}

TEST_CASE("glTF out: what is written shows what was worked on, also where keys are shown") {
  SkinnedSeam seam = with_key(lying_skin());
  const auto at = [](const WrittenGlb& out, std::size_t k) {
    return out.glb.numbers<float>(out.glb.primitive()["attributes"]["POSITION"])[k];
  };
  const WrittenGlb hidden = glb_of(read_glb(seam.glb()));
  seam.scene["nodes"][0]["weights"] = {0.5};
  io::MeshFile file = read_glb(seam.glb());
  const WrittenGlb shown = glb_of(file);
  CHECK(shown.glb.scene["nodes"][0]["weights"] == seam.scene["nodes"][0]["weights"]);
  for (std::size_t k = 0; k < 18; ++k) CHECK(at(shown, k) == Approx(at(hidden, k)).margin(1e-6));
  for (const Vertex v : file.mesh->vertices())
    file.mesh->point(v) += Vector(0.001, 0, 0);  // an armature in cm
  const io::MeshFile again = read_glb(glb_of(file).bytes);
  for (const Vertex v : file.mesh->vertices())
    CHECK(std::sqrt(CGAL::squared_distance(again.mesh->point(v), file.mesh->point(v))) < 1e-8);
}

TEST_CASE("glTF out: vertices of one place that a key parts stay apart") {
  Seam seam = with_key(Seam());  // vertices 2 and 4 are one place
  for (const std::uint16_t moved : {std::uint16_t{2}, std::uint16_t{5}}) {
    Seam parting = seam;
    const std::size_t at = parting.scene["bufferViews"][3]["byteOffset"];
    parting.buffer[at] = static_cast<char>(moved);
    CHECK(read_glb(parting.glb()).mesh->number_of_vertices() ==
          (moved == 5 ? 4 : 6));  // faces in one point alone part
  }
}

TEST_CASE("glTF out: figures that are not chosen, and scenes that are not shown, stay as they are") {
  SkinnedSeam seam = with_key(lying_skin());
  for (int copy = 0; copy < 2; ++copy) seam.scene["meshes"].push_back(json(seam.scene["meshes"][0]));
  for (const char* bound : {"JOINTS_0", "WEIGHTS_0"})
    seam.scene["meshes"][1]["primitives"][0]["attributes"].erase(bound);
  seam.scene["nodes"].push_back({{"mesh", 1}, {"name", "body"}});
  seam.scene["scenes"][0]["nodes"].push_back(seam.scene["nodes"].size() - 1);
  seam.scene["nodes"].push_back({{"mesh", 2}, {"name", "spare"}, {"skin", 0}});
  seam.scene["scenes"].push_back({{"nodes", {seam.scene["nodes"].size() - 1}}});
  TemporaryFolder folder;
  spit(folder / "a.glb", seam.glb());
  io::MeshFile file = io::read_mesh(folder / "a.glb#sleeve");
  CHECK(file.mesh->number_of_faces() == 2);
  for (const Vertex v : file.mesh->vertices()) file.mesh->point(v) += Vector(0, 0, 1);
  const WrittenGlb out = glb_of(file);
  CHECK(out.lost.empty());
  CHECK(out.glb.scene["nodes"] == seam.scene["nodes"]);
  CHECK(out.glb.scene["scenes"] == seam.scene["scenes"]);
  spit(folder / "b.glb", out.bytes);
  const auto points = [&](const std::string& name) {
    std::vector<Point> list;
    const io::MeshFile read = io::read_mesh(folder / name);
    for (const Vertex v : read.mesh->vertices()) list.push_back(read.mesh->point(v));
    return list;
  };
  CHECK(points("b.glb#body") == points("a.glb#body"));
  CHECK(points("b.glb#sleeve")[3].z() == Approx(points("a.glb#sleeve")[3].z() + 1));
}

TEST_CASE("glTF out: a GLB goes back as it came: places, textures, materials, nodes") {
  Seam seam;
  seam.scene["nodes"][0]["extras"] = {{"size", "M"}};
  seam.scene["meshes"][0]["name"] = "cut";
  seam.scene["materials"][0]["extensions"]["KHR_materials_sheen"]["sheenRoughnessFactor"] = 0.5;
  seam.scene["extensionsUsed"] = {"KHR_materials_sheen", "KHR_mesh_quantization"};
  seam.scene["extensionsRequired"] = {"KHR_mesh_quantization"};
  const io::MeshFile file = read_glb(seam.glb());
  const WrittenGlb out = glb_of(file);
  CHECK(out.lost.empty());
  CHECK(out.glb.scene["nodes"] == seam.scene["nodes"]);
  CHECK(out.glb.scene["materials"] == seam.scene["materials"]);
  CHECK(out.glb.scene["extensionsUsed"] == json::array({"KHR_materials_sheen"}));
  CHECK_FALSE(out.glb.scene.contains("extensionsRequired"));
  CHECK(out.glb.scene["meshes"][0]["name"] == "cut");
  const auto x = out.glb.numbers<float>(out.glb.primitive()["attributes"]["POSITION"]);
  REQUIRE(x.size() == 18);  // the edge's ends are there twice again
  CHECK(*std::ranges::max_element(x) == 1);
  const io::MeshFile back = read_glb(out.bytes);
  CHECK(same_positions(back.mesh, file.mesh));
  CHECK(back.group_names == file.group_names);
  CHECK(back.material_names == file.material_names);
  const auto textures = *find_map(file.mesh, attribute::texture),
             again = *find_map(back.mesh, attribute::texture);
  for (const Halfedge h : file.mesh->halfedges())
    if (!file.mesh->is_border(h)) CHECK(textures[h] == again[h]);
  CHECK(glb_of(back).bytes == out.bytes);
}

TEST_CASE("glTF out: a skin deforms what is written as it did what was read") {
  for (const SkinnedSeam& seam : {SkinnedSeam(), lying_skin()}) {
    const Glb before(seam.glb());
    io::MeshFile file = read_glb(seam.glb());
    const WrittenGlb out = glb_of(file);
    CHECK(out.lost.empty());
    CHECK(out.glb.scene["skins"][0]["joints"] == before.scene["skins"][0]["joints"]);
    CHECK(out.glb.numbers<float>(out.glb.scene["skins"][0]["inverseBindMatrices"]) ==
          before.numbers<float>(before.scene["skins"][0]["inverseBindMatrices"]));
    CHECK(out.glb.scene["nodes"] == before.scene["nodes"]);
    const auto rest = posed(out.glb, 0);  // the mesh's own node, which does not count
    const auto turned = posed(out.glb, 2);
    std::size_t moved = 0;
    for (std::size_t v = 0; v < rest.size(); ++v) {
      double nearest = 1;
      for (const Vertex m : file.mesh->vertices())
        nearest = std::min(nearest, (Eigen::Vector3d(file.mesh->point(m).x(), file.mesh->point(m).y(),
                                                     file.mesh->point(m).z()) -
                                     rest[v])
                                        .norm());
      CHECK(nearest < 1e-7);
      if ((turned[v] - rest[v]).norm() > 1e-4) ++moved;
    }
    CHECK(moved > 0);
    io::MeshFile back = read_glb(out.bytes);
    REQUIRE(back.mesh->number_of_vertices() == file.mesh->number_of_vertices());
    for (const VertexAttribute& joint : vertex_attributes(file.mesh))
      for (const Vertex v : file.mesh->vertices())
        CHECK(ensure_vertex_attribute(back.mesh, joint.name)[v] == Approx(joint.values[v]).margin(1e-7));
  }
}

TEST_CASE("glTF out: added vertices move with their neighbours") {
  io::MeshFile file = read_glb(lying_skin().glb());
  const auto before = posed(glb_of(file).glb, 2);
  midpoint_subdivide(file.mesh, 1);
  const WrittenGlb out = glb_of(file);
  const auto after = posed(out.glb, 2);
  CHECK(after.size() > before.size());
  for (const Eigen::Vector3d& p : before) {  // the old ones are among the new
    double nearest = 1;
    for (const Eigen::Vector3d& q : after) nearest = std::min(nearest, (p - q).norm());
    CHECK(nearest < 1e-7);
  }
  double farthest = 0;  // of a new one from the middle of two old ones, whose weights it blends
  for (const Eigen::Vector3d& q : after) {
    double nearest = 1;
    for (const Eigen::Vector3d& a : before)
      for (const Eigen::Vector3d& b : before) nearest = std::min(nearest, ((a + b) / 2 - q).norm());
    farthest = std::max(farthest, nearest);
  }
  CHECK(farthest < 2e-3);  // of 10 mm
}

TEST_CASE("glTF out: a skeleton in another pose than it was bound in stays in it") {
  SkinnedSeam seam({{{0, -1, 0}, {0, -1.5F, 0}}});
  seam.scene["nodes"][1]["translation"] = {0, 1, 0};
  seam.scene["nodes"][2]["translation"] = {0.3, 0.5, 0};
  const WrittenGlb out = glb_of(read_glb(seam.glb()));
  CHECK(out.glb.scene["nodes"] == seam.scene["nodes"]);
  const auto x = out.glb.numbers<float>(out.glb.primitive()["attributes"]["POSITION"]);
  CHECK(*std::ranges::max_element(x) == 1);
}

TEST_CASE("glTF out: what one vertex has too many or too few weights for is told") {
  io::MeshFile file = read_glb(SkinnedSeam().glb());
  const Vertex none(0);
  for (VertexAttribute& joint : vertex_attributes(file.mesh)) joint.values[none] = 0;
  const WrittenGlb out = glb_of(file);
  CHECK(tells(out.lost, "1 vertices without skin weights"));
  SkinnedSeam crowd;  // five joints at every vertex
  for (int n = 0; n < 3; ++n) {
    crowd.scene["skins"][0]["joints"].push_back(crowd.scene["nodes"].size());
    crowd.scene["scenes"][0]["nodes"].push_back(crowd.scene["nodes"].size());
    crowd.scene["nodes"].push_back({{"name", "extra" + std::to_string(n)}});
  }
  crowd.scene["skins"][0].erase("inverseBindMatrices");
  crowd.scene["accessors"].erase(5), crowd.scene["bufferViews"].erase(5);
  for (int n = 0; n < 3; ++n)
    for (int i = 0; i < 16; ++i) put_bytes(crowd.buffer, i % 5 == 0 ? 1.F : 0.F);
  const std::size_t at = crowd.buffer.size() - 5 * 64;
  crowd.scene["buffers"][0]["byteLength"] = crowd.buffer.size();
  crowd.scene["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 320}});
  crowd.scene["accessors"].push_back(
      {{"bufferView", 5}, {"componentType", 5126}, {"count", 5}, {"type", "MAT4"}});
  crowd.scene["skins"][0]["inverseBindMatrices"] = 5;
  io::MeshFile many = read_glb(crowd.glb());
  for (int n = 0; n < 3; ++n) ensure_vertex_attribute(many.mesh, "weight_extra" + std::to_string(n));
  REQUIRE(vertex_attributes(many.mesh).size() == 5);
  for (VertexAttribute& joint : vertex_attributes(many.mesh))
    for (const Vertex v : many.mesh->vertices()) joint.values[v] = joint.name == "weight_hand" ? 0.1 : 0.3;
  const WrittenGlb four = glb_of(many);
  CHECK(tells(four.lost, "all but the four largest skin weights of 4 vertices"));
  CHECK(tells(four.lost, "`max_weights=4`"));
  for (const std::uint16_t j :
       four.glb.numbers<std::uint16_t>(four.glb.primitive()["attributes"]["JOINTS_0"]))
    CHECK(j != 1);  // the hand's, the least
  for (const float w : four.glb.numbers<float>(four.glb.primitive()["attributes"]["WEIGHTS_0"]))
    CHECK(w == Approx(0.25).margin(1e-7));
  vertex_attributes(many.mesh)[0].values[Vertex(1)] = -1;
  CHECK_THROWS_AS(glb_of(many), std::invalid_argument);
}

TEST_CASE("glTF out: pictures lie in the file, wherever they came from") {
  TemporaryFolder folder;
  Seam seam;
  spit(folder / "my weave.png", png_bytes);
  seam.scene["buffers"][0]["uri"] = "a.bin";
  const std::size_t at = seam.buffer.size();
  seam.buffer += png_bytes;
  seam.scene["buffers"][0]["byteLength"] = seam.buffer.size();
  seam.scene["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", png_bytes.size()}});
  seam.scene["images"] = json::array({{{"uri", "my%20weave.png"}},
                                      {{"bufferView", 3}, {"mimeType", "image/png"}},
                                      {{"uri", "data:image/png;base64,iVBORw0KGgo="}},
                                      {{"uri", "../away.png"}}});
  seam.scene["textures"] = json::array({{{"source", 0}}, {{"source", 1}}, {{"source", 2}}, {{"source", 3}}});
  json& material = seam.scene["materials"][0];
  material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  material["normalTexture"] = {{"index", 1}};
  material["emissiveTexture"] = {{"index", 2}};
  material["occlusionTexture"] = {{"index", 3}, {"texCoord", 2}};
  spit(folder / "a.bin", seam.buffer);
  spit(folder / "a.gltf", seam.scene.dump());
  const WrittenGlb out = glb_of(io::read_mesh(folder / "a.gltf"));
  const json& images = out.glb.scene["images"];
  REQUIRE(images.size() == 4);
  for (const int i : {0, 1}) {
    CHECK(images[i]["mimeType"] == "image/png");
    CHECK(out.glb.bytes_of_view(images[i]["bufferView"]) == png_bytes);
  }
  CHECK(images[2] == seam.scene["images"][2]);
  CHECK(images[3] == seam.scene["images"][3]);
  CHECK(tells(out.lost, "'../away.png'"));
  CHECK(tells(out.lost, "the occlusionTexture of material 'silk'"));
  CHECK(out.lost.size() == 2);
  json kept = material;
  kept.erase("occlusionTexture");
  CHECK(out.glb.scene["materials"][0] == kept);
}

TEST_CASE("glTF out: motion stays, also that of shape keys") {
  Seam seam = with_key(Seam());
  animate(seam);
  seam.scene["meshes"][0]["weights"] = {0};
  const WrittenGlb out = glb_of(read_glb(seam.glb()));
  const json& animation = out.glb.scene["animations"][0];
  CHECK(animation["name"] == "sway");
  CHECK(animation["channels"] == seam.scene["animations"][0]["channels"]);
  REQUIRE(animation["samplers"].size() == 2);
  CHECK(out.glb.numbers<float>(animation["samplers"][0]["output"]) == std::vector<float>{0, 1});
  CHECK(out.glb.numbers<float>(animation["samplers"][1]["output"]) == std::vector<float>{1, 2, 3, 4, 5, 6});
  CHECK(out.glb.scene["meshes"][0]["weights"] == json{0});
  CHECK(out.lost.empty());
}

TEST_CASE("glTF out: a mirrored node's faces are turned back") {
  Seam seam;
  seam.scene["nodes"][0]["scale"] = {-2, 2, 2};
  const io::MeshFile file = read_glb(seam.glb());
  const WrittenGlb out = glb_of(file);
  const auto x = out.glb.numbers<float>(out.glb.primitive()["attributes"]["POSITION"]);
  const auto n = out.glb.numbers<float>(out.glb.primitive()["attributes"]["NORMAL"]);
  const auto i = out.glb.numbers<std::uint32_t>(out.glb.primitive()["indices"]);
  const auto at = [&](std::size_t k) { return Eigen::Map<const Eigen::Vector3f>(&x[3 * i[k]]); };
  CHECK((at(1) - at(0)).cross(at(2) - at(0)).z() > 0);  // as in the file that was read
  CHECK(n[2] > 0);  // outwards, as the renderer takes a mirrored node's faces
  CHECK(same_positions(read_glb(out.bytes).mesh, file.mesh));
  CHECK(corners_of(read_glb(out.bytes).mesh) == corners_of(file.mesh));
}

TEST_CASE("glTF out: materials of the same name stay apart, and so do nodes") {
  Seam seam;
  seam.scene["materials"] = json::array({{{"name", "silk"}, {"doubleSided", true}}, {{"name", "silk"}}});
  json second = seam.scene["meshes"][0]["primitives"][0];
  second["material"] = 1;
  seam.scene["meshes"].push_back({{"primitives", json::array({second})}});
  seam.scene["nodes"].push_back({{"name", "sleeve"}, {"mesh", 1}});
  seam.scene["scenes"][0]["nodes"].push_back(1);
  const io::MeshFile file = read_glb(seam.glb());
  CHECK(file.material_names == std::vector<std::string>{"silk", "silk (2)"});
  const WrittenGlb out = glb_of(file);
  CHECK(file.group_names == std::vector<std::string>{"sleeve", "sleeve (2)"});
  CHECK(out.lost.empty());
  CHECK(out.glb.scene["materials"] == seam.scene["materials"]);
  CHECK(out.glb.primitive(0)["material"] == 0);
  CHECK(out.glb.primitive(1)["material"] == 1);
  CHECK(out.glb.scene["nodes"] == seam.scene["nodes"]);
}

TEST_CASE("glTF out: nodes, joints and materials without names go back to their places") {
  SkinnedSeam seam;
  for (json& node : seam.scene["nodes"]) node.erase("name");
  seam.scene["materials"][0].erase("name");
  const WrittenGlb out = glb_of(read_glb(seam.glb()));
  CHECK(out.lost.empty());
  CHECK(out.glb.scene["nodes"] == seam.scene["nodes"]);
  CHECK(out.glb.primitive()["material"] == 0);
  CHECK(out.glb.primitive()["attributes"].contains("WEIGHTS_0"));
}

TEST_CASE("glTF out: hard edges are told, and joints whose names differ in blanks alone stay apart") {
  for (const float turned : {0.F, 1.F}) {
    Seam seam;
    const std::size_t at = seam.buffer.size();
    for (int v = 0; v < 6; ++v)
      for (const float c : {v < 3 ? 0.F : turned, 0.F, v < 3 ? 1.F : 1 - turned}) put_bytes(seam.buffer, c);
    seam.scene["buffers"][0]["byteLength"] = seam.buffer.size();
    seam.scene["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 72}});
    seam.scene["accessors"].push_back(
        {{"bufferView", 3}, {"componentType", 5126}, {"count", 6}, {"type", "VEC3"}});
    seam.scene["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = 3;
    const WrittenGlb out = glb_of(read_glb(seam.glb()));
    CHECK(tells(out.lost, "the hard edges at 2 vertices") == (turned > 0));
    CHECK(out.lost.size() == (turned > 0 ? 1 : 0));
  }
  SkinnedSeam twins;
  twins.scene["nodes"][1]["name"] = "upper arm", twins.scene["nodes"][2]["name"] = "upper_arm";
  const WrittenGlb out = glb_of(read_glb(twins.glb()));
  CHECK(out.lost.empty());
  const auto joints = out.glb.numbers<std::uint16_t>(out.glb.primitive()["attributes"]["JOINTS_0"]);
  CHECK(std::ranges::count(joints, 1) > 0);
}

TEST_CASE("glTF out: the frame that a GLB was read in is the one it is written in") {
  const io::MeshFile file = read_glb(lying_skin().glb(), {.metres_per_unit = 0.01, .up = io::Axis::z});
  const WrittenGlb out = glb_of(file, {.metres_per_unit = 0.01, .up = io::Axis::z});
  const WrittenGlb plain = glb_of(read_glb(lying_skin().glb()));
  const json& position = plain.glb.primitive()["attributes"]["POSITION"];
  const auto x = out.glb.numbers<float>(position), y = plain.glb.numbers<float>(position);
  REQUIRE(x.size() == y.size());
  for (std::size_t i = 0; i < x.size(); ++i) CHECK(x[i] == Approx(y[i]).margin(1e-6));
}

TEST_CASE("glTF out: a mesh from elsewhere is one node in metres, with a primitive for each material") {
  const io::MeshFile file = decorated_grid(4);
  const WrittenGlb out = glb_of(file, {.metres_per_unit = 0.01, .up = io::Axis::z});
  REQUIRE(out.glb.scene["meshes"].size() == 1);
  REQUIRE(out.glb.scene["meshes"][0]["primitives"].size() == 2);
  CHECK(out.glb.scene["materials"][0]["name"] == "cotton");
  CHECK(out.glb.scene["materials"][1]["name"] == "silk");
  const auto x = out.glb.numbers<float>(out.glb.primitive(0, 0)["attributes"]["POSITION"]);
  CHECK(*std::ranges::max_element(x) == static_cast<float>(4 / 3.0));
  CHECK(out.glb.primitive()["attributes"].contains("COLOR_0"));
  io::MeshFile white = file;
  for (const Vertex v : white.mesh->vertices()) ensure_map(white.mesh, attribute::color)[v] = {1, 1, 1, 1};
  CHECK_FALSE(glb_of(white).glb.primitive()["attributes"].contains("COLOR_0"));
  for (const char* words : {"in metres, y up", "lines, the state of rest", "struts", "comments", "groups"}) {
    INFO(words);
    CHECK(tells(out.lost, words));
  }
  const io::MeshFile back = read_glb(out.bytes);
  CHECK(back.mesh->number_of_faces() == file.mesh->number_of_faces());
  CHECK(back.mesh->number_of_vertices() == file.mesh->number_of_vertices());
  io::MeshFile weighted = file;
  ensure_vertex_attribute(weighted.mesh, "weight_hand"), ensure_vertex_attribute(weighted.mesh, "mask");
  CHECK(tells(glb_of(weighted).lost, "the skin weights weight_hand"));
  CHECK(tells(glb_of(weighted).lost, "the vertex attributes mask"));
}

TEST_CASE("glTF out: what cannot be is refused, and nothing is written") {
  TemporaryFolder folder;
  CHECK_THROWS_AS(io::write_mesh(folder / "a.gltf", decorated_grid(2)), std::invalid_argument);
  io::MeshFile empty;
  empty.mesh->add_vertex(Point(0, 0, 0));
  CHECK_THROWS_AS(io::write_mesh(folder / "a.glb", empty), std::invalid_argument);
  CHECK_FALSE(std::filesystem::exists(folder / "a.glb"));
  io::MeshFile flat = read_glb(Seam().glb());
  flat.material_names[0] = "caf\xe9";  // not UTF-8
  flat.gltf = nullptr;
  CHECK(glb_of(flat).glb.scene["materials"][0]["name"] == "caf\xef\xbf\xbd");
}

TEST_CASE("glTF out: damaged files that are read are written, too, and what is missing is told") {
  SkinnedSeam seam = lying_skin();
  animate(seam);
  const std::string valid = seam.glb();
  TemporaryFolder folder;
  std::size_t written = 0;
  for (std::size_t at = 12; at < valid.size(); at += 37) {
    std::string changed = valid;
    changed[at] = static_cast<char>(changed[at] ^ 0x15);
    spit(folder / "a.glb", changed);
    io::MeshFile file;
    try {
      file = io::read_mesh(folder / "a.glb");
    } catch (const ContentError&) {
      continue;
    }
    std::ostringstream out;
    try {
      io::write_mesh(out, io::MeshFormat::gltf, file, {});
      Glb glb(out.str());
      check_primitive(glb, glb.primitive(), 0);
      ++written;
    } catch (const std::invalid_argument&) {
      CHECK(out.str().empty());
    }
  }
  CHECK(written > 20);
}

TEST_CASE("glTF out: where the rest of a file cannot be kept, the mesh is written and that is told") {
  SkinnedSeam seam;
  seam.scene["skins"][0]["skeleton"] = 77;  // which the mesh does not need
  const WrittenGlb out = glb_of(read_glb(seam.glb()));
  CHECK(tells(out.lost, "materials, pictures, skeleton and motion of the file that was read (it names by"));
  CHECK(tells(out.lost, "the skin weights weight_upper_arm, weight_hand"));
  CHECK(out.glb.scene["materials"][0]["name"] == "silk");
}
