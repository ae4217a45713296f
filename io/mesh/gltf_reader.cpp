// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "geometry/mesh/errors.h"
#include "geometry/mesh/vertex_attributes.h"
#include "io/base/bytes_file.h"
#include "io/base/child_process.h"
#include "io/base/figure_path.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/gltf_document.h"
#include "io/mesh/gltf_nodes.h"
#include "io/mesh/merge_points.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/soup_bytes.h"
#include "io/mesh/weld.h"

namespace furrow::io {
namespace {

using namespace geometry;
using Eigen::Matrix4d;
using nlohmann::json;

constexpr std::size_t most_kept = std::size_t{256} << 20;  // of a file beside its geometry [bytes]
constexpr double same_place = 1e-5;  // of entries of transforms: inverse bind matrices are single precision
/// How required extensions begin that say nothing of where vertices are: what they say is kept as it is.
constexpr std::array harmless = {"KHR_mesh_quantization", "KHR_materials_", "KHR_texture_", "EXT_texture_",
                                 "MSFT_texture_",         "KHR_lights_",    "EXT_lights_",  "KHR_xmp"};
constexpr const char* newer_compression = "KHR_meshopt_compression";  // others are undone before

bool agree(const Matrix4d& a, const Matrix4d& b) { return (a - b).cwiseAbs().maxCoeff() <= same_place; }

void check_required(const json& document) {
  for (const json& one : list_of(document, "extensionsRequired")) {
    const auto name = one.get<std::string>();
    if (std::ranges::any_of(harmless, [&](const char* known) { return name.starts_with(known); })) continue;
    throw ContentError("it needs the extension " + name + ", which is not read; " +
                       (name == newer_compression ? "undo it by gltf-transform cp packed.glb plain.glb"
                                                  : "export the file again without it"));
  }
}

/// The corners of a primitive's triangles, three each; none for points and lines.
std::vector<std::uint32_t> corners_of(const std::vector<std::uint32_t>& along, int mode) {
  constexpr int triangles = 4, strip = 5, fan = 6;
  if (mode == triangles) return {along.begin(), along.end() - static_cast<std::ptrdiff_t>(along.size() % 3)};
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; (mode == strip || mode == fan) && i + 2 < along.size(); ++i) {
    const bool odd = mode == strip && i % 2 == 1;
    for (const std::size_t c : {mode == fan ? 0 : i, i + (odd ? 2 : 1), i + (odd ? 1 : 2)})
      corners.push_back(along[c]);
  }
  return corners;
}

/// What skins a mesh.
struct Skin {
  std::vector<std::string> attributes;  ///< by joint
  std::optional<Matrix4d> place;        ///< where it puts the mesh; none: it has no joint
  bool moved = false;                   ///< whether joints stand otherwise: the file shows another pose
};

/// Reads what a document shows into a soup.
class GltfReader {
 public:
  GltfReader(GltfDocument& document, const ReadOptions& options)
      : document_(document), options_(options), places_(gltf_places(document.root)) {}

  SoupFile read(const std::vector<GltfMeshNode>& nodes) {
    for (const GltfMeshNode& node : nodes) read_node(node);
    PolygonSoup& soup = out_.soup;
    const auto is_none = [](const TextureCoordinate& t) { return std::isnan(t[0]); };
    for (auto* textures : {&soup.textures, &soup.second_textures})
      if (std::ranges::all_of(*textures, is_none)) textures->clear();
    if (!has_colors_) soup.colors.clear();
    for (SoupAttribute& attribute : soup.attributes) attribute.values.resize(soup.points.size(), 0);
    if (!hard_points_.empty())
      out_.gltf.lost.push_back("the hard edges at " + std::to_string(hard_points_.size()) +
                               " vertices: all normals are smooth; mark edges as sharp again");
    out_.gltf.materials.assign(out_.material_names.size(), -1);
    for (const auto& [from, to] : materials_) out_.gltf.materials[to] = static_cast<int>(from);
    return std::move(out_);
  }

 private:
  using Numbers = std::vector<float>;

