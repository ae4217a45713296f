// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>
#include <set>
#include <utility>

#include "bridge/arrays/convert.h"
#include "geometry/mesh/errors.h"
#include "geometry/mesh/property_names.h"
#include "geometry/mesh/struts.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/base/byte_order.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/glb_container.h"
#include "io/mesh/gltf_document.h"
#include "io/mesh/gltf_nodes.h"
#include "io/mesh/mesh_writers.h"

namespace furrow::io {
namespace {

using namespace geometry;
using nlohmann::json;
using physics::Vec3;

constexpr std::size_t joints_a_vertex = 4;

/// The weights of a skin's joints.
struct Skinning {
  std::vector<std::optional<VertexMap<double>>> joints;  ///< by joint of the skin; nothing: no vertex has it
  std::size_t root = 0;                                  ///< the joint nearest to the tree's root
};

/// A vertex of a file: glTF has one texture coordinate each, of each map.
struct GltfCorner {
  Vertex vertex;
  std::array<std::array<float, 2>, 2> texture;
  auto operator<=>(const GltfCorner& other) const {
    return std::pair(vertex.idx(), texture) <=> std::pair(other.vertex.idx(), other.texture);
  }
  bool operator==(const GltfCorner& other) const = default;
};

/// A shape key of a node's mesh.
struct GltfKey {
  std::string name;
  std::vector<Vec3> moves;           ///< by vertex, in the scene
  double shown = 0;                  ///< how far the node shows it
  bool with_normals = false;         ///< whether it came with moves of normals
  std::vector<Float3> normals = {};  ///< then: those of the scene with it
};

/// What becomes one node's mesh.
struct GltfPart {
  int node = -1;            ///< -1: a node of its own
  Eigen::Matrix4d to_node;  ///< from the scene
  std::vector<GltfKey> keys = {};
  /// The document's material, -1: none; and whether they are backs, which are linings.
  std::map<std::pair<int, bool>, std::vector<Face>> by_material;
};

template <class T, std::size_t N>
void append_all(std::string& bytes, const std::array<T, N>& values) {
  for (const T value : values) append_in_order(bytes, value, std::endian::little);
}

/// Adds the mesh of a file to a document and its binary.
class GltfMeshWriter {
 public:
  GltfMeshWriter(const MeshFile& file, const WriteOptions& options)
      : file_(file), mesh_(file.mesh), options_(options) {
    if (mesh_.number_of_faces() == 0) throw std::invalid_argument("mesh: a GLB needs a mesh with faces");
    has_source_ = file.gltf && !file.gltf->document.empty();
    if (file.gltf) lost_ = file.gltf->lost;
    has_source_ ? take_source() : make_document();
    place_points();
  }

  std::string bytes() {
    GltfAccessors accessors(binary_.size());
    accessors.accessors = document_["accessors"], accessors.views = document_["bufferViews"];
    for (const GltfPart& part : parts()) add_part(part, accessors);
    clear_unused_nodes();
    fill_meshes();
    document_["meshes"] = std::move(meshes_);
    document_["accessors"] = std::move(accessors.accessors);
    document_["bufferViews"] = std::move(accessors.views);
    document_["buffers"] = json::array({{{"byteLength", binary_.size()}}});
    document_["asset"]["version"] = "2.0";
    document_["asset"].erase("minVersion");
    document_["asset"]["generator"] = gltf_generator;
    name_extensions();
    const std::string head = glb_head(document_, binary_.size());
    if (head.size() + binary_.size() > std::numeric_limits<std::uint32_t>::max())
      throw std::invalid_argument("mesh: a GLB ends at 4 GiB, and it would be larger; write a ply");
    return head + binary_;
  }

  std::vector<std::string> lost() {
    tell_weights();
    tell_maps();
    if (!has_source_ && (options_.metres_per_unit != 1 || options_.up != Axis::y))
      lost_.emplace_back(
          "the unit and axis of `unit` and `up`: it is in metres, y up, as every glTF is; "
          "read it without them");
    return lost_;
  }

 private:
  void take_source() {
    document_ = json::parse(file_.gltf->document);
    binary_ = file_.gltf->binary;
    meshes_ = document_.value("meshes", json::array());
    joints_ = joint_attributes(document_);
    const json& nodes = document_["nodes"];
    parents_.assign(nodes.size(), -1);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (const json& child : nodes[n].value("children", json::array()))
        parents_.at(child.get<std::size_t>()) = static_cast<int>(n);
  }

