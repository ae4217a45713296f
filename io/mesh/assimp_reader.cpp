// SPDX-License-Identifier: GPL-3.0-or-later
// The only source that knows assimp.
#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "geometry/mesh/errors.h"
#include "io/base/bytes_file.h"
#include "io/base/child_process.h"
#include "io/base/lower_case.h"
#include "io/base/name_table.h"
#include "io/mesh/file_frame.h"
#include "io/mesh/gltf_source.h"
#include "io/mesh/merge_points.h"
#include "io/mesh/mesh_readers.h"
#include "io/mesh/soup_bytes.h"
#include "io/mesh/weld.h"

namespace furrow::io {
namespace {

using namespace geometry;
using Transform = aiMatrix4x4t<double>;

constexpr std::size_t most_kept = std::size_t{256} << 20;  // of a file beside its geometry [bytes]
constexpr double same_place = 1e-5;  // of entries of transforms: inverse bind matrices are single precision

bool agree(const Transform& a, const Transform& b) {
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column)
      if (!(std::abs(a[row][column] - b[row][column]) <= same_place)) return false;
  return true;
}

/// From a joint's own frame to the scene's.
Transform place_of(const aiNode* node) {
  Transform place;
  for (; node; node = node->mParent) place = Transform(node->mTransformation) * place;
  return place;
}

std::size_t depth_of(const aiNode* node) {
  std::size_t depth = 0;
  for (; node->mParent; node = node->mParent) ++depth;
  return depth;
}

/// Where a skin puts a mesh.
struct BindPose {
  Transform place;     ///< of all of it, by the joint nearest to the root
  bool moved = false;  ///< whether other joints stand otherwise: the file shows another pose
};

/// The joints alone place a skinned mesh: its node's transform does not count (glTF 2.0, 3.7.3.3). What a
/// joint does to the mesh is its place times its inverse bind matrix, the same for all in the bind pose.
std::optional<BindPose> bind_pose(const aiScene& scene, const aiMesh& mesh) {
  std::optional<BindPose> pose;
  std::size_t least = 0;
  std::vector<Transform> all;
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiNode* joint = scene.mRootNode->FindNode(mesh.mBones[b]->mName);
    if (!joint) continue;
    all.push_back(place_of(joint) * Transform(mesh.mBones[b]->mOffsetMatrix));
    const std::size_t depth = depth_of(joint);
    if (pose && depth >= least) continue;
    pose = BindPose{all.back()};
    least = depth;
  }
  if (!pose) return std::nullopt;
  for (const Transform& place : all) pose->moved = pose->moved || !agree(place, pose->place);
  if (agree(pose->place, Transform())) pose->place = Transform();
  return pose;
}

class SceneReader {
 public:
  /// `kept`: the same file's content beside its geometry; null: none.
  SceneReader(const aiScene& scene, const ReadOptions& options, KeptGltf* kept)
      : scene_(scene), options_(options), kept_(kept) {}

  SoupFile read() {
    std::vector<std::pair<const aiNode*, Transform>> open = {{scene_.mRootNode, Transform()}};
    while (!open.empty()) {
      const auto [node, parent] = open.back();
      open.pop_back();
      if (!node) continue;
      const Transform transform = parent * Transform(node->mTransformation);
      if (node->mNumMeshes > 0) read_node(*node, transform);
      for (unsigned c = node->mNumChildren; c-- > 0;) open.emplace_back(node->mChildren[c], transform);
    }
    const auto is_none = [](const TextureCoordinate& t) { return std::isnan(t[0]); };
    if (std::ranges::all_of(out_.soup.textures, is_none)) out_.soup.textures.clear();
    if (!has_colors_) out_.soup.colors.clear();
    for (SoupAttribute& weights : out_.soup.attributes) weights.values.resize(out_.soup.points.size(), 0);
    if (kept_) out_.gltf = source();
    return std::move(out_);
  }

