// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <vector>

#include "geometry/mesh/mesh_fwd.h"

namespace furrow::geometry {

/// What a drawn line does to the rest state around it (method S1.18).
enum class RestRule {
  drawn,  ///< the line adds cloth: rest lengths grow with it, rest angles stay (flat cloth stays flat)
  flat,   ///< it adds none: the cloth stays what it was
  copied  ///< as drawn, and rest angles turn with the line: the shape as it lies is the rest
};

/// The shape before a displacement, to compare with after it.
struct RestSnapshot {
  std::vector<Point> positions;  ///< by vertex index [m]
  std::vector<double> angles;    ///< between the faces of each edge, by its index [rad]
  std::size_t edges = 0;         ///< of the mesh, to notice a changed connectivity
};

/// Taken after insertion, flips and rebuild_bending_springs, before displacement and smoothing.
RestSnapshot take_rest_snapshot(const Mesh& mesh);

struct RestReport {
  std::size_t scaled_edges = 0;            ///< structural rest lengths that were scaled
  std::size_t scaled_bending_springs = 0;  ///< bending rest lengths that were scaled
  std::size_t scaled_struts = 0;
  std::size_t turned_hinges = 0;  ///< rest angles that were changed
};

/// What the rest state learns of displacement and smoothing. Rule flat: nothing. Rules drawn and copied:
/// every rest length of an edge, a face's own edge, a bending spring or a strut with a vertex that has moved
/// is multiplied by length after / length before, so that strain is carried over. Rule copied: a rest angle
/// grows by what the angle grew. All others keep their bits, stiffnesses too. Throws std::invalid_argument,
/// the mesh untouched, if the snapshot is of another connectivity; ContentError if a position is not finite.
/// O(vertices + edges).
/// \details Changes attribute::rest_length (added if missing), attribute::triangle_rest_length,
/// attribute::bending_rest_length, struts and attribute::rest_angle (if there is one). Where an edge's rest
/// length was unset, or the length before was 0, it becomes the length after.
RestReport apply_rest_rule(Mesh& mesh, const RestSnapshot& before, RestRule rule);

/// Sum of the areas of the faces at rest [m^2] (Heron's formula on the rest lengths, the present length where
/// unset; 0 for a face that breaks the triangle inequality).
double rest_area(const Mesh& mesh);

struct RestMetricAudit {
  std::size_t inverted_faces =
      0;  ///< triangle inequality fails, or Heron area < 1e-12 of the longest edge squared
  std::size_t duplicate_edges = 0;  ///< edges beyond the first between two vertices
  double min_angle_deg = 0;         ///< smallest angle of all faces; 0 if a face is inverted [degrees]
  double area = 0;                  ///< of all faces [m^2]
};

/// Measures a triangle mesh by e:rest_length (by lengths in space where that is not set). O(edges log edges).
RestMetricAudit audit_rest_metric(const Mesh& mesh);

}  // namespace furrow::geometry