  /// Plain materials by name, and one for what has none.
  void make_document() {
    document_ = {{"scene", 0}, {"nodes", json::array()}};
    document_["scenes"] = json::array({{{"nodes", json::array()}}});
    document_["accessors"] = document_["bufferViews"] = json::array();
    std::set<int> used;
    for (const Face f : mesh_.faces()) {
      used.insert(named(index_of(attribute::material, f)));
      if (const int lining = index_of(attribute::lining, f); lining >= 0) used.insert(named(lining));
    }
    for (const int m : used) {
      const json plain = {{"metallicFactor", 0}, {"roughnessFactor", 0.9}};
      plain_[m] = static_cast<int>(plain_.size());
      document_["materials"].push_back({{"name", m < 0 ? "cloth" : file_.material_names[m]},
                                        {"doubleSided", true},
                                        {"pbrMetallicRoughness", plain}});
    }
  }

  int named(int material) const {
    return material >= 0 && material < static_cast<int>(file_.material_names.size()) ? material : -1;
  }

  int index_of(const PropertyName<Face, int>& name, Face f) const {
    const auto map = find_map(mesh_, name);
    return map ? (*map)[f] : -1;
  }

  /// The document's, by that of the file.
  int material_of(int index) const {
    const int m = named(index);
    if (!has_source_) return plain_.at(m);
    return m < 0 ? -1 : file_.gltf->materials.at(m);
  }

  /// In the frame of the scene, and the normals there.
  void place_points() {
    points_.assign(mesh_.num_vertices(), Vec3::Zero());
    const WriteOptions metres;
    for (const Vertex v : mesh_.vertices()) {
      const Vector p = to_file(mesh_.point(v), has_source_ ? options_ : metres);
      points_[v] = Vec3(p.x(), p.y(), p.z());
    }
    normals_ = smooth_normals(bridge::triangles_of(mesh_), points_);
  }

  /// By node, in the order of the first face of each.
  std::vector<GltfPart> parts() const {
    std::vector<GltfPart> parts;
    std::map<int, std::size_t> known;
    const auto groups = find_map(mesh_, attribute::group);
    for (const Face f : mesh_.faces()) {
      const int group = groups ? (*groups)[f] : -1;
      const auto* place = has_source_ && group >= 0 && group < static_cast<int>(file_.gltf->places.size())
                              ? &file_.gltf->places[group]
                              : nullptr;
      const auto [found, is_new] = known.emplace(place ? place->node : -1, parts.size());
      if (is_new) parts.push_back(part_at(place));
      auto& faces = parts[found->second].by_material;
      faces[{material_of(index_of(attribute::material, f)), false}].push_back(f);
      if (const int lining = index_of(attribute::lining, f); lining >= 0)
        faces[{material_of(lining), true}].push_back(f);
    }
    return parts;
  }

  static GltfPart part_at(const GltfSource::Place* place) {
    GltfPart part{-1, Eigen::Matrix4d::Identity(), {}, {}};
    if (!place || place->node < 0) return part;
    const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> to_scene(place->to_scene.data());
    const Eigen::FullPivLU<Eigen::Matrix4d> inverse(to_scene);
    part.node = place->node;
    if (inverse.isInvertible()) part.to_node = inverse.inverse();
    return part;
  }

  /// A node that came without a skin loses nothing: there is no deformation to go with weights.
  std::optional<Skinning> skinning_of(const GltfPart& part) {
    if (part.node < 0 || !document_["nodes"].at(part.node).contains("skin")) return std::nullopt;
    const json& skin = document_["skins"].at(document_["nodes"][part.node]["skin"].get<std::size_t>());
    Skinning skinning;
    std::size_t least = std::numeric_limits<std::size_t>::max();
    for (const json& joint : skin.at("joints")) {
      const std::size_t node = joint.get<std::size_t>();
      auto& weights = skinning.joints.emplace_back();
      if (const VertexAttribute* known = attribute_named(joints_.at(node))) weights = known->values;
      const std::size_t depth = depth_of(static_cast<int>(node));
      if (depth < least) least = depth, skinning.root = skinning.joints.size() - 1;
    }
    return skinning;
  }

  /// Null: the mesh has none of that name. What is asked for is carried.
  const VertexAttribute* attribute_named(const std::string& name) {
    carried_.insert(name);
    const auto found = std::ranges::find(attributes_, name, &VertexAttribute::name);
    return found == attributes_.end() ? nullptr : &*found;
  }

