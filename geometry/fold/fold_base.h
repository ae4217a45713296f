// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/mesh/face_point.h"

namespace furrow::geometry {

/// Where a point of a mesh lies on a curved surface over its facets (Boubekeur and Alexa 2008, "Phong
/// tessellation"): `normals` are those of the mesh's vertices. The share is 1/2, not their 3/4, since then
/// a quadric with its own normals is met to second order: the mean of the ways to the tangent planes of the
/// corners is twice the way to the surface. Corners stay where they are.
Point curved_place(const Mesh& mesh, const std::vector<Vector>& normals, const FacePoint& at);

/// Unit normals of the vertices, each six times the mean of its own and its neighbours', so that the facets
/// of a coarse garment do not print into a fold; by vertex index, 0 for vertices without faces.
std::vector<Vector> averaged_normals(const Mesh& mesh);

/// Six means more of the normals of the vertices `of`, by vertex index.
void average_normals(const Mesh& mesh, const std::vector<bool>& of, std::vector<Vector>& normals);

/// By vertex index: 2 pi less the angles around an inner vertex [rad]; 0 for all others. O(faces).
std::vector<double> angle_defects(const Mesh& mesh);

/// Sum of the absolute angle defects (2 pi less the angles around it) of inner vertices over the area
/// [rad/m^2]; 0 without area. Cloth is nearly developable, so what is more than that of the garment is error.
double angle_defect(const Mesh& mesh);

}  // namespace furrow::geometry
