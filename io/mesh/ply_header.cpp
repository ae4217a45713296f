// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/ply_header.h"

#include <array>
#include <utility>

namespace furrow::io {
namespace {

PlyType read_type(TextScanner& in) {
  constexpr std::array<std::pair<const char*, PlyType>, 16> types = {{{"char", PlyType::int8},
                                                                      {"int8", PlyType::int8},
                                                                      {"uchar", PlyType::uint8},
                                                                      {"uint8", PlyType::uint8},
                                                                      {"short", PlyType::int16},
                                                                      {"int16", PlyType::int16},
                                                                      {"ushort", PlyType::uint16},
                                                                      {"uint16", PlyType::uint16},
                                                                      {"int", PlyType::int32},
                                                                      {"int32", PlyType::int32},
                                                                      {"uint", PlyType::uint32},
                                                                      {"uint32", PlyType::uint32},
                                                                      {"float", PlyType::float32},
                                                                      {"float32", PlyType::float32},
                                                                      {"double", PlyType::float64},
                                                                      {"float64", PlyType::float64}}};
  const std::string_view word = in.word();
  for (const auto& [name, type] : types)
    if (word == name) return type;
  in.fail(in_quotes(word) +
          " is no type of a property; char, uchar, short, ushort, int, uint, float, double are");
}

PlyEncoding read_encoding(TextScanner& in) {
  const std::string_view word = in.word();
  if (word == "ascii") return PlyEncoding::ascii;
  if (word == "binary_little_endian") return PlyEncoding::little_endian;
  if (word == "binary_big_endian") return PlyEncoding::big_endian;
  in.fail("unknown format " + in_quotes(word) +
          "; ascii, binary_little_endian and binary_big_endian are read");
}

PlyElement read_element(TextScanner& in) {
  PlyElement element{std::string(in.word()), 0, {}, in.line()};
  const std::int64_t count = in.integer(in.word(), "number of elements");
  if (count < 0) in.fail("a negative number of elements; correct it");
  element.count = static_cast<std::size_t>(count);
  return element;
}

PlyProperty read_property(TextScanner& in) {
  PlyProperty property;
  TextScanner ahead = in;
  if (ahead.word() == "list") {
    in = ahead;
    property.count_type = read_type(in);
    if (!is_integer(*property.count_type)) in.fail("the length of a list must be of a whole-number type");
  }
  property.type = read_type(in);
  property.name = in.word();
  if (property.name.empty()) in.fail("a property without a name; add one");
  return property;
}

void check_counts(const PlyHeader& header, const TextScanner& in, std::size_t file_size) {
  for (const PlyElement& element : header.elements) {
    const std::size_t least = element.smallest_size(header.encoding);
    if (least > 0 && element.count > file_size / least)
      in.fail("the header announces " + std::to_string(element.count) + " of '" + element.name + "' (line " +
              std::to_string(element.line) + "), more than the file can hold; it is cut short or damaged");
  }
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

std::size_t PlyElement::smallest_size(PlyEncoding encoding) const {
  std::size_t bytes = 0;
  for (const PlyProperty& p : properties)
    bytes += encoding == PlyEncoding::ascii ? 2 : size_of(p.count_type.value_or(p.type));
  return bytes;
}

PlyHeader read_ply_header(TextScanner& in, std::size_t file_size) {
  PlyHeader header;
  bool has_format = false;
  if (!in.next_line() || in.word() != "ply") in.fail("the first line is not 'ply': this is no PLY file");
  while (in.next_line()) {
    const std::string_view word = in.word();
    if (word == "end_header") {
      if (!has_format) in.fail("no line 'format' in the header; add it");
      check_counts(header, in, file_size);
      return header;
    }
    if (word == "format") {
      header.encoding = read_encoding(in);
      has_format = true;
    } else if (word == "comment") {
      header.comments.emplace_back(in.rest_of_line());
    } else if (word == "element") {
      PlyElement element = read_element(in);
      for (const PlyElement& other : header.elements)
        if (other.name == element.name)
          in.fail("a second element " + in_quotes(element.name) + "; remove it");
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      if (header.elements.empty()) in.fail("a property before the first element; move it");
      header.elements.back().properties.push_back(read_property(in));
    } else if (word != "obj_info" && !word.empty()) {
      in.fail("unknown word " + in_quotes(word) + " in the header; remove the line");
    }
  }
  in.fail("the header has no end_header: the file is cut short");
}

}  // namespace furrow::io
