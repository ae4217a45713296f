// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// The sheet that a plate's hinges belong to, known by its lengths at rest.
struct PlateSheet {
  std::span<const std::array<int, 3>> triangles;        ///< particles, counter-clockwise from outside
  std::span<const std::array<double, 3>> rest_lengths;  ///< [m] of the edges opposite them
  std::span<const Hinge> hinges;                        ///< of these triangles; sides as Hinge says
  std::span<const double> inv_mass;                     ///< of each particle; 0: held
  std::span<const char> apart = {};                     ///< hinges that stay as they are; empty: none
  std::span<const double> press = {};                   ///< factor on each hinge, >= 0; empty: 1
};

/// A triangle laid into the plane, corners in its order, counter-clockwise [m].
using FlatTriangle = std::array<Eigen::Vector2d, 3>;

/// Which hinge joins which triangles, and what each is at rest.
struct PlateNet {
  struct Side {
    int triangle, edge;  ///< edge i lies opposite corner i
  };
  struct Triangle {
    std::array<int, 3> hinge = {-1, -1, -1};  ///< over each edge; -1: a border
    std::array<double, 3> length;             ///< [m]
    double area = 0;                          ///< [m^2]; 0: none, or too little to be told from none
    bool held = false;                        ///< all corners are: it cannot bend
    bool sliver = false;                      ///< lower than 1e-4 of its longest edge
  };
  struct Joint {
    std::array<Side, 2> side;  ///< left and right of the hinge's edge 0 -> 1
    bool coupled = false;      ///< takes part in the plate; else the hinge stays plain
  };
  std::vector<Triangle> triangles;
  std::vector<Joint> joints;  ///< one a hinge
};

/// Plain stay hinges set apart, of edges with more than two triangles or two on one side, beside triangles
/// without area, and between triangles that are held. Cost: a sort of the edges. Throws
/// std::invalid_argument if the arrays do not fit each other or a length is not > 0.
PlateNet plate_net(const PlateSheet& sheet);

/// The triangle unfolded over its edge: that edge from a on towards b, the triangle to the left of it.
FlatTriangle unfold(const PlateNet::Triangle& triangle, int edge, const Eigen::Vector2d& a,
                    const Eigen::Vector2d& b);

/// n^T (slope of the surface - slope of the triangle) at the middle of an edge, n outward, for the surfaces
/// x^2/2, y^2/2 and x y (curvatures K11 = 1, K22 = 1, K12 = 1): the part of a hinge's angle that lies in this
/// triangle [m times curvature].
Eigen::Vector3d edge_turn(const FlatTriangle& corners, double area, int edge);

}  // namespace furrow::physics