 private:
  /// All meshes of a node (glTF: its primitives) share the points of equal position.
  void read_node(const aiNode& node, const Transform& transform) {
    PointNumbers numbers;
    const std::size_t base = out_.soup.points.size();
    const int group = groups_.index(node.mName.length ? node.mName.C_Str() : "mesh");
    const GltfMeshNode* origin = origin_of(node);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) throw ContentError("a node names a mesh that is not there");
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      const Transform place = place_of_mesh(mesh, node, transform);
      const std::vector<std::size_t> points = read_points(mesh, place, numbers, base);
      read_weights(mesh, points);
      read_faces(mesh, points, group, material_of(mesh, origin, i), place.Determinant() < 0);
      if (i == 0) note_place(group, origin, place);
    }
  }

  /// assimp walks the tree in the file's order: the next node with a mesh and that name.
  const GltfMeshNode* origin_of(const aiNode& node) {
    if (!kept_) return nullptr;
    const auto& all = kept_->mesh_nodes;
    for (std::size_t n = next_origin_; n < all.size(); ++n)
      if (all[n].name.empty() || all[n].name == node.mName.C_Str()) {
        next_origin_ = n + 1;
        return &all[n];
      }
    return nullptr;
  }

  void note_place(int group, const GltfMeshNode* origin, const Transform& place) {
    places_.resize(out_.group_names.size());
    GltfSource::Place& noted = places_[group];
    if (noted.node >= 0 && origin)
      kept_->source.lost.push_back(
          "of nodes of the same name, '" + out_.group_names[group] +
          "', the others: all their faces are written to the first; give them names");
    if (noted.node >= 0 || !origin) return;
    noted.node = origin->node;
    for (unsigned i = 0; i < 16; ++i) noted.to_scene[i] = place[i / 4][i % 4];
  }

  /// A name for each material of the file, also where two have the same.
  int material_of(const aiMesh& mesh, const GltfMeshNode* origin, unsigned primitive) {
    const std::string name = mesh.mMaterialIndex < scene_.mNumMaterials
                                 ? scene_.mMaterials[mesh.mMaterialIndex]->GetName().C_Str()
                                 : "";
    const bool known = origin && primitive < origin->materials.size() && origin->materials[primitive] >= 0;
    if (!known) return materials_.index(name);
    const int source = origin->materials[primitive];
    if (const auto found = numbers_.find(source); found != numbers_.end()) return found->second;
    std::string own = kept_->material_names.at(source);
    if (own.empty()) own = "material";
    std::string unique = own;
    for (int copy = 2; std::ranges::find(out_.material_names, unique) != out_.material_names.end(); ++copy)
      unique = own + " (" + std::to_string(copy) + ")";
    return numbers_[source] = materials_.index(unique);
  }

  GltfSource source() {
    GltfSource source = std::move(kept_->source);
    if (!hard_points_.empty())
      source.lost.push_back("the hard edges at " + std::to_string(hard_points_.size()) +
                            " vertices: all normals are smooth; mark edges as sharp again");
    places_.resize(out_.group_names.size());
    source.places = std::move(places_);
    source.materials.assign(out_.material_names.size(), -1);
    for (const auto& [from, to] : numbers_) source.materials[to] = from;
    return source;
  }

  /// Its node's transform, or, of a skinned mesh, that of its bind pose.
  Transform place_of_mesh(const aiMesh& mesh, const aiNode& node, const Transform& transform) {
    const std::optional<BindPose> pose = bind_pose(scene_, mesh);
    if (!pose) return transform;
    if (pose->moved)
      out_.warnings.push_back(
          std::string(node.mName.C_Str()) +
          ": its skeleton stands in another pose than it was bound in; read as it was bound");
    return agree(pose->place, transform) ? transform : pose->place;
  }

  std::vector<std::size_t> read_points(const aiMesh& mesh, const Transform& transform, PointNumbers& numbers,
                                       std::size_t base) {
    std::vector<std::size_t> points(mesh.mNumVertices);
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& raw = mesh.mVertices[v];
      const aiVector3t<double> p = transform * aiVector3t<double>(raw.x, raw.y, raw.z);
      const auto point = from_file(p.x, p.y, p.z, options_);
      if (!point) throw ContentError(bad_coordinate);
      const auto [index, is_new] = numbers.number(*point);
      points[v] = base + index;
      const aiVector3D normal = mesh.HasNormals() ? mesh.mNormals[v] : aiVector3D();
      if (!is_new) {
        ++out_.merged_vertices;
        note_hard_edge(points[v], normal);
        continue;
      }
      normals_.push_back(normal);
      out_.soup.points.push_back(*point);
      out_.soup.colors.push_back(attribute::color.default_value);
      if (!mesh.HasVertexColors(0)) continue;
      const aiColor4D& c = mesh.mColors[0][v];
      out_.soup.colors.back() = {c.r, c.g, c.b, c.a};
      has_colors_ = true;
    }
    return points;
  }

  /// Where two normals of a point that is one now are more than 8 degrees apart.
  void note_hard_edge(std::size_t point, const aiVector3D& normal) {
    const aiVector3D& first = normals_[point];
    const float lengths = first.Length() * normal.Length();
    if (lengths > 0 && first * normal < 0.99F * lengths) hard_points_.insert(point);
  }

  /// A skin's joints become attributes "weight_<joint>"; of points merged into one, the first with weights
  /// counts. (The positions are those of the bind pose.)
  void read_weights(const aiMesh& mesh, const std::vector<std::size_t>& points) {
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      const std::string name = weight_attribute(bone.mName.C_Str());
      std::vector<double>& values = weights_of(name);
      for (unsigned i = 0; i < bone.mNumWeights; ++i) {
        const aiVertexWeight& weight = bone.mWeights[i];
        if (weight.mVertexId >= points.size() || !(weight.mWeight >= 0) || std::isinf(weight.mWeight))
          throw ContentError("joint " + name + " has a weight that cannot be used; repair the file");
        const std::size_t point = points[weight.mVertexId];
        const std::pair source(&mesh, weight.mVertexId);
        if (taken_from_.emplace(point, source).first->second != source) continue;
        values.resize(std::max(values.size(), point + 1), 0);
        values[point] = weight.mWeight;
      }
    }
  }

  std::vector<double>& weights_of(const std::string& name) {
    for (SoupAttribute& attribute : out_.soup.attributes)
      if (attribute.name == name) return attribute.values;
    return out_.soup.attributes.emplace_back(SoupAttribute{name, {}}).values;
  }

  void read_faces(const aiMesh& mesh, const std::vector<std::size_t>& points, int group, int material,
                  bool mirrored) {
    PolygonSoup& soup = out_.soup;
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices < 3) continue;  // points and lines
      for (unsigned k = 0; k < face.mNumIndices; ++k) {
        const unsigned v = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
        if (v >= points.size()) throw ContentError("a face names a vertex that is not there");
        soup.corners.push_back(points[v]);
        TextureCoordinate t = attribute::texture.default_value;
        if (mesh.HasTextureCoords(0)) t = {mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y};
        soup.textures.push_back(t);
      }
      soup.close_face();
      soup.groups.push_back(group);
      soup.materials.push_back(material);
    }
  }

  const aiScene& scene_;
  ReadOptions options_;
  KeptGltf* kept_;
  std::size_t next_origin_ = 0;
  std::vector<GltfSource::Place> places_;
  std::vector<aiVector3D> normals_;  // by point: of its first vertex
  std::set<std::size_t> hard_points_;
  std::map<int, int> numbers_;  // of the file's materials, among the mesh's
  SoupFile out_;
  NameTable groups_{out_.group_names}, materials_{out_.material_names};
  std::map<std::size_t, std::pair<const aiMesh*, unsigned>> taken_from_;  // whose weights a point has
  bool has_colors_ = false;
};