  /// All primitives of a node share the points of equal position.
  void read_node(const GltfMeshNode& node) {
    const json& mesh = document_.root["meshes"][node.mesh];
    const std::size_t faces = out_.soup.faces();
    const std::optional<Skin> skin = skin_of(node);
    Matrix4d place = node.to_scene;
    if (skin && skin->place && !agree(*skin->place, place)) place = *skin->place;
    if (skin && skin->moved)
      out_.warnings.push_back(
          node.name + ": its skeleton stands in another pose than it was bound in; read as it was bound");
    if (std::ranges::any_of(node.shown, [](float share) { return share != 0; })) tell_shown(node, mesh);
    numbers_ = {};
    base_ = out_.soup.points.size();
    for (const json& primitive : list_of(mesh, "primitives")) {
      const json attributes = primitive.value("attributes", json::object());
      if (!attributes.contains("POSITION") || primitive.value("mode", 4) < 4) continue;
      read_primitive(node, mesh, primitive, attributes, place, skin ? &*skin : nullptr);
    }
    if (out_.soup.faces() == faces) return;
    GltfSource::Place& noted = out_.gltf.places.emplace_back();
    noted.node = static_cast<int>(node.node);
    for (int i = 0; i < 16; ++i) noted.to_scene[static_cast<std::size_t>(i)] = place(i / 4, i % 4);
    out_.group_names.push_back(node.name);
  }

  void read_primitive(const GltfMeshNode& node, const json& mesh, const json& primitive,
                      const json& attributes, const Matrix4d& place, const Skin* skin) {
    Numbers positions = numbers_in(attributes, "POSITION", 3);
    vertices_ = positions.size() / 3;
    std::vector<Numbers> keys;
    for (const json& target : list_of(primitive, "targets"))
      keys.push_back(target.contains("POSITION") ? key_in(target, positions.size())
                                                 : Numbers(positions.size(), 0));
    for (std::size_t k = 0; k < keys.size(); ++k)
      for (std::size_t i = 0; node.shown.at(k) != 0 && i < positions.size(); ++i)
        positions[i] += node.shown[k] * keys[k][i];
    const std::size_t before = out_.soup.points.size();
    const std::vector<std::size_t> points = read_points(positions, keys, place);
    read_normals_and_colors(attributes, points, before);
    read_keys(gltf_key_names(mesh), keys, place, points, before);
    if (skin) read_weights(attributes, *skin, points);
    read_faces(primitive, attributes, points, place.topLeftCorner<3, 3>().determinant() < 0);
  }

  /// An attribute of as many elements as the primitive has vertices; empty where it has none.
  Numbers numbers_in(const json& attributes, const char* name, std::size_t width) {
    if (!attributes.contains(name)) return {};
    const json& accessor = document_.accessor(attributes[name]);
    Numbers numbers = document_.numbers_of(accessor);
    const bool is_position = std::string_view(name) == "POSITION";
    if (gltf_width(accessor) != width || (!is_position && numbers.size() != width * vertices_))
      throw ContentError(std::string("the attribute ") + name + " has not the vertices of its mesh");
    return numbers;
  }

  Numbers key_in(const json& target, std::size_t size) {
    Numbers moves = document_.numbers_of(document_.accessor(target["POSITION"]));
    if (moves.size() != size) throw ContentError("a shape key has not the vertices of its mesh");
    for (const float move : moves)
      if (!std::isfinite(move)) throw ContentError("a shape key is not finite");
    return moves;
  }

  void tell_shown(const GltfMeshNode& node, const json& mesh) {
    std::string list;
    const std::vector<std::string> names = gltf_key_names(mesh);
    for (std::size_t k = 0; k < names.size(); ++k)
      if (node.shown[k] != 0) list += (list.empty() ? "'" : ", '") + names[k] + "'";
    out_.warnings.push_back("mesh '" + mesh.value("name", node.name) + "' shows shape keys (" + list +
                            "); its shape with them is read");
  }