  std::size_t depth_of(int node) const {
    std::size_t depth = 0;
    for (; (node = parents_.at(node)) >= 0 && depth < parents_.size();) ++depth;
    return depth;
  }

  void add_part(GltfPart part, GltfAccessors& accessors) {
    const std::optional<Skinning> skinning = skinning_of(part);
    std::size_t slot = meshes_.size();
    json mesh = {{"name", "cloth"}};
    if (part.node >= 0) {
      json& node = document_["nodes"][part.node];
      const std::size_t own = node.at("mesh").get<std::size_t>();
      mesh = meshes_.at(own);
      if (anew_.insert(own).second && is_made_anew(mesh)) slot = own;
      node["mesh"] = slot;
      filled_.insert(part.node);
    } else {
      filled_.insert(static_cast<int>(document_["nodes"].size()));
      document_["scenes"][0]["nodes"].push_back(document_["nodes"].size());
      document_["nodes"].push_back({{"mesh", slot}, {"name", "cloth"}});
    }
    std::set<Vertex> vertices;
    for (const auto& [side, faces] : part.by_material)
      for (const Face f : faces)
        for (const Vertex v : mesh_.vertices_around_face(mesh_.halfedge(f))) vertices.insert(v);
    part.keys = keys_of(mesh, part.node >= 0 ? document_["nodes"][part.node] : json::object(), vertices);
    if (!part.keys.empty()) hide(part.keys, vertices);
    name_keys(part.keys, mesh);
    for (json* shown :
         {&mesh, part.node >= 0 ? &document_["nodes"][part.node] : nullptr})  // one number a key
      while (shown && shown->contains("weights") && (*shown)["weights"].size() < part.keys.size())
        (*shown)["weights"].push_back(0);
    json primitives = json::array();
    for (const auto& [side, faces] : part.by_material) {
      json& primitive = primitives.emplace_back(json::object());
      if (side.first >= 0) primitive["material"] = side.first;
      add_primitive(part, faces, side.second, skinning, primitive, accessors);
    }
    mesh["primitives"] = std::move(primitives);
    if (slot == meshes_.size()) meshes_.emplace_back();
    meshes_[slot] = std::move(mesh);
  }

  /// A mesh that was read: its primitives are gone, but for the names of keys.
  static bool is_made_anew(const json& mesh) {
    return list_of(mesh, "primitives").empty() || !mesh["primitives"][0].contains("attributes");
  }

  /// Those of the mesh that was read, and what else moves the part's vertices.
  std::vector<GltfKey> keys_of(const json& mesh, const json& node, const std::set<Vertex>& vertices) {
    std::vector<GltfKey> keys;
    const json& weights = list_of(list_of(node, "weights").empty() ? mesh : node, "weights");
    for (const std::string& name : gltf_key_names(mesh)) {
      const json& targets = list_of(mesh["primitives"][0], "targets");
      GltfKey key{name, moves_of(name)};
      key.with_normals = keys.size() < targets.size() && targets[keys.size()].contains("NORMAL");
      if (keys.size() < weights.size()) key.shown = weights[keys.size()].get<double>();
      keys.push_back(std::move(key));
    }
    for (const std::string& name : shape_key_names(mesh_)) {
      if (std::ranges::find(keys, name, &GltfKey::name) != keys.end()) continue;
      GltfKey key{name, moves_of(name)};
      const auto moves = [&](Vertex v) { return key.moves[v] != Vec3::Zero(); };
      if (std::ranges::any_of(vertices, moves)) keys.push_back(std::move(key));
    }
    return keys;
  }

  /// In the scene's frame.
  std::vector<Vec3> moves_of(const std::string& key) {
    for (int axis = 0; axis < 3; ++axis) carried_.insert(key_attribute(key, axis));
    std::vector<Vec3> moves;
    for (const Vector& ours : shape_key(mesh_, key)) {
      const Vector move = to_file(CGAL::ORIGIN + ours, has_source_ ? options_ : WriteOptions{});
      moves.emplace_back(move.x(), move.y(), move.z());
    }
    return moves;
  }

