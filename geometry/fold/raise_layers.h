// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// What lay over cloth that lines raised.
struct RaisedLayers {
  std::size_t vertices = 0;  ///< that went along
  double most = 0;           ///< [m]
};

/// Raises other layers of cloth with the folds below them, so that these do not come through. The mesh is one
/// whose lines were raised from the places `undisplaced` (by vertex). A vertex that lies over a raised face
/// goes along by what that is raised by: in full up to as far off as that, and not beyond three times as far.
/// Where a coarse layer spans a fold its corners rise until the face clears it. What lies under a fold stays,
/// and so do `held` vertices, and what valleys leave. Rest lengths are not touched.
/// \details One connected raised patch after the other; each vertex by its nearest point of it, which makes
/// the raise continuous along a layer. Cost: O(faces log faces) of the patches, and the vertices near them.
RaisedLayers raise_layers(Mesh& mesh, const std::vector<Coordinates<Point>>& undisplaced,
                          std::span<const Index<Vertex>> held);

}  // namespace furrow::geometry
