// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "geometry/mesh/errors.h"
#include "io/mesh/gltf_document.h"

namespace furrow::io {
namespace {

using geometry::ContentError;
using nlohmann::json;

constexpr const char* second_map = "; only the first is kept: let the one that counts be the first";

std::string image_type(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return "image/png";
  if (bytes.starts_with("\xFF\xD8\xFF")) return "image/jpeg";
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "image/webp";
  if (bytes.starts_with("\xABKTX 20")) return "image/ktx2";
  return {};
}

/// "skin 'Rig'", or "skin 0" where it has no name.
std::string called(const char* what, const json& list, std::size_t i) {
  const std::string name = list[i].value("name", "");
  return std::string(what) + " " + (name.empty() ? std::to_string(i) : "'" + name + "'");
}

/// Whether what an extension says points into what is made anew.
bool touches_geometry(const json& value) {
  if (!value.is_structured()) return false;
  for (const auto& [key, inner] : value.items()) {
    for (const char* word :
         {"bufferView", "bufferViews", "accessor", "accessors", "mesh", "meshes", "primitives", "attributes"})
      if (value.is_object() && key == word) return true;
    if (touches_geometry(inner)) return true;
  }
  return false;
}

/// Takes out what names shape keys in VRM 1.0 (VRMC_vrm, expressions); whether there was any.
bool drop_key_binds(json& value) {
  if (!value.is_structured()) return false;
  bool dropped = value.is_object() && value.erase("morphTargetBinds") > 0;
  for (json& inner : value) dropped = drop_key_binds(inner) || dropped;
  return dropped;
}

/// Copies what is kept out of a document whose geometry is left behind.
class GltfKeeper {
 public:
  GltfKeeper(std::string_view bytes, const OpenBeside& open) : open_(open), document_(bytes, open) {}

  KeptGltf keep() {
    to_ = from_;
    for (const char* list : {"meshes", "accessors", "bufferViews", "buffers"}) to_.erase(list);
    to_["accessors"] = to_["bufferViews"] = json::array();
    keep_scene();
    keep_nodes();
    keep_mesh_names();
    keep_skins();
    keep_animations();
    keep_images();
    keep_materials();
    drop_extensions(to_, "");
    kept_.source.document = to_.dump();
    return std::move(kept_);
  }

 private:
  void lose(const std::string& what) {
    auto& lost = kept_.source.lost;
    if (std::ranges::find(lost, what) == lost.end()) lost.push_back(what);
  }

  /// The one that is read, and of it the nodes that have a mesh.
  void keep_scene() {
    const json& scenes = list_of(from_, "scenes");
    if (scenes.empty()) throw ContentError("it has no scene");
    const std::size_t shown = from_.contains("scene") ? index_in(scenes, from_["scene"]) : 0;
    if (scenes.size() > 1)
      lose("only " + called("scene", scenes, shown) + " of its " + std::to_string(scenes.size()) +
           " scenes; the others stay in the file that was read");
    to_["scenes"] = json::array({scenes[shown]});
    to_["scene"] = 0;
    std::set<std::size_t> seen;
    for (const json& root : list_of(scenes[shown], "nodes")) walk(root, seen);
  }

  void walk(const json& number, std::set<std::size_t>& seen) {
    const json& nodes = list_of(from_, "nodes");
    std::vector<std::size_t> open = {index_in(nodes, number)};
    while (!open.empty()) {
      const std::size_t n = open.back();
      open.pop_back();
      if (!seen.insert(n).second) throw ContentError("its nodes are no tree");
      if (nodes[n].contains("mesh")) add_mesh_node(n);
      const json& children = list_of(nodes[n], "children");
      for (std::size_t c = children.size(); c-- > 0;) open.push_back(index_in(nodes, children[c]));
    }
  }

  void add_mesh_node(std::size_t n) {
    const json& node = list_of(from_, "nodes")[n];
    const json& mesh = list_of(from_, "meshes")[index_in(list_of(from_, "meshes"), node["mesh"])];
    GltfMeshNode& found = kept_.mesh_nodes.emplace_back();
    found.node = static_cast<int>(n);
    found.name = node.value("name", "");
    for (const json& primitive : list_of(mesh, "primitives"))
      found.materials.push_back(
          primitive.contains("material")
              ? static_cast<int>(index_in(list_of(from_, "materials"), primitive["material"]))
              : -1);
  }

  void keep_nodes() {
    if (!to_.contains("nodes")) return;
    std::set<std::size_t> read;
    for (const GltfMeshNode& node : kept_.mesh_nodes) read.insert(static_cast<std::size_t>(node.node));
    for (std::size_t n = 0; n < to_["nodes"].size(); ++n) {
      json& node = to_["nodes"][n];
      node.erase("weights");
      if (node.contains("skin")) index_in(list_of(from_, "skins"), node["skin"]);
      if (!node.contains("mesh") || read.contains(n)) continue;
      lose("the mesh of " + called("node", to_["nodes"], n) + ", which is in no scene that is read");
      node.erase("mesh"), node.erase("skin");
    }
  }