  /// The joints alone place a skinned mesh: its node's transform does not count (glTF 2.0, 3.7.3.3). What a
  /// joint does to the mesh is its place times its inverse bind matrix, the same for all in the bind pose;
  /// where it is not, the joint nearest to the root counts.
  std::optional<Skin> skin_of(const GltfMeshNode& node) {
    const json& from = list_of(document_.root, "nodes")[node.node];
    if (!from.contains("skin")) return std::nullopt;
    const json& skins = list_of(document_.root, "skins");
    const json& skin = skins[index_in(skins, from["skin"])];
    const json& joints = list_of(skin, "joints");
    Numbers inverse;
    if (skin.contains("inverseBindMatrices"))
      inverse = document_.numbers_of(document_.accessor(skin["inverseBindMatrices"]));
    if (!inverse.empty() && inverse.size() < 16 * joints.size())
      throw ContentError("a skin has fewer bind matrices than joints");
    const std::vector<std::string> names = joint_attributes(document_.root);
    Skin found;
    std::vector<Matrix4d> all;
    std::size_t least = 0;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const std::size_t n = joints[j].get<std::size_t>();
      found.attributes.push_back(names[n]);
      all.push_back(places_[n]);  // no matrices are given: all are the identity (glTF 2.0, 3.7.3.1)
      if (!inverse.empty()) all.back() *= Eigen::Map<const Eigen::Matrix4f>(&inverse[16 * j]).cast<double>();
      const std::size_t depth = depth_of(n);
      if (!found.place || depth < least) found.place = all.back(), least = depth;
    }
    for (const Matrix4d& place : all) found.moved = found.moved || !agree(place, *found.place);
    if (found.place && agree(*found.place, Matrix4d::Identity())) found.place = Matrix4d::Identity();
    return found;
  }

  /// How many nodes are above one.
  std::size_t depth_of(std::size_t node) {
    if (parents_.empty()) {
      const json& nodes = list_of(document_.root, "nodes");
      parents_.assign(nodes.size(), -1);
      for (std::size_t n = 0; n < nodes.size(); ++n)
        for (const json& child : list_of(nodes[n], "children"))
          parents_[index_in(nodes, child)] = static_cast<int>(n);
    }
    std::size_t depth = 0;
    for (int n = parents_[node]; n >= 0 && depth < parents_.size(); n = parents_[static_cast<std::size_t>(n)])
      ++depth;
    return depth;
  }

  /// Vertices that a key parts stay apart, as those of a mouth that it opens.
  std::vector<std::size_t> read_points(const Numbers& positions, const std::vector<Numbers>& keys,
                                       const Matrix4d& place) {
    std::vector<std::size_t> points(vertices_);
    for (std::size_t v = 0; v < vertices_; ++v) {
      const float* raw = &positions[3 * v];
      const Eigen::Vector3d p = (place * Eigen::Vector3d(raw[0], raw[1], raw[2]).homogeneous()).head<3>();
      const auto point = from_file(p.x(), p.y(), p.z(), options_);
      if (!point) throw ContentError(bad_coordinate);
      const auto [index, is_new] = numbers_.number(*point, moves_of(keys, v));
      points[v] = base_ + index;
      is_new ? out_.soup.points.push_back(*point) : void(++out_.merged_vertices);
    }
    return points;
  }

