// SPDX-License-Identifier: GPL-3.0-or-later
// The only source that knows Draco and meshoptimizer.
#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/mesh/errors.h"
#include "io/base/byte_order.h"
#include "io/mesh/glb_container.h"
#include "io/mesh/gltf_document.h"

namespace furrow::io {
namespace {

using geometry::ContentError;
using nlohmann::json;

constexpr const char* draco_name = "KHR_draco_mesh_compression";
constexpr const char* meshopt_name = "EXT_meshopt_compression";
constexpr std::size_t most_bytes = std::size_t{1} << 30;  // of a view
constexpr const char* damaged = " data that are damaged; pack the file again";

/// Values of an attribute, by point, as numbers of the type T in the file's byte order.
template <class T>
void append_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, std::size_t width,
                   std::string& out) {
  std::array<T, 16> values{};
  for (draco::PointIndex p(0); p < mesh.num_points(); ++p) {
    if (!attribute.ConvertValue<T>(attribute.mapped_index(p), static_cast<std::int8_t>(width), values.data()))
      throw ContentError(std::string("it has Draco") + damaged);
    for (std::size_t k = 0; k < width; ++k) append_in_order(out, values[k], std::endian::little);
  }
}

void append_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, const json& accessor,
                   std::string& out) {
  const std::size_t width = gltf_width(accessor);
  switch (accessor.at("componentType").get<int>()) {
    case 5120:
      return append_values<std::int8_t>(mesh, attribute, width, out);
    case 5121:
      return append_values<std::uint8_t>(mesh, attribute, width, out);
    case 5122:
      return append_values<std::int16_t>(mesh, attribute, width, out);
    case gltf_unsigned_short:
      return append_values<std::uint16_t>(mesh, attribute, width, out);
    case gltf_unsigned_int:
      return append_values<std::uint32_t>(mesh, attribute, width, out);
    default:
      return append_values<float>(mesh, attribute, width, out);
  }
}

/// How a view is packed by meshoptimizer.
struct PackedView {
  std::string_view bytes;
  std::size_t count = 0, stride = 0;  ///< of elements, and of the bytes of each
  std::string mode, filter;
};

/// Whether the library may be asked: it takes other strides for errors of the program.
bool is_possible(const PackedView& view) {
  if (view.count == 0 || view.stride == 0 || view.count > most_bytes / view.stride) return false;
  const bool of_indices = view.stride == 2 || view.stride == 4;
  if (view.mode == "TRIANGLES") return of_indices && view.count % 3 == 0;
  if (view.mode == "INDICES") return of_indices;
  if (view.mode != "ATTRIBUTES" || view.stride % 4 != 0 || view.stride > 256) return false;
  if (view.filter == "OCTAHEDRAL") return view.stride == 4 || view.stride == 8;
  if (view.filter == "QUATERNION") return view.stride == 8;
  return view.filter == "EXPONENTIAL" || view.filter == "NONE";
}

/// Source: EXT_meshopt_compression, Vendor extension of Khronos, 2022.
std::string unpacked(const PackedView& view) {
  std::string out;
  if (is_possible(view)) out.resize(view.count * view.stride);
  const auto* bytes = reinterpret_cast<const unsigned char*>(view.bytes.data());
  int fault = out.empty();
  if (!fault && view.mode == "TRIANGLES")
    fault = meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, bytes, view.bytes.size());
  else if (!fault && view.mode == "INDICES")
    fault = meshopt_decodeIndexSequence(out.data(), view.count, view.stride, bytes, view.bytes.size());
  else if (!fault)
    fault = meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, bytes, view.bytes.size());
  if (fault) throw ContentError(std::string("it has meshopt") + damaged);
  if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), view.count, view.stride);
  if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
  if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), view.count, view.stride);
  return out;
}

/// Rewrites a document.
class GltfUnpacker {
 public:
  GltfUnpacker(std::string_view bytes, const OpenBeside& open) : document_(bytes, open) {}

  std::optional<std::string> unpack() {
    const json& required = list_of(document_.root, "extensionsRequired");
    const auto needs = [&](const char* name) {
      return std::ranges::find(required, json(name)) != required.end();
    };
    const bool has_draco = needs(draco_name), has_meshopt = needs(meshopt_name);
    if (!has_draco && !has_meshopt) return std::nullopt;
    if (has_meshopt) unpack_views();
    if (has_draco) unpack_primitives();
    for (const char* list : {"extensionsRequired", "extensionsUsed"}) {
      json left = json::array();
      for (const json& name : list_of(document_.root, list))
        if (name != draco_name && name != meshopt_name) left.push_back(name);
      left.empty() ? void(document_.root.erase(list)) : void(document_.root[list] = left);
    }
    return document_.serialized(added_);
  }

