// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "physics/base/arrays.h"
#include "physics/base/byte_block.h"

/// Values to bytes and back: visit(archive, value) is one list of a struct's fields for both directions.
namespace furrow::jobs {

/// Writes what it is given.
class Saver {
 public:
  template <class T>
  void operator()(const T& value) {
    if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>)
      out_.put(std::uint32_t(value));
    else
      out_.put(value);
  }
  void count(std::size_t& n) { out_.put(std::uint64_t(n)); }
  std::vector<std::byte> take() { return out_.take(); }

 private:
  physics::ByteWriter out_;
};

/// Fills what it is given; std::invalid_argument where the block is too short for it.
class Loader {
 public:
  explicit Loader(std::span<const std::byte> block) : in_(block) {}
  template <class T>
  void operator()(T& value) {
    if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>)
      value = T(in_.get<std::uint32_t>());
    else
      value = in_.get<T>();
  }
  void count(std::size_t& n) {
    n = std::size_t(in_.get<std::uint64_t>());
    if (n > in_.left()) throw std::invalid_argument("a list is longer than the block");
  }
  std::size_t left() const { return in_.left(); }

 private:
  physics::ByteReader in_;
};

template <class Archive, class T>
requires std::is_arithmetic_v<T>
void visit(Archive& a, T& value) { a(value); }

template <class Archive>
void visit(Archive& a, physics::Vec3& v) {
  for (int i = 0; i < 3; ++i) a(v[i]);
}

/// Of a point or a vector of CGAL, whose coordinates cannot be written to.
template <class Archive, class Triple>
void visit_triple(Archive& a, Triple& p) {
  double x = p.x(), y = p.y(), z = p.z();
  a(x), a(y), a(z);
  p = Triple(x, y, z);
}
template <class Archive>
void visit(Archive& a, geometry::Point& p) {
  visit_triple(a, p);
}
template <class Archive>
void visit(Archive& a, geometry::Vector& v) {
  visit_triple(a, v);
}

template <class Archive, class T, std::size_t N>
void visit(Archive& a, std::array<T, N>& list) {
  for (T& value : list) visit(a, value);
}

/// A text, or a list of any length.
template <class Archive, class List>
requires requires(List& l) { l.resize(1); }
void visit(Archive& a, List& list) {
  std::size_t n = list.size();
  a.count(n);
  list.resize(n);
  for (auto& value : list) visit(a, value);
}

template <class Archive, class T>
void visit(Archive& a, std::optional<T>& value) {
  bool there = value.has_value();
  a(there);
  if (there && !value) value.emplace();
  if (there) visit(a, *value);
}

}  // namespace furrow::jobs