  void keep_mesh_names() {
    json names = json::array();
    for (const json& mesh : list_of(from_, "meshes")) {
      json& name = names.emplace_back(json::object());
      for (const char* key : {"name", "extras"})
        if (mesh.contains(key)) name[key] = mesh[key];
      if (name.contains("extras") && name["extras"].is_object()) name["extras"].erase("targetNames");
      for (const json& primitive : list_of(mesh, "primitives"))
        tell_lost(primitive, called("mesh", from_["meshes"], names.size() - 1));
    }
    if (!names.empty()) to_["meshes"] = std::move(names);
  }

  /// What our mesh has no place for.
  void tell_lost(const json& primitive, const std::string& mesh) {
    const json attributes = primitive.value("attributes", json::object());
    if (primitive.contains("targets"))
      lose("the shape keys (morph targets) of " + mesh +
           "; the add-on for Blender puts results beside them, as keys of their own (docs/blender.md)");
    if (attributes.contains("TEXCOORD_1")) lose("the second UV map of " + mesh + second_map);
    if (attributes.contains("COLOR_1")) lose("the second colours of " + mesh + second_map);
    for (const auto& [name, accessor] : attributes.items())
      if (name.starts_with("_")) lose("the attribute " + name + " of " + mesh + "; a PLY keeps such");
    if (primitive.value("mode", 4) < 4) lose("the points and lines of " + mesh + ", which are not read");
    const json extensions = primitive.value("extensions", json::object());
    for (const auto& [name, content] : extensions.items())
      if (name != "KHR_draco_mesh_compression")
        lose("what the extension " + name + " says of " + mesh + "; add it where the file is used");
  }

  void keep_skins() {
    const json& nodes = list_of(from_, "nodes");
    if (!to_.contains("skins")) return;
    for (json& skin : to_["skins"]) {
      for (const json& joint : list_of(skin, "joints")) index_in(nodes, joint);
      if (skin.contains("skeleton")) index_in(nodes, skin["skeleton"]);
      if (skin.contains("inverseBindMatrices"))
        skin["inverseBindMatrices"] = keep_accessor(skin["inverseBindMatrices"]);
    }
  }

  /// All but the weights of morph targets.
  void keep_animations() {
    json animations = json::array();
    for (json animation : list_of(from_, "animations")) {
      json channels = json::array();
      for (const json& channel : list_of(animation, "channels")) {
        const bool of_weights = channel.value("target", json::object()).value("path", "") == "weights";
        if (!of_weights) channels.push_back(channel);
      }
      if (channels.size() < list_of(animation, "channels").size())
        lose("the motion of shape keys in animation '" + animation.value("name", "") +
             "'; the add-on for Blender leaves it in place (docs/blender.md)");
      if (channels.empty()) continue;
      animation["channels"] = channels;
      keep_samplers(animation);
      animations.push_back(std::move(animation));
    }
    animations.empty() ? void(to_.erase("animations")) : void(to_["animations"] = std::move(animations));
  }

  /// Those that a channel uses, in their order.
  void keep_samplers(json& animation) {
    const json samplers = list_of(animation, "samplers");
    std::map<std::size_t, std::size_t> numbers;
    json kept = json::array();
    for (const json& channel : animation["channels"])
      numbers.emplace(index_in(samplers, channel.at("sampler")), 0);
    for (auto& [from, to] : numbers) {
      to = kept.size();
      json& sampler = kept.emplace_back(samplers[from]);
      for (const char* end : {"input", "output"}) sampler[end] = keep_accessor(sampler.at(end));
    }
    for (json& channel : animation["channels"])
      channel["sampler"] = numbers.at(channel["sampler"].get<std::size_t>());
    animation["samplers"] = std::move(kept);
  }

  void keep_images() {
    if (!to_.contains("images")) return;
    for (std::size_t i = 0; i < to_["images"].size(); ++i) {
      json& image = to_["images"][i];
      if (image.contains("bufferView")) image["bufferView"] = keep_view(image["bufferView"]);
      const std::string uri = image.value("uri", "");
      if (uri.empty() || uri.starts_with("data:")) continue;
      const std::optional<std::string> content = open_(gltf_file_of(uri));
      const std::string type = content ? image_type(*content) : "";
      if (type.empty()) {
        lose("the picture of " + called("image", to_["images"], i) + ": '" + uri +
             "' is named as before, but is no picture in the folder of the file that was read; lay it there");
        continue;
      }
      if (!image.contains("name")) image["name"] = gltf_file_of(uri);
      image.erase("uri");
      image["mimeType"] = type;
      image["bufferView"] = add_view(*content, {});
    }
  }

