// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/gltf_document.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "geometry/mesh/errors.h"
#include "io/base/base64.h"
#include "io/base/byte_order.h"
#include "io/base/nesting.h"
#include "io/mesh/glb_container.h"

namespace furrow::io {

using geometry::ContentError;
using nlohmann::json;

namespace {

std::uint32_t glb_word(std::string_view bytes, std::size_t at) {
  if (bytes.size() < 4 || at > bytes.size() - 4) throw ContentError("it ends too soon");
  return read_in_order<std::uint32_t>(bytes.data() + at, std::endian::little);
}

/// The JSON and the binary chunk of a GLB; a glTF has the first alone.
std::pair<std::string_view, std::string_view> chunks_of(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return {bytes, {}};
  std::pair<std::string_view, std::string_view> chunks;
  for (std::size_t at = 12; at < bytes.size();) {
    const std::size_t length = glb_word(bytes, at), kind = glb_word(bytes, at + 4);
    at += 8;
    if (length > bytes.size() - at) throw ContentError("it ends too soon");
    if (kind == glb_json_chunk && chunks.first.empty()) chunks.first = bytes.substr(at, length);
    if (kind == glb_binary_chunk && chunks.second.empty()) chunks.second = bytes.substr(at, length);
    at += length;
  }
  return chunks;
}

}  // namespace

GltfDocument::GltfDocument(std::string_view bytes, const OpenBeside& open) : open_(open) {
  const auto [text, binary] = chunks_of(bytes);
  if (const auto first = text.find_first_not_of(" \t\r\n"); first == text.npos || text[first] != '{')
    throw ContentError("it is no glTF of version 2, or is damaged where it begins; export it again");
  if (is_nested_too_deep(text)) throw ContentError("its JSON is " + too_deep_text());
  root = json::parse(text);
  chunk = binary;
  if (!root.is_object()) throw ContentError("its JSON is no object");
}

std::string_view GltfDocument::bytes_of(const json& view) {
  const std::string_view buffer = buffer_of(index_in(list_of(root, "buffers"), view.at("buffer")));
  const std::size_t at = count_of(view, "byteOffset"), length = count_of(view, "byteLength");
  if (at > buffer.size() || length > buffer.size() - at)
    throw ContentError("a view reaches beyond its buffer");
  return buffer.substr(at, length);
}

std::string_view GltfDocument::buffer_of(std::size_t number) {
  const std::string uri = root["buffers"][number].value("uri", "");
  if (uri.empty()) return chunk;
  const auto [place, is_new] = buffers_.try_emplace(number);
  if (!is_new) return place->second;
  const std::size_t comma = uri.find(',');
  if (uri.starts_with("data:") && comma != uri.npos) {
    place->second = from_base64(std::string_view(uri).substr(comma + 1));
  } else {
    std::optional<std::string> content = open_(gltf_file_of(uri));
    if (!content) throw ContentError("the buffer '" + uri + "' is not to be had");
    place->second = std::move(*content);
  }
  return place->second;
}

std::string GltfDocument::elements_of(const json& accessor) {
  const std::size_t size = gltf_element_size(accessor);
  const json& view = root["bufferViews"][index_in(list_of(root, "bufferViews"), accessor.at("bufferView"))];
  const std::string_view bytes = bytes_of(view);
  const std::size_t count = count_of(accessor, "count"), at = count_of(accessor, "byteOffset");
  const std::size_t stride = std::max(count_of(view, "byteStride"), size);
  if (count == 0 || at > bytes.size() || bytes.size() - at < size ||
      (count - 1) > (bytes.size() - at - size) / stride)
    throw ContentError("an accessor reaches beyond its view");
  std::string elements;
  for (std::size_t i = 0; i < count; ++i) elements += bytes.substr(at + i * stride, size);
  return elements;
}

std::string GltfDocument::serialized(std::string_view added) {
  if (!added.empty())
    root["buffers"].push_back({{"byteLength", added.size()},
                               {"uri", "data:application/octet-stream;base64," +
                                           to_base64(std::as_bytes(std::span(added.data(), added.size())))}});
  if (chunk.empty()) return root.dump();
  std::string binary(chunk);
  binary.append((4 - binary.size() % 4) % 4, '\0');
  return glb_head(root, binary.size()) + binary;
}

std::size_t gltf_element_size(const json& accessor) {
  static const std::map<int, std::size_t> components = {{5120, 1}, {5121, 1}, {5122, 2},
                                                        {5123, 2}, {5125, 4}, {5126, 4}};
  static const std::map<std::string, std::size_t> widths = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const auto component = components.find(accessor.value("componentType", 0));
  const auto width = widths.find(accessor.value("type", ""));
  return component == components.end() || width == widths.end() ? 0 : component->second * width->second;
}

const json& list_of(const json& from, const char* name) {
  static const json none = json::array();
  const auto found = from.find(name);
  if (found == from.end()) return none;
  if (!found->is_array()) throw ContentError(std::string(name) + " is no list");
  return *found;
}

std::size_t index_in(const json& list, const json& index) {
  if (!index.is_number_unsigned() || index.get<std::size_t>() >= list.size())
    throw ContentError("it names by number what is not there");
  return index.get<std::size_t>();
}

std::size_t count_of(const json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) return 0;
  if (!found->is_number_unsigned()) throw ContentError(std::string(name) + " is no count");
  return found->get<std::size_t>();
}

std::string gltf_file_of(const std::string& uri) {
  const auto digit = [](char c) {
    constexpr std::string_view digits = "0123456789abcdefABCDEF";
    const std::size_t at = digits.find(c);
    return at == digits.npos ? -1 : static_cast<int>(at < 16 ? at : at - 6);
  };
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded =
        uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
    name += coded ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
    if (coded) i += 2;
  }
  return name;
}

}  // namespace furrow::io