/// assimp drops faces with bad indices and says so in its log only.
class Warnings : public Assimp::LogStream {
 public:
  explicit Warnings(std::vector<std::string>& messages) : messages_(messages) {}
  void write(const char* message) override {
    std::string_view text = message;
    if (const auto mark = text.find(": "); mark != text.npos) text.remove_prefix(mark + 2);  // "Warn,  T0: "
    while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
    if (messages_.size() < 10 && !text.starts_with("Validation")) messages_.emplace_back(text);
    if (text.find("out-of-range") != text.npos) damage_ = true;
  }
  bool damage() const { return damage_; }

 private:
  std::vector<std::string>& messages_;
  bool damage_ = false;
};

/// Opens ordinary files in a file's own folder, or below it: a file from elsewhere may name any other.
class OwnFolder : public Assimp::DefaultIOSystem {
 public:
  explicit OwnFolder(const std::filesystem::path& file)
      : file_(as_glb(file).string()), folder_(folder_of(file)) {}
  /// The name under which assimp reads the file: it knows no ending of a GLB but its own.
  static std::filesystem::path as_glb(std::filesystem::path file) {
    return ending_of(file) == ".vrm" ? file.replace_extension(".glb") : file;
  }
  /// Gives these bytes in place of the file's.
  void put_in_place(std::string bytes) { in_place_ = std::move(bytes); }

