// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstring>

#include "geometry/mesh/attribute_register.h"

/// Every registered attribute on one mesh, and comparisons.
namespace furrow::tests {

/// visit(attribute) for every attribute of the register.
template <class Visit>
void for_each_attribute(Visit&& visit) {
  std::apply([&](const auto&... a) { (visit(a), ...); }, geometry::attribute_register);
}

/// A value of many digits for element i that is in every range and no default.
template <class Value>
Value value_at(std::size_t i) {
  const double x = 1 / (3.0 + static_cast<double>(i));
  if constexpr (std::is_same_v<Value, geometry::TextureCoordinate>)
    return {x, 1 - x};
  else if constexpr (std::is_same_v<Value, geometry::Color>)
    return {x, 1 - x, x * x, 0.5 + x};
  else if constexpr (std::is_same_v<Value, bool>)
    return i % 3 != 1;
  else if constexpr (std::is_same_v<Value, int>)
    return static_cast<int>(i) + 1;
  else if constexpr (std::is_same_v<Value, double>)
    return x;
  else
    return {x, 2 * x, 1 - x};  // vectors and rest positions
}

inline bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (a != a && b != b); }
inline bool same(int a, int b) { return a == b; }
inline bool same(bool a, bool b) { return a == b; }
inline bool same(const geometry::Vector& a, const geometry::Vector& b) {
  return same(a.x(), b.x()) && same(a.y(), b.y()) && same(a.z(), b.z());
}
template <std::size_t n>
bool same(const std::array<double, n>& a, const std::array<double, n>& b) {
  for (std::size_t k = 0; k < n; ++k)
    if (!same(a[k], b[k])) return false;
  return true;
}

/// All elements of one kind.
template <class Key>
auto keys_of(const geometry::Mesh& mesh) {
  if constexpr (std::is_same_v<Key, geometry::Vertex>)
    return mesh.vertices();
  else if constexpr (std::is_same_v<Key, geometry::Edge>)
    return mesh.edges();
  else if constexpr (std::is_same_v<Key, geometry::Halfedge>)
    return mesh.halfedges();
  else
    return mesh.faces();
}

/// Adds every registered map and sets value_at(index) everywhere, but in halfedges without a face.
inline void fill_attributes(geometry::Mesh& mesh) {
  for_each_attribute([&]<class K, class V>(const geometry::Attribute<K, V>& attribute) {
    auto map = ensure_map(mesh, attribute);
    for (const K key : keys_of<K>(mesh)) {
      if constexpr (std::is_same_v<K, geometry::Halfedge>)
        if (mesh.is_border(key)) continue;
      map[key] = value_at<V>(key.idx());
    }
  });
}

}  // namespace furrow::tests