  /// Textures that lie on other UV maps than the first go: there is none in what is written.
  void keep_materials() {
    if (!to_.contains("materials")) return;
    for (std::size_t m = 0; m < to_["materials"].size(); ++m) {
      kept_.material_names.push_back(to_["materials"][m].value("name", ""));
      drop_second_maps(to_["materials"][m], called("material", to_["materials"], m));
    }
  }

  static std::size_t uv_map_of(const json& texture) {
    std::size_t map = count_of(texture, "texCoord");
    const json moved =
        texture.value("extensions", json::object()).value("KHR_texture_transform", json::object());
    return moved.contains("texCoord") ? count_of(moved, "texCoord") : map;
  }

  void drop_second_maps(json& value, const std::string& material) {
    if (!value.is_object()) return;
    std::vector<std::string> dropped;
    for (auto& [key, inner] : value.items()) {
      if (inner.is_object() && inner.contains("index") && uv_map_of(inner) > 0)
        dropped.push_back(key);
      else
        drop_second_maps(inner, material);
    }
    for (const std::string& key : dropped) {
      lose("the " + key + " of " + material + ", which lies on another UV map than the first" + second_map);
      value.erase(key);
    }
  }

  void drop_extensions(json& value, const std::string& inside) {
    if (!value.is_structured()) return;
    if (value.is_object() && value.contains("extensions") && value["extensions"].is_object()) {
      std::vector<std::string> dropped;
      for (const auto& [name, content] : value["extensions"].items())
        if (touches_geometry(content)) dropped.push_back(name);
      for (const std::string& name : dropped) {
        lose("what the extension " + name + " says of " + (inside.empty() ? "the file" : inside) +
             "; add it where the file is used");
        value["extensions"].erase(name);
      }
      if (drop_key_binds(value["extensions"]))
        lose("the shape keys of expressions (VRM); add them where the file is used");
      if (value["extensions"].empty()) value.erase("extensions");
    }
    for (auto& [key, inner] : value.items())
      if (key != "extras") drop_extensions(inner, value.is_array() ? inside : key);
  }

  /// The number of the accessor's copy, its elements side by side.
  std::size_t keep_accessor(const json& number) {
    const std::size_t from = index_in(list_of(from_, "accessors"), number);
    if (const auto known = accessors_.find(from); known != accessors_.end()) return known->second;
    json accessor = list_of(from_, "accessors")[from];
    const std::size_t size = gltf_element_size(accessor);
    if (accessor.contains("sparse") || accessor.contains("extensions") || size == 0) {
      keep_views_in(accessor);
    } else if (accessor.contains("bufferView")) {
      const std::string elements = document_.elements_of(accessor);
      accessor.erase("byteOffset");
      accessor["bufferView"] = add_view(elements, {});
    }
    to_["accessors"].push_back(std::move(accessor));
    return accessors_[from] = to_["accessors"].size() - 1;
  }

  void keep_views_in(json& value) {
    if (value.contains("bufferView")) value["bufferView"] = keep_view(value["bufferView"]);
    for (const char* part : {"sparse", "indices", "values"})
      if (value.contains(part) && value[part].is_object()) keep_views_in(value[part]);
  }

  /// The number of a view's copy, byte for byte.
  std::size_t keep_view(const json& number) {
    const std::size_t from = index_in(list_of(from_, "bufferViews"), number);
    if (const auto known = views_.find(from); known != views_.end()) return known->second;
    const json& view = list_of(from_, "bufferViews")[from];
    if (view.contains("extensions")) throw ContentError("a view that is kept is compressed");
    return views_[from] = add_view(document_.bytes_of(view), view);
  }

  std::size_t add_view(std::string_view bytes, const json& like) {
    json view = like.is_object() ? like : json::object();
    std::string& binary = kept_.source.binary;
    view["buffer"] = 0;
    view["byteOffset"] = binary.size();
    view["byteLength"] = bytes.size();
    binary += bytes;
    binary.append((4 - binary.size() % 4) % 4, '\0');
    to_["bufferViews"].push_back(std::move(view));
    return to_["bufferViews"].size() - 1;
  }

  const OpenBeside& open_;
  GltfDocument document_;
  const json& from_ = document_.root;
  json to_;
  std::map<std::size_t, std::size_t> accessors_, views_;  ///< the numbers of copies
  KeptGltf kept_;
};

}  // namespace

KeptGltf keep_gltf(std::string_view bytes, const OpenBeside& open) {
  try {
    return GltfKeeper(bytes, open).keep();
  } catch (const json::exception& error) {
    throw ContentError(error.what());
  }
}

std::string weight_attribute(const std::string& joint) {
  std::string name = "weight_" + joint;
  for (char& c : name)
    if (static_cast<unsigned char>(c) <= ' ') c = '_';
  return name;
}

}  // namespace furrow::io
