// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/face_point.h"
#include "geometry/rest/rest_metric.h"

namespace furrow::geometry {

using Place2 = std::array<double, 2>;  ///< in the plane of a star laid flat [m]

/// The faces around a vertex laid flat in the rest metric, the vertex at (0, 0).
struct Star {
  Vertex centre;
  bool closed = true;            ///< false: the vertex lies on the border
  std::vector<Halfedge> spokes;  ///< outgoing, counter-clockwise; face i lies between spoke i and i + 1
  std::vector<Place2> ends;      ///< of the spokes
  double defect = 0;             ///< 2 pi less the angles around it, of a closed star [rad]

  std::size_t faces() const { return closed ? spokes.size() : spokes.size() - 1; }
  std::size_t after(std::size_t spoke) const { return spoke + 1 < spokes.size() ? spoke + 1 : 0; }
};

/// Starts at the neighbour of the lowest index, on the border at its right end. A closed star that does not
/// lie flat is spread evenly. A vertex whose faces are no single fan gives its first fan. O(valence).
Star lay_flat(const Mesh& mesh, const EdgeMap<double>& rest, Vertex v);
/// The same in the shape of other positions, by vertex.
Star lay_flat(const Mesh& mesh, const std::vector<Point>& positions, Vertex v);

/// 4 sqrt(3) area over the sum of squared sides: 1 for an equilateral triangle, 0 for a flat one, < 0 for one
/// that is turned over.
double quality(const Place2& a, const Place2& b, const Place2& c);
/// The least quality of the star's faces if its centre lay at `x`.
double least_quality(const Star& star, const Place2& x);

/// A point of a face of the star: weights of the centre, the end of spoke `face`, and that of the next.
struct StarPoint {
  std::size_t face = 0;
  Barycentrics weights{1, 0, 0};
};
/// The face that holds a place of the plane, or the nearest one; weights may be < 0 then.
StarPoint find_in_star(const Star& star, const Place2& x);
/// The same for a point of space, by the faces as they lie in space.
StarPoint find_in_star(const Mesh& mesh, const Star& star, const Point& p);
Place2 place_in(const Star& star, const StarPoint& at);
Point position_in(const Mesh& mesh, const Star& star, const StarPoint& at);

}  // namespace furrow::geometry
