// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"
#include "meshes/implicit_shapes.h"

/// A woman as she stands in a shop window: 1.70 m, feet on y = 0, looking along +z, arms 37 degrees from the
/// vertical.
namespace furrow::meshes {

/// < 0 inside the figure.
double mannequin(const Vec& p);
/// The part that a shirt hangs on: trunk, shoulders and neck, without head, arms and legs.
double trunk(const Vec& p);
/// The left arm's axis: from 0 at the shoulder by 0.27 at the elbow to 0.5 m at the wrist.
const Loft& left_arm();
/// A solid at p together with its mirror image in the plane x = 0; see smooth_union().
template <class Solid>
double with_mirror_image(const Vec& p, double blend, const Solid& solid) {
  return smooth_union(solid(p), solid(Vec(-p.x(), p.y(), p.z())), blend);
}

/// Closed, wound outward, about 14,000 triangles.
geometry::Mesh make_mannequin();

}  // namespace furrow::meshes
