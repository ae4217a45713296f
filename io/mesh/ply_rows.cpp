// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mesh/ply_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "geometry/mesh/errors.h"

namespace furrow::io {
namespace {

template <class T>
double number_of(std::string_view bytes, bool swapped) {
  std::array<char, sizeof(T)> raw;
  std::copy_n(bytes.begin(), sizeof(T), raw.begin());
  if (swapped) std::reverse(raw.begin(), raw.end());
  return static_cast<double>(std::bit_cast<T>(raw));
}

double number_of(std::string_view bytes, PlyType type, bool swapped) {
  switch (type) {
    case PlyType::int8:
      return number_of<std::int8_t>(bytes, swapped);
    case PlyType::uint8:
      return number_of<std::uint8_t>(bytes, swapped);
    case PlyType::int16:
      return number_of<std::int16_t>(bytes, swapped);
    case PlyType::uint16:
      return number_of<std::uint16_t>(bytes, swapped);
    case PlyType::int32:
      return number_of<std::int32_t>(bytes, swapped);
    case PlyType::uint32:
      return number_of<std::uint32_t>(bytes, swapped);
    case PlyType::float32:
      return number_of<float>(bytes, swapped);
    default:
      return number_of<double>(bytes, swapped);
  }
}

}  // namespace

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
  const bool file_is_big = encoding_ == PlyEncoding::big_endian;
  const double value =
      number_of(bytes_.substr(0, size), type, file_is_big != (std::endian::native == std::endian::big));
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
