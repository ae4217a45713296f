// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"

/// Clothes for the mannequin, wound outward, of triangles of equal size unless they say otherwise. They lie 4
/// mm or more from its surface.
namespace furrow::meshes {

/// A T-shirt with four openings: neck, hem, two sleeves.
geometry::Mesh make_shirt();
/// A flared skirt from the waist to the knee with two openings.
geometry::Mesh make_skirt();
/// A dress with a strap over her left shoulder alone; triangles and quads, coarser below.
geometry::Mesh make_dress();
/// A wide tunic without sleeves: a pointed neck, slits from the hem to the hips, faces of three to six
/// corners.
geometry::Mesh make_tunic();

}  // namespace furrow::meshes
