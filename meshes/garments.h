// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"

/// Clothes for the mannequin, of triangles of equal size, wound outward. They lie 4 mm or more from its
/// surface.
namespace furrow::meshes {

/// A T-shirt with four openings: neck, hem, two sleeves.
geometry::Mesh make_shirt();
/// A flared skirt from the waist to the knee with two openings.
geometry::Mesh make_skirt();

}  // namespace furrow::meshes
