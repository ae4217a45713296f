// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/mesh/parts.h"

namespace furrow::geometry {

/// A place where a mesh passes through itself: crossing faces that cross each other or share a vertex.
struct CrossingPlace {
  Point centre{0, 0, 0};       ///< of the box around its faces [m]
  double extent = 0;           ///< longest side of that box [m]
  std::size_t pairs = 0;       ///< that cross here
  std::size_t from_start = 0;  ///< of them, where faces crossed before
  std::array<int, 2> parts{0,
                           0};  ///< of most of its pairs (geometry/mesh/parts.h); equal: one crosses itself
};

struct Crossings {
  std::size_t pairs = 0;              ///< count_self_intersections()
  std::size_t from_start = 0;         ///< of them, of two faces that both have a vertex which was crossed
  std::vector<Face> faces;            ///< that cross another, in ascending order
  std::vector<CrossingPlace> places;  ///< most pairs first
};

/// Where a mesh crosses itself. `crossed`: by vertex index, whether faces at the vertex crossed at an earlier
/// time (crossed_vertices()); vertices beyond its end did not. Errors and cost as count_self_intersections().
Crossings find_crossings(const Mesh& mesh, const Parts& parts, std::span<const char> crossed = {});
/// The same of self_intersections() that are known; `parts` is not asked where there are none.
Crossings find_crossings(const Mesh& mesh, const Parts& parts, std::span<const std::array<Face, 2>> pairs,
                         std::span<const char> crossed);

/// By vertex index, the corners of faces that cross.
std::vector<char> crossed_vertices(const Mesh& mesh, const Crossings& crossings);

}  // namespace furrow::geometry
