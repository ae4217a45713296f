// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

#include "io/mesh/ply_header.h"

namespace furrow::io {

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
