// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/mesh/gltf_source.h"

namespace furrow::io {

/// A glTF or GLB file taken apart: its JSON, and the bytes that this names. All throw geometry::ContentError
/// for what contradicts itself, nlohmann::json::exception for what is no glTF.
class GltfDocument {
 public:
  /// Both must outlive it.
  GltfDocument(std::string_view bytes, const OpenBeside& open);

  nlohmann::json root;     ///< an object
  std::string_view chunk;  ///< the binary one of a GLB

  std::string_view bytes_of(const nlohmann::json& view);
  /// The elements of an accessor with a view and a known size, side by side.
  std::string elements_of(const nlohmann::json& accessor);
  /// The accessor of that number.
  const nlohmann::json& accessor(const nlohmann::json& number) const;
  /// Its elements side by side, as the numbers that they stand for: normalised integers as shares, and sparse
  /// ones in their places. Those that no view has are 0.
  std::vector<float> numbers_of(const nlohmann::json& accessor);
  /// The same of one whose elements are whole numbers.
  std::vector<std::uint32_t> whole_numbers_of(const nlohmann::json& accessor);
  /// The file, as root now says, with these bytes as one more buffer where there are any.
  std::string serialized(std::string_view added);

 private:
  std::string_view buffer_of(std::size_t number);

  const OpenBeside& open_;
  std::map<std::size_t, std::string> buffers_;
};

/// How many numbers an element of an accessor has. Throws for a type that there is not.
std::size_t gltf_width(const nlohmann::json& accessor);

/// Of an element [bytes]; 0 where a component is of no known type, or an element's parts are padded.
std::size_t gltf_element_size(const nlohmann::json& accessor);

/// A list of the document; an empty one where it has none.
const nlohmann::json& list_of(const nlohmann::json& from, const char* name);

std::size_t index_in(const nlohmann::json& list, const nlohmann::json& index);

/// 0 where the object does not have it.
std::size_t count_of(const nlohmann::json& object, const char* name);

struct GltfMeshNode;
/// All of a document but the geometry that is read, that of these nodes: without places and materials. Files
/// that it names are put into the binary.
GltfSource keep_gltf(GltfDocument& document, const OpenBeside& open, const std::vector<GltfMeshNode>& read);

/// The file that a URI names: "%20" is a blank.
std::string gltf_file_of(const std::string& uri);

}  // namespace furrow::io
