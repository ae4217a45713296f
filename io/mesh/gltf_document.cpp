// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/gltf_document.h"

#include <algorithm>
#include <cstdint>
#include <limits>
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

constexpr std::size_t most_numbers = std::size_t{1} << 28;  // of an accessor

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

std::uint32_t whole_number_at(const char* bytes, int type) {
  if (type == 5121) return read_in_order<std::uint8_t>(bytes, std::endian::little);
  if (type == gltf_unsigned_short) return read_in_order<std::uint16_t>(bytes, std::endian::little);
  if (type == gltf_unsigned_int) return read_in_order<std::uint32_t>(bytes, std::endian::little);
  throw ContentError("an accessor's indices are of no known type");
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
    if (!content)
      throw ContentError("it names '" + uri +
                         "', which is no file in its folder or below; lay the file there");
    place->second = std::move(*content);
  }
  return place->second;
}

std::string GltfDocument::elements_of(const json& accessor) {
  const std::size_t size = gltf_element_size(accessor);
  if (size == 0) throw ContentError("an accessor is of no known type");
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

const json& GltfDocument::accessor(const json& number) const {
  const json& accessors = list_of(root, "accessors");
  return accessors[index_in(accessors, number)];
}

std::vector<float> GltfDocument::numbers_of(const json& accessor) {
  const int type = accessor.at("componentType").get<int>();
  const std::size_t count = count_of(accessor, "count"), width = gltf_width(accessor),
                    step = gltf_element_size(accessor) / width;
  if (step == 0) throw ContentError("an accessor is of no known type");
  if (count > most_numbers / width) throw ContentError("an accessor has too many elements");
  const auto decoded = [&](const std::string& bytes) {
    std::vector<float> numbers;
    for (std::size_t at = 0; at < bytes.size(); at += step)
      numbers.push_back(component_at(&bytes[at], type, accessor.value("normalized", false)));
    return numbers;
  };
  std::vector<float> numbers;
  if (accessor.contains("bufferView")) numbers = decoded(elements_of(accessor));
  numbers.resize(count * width, 0);
  const json sparse = accessor.value("sparse", json::object());
  if (sparse.empty()) return numbers;
  json at = sparse.at("indices"), values = sparse.at("values");
  at.update({{"type", "SCALAR"}, {"count", sparse.at("count")}});
  values.update({{"type", accessor.at("type")}, {"componentType", type}, {"count", sparse.at("count")}});
  const std::vector<std::uint32_t> elements = whole_numbers_of(at);
  const std::vector<float> given = decoded(elements_of(values));
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (elements[i] >= count) throw ContentError("an accessor names an element that it does not have");
    std::copy_n(&given[i * width], width, &numbers[elements[i] * width]);
  }
  return numbers;
}

std::vector<std::uint32_t> GltfDocument::whole_numbers_of(const json& accessor) {
  const int type = accessor.at("componentType").get<int>();
  const std::string bytes = elements_of(accessor);
  const std::size_t step = gltf_element_size(accessor) / gltf_width(accessor);
  std::vector<std::uint32_t> numbers;
  for (std::size_t at = 0; step > 0 && at < bytes.size(); at += step)
    numbers.push_back(whole_number_at(&bytes[at], type));
  return numbers;
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

std::size_t gltf_width(const json& accessor) {
  static const std::map<std::string, std::size_t> widths = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const auto width = widths.find(accessor.value("type", ""));
  if (width == widths.end()) throw ContentError("an accessor is of no known type");
  return width->second;
}

std::size_t gltf_element_size(const json& accessor) {
  static const std::map<int, std::size_t> components = {{5120, 1}, {5121, 1}, {5122, 2},
                                                        {5123, 2}, {5125, 4}, {5126, 4}};
  const auto component = components.find(accessor.value("componentType", 0));
  return component == components.end() ? 0 : component->second * gltf_width(accessor);
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
