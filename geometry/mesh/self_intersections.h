// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// Number of pairs of faces that cross or touch each other and share no vertex, decided exactly for the given
/// coordinates. Vertices at exactly the same position count as one (seams that are parted in the file would
/// touch themselves everywhere). Faces without area are left out.
/// Throws ContentError if a position is not finite or a face no triangle, or if more than 2e7 pairs, and 200
/// a face, have overlapping boxes: faces that all share one edge would take quadratic time. Cost: O(n log n +
/// candidate pairs): overlapping boxes, then exact predicates.
std::size_t count_self_intersections(const Mesh& mesh);

/// Those pairs: the lower face first, in ascending order. Errors and cost as above.
std::vector<std::array<Face, 2>> self_intersections(const Mesh& mesh);

/// The pairs of the mesh that was last asked for. Several threads may share one.
struct CrossingMemory {
  std::mutex mutex;
  std::vector<Point> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<std::size_t, 2>> pairs;  ///< of triangles
};

/// self_intersections() of a mesh of which most is as the last one was: only pairs of which one face is new
/// or lies elsewhere are looked for.
std::vector<std::array<Face, 2>> self_intersections(const Mesh& mesh, CrossingMemory& memory);

/// The same count for plain arrays; `triangles` index `points`. Throws ContentError for an index out of range
/// too.
std::size_t count_self_intersections(std::span<const Point> points,
                                     std::span<const std::array<int, 3>> triangles);

}  // namespace furrow::geometry