  /// The shape without what the node shows of the keys, and its normals.
  void hide(std::vector<GltfKey>& keys, const std::set<Vertex>& vertices) {
    const auto move = [&](std::vector<Vec3>& points, const GltfKey& key, double share) {
      for (const Vertex v : vertices)
        if (share != 0) points[v] += share * key.moves[v];
    };
    for (const GltfKey& key : keys) move(points_, key, -key.shown);
    normals_ = smooth_normals(bridge::triangles_of(mesh_), points_);
    for (GltfKey& key : keys) {
      if (!key.with_normals) continue;
      std::vector<Vec3> moved = points_;
      move(moved, key, 1);
      key.normals = smooth_normals(bridge::triangles_of(mesh_), moved);
    }
  }

  static void name_keys(const std::vector<GltfKey>& keys, json& mesh) {
    if (keys.empty()) return;
    if (!mesh.contains("extras") || !mesh["extras"].is_object()) mesh["extras"] = json::object();
    json names = list_of(mesh["extras"], "targetNames");
    for (std::size_t k = names.size(); k < keys.size(); ++k) names.push_back(keys[k].name);
    mesh["extras"]["targetNames"] = std::move(names);
  }

  /// Meshes that have no face any more keep their numbers, as what no node shows.
  void fill_meshes() {
    const auto with_faces = std::ranges::find_if(meshes_, [](const json& m) { return !is_made_anew(m); });
    for (json& mesh : meshes_) {
      if (!is_made_anew(mesh)) continue;
      mesh["primitives"] = (*with_faces)["primitives"];
      for (const char* of_keys : {"weights", "extras"}) mesh.erase(of_keys);
    }
  }

  /// Triangles of one material or their backs, and the vertices that they need.
  void add_primitive(const GltfPart& part, const std::vector<Face>& faces, bool backs,
                     const std::optional<Skinning>& skinning, json& primitive, GltfAccessors& accessors) {
    const bool mirrored = (part.to_node.topLeftCorner<3, 3>().determinant() < 0) != backs;
    const auto textures = find_map(mesh_, attribute::texture),
               seconds = find_map(mesh_, attribute::second_texture);
    const auto none = gltf_texture(attribute::texture.default_value);
    const auto corner_of = [&](Halfedge h) {
      return GltfCorner{
          mesh_.target(h),
          {textures ? gltf_texture((*textures)[h]) : none, seconds ? gltf_texture((*seconds)[h]) : none}};
    };
    std::vector<GltfCorner> corners;  // in the mesh's order
    for (const Face f : faces)
      for (const Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f))) corners.push_back(corner_of(h));
    std::ranges::sort(corners);
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    const auto number_of = [&](Halfedge h) {
      return static_cast<std::uint32_t>(std::ranges::lower_bound(corners, corner_of(h)) - corners.begin());
    };
    std::string indices;
    for (const Face f : faces) {
      std::array<std::uint32_t, 3> triangle{};
      std::size_t k = mirrored ? 3 : 0;
      for (const Halfedge h : mesh_.halfedges_around_face(mesh_.halfedge(f)))
        triangle[mirrored ? --k : k++] = number_of(h);
      append_all(indices, triangle);
    }
    primitive["indices"] =
        add(accessors, indices, 3 * faces.size(), gltf_unsigned_int, "SCALAR", gltf_indices);
    json& attributes = primitive["attributes"];
    add_shape(part, corners, backs, attributes, accessors);
    for (std::size_t map = 0; map < 2; ++map)
      if (uses_texture(primitive, map) ||
          std::ranges::any_of(corners, [&](const GltfCorner& c) { return c.texture[map] != none; }))
        add_textures(corners, map, attributes, accessors);
    add_colors(corners, attributes, accessors);
    if (skinning) add_weights(*skinning, corners, attributes, accessors);
    for (const GltfKey& key : part.keys)
      primitive["targets"].push_back(target_of(part, key, corners, backs, accessors));
  }

  json target_of(const GltfPart& part, const GltfKey& key, const std::vector<GltfCorner>& corners, bool backs,
                 GltfAccessors& accessors) {
    std::vector<Float3> moves, turns;
    for (const GltfCorner& corner : corners) {
      const Vec3 move = part.to_node.topLeftCorner<3, 3>() * key.moves[corner.vertex];
      moves.push_back(
          {static_cast<float>(move[0]), static_cast<float>(move[1]), static_cast<float>(move[2])});
      if (!key.with_normals) continue;
      const Float3 from = direction_of(part, normals_[corner.vertex], backs),
                   to = direction_of(part, key.normals[corner.vertex], backs);
      turns.push_back({to[0] - from[0], to[1] - from[1], to[2] - from[2]});
    }
    json target{{"POSITION", add_moves(moves, accessors)}};
    if (key.with_normals) target["NORMAL"] = add_moves(turns, accessors);
    return target;
  }

