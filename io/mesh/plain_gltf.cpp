// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>
#include <set>

#include "geometry/mesh/errors.h"
#include "io/base/byte_order.h"
#include "io/mesh/glb_container.h"
#include "io/mesh/gltf_document.h"

namespace furrow::io {
namespace {

using geometry::ContentError;
using nlohmann::json;

/// How required extensions begin that say nothing of where vertices are: what they say is kept as it is.
constexpr std::array harmless = {"KHR_mesh_quantization", "KHR_materials_", "KHR_texture_", "EXT_texture_",
                                 "MSFT_texture_",         "KHR_lights_",    "EXT_lights_",  "KHR_xmp"};
constexpr const char* newer_compression = "KHR_meshopt_compression";  // others are undone before

/// What is numbers and may be stored as integers (glTF 2.0, 3.7.2.1, and KHR_mesh_quantization).
bool is_measured(const std::string& attribute) {
  constexpr std::array names = {"POSITION", "NORMAL", "TANGENT", "TEXCOORD_", "COLOR_", "WEIGHTS_"};
  return std::ranges::any_of(names, [&](const char* name) { return attribute.starts_with(name); });
}

/// Source: glTF 2.0, 3.11: c / 255, max(c / 127, -1) …
template <class T>
float number_at(const char* bytes, bool normalized) {
  const auto c = static_cast<float>(read_in_order<T>(bytes, std::endian::little));
  return normalized ? std::max(c / static_cast<float>(std::numeric_limits<T>::max()), -1.0F) : c;
}

float component_at(const char* bytes, int type, bool normalized) {
  switch (type) {
    case 5120:
      return number_at<std::int8_t>(bytes, normalized);
    case 5121:
      return number_at<std::uint8_t>(bytes, normalized);
    case 5122:
      return number_at<std::int16_t>(bytes, normalized);
    case gltf_unsigned_short:
      return number_at<std::uint16_t>(bytes, normalized);
    default:
      return number_at<std::uint32_t>(bytes, normalized);
  }
}

/// Rewrites a document.
class GltfPlainer {
 public:
  GltfPlainer(std::string_view bytes, const OpenBeside& open) : document_(bytes, open) {}

  std::optional<std::string> plain() {
    check_required();
    for (json& mesh : lists("meshes"))
      for (json& primitive : lists("primitives", mesh)) make_plain(primitive);
    for (json& skin : lists("skins"))
      if (!skin.contains("inverseBindMatrices")) add_identities(skin);
    if (floats_.empty() && !changed_) return std::nullopt;
    return document_.serialized(floats_);
  }

 private:
  /// An empty list where there is none.
  json& lists(const char* name) { return lists(name, document_.root); }
  json& lists(const char* name, json& object) {
    if (list_of(object, name).empty()) return none_;
    return object[name];
  }

  void check_required() {
    for (const json& one : list_of(document_.root, "extensionsRequired")) {
      const auto name = one.get<std::string>();
      const auto begins = [&](const char* known) { return name.starts_with(known); };
      if (std::ranges::any_of(harmless, begins)) continue;
      throw ContentError("it needs the extension " + name + ", which is not read; " +
                         (name == newer_compression ? "undo it by gltf-transform cp packed.glb plain.glb"
                                                    : "export the file again without it"));
    }
  }

  void make_plain(json& primitive) {
    if (const auto found = primitive.find("extensions"); found != primitive.end())
      changed_ = found->erase("KHR_draco_mesh_compression") > 0 || changed_;  // the plain data are there, too
    if (!primitive.contains("attributes")) return;
    for (const auto& [name, number] : primitive["attributes"].items())
      if (is_measured(name)) make_floats(index_in(list_of(document_.root, "accessors"), number));
  }

  void make_floats(std::size_t number) {
    json& accessor = document_.root["accessors"][number];
    const int type = accessor.at("componentType").get<int>();
    if (type == gltf_float) return;
    if (gltf_element_size(accessor) == 0) throw ContentError("an accessor is of no known type");
    if (accessor.contains("sparse") || !accessor.contains("bufferView"))
      throw ContentError("sparse integers are not read; export the file again with floats");
    const std::string elements = document_.elements_of(accessor);
    const std::size_t width = gltf_element_size(json{{"componentType", 5121}, {"type", accessor["type"]}}),
                      size = gltf_element_size(accessor) / width;
    const bool normalized = accessor.value("normalized", false);
    const std::size_t begin = floats_.size();
    for (std::size_t at = 0; at < elements.size(); at += size)
      append_in_order(floats_, component_at(&elements[at], type, normalized), std::endian::little);
    for (const char* key : {"byteOffset", "normalized", "min", "max"}) accessor.erase(key);
    accessor["componentType"] = gltf_float;
    accessor["bufferView"] = add_view(begin);
  }

  /// None are given: all are the identity (glTF 2.0, 3.7.3.1).
  void add_identities(json& skin) {
    const std::size_t joints = list_of(skin, "joints").size(), begin = floats_.size();
    for (std::size_t i = 0; i < 16 * joints; ++i)
      append_in_order(floats_, i % 16 % 5 == 0 ? 1.0F : 0.0F, std::endian::little);
    json accessor{{"componentType", gltf_float}, {"count", joints}, {"type", "MAT4"}};
    accessor["bufferView"] = add_view(begin);
    skin["inverseBindMatrices"] = list_of(document_.root, "accessors").size();
    document_.root["accessors"].push_back(std::move(accessor));
  }

  /// Of the floats from there on.
  std::size_t add_view(std::size_t begin) {
    const std::size_t buffer = list_of(document_.root, "buffers").size(), length = floats_.size() - begin;
    json& views = document_.root["bufferViews"];
    views.push_back({{"buffer", buffer}, {"byteOffset", begin}, {"byteLength", length}});
    return views.size() - 1;
  }

  GltfDocument document_;
  json none_ = json::array();
  std::string floats_;  ///< of the buffer that is added
  bool changed_ = false;
};

}  // namespace

std::optional<std::string> plain_gltf(std::string_view bytes, const OpenBeside& open) {
  try {
    return GltfPlainer(bytes, open).plain();
  } catch (const json::exception& error) {
    throw ContentError(error.what());
  }
}

}  // namespace furrow::io
