// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/ply_rows.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <unordered_set>
#include <utility>

#include "geometry/mesh/errors.h"
#include "io/base/byte_order.h"

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

double number_of(const char* at, PlyType type, std::endian order) {
  switch (type) {
    case PlyType::int8:
      return read_in_order<std::int8_t>(at, order);
    case PlyType::uint8:
      return read_in_order<std::uint8_t>(at, order);
    case PlyType::int16:
      return read_in_order<std::int16_t>(at, order);
    case PlyType::uint16:
      return read_in_order<std::uint16_t>(at, order);
    case PlyType::int32:
      return read_in_order<std::int32_t>(at, order);
    case PlyType::uint32:
      return read_in_order<std::uint32_t>(at, order);
    case PlyType::float32:
      return read_in_order<float>(at, order);
    default:
      return read_in_order<double>(at, order);
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
  std::unordered_set<std::string> names;
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
      if (!names.insert(element.name).second)
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

std::optional<std::size_t> find_column(const PlyElement& element, std::initializer_list<const char*> names,
                                       PlyKind kind) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& p = element.properties[i];
    const bool named = std::ranges::any_of(names, [&](const char* name) { return p.name == name; });
    if (named && p.count_type.has_value() == (kind == PlyKind::list)) return i;
  }
  return std::nullopt;
}

PlyRows::PlyRows(TextScanner in, std::string_view text, PlyEncoding encoding)
    : in_(std::move(in)), size_(text.size()), encoding_(encoding) {
  const bool more = in_.next_line();
  if (encoding != PlyEncoding::ascii && more) bytes_ = text.substr(in_.position());
}

std::size_t PlyRows::bytes_left() const {
  return encoding_ == PlyEncoding::ascii ? size_ - std::min(size_, in_.position()) : bytes_.size();
}

double PlyRows::read_value(PlyType type) {
  if (encoding_ == PlyEncoding::ascii) {
    const std::string_view word = in_.next_word();
    if (word.empty()) fail("the file is cut short");
    if (is_integer(type)) return static_cast<double>(in_.integer(word, "value of a whole-number property"));
    return in_.any_number(word, "value of a property");
  }
  const std::size_t size = size_of(type);
  if (bytes_.size() < size) fail("the file is cut short");
  const auto order = encoding_ == PlyEncoding::big_endian ? std::endian::big : std::endian::little;
  const double value = number_of(bytes_.data(), type, order);
  bytes_.remove_prefix(size);
  return value;
}

void PlyRows::read_list(const PlyProperty& property, std::vector<double>& list) {
  list.clear();
  const double count = read_value(*property.count_type);
  if (count < 0) fail("a list of negative length");
  const std::size_t least = encoding_ == PlyEncoding::ascii ? 1 : size_of(property.type);
  if (count > static_cast<double>(bytes_left() / least))
    fail("a list is longer than the file: it is damaged");
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) list.push_back(read_value(property.type));
}

void PlyRows::read(const PlyElement& element, std::size_t index, PlyRow& row) {
  element_ = &element;
  index_ = index;
  row.numbers.resize(element.properties.size());
  row.lists.resize(element.properties.size());
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& p = element.properties[i];
    if (p.count_type)
      read_list(p, row.lists[i]);
    else
      row.numbers[i] = read_value(p.type);
  }
}

void PlyRows::fail(const std::string& what) const {
  const std::string element = element_ ? element_->name + " " + std::to_string(index_) + ": " : "";
  if (encoding_ == PlyEncoding::ascii) in_.fail(element + what);
  throw geometry::ContentError(in_.name() + ": " + element + what);
}

}  // namespace furrow::io