  /// The same number for vertices that all keys move alike; 0 where none does.
  static std::uint64_t moves_of(const std::vector<Numbers>& keys, std::size_t vertex) {
    std::uint64_t hash = 0;
    for (std::size_t k = 0; k < keys.size(); ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (const float move = keys[k][3 * vertex + axis]; move != 0)
          hash = (hash ^ std::bit_cast<std::uint32_t>(move) ^ ((3 * k + axis) << 32)) * 0x9E3779B97F4A7C15u,
          hash ^= hash >> 29;
    return hash;
  }

  /// Of points from there on the first vertex counts.
  void read_normals_and_colors(const json& attributes, const std::vector<std::size_t>& points,
                               std::size_t before) {
    const Numbers normals = numbers_in(attributes, "NORMAL", 3);
    const bool with_alpha =
        attributes.contains("COLOR_0") && gltf_width(document_.accessor(attributes["COLOR_0"])) == 4;
    const std::size_t width = with_alpha ? 4 : 3;
    const Numbers colors = numbers_in(attributes, "COLOR_0", width);
    has_colors_ = has_colors_ || !colors.empty();
    out_.soup.colors.resize(out_.soup.points.size(), attribute::color.default_value);
    normals_.resize(out_.soup.points.size(), Eigen::Vector3f::Zero());
    std::vector<char> known(out_.soup.points.size() - before, 0);
    for (std::size_t v = 0; v < points.size(); ++v) {
      const Eigen::Vector3f normal =
          normals.empty() ? Eigen::Vector3f::Zero()
                          : Eigen::Vector3f(Eigen::Map<const Eigen::Vector3f>(&normals[3 * v]));
      if (points[v] < before || known[points[v] - before]) {
        note_hard_edge(points[v], normal);
        continue;
      }
      known[points[v] - before] = 1;
      normals_[points[v]] = normal;
      for (std::size_t k = 0; k < width && !colors.empty(); ++k)
        out_.soup.colors[points[v]][k] = colors[width * v + k];
    }
  }

  /// Where two normals of a point that is one now are more than 8 degrees apart.
  void note_hard_edge(std::size_t point, const Eigen::Vector3f& normal) {
    const float lengths = normals_[point].norm() * normal.norm();
    if (lengths > 0 && normals_[point].dot(normal) < 0.99F * lengths) hard_points_.insert(point);
  }

  /// In metres, y up, as positions; of points from there on.
  void read_keys(const std::vector<std::string>& names, const std::vector<Numbers>& keys,
                 const Matrix4d& place, const std::vector<std::size_t>& points, std::size_t before) {
    for (std::size_t k = 0; k < keys.size(); ++k) {
      std::array<std::vector<double>, 3> moves;
      for (std::size_t v = 0; v < points.size(); ++v) {
        const float* raw = &keys[k][3 * v];
        if (points[v] < before || (raw[0] == 0 && raw[1] == 0 && raw[2] == 0)) continue;
        const Eigen::Vector3d move = place.topLeftCorner<3, 3>() * Eigen::Vector3d(raw[0], raw[1], raw[2]);
        const Vector ours =
            turned_from_file(options_.metres_per_unit * Vector(move.x(), move.y(), move.z()), options_.up);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          moves[axis].resize(out_.soup.points.size(), 0);
          moves[axis][points[v]] = ours[static_cast<int>(axis)];
        }
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::vector<double>& along = moves[axis];
        if (std::ranges::all_of(along, [](double move) { return move == 0; })) continue;
        std::vector<double>& values = values_of(key_attribute(names[k], static_cast<int>(axis)));
        for (std::size_t i = before; i < along.size(); ++i) values[i] = along[i];
      }
    }
  }

  /// A skin's joints become attributes; of points merged into one, the first with weights counts. (The
  /// positions are those of the bind pose.)
  void read_weights(const json& attributes, const Skin& skin, const std::vector<std::size_t>& points) {
    std::set<std::size_t> taken;
    for (std::size_t v = 0; v < points.size(); ++v)
      if (weighted_.contains(points[v])) taken.insert(v);
    for (std::size_t set = 0;; ++set) {
      const std::string weights_name = "WEIGHTS_" + std::to_string(set),
                        joints_name = "JOINTS_" + std::to_string(set);
      if (!attributes.contains(weights_name) || !attributes.contains(joints_name)) break;
      const Numbers weights = numbers_in(attributes, weights_name.c_str(), 4);
      const auto joints = document_.whole_numbers_of(document_.accessor(attributes[joints_name]));
      if (joints.size() != weights.size()) throw ContentError("joints have not the vertices of their mesh");
      std::set<std::uint32_t> used;  // in the skin's order, whatever that of the vertices is
      for (std::size_t i = 0; i < joints.size(); ++i)
        if (weights[i] != 0 && joints[i] < skin.attributes.size()) used.insert(joints[i]);
      for (const std::uint32_t joint : used) values_of(skin.attributes[joint]);
      for (std::size_t v = 0; v < points.size(); ++v)
        if (!taken.contains(v)) add_weights(skin, &joints[4 * v], &weights[4 * v], points[v], v);
    }
    source_.clear();
  }

