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
constexpr std::size_t most_numbers = std::size_t{1} << 28;            // of an accessor
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
    case gltf_float:
      return read_in_order<float>(bytes, std::endian::little);
    default:
      return number_at<std::uint32_t>(bytes, normalized);
  }
}

std::size_t index_at(const char* bytes, int type) {
  if (type == 5121) return read_in_order<std::uint8_t>(bytes, std::endian::little);
  if (type == gltf_unsigned_short) return read_in_order<std::uint16_t>(bytes, std::endian::little);
  if (type == gltf_unsigned_int) return read_in_order<std::uint32_t>(bytes, std::endian::little);
  throw ContentError("an accessor's indices are of no known type");
}

/// Rewrites a document.
class GltfPlainer {
 public:
  GltfPlainer(std::string_view bytes, const OpenBeside& open, std::vector<std::string>& warnings)
      : document_(bytes, open), warnings_(warnings) {}

  std::optional<std::string> plain() {
    check_required();
    for (std::size_t m = 0; m < list_of(document_.root, "meshes").size(); ++m) {
      json& mesh = document_.root["meshes"][m];
      const std::vector<float> keys = shown_keys(m);
      const bool shows = std::ranges::any_of(keys, [](float weight) { return weight != 0; });
      if (shows) tell_shown(mesh, keys);
      for (json& primitive : lists("primitives", mesh)) {
        if (shows) show_keys(primitive, keys);
        make_plain(primitive);
      }
    }
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
      if (is_measured(name)) make_floats(accessor_of(number));
  }

  json& accessor_of(const json& number) {
    return document_.root["accessors"][index_in(list_of(document_.root, "accessors"), number)];
  }

  void make_floats(json& accessor) {
    if (accessor.at("componentType").get<int>() != gltf_float) store(numbers_of(accessor), accessor);
  }

  /// How far each shape key of a mesh is shown: the weights of a node with it override its own.
  std::vector<float> shown_keys(std::size_t mesh) {
    json weights = list_of(document_.root["meshes"][mesh], "weights");
    for (const json& node : list_of(document_.root, "nodes"))
      if (node.contains("mesh") && node["mesh"] == mesh && node.contains("weights"))
        weights = list_of(node, "weights");
    return weights.get<std::vector<float>>();
  }

  /// The shape that the file shows: POSITION and the targets by their weights (glTF 2.0, 3.7.2.2).
  void show_keys(json& primitive, const std::vector<float>& weights) {
    const json targets = list_of(primitive, "targets");
    const json position = primitive.value("attributes", json::object()).value("POSITION", json());
    if (targets.empty() || position.is_null()) return;
    std::vector<float> points = numbers_of(accessor_of(position));
    for (std::size_t k = 0; k < std::min(targets.size(), weights.size()); ++k) {
      if (weights[k] == 0 || !targets[k].contains("POSITION")) continue;
      const std::vector<float> moves = numbers_of(accessor_of(targets[k]["POSITION"]));
      if (moves.size() != points.size()) throw ContentError("a shape key has not the vertices of its mesh");
      for (std::size_t i = 0; i < points.size(); ++i) points[i] += weights[k] * moves[i];
    }
    json shown = accessor_of(position);  // others may share the accessor
    shown.erase("sparse");
    store(points, shown);
    primitive["attributes"]["POSITION"] = list_of(document_.root, "accessors").size();
    document_.root["accessors"].push_back(std::move(shown));
  }

  void tell_shown(const json& mesh, const std::vector<float>& weights) {
    const json extras = mesh.value("extras", json::object());
    const json& names = list_of(extras, "targetNames");
    std::string list;
    for (std::size_t k = 0; k < weights.size(); ++k)
      if (weights[k] != 0)
        list += (list.empty() ? "" : ", ") +
                (k < names.size() ? "'" + names[k].get<std::string>() + "'" : "number " + std::to_string(k));
    warnings_.push_back("mesh '" + mesh.value("name", "") + "' shows shape keys (" + list +
                        "); its shape with them is read");
  }

  /// The elements of an accessor, side by side; those that no view has are 0.
  std::vector<float> numbers_of(const json& accessor) {
    const int type = accessor.at("componentType").get<int>();
    const std::size_t size = gltf_element_size(accessor), count = count_of(accessor, "count"),
                      width = gltf_element_size(json{{"componentType", 5121}, {"type", accessor.at("type")}});
    if (size == 0) throw ContentError("an accessor is of no known type");
    if (count > most_numbers / width) throw ContentError("an accessor has too many elements");
    const auto decoded = [&](const std::string& bytes) {
      std::vector<float> numbers;
      const std::size_t step = size / width;
      for (std::size_t at = 0; at < bytes.size(); at += step)
        numbers.push_back(component_at(&bytes[at], type, accessor.value("normalized", false)));
      return numbers;
    };
    std::vector<float> numbers(count * width);
    if (accessor.contains("bufferView")) numbers = decoded(document_.elements_of(accessor));
    const json sparse = accessor.value("sparse", json::object());
    if (sparse.empty()) return numbers;
    json at = sparse.at("indices"), values = sparse.at("values");
    at.update({{"type", "SCALAR"}, {"count", sparse.at("count")}});
    values.update({{"type", accessor.at("type")}, {"componentType", type}, {"count", sparse.at("count")}});
    const std::string indices = document_.elements_of(at);
    const std::vector<float> given = decoded(document_.elements_of(values));
    const std::size_t step = gltf_element_size(at);
    for (std::size_t i = 0; i * width < given.size(); ++i) {
      const std::size_t element = index_at(&indices[i * step], at.at("componentType").get<int>());
      if (element >= count) throw ContentError("an accessor names an element that it does not have");
      std::copy_n(&given[i * width], width, &numbers[element * width]);
    }
    return numbers;
  }

  /// As the accessor's elements from now on.
  void store(const std::vector<float>& numbers, json& accessor) {
    const std::size_t begin = floats_.size();
    for (const float number : numbers) append_in_order(floats_, number, std::endian::little);
    for (const char* key : {"byteOffset", "normalized", "min", "max", "sparse"}) accessor.erase(key);
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
  std::vector<std::string>& warnings_;
  std::string floats_;  ///< of the buffer that is added
  bool changed_ = false;
};

}  // namespace

std::optional<std::string> plain_gltf(std::string_view bytes, const OpenBeside& open,
                                      std::vector<std::string>& warnings) {
  try {
    return GltfPlainer(bytes, open, warnings).plain();
  } catch (const json::exception& error) {
    throw ContentError(error.what());
  }
}

}  // namespace furrow::io
