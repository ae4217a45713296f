// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// Strain of a face along the two directions, at right angles, in which it is stretched most and least:
/// length now over length at rest, less 1 (engineering strain). > 0: stretched, < 0: pressed together.
struct PrincipalStrain {
  double largest = 0, smallest = 0;  ///< [-], >= -1; NaN: the face's rest lengths span no triangle
};

/// By face index, from the rest lengths of the edges (attribute::rest_length; the present length where it is
/// unset) and their present lengths: the singular values of the map from the triangle at rest to the present
/// one, less
/// 1. Rigid motions do not matter, nor bending. Throws ContentError if a position is not finite, a face is no
/// triangle or a rest length is negative or infinite. O(faces).
std::vector<PrincipalStrain> principal_strains(const Mesh& mesh);

}  // namespace furrow::geometry
