// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "geometry/mesh/owned.h"

namespace CGAL {
template <class>
class Point_3;
template <class>
class Vector_3;
template <class>
struct Simple_cartesian;
template <class>
class Surface_mesh;
class SM_Vertex_index;
class SM_Halfedge_index;
class SM_Edge_index;
class SM_Face_index;
}  // namespace CGAL

/// The mesh and its parts, declared: what takes or returns them needs no more, and CGAL costs seconds. What
/// touches one includes geometry/mesh/mesh.h.
namespace furrow::geometry {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = CGAL::Point_3<Kernel>;    ///< [m]
using Vector = CGAL::Vector_3<Kernel>;  ///< not zero by default: initialise it
using Mesh = CGAL::Surface_mesh<Point>;
using Vertex = CGAL::SM_Vertex_index;
using Halfedge = CGAL::SM_Halfedge_index;
using Edge = CGAL::SM_Edge_index;
using Face = CGAL::SM_Face_index;

using TextureCoordinate = std::array<double, 2>;  ///< (u, v); NaN = none

extern template class Owned<Mesh>;

/// A Vertex, an Edge or a Face in an option or a report: it converts to and from it where mesh.h is included.
template <class Of>
class Index {
 public:
  Index() = default;  ///< no element
  Index(const Of& of) : number_(of.idx()) {}
  operator Of() const { return Of(number_); }
  std::size_t idx() const { return number_; }
  friend bool operator==(const Index&, const Index&) = default;
  friend auto operator<=>(const Index&, const Index&) = default;
  friend bool operator==(const Index& a, const std::same_as<Of> auto& b) { return Of(a) == b; }

 private:
  std::uint32_t number_ = std::numeric_limits<std::uint32_t>::max();
};

/// A Point or a Vector in an option or a report: it converts to and from it where mesh.h is included.
template <class Of>
class Coordinates {
 public:
  Coordinates() = default;
  Coordinates(double x, double y, double z) : xyz_{x, y, z} {}
  Coordinates(const Of& of) : xyz_{of.x(), of.y(), of.z()} {}
  operator Of() const { return Of(xyz_[0], xyz_[1], xyz_[2]); }
  double x() const { return xyz_[0]; }
  double y() const { return xyz_[1]; }
  double z() const { return xyz_[2]; }
  double operator[](std::size_t i) const { return xyz_[i]; }
  friend bool operator==(const Coordinates&, const Coordinates&) = default;
  friend bool operator==(const Coordinates& a, const std::same_as<Of> auto& b) { return Of(a) == b; }

 private:
  std::array<double, 3> xyz_{};
};

}  // namespace furrow::geometry
