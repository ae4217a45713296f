// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include "physics/body/exact_distance.h"

namespace furrow::physics {

struct CompareOptions {
  int points = 10'000;    ///< half of them outside; >= 2
  double outside = 0.02;  ///< farthest offset along the faces' normals, outwards [m]; > outside_margin
  double inside = 0.01;   ///< and inwards [m]; > inside_margin
  double outside_margin = 0.005;  ///< points nearer to the surface may lie on the wrong side [m]; >= 0
  double inside_margin = 0.002;   ///< the same inside [m]; >= 0
  double near = 0.005;            ///< up to where values outside are compared [m]; > 0
  std::uint64_t seed = 1;
};

/// Absolute values [m].
struct ErrorSpread {
  double median = 0, p95 = 0, p99 = 0;
};

/// What a collider says of points near a body, against the exact distance.
struct ColliderComparison {
  int outside = 0, inside = 0;  ///< points beyond the margins
  int false_inside = 0;         ///< of those outside, by the collider inside
  int false_outside = 0;        ///< of those inside, by the collider outside
  ErrorSpread push_out;         ///< error of the depth of points that both call inside
  ErrorSpread near;             ///< error of the value of points that both call outside, up to `near`
  ErrorSpread overestimate;     ///< how much too large values outside are; 0 for those too small
  ErrorSpread angle;  ///< of the gradient to the exact one, of the points of push_out and near [rad]

  double false_inside_share() const { return outside ? double(false_inside) / outside : 0; }
  double false_outside_share() const { return inside ? double(false_outside) / inside : 0; }
  /// Whether it is wrong too often to be used without a warning: more than 0.2 % of either kind.
  bool disagrees() const { return false_inside_share() > 0.002 || false_outside_share() > 0.002; }
};

/// Self-test of a collider. The points are spread evenly over the body's area and moved along the faces'
/// normals; which side they are on, and how far, the exact distance says. The same input gives the same
/// points. Throws std::invalid_argument, naming the option, or as check_body(). Cost: about 2 us a point.
/// Source: method S2.8.
ColliderComparison compare_colliders(const Collider& tested, const ExactDistance& exact,
                                     const TriangleMesh& mesh, const CompareOptions& options = {});

}  // namespace furrow::physics
