// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/text_scanner.h"

namespace furrow::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyEncoding { ascii, little_endian, big_endian };

std::size_t size_of(PlyType type);  ///< [bytes]
inline bool is_integer(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::int32;
  std::optional<PlyType> count_type;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  std::size_t line = 0;  ///< of its declaration

  std::size_t smallest_size(PlyEncoding encoding) const;  ///< [bytes] that one takes at least
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;
};

/// Reads up to the line end_header; the scanner stands at that line's end. Throws geometry::ContentError with
/// the line; no element may announce more than could stand in `file_size` bytes.
PlyHeader read_ply_header(TextScanner& in, std::size_t file_size);

}  // namespace furrow::io