  bool Exists(const char* path) const override {
    return (in_place_ && path == file_) || (is_own(path) && Assimp::DefaultIOSystem::Exists(path));
  }
  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (in_place_ && path == file_)
      return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(in_place_->data()),
                                        in_place_->size());
    if (is_own(path)) return Assimp::DefaultIOSystem::Open(path, mode);
    refused_ = path;
    return nullptr;
  }
  const std::string& refused() const { return refused_; }  ///< the last one; empty: none
  /// The content of a file that is named from there.
  std::optional<std::string> content(const std::string& name) const {
    const std::string path = (folder_ / name).string();
    if (!is_own(path.c_str())) return std::nullopt;
    return read_text(path);
  }

 private:
  static std::filesystem::path folder_of(const std::filesystem::path& file) {
    return std::filesystem::canonical(std::filesystem::absolute(file)).parent_path();
  }
  bool is_own(const char* path) const {
    std::error_code fault;
    const auto real = std::filesystem::canonical(path, fault);
    if (fault || !std::filesystem::is_regular_file(real, fault)) return false;
    return std::mismatch(folder_.begin(), folder_.end(), real.begin(), real.end()).first == folder_.end();
  }

  std::string file_;
  std::filesystem::path folder_;
  std::optional<std::string> in_place_;
  std::string refused_;
};

/// Ten seconds, and one more for each megabyte; a gigabyte, and twenty times the file.
ChildLimits limits_for(std::size_t file_size) {
  ChildLimits limits;
  limits.cpu_seconds = 10 + static_cast<unsigned>(file_size >> 20);
  limits.memory_bytes += 20 * file_size;
  return limits;
}

/// What a writer of GLB needs of the file. A file that assimp reads and we do not is one that keeps nothing.
std::optional<KeptGltf> keep_beside(const std::string& bytes, const OwnFolder& folder,
                                    std::vector<std::string>& lost) {
  std::string reason;
  try {
    KeptGltf kept = keep_gltf(bytes, [&](const std::string& name) { return folder.content(name); });
    if (kept.source.document.size() <= most_kept && kept.source.binary.size() <= most_kept) return kept;
    reason = "more than 256 MiB of pictures and motion";
  } catch (const ContentError& error) {
    reason = error.what();
  } catch (const std::bad_alloc&) {
    reason = "too large to be kept";
  }
  lost = {"materials, pictures, skeleton and motion of the file that was read (" + reason +
          "); export it again, smaller or repaired"};
  return std::nullopt;
}

/// Runs in the child: the logger is the child's own.
std::string import(const std::filesystem::path& path, std::string bytes, const ReadOptions& options) {
  std::vector<std::string> messages;
  auto* warnings = new Warnings(messages);  // the logger's from here
  Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0)
      ->attachStream(warnings, Assimp::Logger::Warn | Assimp::Logger::Err);
  Assimp::Importer importer;
  auto* folder = new OwnFolder(path);  // the importer's from here
  importer.SetIOHandler(folder);
  const std::filesystem::path name = OwnFolder::as_glb(path);
  if (name != path) folder->put_in_place(bytes);
  const OpenBeside open = [&](const std::string& name) { return folder->content(name); };
  if (std::optional<std::string> unpacked = unpack_gltf(bytes, open)) {
    bytes = std::move(*unpacked);
    folder->put_in_place(bytes);
  }
  std::vector<std::string> shown;
  if (std::optional<std::string> plain = plain_gltf(bytes, open, shown))
    folder->put_in_place(std::move(*plain));
  const aiScene* scene = importer.ReadFile(name.string(), aiProcess_ValidateDataStructure);
  if (!scene && !folder->refused().empty())
    throw ContentError("it names '" + folder->refused() +
                       "', which is no file in its folder or below; lay the file there");
  if (!scene && std::string(importer.GetErrorString()) == "std::bad_alloc") throw std::bad_alloc();
  if (!scene && std::string(importer.GetErrorString()).find("No suitable reader") != std::string::npos)
    throw ContentError("it is no glTF of version 2, or is damaged where it begins; export it again");
  if (!scene) throw ContentError(importer.GetErrorString());
  if (warnings->damage()) throw ContentError("a face names a vertex that is not there; repair the file");
  std::vector<std::string> lost;
  std::optional<KeptGltf> kept = keep_beside(bytes, *folder, lost);
  SoupFile file = SceneReader(*scene, options, kept ? &*kept : nullptr).read();
  if (!kept) file.gltf.lost = lost;
  file.warnings.insert(file.warnings.end(), shown.begin(), shown.end());
  for (std::string& message : messages) file.warnings.push_back("assimp: " + std::move(message));
  return to_bytes(file);
}

}  // namespace

MeshFile read_gltf(const std::filesystem::path& path, const ReadOptions& options) {
  const std::string name = path.string();
  const std::string bytes = read_text(path);
  if (bytes.empty()) throw ContentError(name + ": the file is empty");
  MeshFile file;
  SoupFile content;
  try {
    content =
        soup_from_bytes(run_in_child([&] { return import(path, bytes, options); }, limits_for(bytes.size())));
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
