// SPDX-License-Identifier: MIT
#pragma once
#include <array>

#include "physics/pairs/pair_distance.h"

namespace furrow::physics {

/// How the distance d of a pair falls to second order. Where primitives slide past each other by s, in their
/// parameters, while they tilt by q, the slope of the distance over these, d changes by s . q, however small
/// it is: a step that knows only the first order runs into what it slides along. For a pair that pushes
/// with a force F, F / 2 times the squares of the rows, sum over i of (weights[i] slide + tilt[i] normal) .
/// dx_i, are at least minus F times that change, and positive semidefinite. What is left out is F d at most.
struct PairCurvature {
  int rows = 0;                               ///< parameters of the closest points that are free
  std::array<Vec3, 2> slide;                  ///< of a row [m^-1/2]
  std::array<std::array<double, 4>, 2> tilt;  ///< likewise, by vertex [m^-1/2]

  /// What a row has for vertex i.
  Vec3 row(int of, std::size_t i, const std::array<double, 4>& weights, const Vec3& normal) const {
    const auto j = std::size_t(of);
    return weights[i] * slide[j] + tilt[j][i] * normal;
  }
};

/// x: the corners of two edges, else of a vertex and a triangle; weights: of their PairDistance. Without rows
/// where two corners are next to each other, or edges are nearly parallel (squared sine below 1e-3).
PairCurvature pair_curvature(bool edges, const std::array<Vec3, 4>& x, const std::array<double, 4>& weights);

}  // namespace furrow::physics
