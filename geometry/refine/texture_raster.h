// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/face_point.h"
#include "geometry/mesh/property_names.h"

namespace furrow::geometry {

/// Which face of a mesh the middle of each texel lies in, in texture space. Rows run from the top (v = 1):
/// the middle of texel (column, row) is u = (column + 1/2) / size, v = 1 - (row + 1/2) / size.
struct TextureRaster {
  int size = 0;
  std::vector<int> face;         ///< size² face indices, by rows; -1 = none
  std::size_t covered = 0;       ///< texels with a face
  std::size_t overlapping = 0;   ///< texels well inside two faces: charts that lie on one another
  std::size_t out_of_range = 0;  ///< faces that reach out of the unit square
};

/// Texels on an edge between two faces go to the lower one. Faces without coordinates are left out. `size`
/// in [1, 8192]: std::invalid_argument. ContentError if the mesh has no texture coordinates. O(faces +
/// texels in them).
TextureRaster rasterize_texture(const Mesh& mesh, int size);

/// Barycentrics of a point of texture space in a face; outside of it some are negative. NaN if the face has
/// no area there.
Barycentrics texture_barycentrics(const Mesh& mesh, const HalfedgeMap<TextureCoordinate>& texture, Face face,
                                  const TextureCoordinate& at);

inline TextureCoordinate texel_middle(int size, int column, int row) {
  return {(column + 0.5) / size, 1 - (row + 0.5) / size};
}

}  // namespace furrow::geometry