  void add_weights(const Skin& skin, const std::uint32_t* joints, const float* weights, std::size_t point,
                   std::size_t vertex) {
    for (std::size_t k = 0; k < 4; ++k) {
      if (weights[k] == 0) continue;
      if (joints[k] >= skin.attributes.size() || !(weights[k] >= 0) || std::isinf(weights[k]))
        throw ContentError("a vertex has a joint or a skin weight that cannot be used; repair the file");
      if (source_.emplace(point, vertex).first->second != vertex) return;
      weighted_.insert(point);
      values_of(skin.attributes[joints[k]])[point] += weights[k];
    }
  }

  /// By point, as many as there are now.
  std::vector<double>& values_of(const std::string& name) {
    const auto [known, is_new] = attributes_.emplace(name, out_.soup.attributes.size());
    if (is_new) out_.soup.attributes.push_back({name, {}});
    std::vector<double>& values = out_.soup.attributes[known->second].values;
    values.resize(out_.soup.points.size(), 0);
    return values;
  }

  void read_faces(const json& primitive, const json& attributes, const std::vector<std::size_t>& points,
                  bool mirrored) {
    std::vector<std::uint32_t> along;
    if (primitive.contains("indices"))
      along = document_.whole_numbers_of(document_.accessor(primitive["indices"]));
    else
      for (std::uint32_t v = 0; v < points.size(); ++v) along.push_back(v);
    const std::vector<std::uint32_t> corners = corners_of(along, primitive.value("mode", 4));
    const Numbers textures = numbers_in(attributes, "TEXCOORD_0", 2),
                  seconds = numbers_in(attributes, "TEXCOORD_1", 2);
    const int material = material_of(primitive), group = static_cast<int>(out_.group_names.size());
    PolygonSoup& soup = out_.soup;
    for (std::size_t f = 0; f < corners.size(); f += 3) {
      for (const std::size_t k : {0, 1, 2}) {
        const std::size_t v = corners[f + (mirrored ? 2 - k : k)];
        if (v >= points.size())
          throw ContentError("a face names a vertex that is not there; repair the file");
        soup.corners.push_back(points[v]);
        soup.textures.push_back(texture_of(textures, v));
        soup.second_textures.push_back(texture_of(seconds, v));
      }
      soup.close_face();
      soup.groups.push_back(group);
      soup.materials.push_back(material);
    }
  }

  /// glTF has v downwards.
  static TextureCoordinate texture_of(const Numbers& map, std::size_t v) {
    if (map.empty()) return attribute::texture.default_value;
    return {map[2 * v], 1 - static_cast<double>(map[2 * v + 1])};
  }

  /// A name for each material of the file, also where two have the same.
  int material_of(const json& primitive) {
    if (!primitive.contains("material")) return -1;
    const json& all = list_of(document_.root, "materials");
    const std::size_t source = index_in(all, primitive["material"]);
    if (const auto found = materials_.find(source); found != materials_.end()) return found->second;
    std::string own = all[source].value("name", "");
    if (own.empty()) own = "material";
    std::string unique = own;
    for (int copy = 2; std::ranges::find(out_.material_names, unique) != out_.material_names.end(); ++copy)
      unique = own + " (" + std::to_string(copy) + ")";
    out_.material_names.push_back(unique);
    return materials_[source] = static_cast<int>(out_.material_names.size()) - 1;
  }

  GltfDocument& document_;
  ReadOptions options_;
  std::vector<Matrix4d> places_;          ///< by node
  std::vector<int> parents_;              ///< by node
  std::size_t vertices_ = 0;              ///< of the primitive
  std::size_t base_ = 0;                  ///< the node's first point
  PointNumbers numbers_;                  ///< of the node
  std::vector<Eigen::Vector3f> normals_;  ///< by point: of its first vertex
  std::set<std::size_t> hard_points_, weighted_;
  std::map<std::size_t, std::size_t> source_;      ///< the primitive's vertex whose weights a point has
  std::map<std::size_t, int> materials_;           ///< the mesh's, by the document's
  std::map<std::string, std::size_t> attributes_;  ///< the soup's, by name
  SoupFile out_;
  bool has_colors_ = false;
};