 private:
  /// What an object has of that extension, taken out; none: null.
  static json taken(json& object, const char* name) {
    json none;
    const auto extensions = object.is_object() ? object.find("extensions") : object.end();
    if (!object.is_object() || extensions == object.end() || !extensions->contains(name)) return none;
    json content = (*extensions)[name];
    extensions->erase(name);
    if (extensions->empty()) object.erase("extensions");
    return content;
  }

  void unpack_views() {
    for (std::size_t v = 0; v < list_of(document_.root, "bufferViews").size(); ++v) {
      const json packed = taken(document_.root["bufferViews"][v], meshopt_name);
      if (packed.is_null()) continue;
      const std::string plain =
          unpacked({document_.bytes_of(packed), count_of(packed, "count"), count_of(packed, "byteStride"),
                    packed.value("mode", ""), packed.value("filter", "NONE")});
      json& view = document_.root["bufferViews"][v];
      view.update(place_of(plain));
    }
    const std::size_t buffers = list_of(document_.root, "buffers").size();
    for (std::size_t b = 0; b < buffers; ++b)  // where a reader without the extension would find it all
      if (json& buffer = document_.root["buffers"][b]; !taken(buffer, meshopt_name).is_null())
        if (!buffer.contains("uri"))
          buffer = {{"byteLength", 1}, {"uri", "data:application/octet-stream;base64,AA=="}};
  }

  void unpack_primitives() {
    for (std::size_t m = 0; m < list_of(document_.root, "meshes").size(); ++m) {
      json& mesh = document_.root["meshes"][m];
      for (std::size_t p = 0; p < list_of(mesh, "primitives").size(); ++p)
        if (const json packed = taken(mesh["primitives"][p], draco_name); !packed.is_null())
          unpack_primitive(packed, mesh["primitives"][p]);
    }
  }

  /// Source: KHR_draco_mesh_compression: its attributes by name are unique ids of those in the data.
  void unpack_primitive(const json& packed, json& primitive) {
    const json& views = list_of(document_.root, "bufferViews");
    const std::string_view bytes = document_.bytes_of(views[index_in(views, packed.at("bufferView"))]);
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) throw ContentError(std::string("it has Draco") + damaged);
    const draco::Mesh& mesh = *decoded.value();
    for (const auto& [name, id] : packed.at("attributes").items()) {
      const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(id.get<std::uint32_t>());
      if (!attribute) throw ContentError("its Draco data have no attribute for " + name);
      json& accessor = accessor_of(primitive.at("attributes").at(name));
      std::string values;
      append_values(mesh, *attribute, accessor, values);
      fill(accessor, mesh.num_points(), values);
    }
    std::string corners;
    for (draco::FaceIndex f(0); f < mesh.num_faces(); ++f)
      for (const draco::PointIndex& p : mesh.face(f))
        append_in_order(corners, p.value(), std::endian::little);
    if (!primitive.contains("indices")) {
      primitive["indices"] = list_of(document_.root, "accessors").size();
      document_.root["accessors"].push_back({{"type", "SCALAR"}});
    }
    json& indices = accessor_of(primitive["indices"]);
    indices["componentType"] = gltf_unsigned_int;
    fill(indices, 3 * std::size_t{mesh.num_faces()}, corners);
    primitive["mode"] = 4;
  }

  json& accessor_of(const json& number) {
    return document_.root["accessors"][index_in(list_of(document_.root, "accessors"), number)];
  }

  /// With elements of its own.
  void fill(json& accessor, std::size_t count, std::string_view elements) {
    json view = place_of(elements);
    json& views = document_.root["bufferViews"];
    accessor["count"] = count;
    accessor["bufferView"] = views.size();
    for (const char* key : {"byteOffset", "sparse"}) accessor.erase(key);
    views.push_back(std::move(view));
  }

  /// Where bytes lie that are added, as a view has it.
  json place_of(std::string_view bytes) {
    added_.append((4 - added_.size() % 4) % 4, '\0');
    json place{{"buffer", list_of(document_.root, "buffers").size()},
               {"byteOffset", added_.size()},
               {"byteLength", bytes.size()}};
    added_ += bytes;
    return place;
  }

  GltfDocument document_;
  std::string added_;  ///< the buffer that is added
};

}  // namespace

std::optional<std::string> unpack_gltf(std::string_view bytes, const OpenBeside& open) {
  try {
    return GltfUnpacker(bytes, open).unpack();
  } catch (const json::exception& error) {
    throw ContentError(error.what());
  }
}

}  // namespace furrow::io
