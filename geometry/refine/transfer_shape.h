// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

#include "geometry/mesh/mesh_fwd.h"

namespace furrow::geometry {

struct TransferOptions {
  double max_distance = 0.02;  ///< of an original vertex from the wrinkled mesh's rest surface [m]; > 0
};

struct TransferReport {
  std::size_t copied = 0;        ///< vertices that the wrinkled mesh still has
  std::size_t by_index = 0;      ///< vertices that Loop subdivision moved, found again by their index
  std::size_t interpolated = 0;  ///< vertices that took the shape of the closest rest point
  std::size_t unchanged = 0;     ///< of either kind: position kept bit for bit
  double max_distance = 0;       ///< largest distance of an interpolated one from the rest surface [m]
};

/// Brings the shape of a wrinkled, finer and perhaps simulated mesh back to the mesh that it was made of:
/// moves the vertices of `original` and changes nothing else, so that topology and attributes stay exact.
/// `wrinkled` knows by attribute::rest_position where each vertex came from. Where nothing moved, positions
/// keep their bits. Throws std::invalid_argument for max_distance; ContentError, `original` unchanged, if
/// `wrinkled` has no rest positions, or a vertex is farther than max_distance from the rest surface. O(n log
/// n).
/// \details A vertex of the same index whose rest position is the original position (insertion only appends
/// vertices) is copied. If the wrinkled mesh begins with the original's vertices where one to four Loop
/// subdivisions put them, each follows that vertex, its offset turned with a face there. Any other (of
/// another mesh of the same garment) goes to the closest point q of the rest surface, whose corners' wrinkled
/// positions are interpolated; the offset of the vertex from q is turned with q's triangle. Vertices without
/// faces that are not copied stay.
TransferReport transfer_shape(Mesh& original, const Mesh& wrinkled, const TransferOptions& options = {});

}  // namespace furrow::geometry