/// Opens ordinary files in a file's own folder, or below it: a file from elsewhere may name any other.
class OwnFolder {
 public:
  explicit OwnFolder(const std::filesystem::path& file)
      : folder_(std::filesystem::canonical(std::filesystem::absolute(file)).parent_path()) {}

  /// The content of a file that is named from there; none: it is no such file.
  std::optional<std::string> content(const std::string& name) const {
    std::error_code fault;
    const auto real = std::filesystem::canonical(folder_ / name, fault);
    if (fault || !std::filesystem::is_regular_file(real, fault)) return std::nullopt;
    if (std::mismatch(folder_.begin(), folder_.end(), real.begin(), real.end()).first != folder_.end())
      return std::nullopt;
    return read_text(real);
  }

 private:
  std::filesystem::path folder_;
};

/// Ten seconds, and one more for each megabyte; a gigabyte, and twenty times the file.
ChildLimits limits_for(std::size_t file_size) {
  ChildLimits limits;
  limits.cpu_seconds = 10 + static_cast<unsigned>(file_size >> 20);
  limits.memory_bytes += 20 * file_size;
  return limits;
}

/// What a writer of GLB needs of the file. A file whose geometry alone can be used is one that keeps nothing.
void keep_beside(GltfDocument& document, const OpenBeside& open, const std::vector<GltfMeshNode>& nodes,
                 GltfSource& source) {
  std::string reason;
  try {
    GltfSource kept = keep_gltf(document, open, nodes);
    if (kept.document.size() <= most_kept && kept.binary.size() <= most_kept) {
      source.document = std::move(kept.document), source.binary = std::move(kept.binary);
      source.lost.insert(source.lost.begin(), kept.lost.begin(), kept.lost.end());
      return;
    }
    reason = "more than 256 MiB of pictures and motion";
  } catch (const ContentError& error) {
    reason = error.what();
  } catch (const std::bad_alloc&) {
    reason = "too large to be kept";
  }
  source = {};
  source.lost = {"materials, pictures, skeleton and motion of the file that was read (" + reason +
                 "); export it again, smaller or repaired"};
}

}  // namespace

SoupFile read_gltf_soup(std::string_view bytes, const std::string& figure, const OpenBeside& open,
                        const ReadOptions& options) {
  try {
    const std::optional<std::string> unpacked = unpack_gltf(bytes, open);
    GltfDocument document(unpacked ? *unpacked : bytes, open);
    check_required(document.root);
    const std::vector<GltfMeshNode> nodes = gltf_mesh_nodes(document.root, figure);
    SoupFile file = GltfReader(document, options).read(nodes);
    keep_beside(document, open, nodes, file.gltf);
    return file;
  } catch (const json::exception& error) {
    throw ContentError(error.what());
  }
}

MeshFile read_gltf(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string name = path.string();
  const FigurePath named = figure_path(path);
  const std::string bytes = read_text(named.file);
  if (bytes.empty()) throw ContentError(name + ": the file is empty");
  const OwnFolder folder(named.file);
  const OpenBeside open = [&](const std::string& beside) { return folder.content(beside); };
  const std::string ending = ending_of(path);
  const bool is_other = ending == ".fbx" || ending == ".dae";
  const auto soup = [&] {
    return read_gltf_soup(is_other ? other_as_gltf(bytes, ending.substr(1)) : bytes, named.figure, open,
                          options);
  };
  MeshFile file;
  SoupFile content;
  try {
    content = soup_from_bytes(run_in_child([&] { return to_bytes(soup()); }, limits_for(bytes.size())));
  } catch (const ContentError& error) {
    throw ContentError(name + ": " + error.what());
  }
  file.group_names = std::move(content.group_names);
  file.material_names = std::move(content.material_names);
  file.repairs.merged_vertices = content.merged_vertices;
  file.gltf = std::make_shared<const GltfSource>(std::move(content.gltf));
  file.warnings.push_back(name + ": single precision, vertex order not kept");
  for (const std::string& warning : content.warnings) file.warnings.push_back(name + ": " + warning);
  set_mesh(file, content.soup, name);
  return with_joined_seams(std::move(file), name);
}

}  // namespace furrow::io
