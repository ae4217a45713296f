// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/base/text_scanner.h"

/// PLY as a format: the header and, element by element, rows of numbers. What they mean is ply_reader's.
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

/// One element of a PLY file: a number for each of its properties (0 for lists), a list for each list.
struct PlyRow {
  std::vector<double> numbers;
  std::vector<std::vector<double>> lists;
};

/// The index of the element's first property of one of these names; nothing if it has none, or if that
/// property is a list where none is wanted, or the other way round.
enum class PlyKind { number, list };
std::optional<std::size_t> find_column(const PlyElement& element, std::initializer_list<const char*> names,
                                       PlyKind kind);

/// Reads a file's elements one row after the other, from text or bytes.
class PlyRows {
 public:
  /// `in` stands at the end of the header; `text` is the whole file.
  PlyRows(TextScanner in, std::string_view text, PlyEncoding encoding);

  /// Reads the next row of this element into `row`.
  void read(const PlyElement& element, std::size_t index, PlyRow& row);

  /// Throws geometry::ContentError with the line, or in binary files the element, that was read last.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  double read_value(PlyType type);
  void read_list(const PlyProperty& property, std::vector<double>& list);
  std::size_t bytes_left() const;

  TextScanner in_;
  std::string_view bytes_;  ///< what is left of a binary file
  std::size_t size_;
  PlyEncoding encoding_;
  const PlyElement* element_ = nullptr;
  std::size_t index_ = 0;
};

}  // namespace furrow::io
