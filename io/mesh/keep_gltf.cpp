// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "geometry/mesh/errors.h"
#include "io/mesh/gltf_document.h"
#include "io/mesh/gltf_nodes.h"

namespace furrow::io {
namespace {

using geometry::ContentError;
using nlohmann::json;

constexpr const char* further_map = "; only two are kept: let those that count be the first";

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
         {"bufferView", "bufferViews", "accessor", "accessors", "primitives", "attributes"})
      if (value.is_object() && key == word) return true;
    if (touches_geometry(inner)) return true;
  }
  return false;
}

/// Copies what is kept out of a document whose geometry is left behind.
class GltfKeeper {
 public:
  GltfKeeper(GltfDocument& document, const OpenBeside& open, const std::vector<GltfMeshNode>& read)
      : open_(open), document_(document) {
    for (const GltfMeshNode& node : read) read_.insert(node.node);
  }

  GltfSource keep() {
    to_ = from_;
    for (const char* list : {"accessors", "bufferViews", "buffers"}) to_.erase(list);
    to_["accessors"] = to_["bufferViews"] = json::array();
    keep_meshes();
    keep_skins();
    keep_animations();
    keep_images();
    keep_materials();
    drop_extensions(to_, "");
    kept_.document = to_.dump();
    return std::move(kept_);
  }

 private:
  void lose(const std::string& what) {
    auto& lost = kept_.lost;
    if (std::ranges::find(lost, what) == lost.end()) lost.push_back(what);
  }

  /// Those that other nodes show, or none, as they are; of the others their names and keys.
  void keep_meshes() {
    std::set<std::size_t> made_anew;
    const json& nodes = list_of(from_, "nodes");
    const auto mesh_of = [&](std::size_t n) { return index_in(list_of(from_, "meshes"), nodes[n]["mesh"]); };
    for (const std::size_t n : read_) made_anew.insert(mesh_of(n));
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (nodes[n].contains("mesh") && !read_.contains(n)) made_anew.erase(mesh_of(n));
    for (std::size_t m = 0; m < list_of(from_, "meshes").size(); ++m) {
      json& mesh = to_["meshes"][m];
      if (made_anew.contains(m))
        leave_keys(mesh, called("mesh", from_["meshes"], m));
      else
        for (std::size_t p = 0; p < list_of(mesh, "primitives").size(); ++p)
          keep_primitive(mesh["primitives"][p]);
    }
  }

  void leave_keys(json& mesh, const std::string& name) {
    json keys = json::array();
    for (const json& primitive : list_of(mesh, "primitives")) {
      tell_lost(primitive, name);
      if (list_of(primitive, "targets").size() > keys.size()) keys = primitive["targets"];
    }
    mesh["primitives"] = {{{"targets", keys}}};
  }

  void keep_primitive(json& primitive) {
    if (primitive.contains("extensions")) primitive["extensions"].erase("KHR_draco_mesh_compression");
    if (primitive.contains("indices")) primitive["indices"] = keep_vertices(primitive["indices"]);
    for (json& number :
         primitive.value("attributes", json::object()).empty() ? none_ : primitive["attributes"])
      number = keep_vertices(number);
    for (std::size_t t = 0; t < list_of(primitive, "targets").size(); ++t)
      for (json& number : primitive["targets"][t]) number = keep_vertices(number);
  }

  /// What our mesh has no place for.
  void tell_lost(const json& primitive, const std::string& mesh) {
    const json attributes = primitive.value("attributes", json::object());
    if (attributes.contains("TEXCOORD_2")) lose("the third UV map of " + mesh + further_map);
    if (attributes.contains("COLOR_1")) lose("the second colours of " + mesh + "; only the first are kept");
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

  void keep_animations() {
    if (!to_.contains("animations")) return;
    for (json& animation : to_["animations"])
      for (std::size_t i = 0; i < list_of(animation, "samplers").size(); ++i)
        for (const char* end : {"input", "output"}) {
          json& sampler = animation["samplers"][i];
          sampler[end] = keep_accessor(sampler.at(end));
        }
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

  /// Textures that lie on other UV maps than the first two go: there is none in what is written.
  void keep_materials() {
    if (!to_.contains("materials")) return;
    for (std::size_t m = 0; m < to_["materials"].size(); ++m)
      drop_further_maps(to_["materials"][m], called("material", to_["materials"], m));
  }

  static std::size_t uv_map_of(const json& texture) {
    std::size_t map = count_of(texture, "texCoord");
    const json moved =
        texture.value("extensions", json::object()).value("KHR_texture_transform", json::object());
    return moved.contains("texCoord") ? count_of(moved, "texCoord") : map;
  }

  void drop_further_maps(json& value, const std::string& material) {
    if (!value.is_object()) return;
    std::vector<std::string> dropped;
    for (auto& [key, inner] : value.items()) {
      if (inner.is_object() && inner.contains("index") && uv_map_of(inner) > 1)
        dropped.push_back(key);
      else
        drop_further_maps(inner, material);
    }
    for (const std::string& key : dropped) {
      lose("the " + key + " of " + material + ", which lies on another UV map than the first two" +
           further_map);
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

  /// The number of the copy of an accessor of vertices: its views as they are, as strides count there.
  std::size_t keep_vertices(const json& number) {
    const std::size_t from = index_in(list_of(from_, "accessors"), number);
    if (const auto known = vertices_.find(from); known != vertices_.end()) return known->second;
    to_["accessors"].push_back(list_of(from_, "accessors")[from]);
    keep_views_in(to_["accessors"].back());
    return vertices_[from] = to_["accessors"].size() - 1;
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
    json view = list_of(from_, "bufferViews")[from];
    view.erase("extensions");  // packed once more, for programs that unpack
    return views_[from] = add_view(document_.bytes_of(view), view);
  }

  std::size_t add_view(std::string_view bytes, const json& like) {
    json view = like.is_object() ? like : json::object();
    std::string& binary = kept_.binary;
    view["buffer"] = 0;
    view["byteOffset"] = binary.size();
    view["byteLength"] = bytes.size();
    binary += bytes;
    binary.append((4 - binary.size() % 4) % 4, '\0');
    to_["bufferViews"].push_back(std::move(view));
    return to_["bufferViews"].size() - 1;
  }

  const OpenBeside& open_;
  GltfDocument& document_;
  const json& from_ = document_.root;
  json to_, none_ = json::object();
  std::set<std::size_t> read_;                                       ///< nodes
  std::map<std::size_t, std::size_t> accessors_, vertices_, views_;  ///< the numbers of copies
  GltfSource kept_;
};

}  // namespace

GltfSource keep_gltf(GltfDocument& document, const OpenBeside& open, const std::vector<GltfMeshNode>& read) {
  try {
    return GltfKeeper(document, open, read).keep();
  } catch (const json::exception& error) {
    throw ContentError(error.what());
  }
}

}  // namespace furrow::io