  /// An accessor without a view is 0 everywhere but at its sparse elements.
  int add_moves(const std::vector<Float3>& moves, GltfAccessors& accessors) {
    std::string indices, values;
    Float3 low = {}, high = {};
    std::uint32_t moved = 0;
    for (std::size_t i = 0; i < moves.size(); ++i) {
      if (moves[i] == Float3{}) continue;
      ++moved;
      append_in_order(indices, static_cast<std::uint32_t>(i), std::endian::little);
      append_all(values, moves[i]);
    }
    for (std::size_t i = 0; i < moves.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        low[k] = i == 0 ? moves[i][k] : std::min(low[k], moves[i][k]),
        high[k] = i == 0 ? moves[i][k] : std::max(high[k], moves[i][k]);
    if (2 * std::size_t{moved} > moves.size()) {
      std::string all;
      for (const Float3& move : moves) append_all(all, move);
      const int number = add(accessors, all, moves.size(), gltf_float, "VEC3", gltf_vertex_data);
      accessors.bound(low, high);
      return number;
    }
    json accessor{{"componentType", gltf_float}, {"count", moves.size()}, {"type", "VEC3"}};
    if (moved > 0) {
      json at{{"componentType", gltf_unsigned_int}}, given = json::object();
      at["bufferView"] = add_view(accessors, indices), given["bufferView"] = add_view(accessors, values);
      accessor["sparse"] = {{"count", moved}, {"indices", at}, {"values", given}};
    }
    accessors.accessors.push_back(std::move(accessor));
    accessors.bound(low, high);
    return static_cast<int>(accessors.accessors.size()) - 1;
  }

  std::size_t add_view(GltfAccessors& accessors, const std::string& bytes) {
    binary_ += bytes;
    return accessors.add_view(bytes.size());
  }

  /// A unit normal of the scene in the part's node.
  static Float3 direction_of(const GltfPart& part, const Float3& n, bool backs) {
    const Eigen::Matrix3d turned = part.to_node.topLeftCorner<3, 3>().inverse().transpose();
    Vec3 normal = (backs ? -1 : 1) * turned * Vec3(n[0], n[1], n[2]);
    if (!(normal.norm() > 0)) normal = Vec3(0, 1, 0);
    normal.normalize();
    return {static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])};
  }

  int add(GltfAccessors& accessors, const std::string& bytes, std::size_t count, int component,
          const char* type, int target) {
    binary_ += bytes;
    return accessors.add(count, component, type, bytes.size(), target);
  }

  void add_shape(const GltfPart& part, const std::vector<GltfCorner>& corners, bool backs, json& attributes,
                 GltfAccessors& accessors) {
    std::string positions, normals;
    Float3 low, high;
    low.fill(std::numeric_limits<float>::max()), high.fill(std::numeric_limits<float>::lowest());
    for (const GltfCorner& corner : corners) {
      const Vec3 x = (part.to_node * points_[corner.vertex].homogeneous()).head<3>();
      const Float3 direction = direction_of(part, normals_[corner.vertex], backs);
      Float3 place;
      for (int k = 0; k < 3; ++k) {
        place[k] = static_cast<float>(x[k]);
        low[k] = std::min(low[k], place[k]), high[k] = std::max(high[k], place[k]);
      }
      if (!std::isfinite(low[0] + low[1] + low[2] + high[0] + high[1] + high[2]))
        throw std::invalid_argument("mesh: the position of vertex " + std::to_string(corner.vertex.idx()) +
                                    " is beyond single precision");
      append_all(positions, place), append_all(normals, direction);
    }
    attributes["POSITION"] = add(accessors, positions, corners.size(), gltf_float, "VEC3", gltf_vertex_data);
    accessors.bound(low, high);
    attributes["NORMAL"] = add(accessors, normals, corners.size(), gltf_float, "VEC3", gltf_vertex_data);
  }

  /// None where all is white, which changes nothing.
  void add_colors(const std::vector<GltfCorner>& corners, json& attributes, GltfAccessors& accessors) {
    const auto colors = find_map(mesh_, attribute::color);
    if (!colors || std::ranges::all_of(corners, [&](const GltfCorner& c) {
          return (*colors)[c.vertex] == attribute::color.default_value;
        }))
      return;
    std::string bytes;
    for (const GltfCorner& c : corners)
      for (const double k : (*colors)[c.vertex]) append_all(bytes, std::array{static_cast<float>(k)});
    attributes["COLOR_0"] = add(accessors, bytes, corners.size(), gltf_float, "VEC4", gltf_vertex_data);
  }

  void add_textures(const std::vector<GltfCorner>& corners, std::size_t map, json& attributes,
                    GltfAccessors& accessors) {
    std::string bytes;
    for (const GltfCorner& corner : corners) append_all(bytes, corner.texture[map]);
    attributes["TEXCOORD_" + std::to_string(map)] =
        add(accessors, bytes, corners.size(), gltf_float, "VEC2", gltf_vertex_data);
  }

  /// Whether a primitive's material has a texture anywhere, on that map.
  bool uses_texture(const json& primitive, std::size_t map) const {
    if (!has_source_ || !primitive.contains("material")) return false;
    const std::string text = document_["materials"].at(primitive["material"].get<std::size_t>()).dump();
    return text.find("Texture\":{") != text.npos && (map == 0 || text.find("\"texCoord\":1") != text.npos);
  }

  void add_weights(const Skinning& skinning, const std::vector<GltfCorner>& corners, json& attributes,
                   GltfAccessors& accessors) {
    std::string joints, weights;
    for (const GltfCorner& corner : corners) {
      const auto [numbers, parts] = strongest(skinning, corner.vertex);
      append_all(joints, numbers), append_all(weights, parts);
    }
    attributes["JOINTS_0"] =
        add(accessors, joints, corners.size(), gltf_unsigned_short, "VEC4", gltf_vertex_data);
    attributes["WEIGHTS_0"] = add(accessors, weights, corners.size(), gltf_float, "VEC4", gltf_vertex_data);
  }

  /// The joints with the largest weights, of equal ones the first, and those weights with the sum 1; all on
  /// the skin's root where a vertex has none.
  std::pair<std::array<std::uint16_t, 4>, std::array<float, 4>> strongest(const Skinning& skinning,
                                                                          Vertex v) {
    std::vector<std::pair<double, std::uint16_t>> all;
    for (std::size_t j = 0; j < skinning.joints.size(); ++j) {
      const double w = skinning.joints[j] ? (*skinning.joints[j])[v] : 0;
      if (!(w >= 0) || std::isinf(w))
        throw std::invalid_argument("mesh: a skin weight of vertex " + std::to_string(v.idx()) +
                                    " is negative or not finite; `furrow doctor` names it");
      if (w > 0) all.emplace_back(-w, static_cast<std::uint16_t>(j));
    }
    std::ranges::sort(all);
    if (all.empty()) unweighted_.insert(v), all.emplace_back(-1, static_cast<std::uint16_t>(skinning.root));
    if (all.size() > joints_a_vertex) crowded_.insert(v), all.resize(joints_a_vertex);
    double sum = 0, rest = 1;
    for (const auto& [w, j] : all) sum += w;
    std::array<std::uint16_t, 4> numbers{};
    std::array<float, 4> parts{};
    for (std::size_t i = all.size(); i-- > 0;) {  // the largest takes what rounding leaves
      const float part = static_cast<float>(i == 0 ? rest : all[i].first / sum);
      if (part > 0) numbers[i] = all[i].second, parts[i] = part, rest -= static_cast<double>(part);
    }
    return {numbers, parts};
  }

  /// Nodes that were read and have no face any more.
  void clear_unused_nodes() {
    if (!file_.gltf) return;
    for (const GltfSource::Place& place : file_.gltf->places)
      if (place.node >= 0 && !filled_.contains(place.node))
        for (const char* of_mesh : {"mesh", "skin", "weights"})
          document_["nodes"].at(place.node).erase(of_mesh);
  }

  static void collect_extensions(const json& value, std::set<std::string>& names) {
    if (!value.is_structured()) return;
    for (const auto& [key, inner] : value.items()) {
      if (value.is_object() && key == "extensions" && inner.is_object())
        for (const auto& [name, content] : inner.items()) names.insert(name);
      if (key != "extras") collect_extensions(inner, names);
    }
  }

  /// Those that are left, and of them those that were required.
  void name_extensions() {
    std::set<std::string> used;
    collect_extensions(document_, used);
    json required = json::array();
    for (const json& name : document_.value("extensionsRequired", json::array()))
      if (used.contains(name)) required.push_back(name);
    document_.erase("extensionsUsed"), document_.erase("extensionsRequired");
    if (!used.empty()) document_["extensionsUsed"] = used;
    if (!required.empty()) document_["extensionsRequired"] = required;
  }

  void tell_weights() {
    if (!crowded_.empty())
      lost_.push_back("all but the four largest skin weights of " + std::to_string(crowded_.size()) +
                      " vertices, as programs read no more; `max_weights=4` does the same before");
    if (!unweighted_.empty())
      lost_.push_back(
          "the rest of " + std::to_string(unweighted_.size()) +
          " vertices without skin weights, which now follow the skeleton's root; give them weights");
    std::string bound, others;
    for (const VertexAttribute& a : attributes_) {
      if (carried_.contains(a.name)) continue;
      std::string& names = a.name.starts_with("weight_") ? bound : others;
      names += (names.empty() ? "" : ", ") + a.name;
    }
    if (!bound.empty())
      lost_.push_back("the skin weights " + bound +
                      ", whose joints are in no skeleton of a glTF that was read; furrow transfer SOURCE.glb "
                      "takes the shape back to a mesh that has one");
    if (!others.empty()) lost_.push_back("the vertex attributes " + others + "; a PLY keeps them");
  }

  void tell_maps() {
    std::string names;
    const auto tell = [&](bool there, const char* name) {
      if (there) names += (names.empty() ? "" : ", ") + std::string(name);
    };
    tell(
        find_map(mesh_, attribute::line) || find_map(mesh_, attribute::line_edge) || !file_.polylines.empty(),
        "lines");
    tell(find_map(mesh_, attribute::rest_length) || find_map(mesh_, attribute::rest_position) ||
             find_map(mesh_, attribute::triangle_rest_length) || find_map(mesh_, attribute::rest_angle),
         "the state of rest");
    tell(find_map(mesh_, attribute::mass) || find_map(mesh_, attribute::velocity), "masses and motion");
    tell(!struts(mesh_).empty(), "struts");
    if (!names.empty()) lost_.push_back(names + "; write a PLY, too, from which the cloth goes on");
    if (!file_.comments.empty()) lost_.emplace_back("comments; a PLY or an OBJ keeps them");
    if (has_source_) return;
    if (find_map(mesh_, attribute::group) && !file_.group_names.empty())
      lost_.emplace_back("groups; a PLY or an OBJ keeps them");
    if (!file_.material_libraries.empty())
      lost_.push_back("the colours and pictures of " + file_.material_libraries.front() +
                      ": materials go by name; an OBJ keeps them");
  }

  const MeshFile& file_;
  const Mesh& mesh_;
  const WriteOptions& options_;
  bool has_source_ = false;
  json document_, meshes_ = json::array();
  std::vector<std::string> joints_;  ///< attributes, by node
  std::string binary_;
  std::vector<int> parents_;  ///< by node
  std::map<int, int> plain_;  ///< the document's materials, by those of the mesh
  std::vector<Vec3> points_;
  std::vector<Float3> normals_;
  std::vector<VertexAttribute> attributes_ = vertex_attributes(file_.mesh);
  std::set<std::string> carried_;  ///< of the attributes
  std::set<std::size_t> anew_;     ///< meshes that were read, and have a node
  std::set<int> filled_;           ///< nodes that have a mesh
  std::set<Vertex> crowded_, unweighted_;
  std::vector<std::string> lost_;
};

}  // namespace

std::vector<std::string> write_glb(std::ostream& out, const MeshFile& file, const WriteOptions& options) {
  check_positions(file.mesh, options);
  try {
    GltfMeshWriter writer(file, options);
    out << writer.bytes();
    return writer.lost();
  } catch (const json::exception& error) {
    throw geometry::ContentError(std::string("what was kept of the glTF is damaged: ") + error.what());
  } catch (const std::out_of_range& error) {
    throw geometry::ContentError(std::string("what was kept of the glTF is damaged: ") + error.what());
  }
}

bool is_own_glb(std::string_view head, std::string_view) {
  return head.starts_with("glTF") && head.find("\"generator\":\"Furrow\"") != head.npos;
}

}  // namespace furrow::io
