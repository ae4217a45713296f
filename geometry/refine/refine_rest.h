// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "geometry/mesh/carry_attributes.h"

/// The rest metric of a subdivided mesh, from that of the mesh before: a point of the finer mesh lies in an
/// old triangle, flat at rest, so its distances to the others there are exact, wherever the masks move it in
/// space. Only lengths that were set are carried: where an old edge has none (NaN), what lies along it has
/// none either. Stiffnesses and springs are not touched.
namespace furrow::geometry {

/// After a step with the topology of Loop's scheme (each triangle in four; old edge i was cut at the vertex i
/// + number of old vertices): attribute::rest_length, and attribute::triangle_rest_length of the parts of
/// each face. A half of an edge has half its length, and so has the edge between two mid-points, as the side
/// that it is parallel to. `parent(f)` is the old face that f lies in. O(faces).
void refine_rest_of_quarters(const SavedAttributes& saved, Mesh& mesh,
                             const std::function<Face(Face)>& parent);

/// After a step of the sqrt(3) scheme: attribute::rest_length, by unfolding two old triangles where an edge
/// crosses from one to the other. `origins`: where the new vertices lay, in their order. A triangle's own
/// lengths (attribute::triangle_rest_length) become unset, since no new triangle lies in an old one. Does
/// nothing where no rest length was set. O(edges).
void refine_rest_of_sqrt3(const SavedAttributes& saved, Mesh& mesh, std::span<const Origin> origins);

}  // namespace furrow::geometry
