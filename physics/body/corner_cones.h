// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <span>
#include <vector>

#include "physics/base/arrays.h"
#include "physics/base/float4.h"

namespace furrow::physics {

/// A corner of a triangle.
struct TriangleCorner {
  static constexpr int none = -1;
  int triangle = none;
  int corner = 0;  ///< 0 to 2
};

/// A corner at a place that more triangles share than any mesh of a body has, and the place's number.
struct CrowdedCorner {
  int place;
  TriangleCorner at;
};

/// Triangles at places that many share: their boxes all hold the place, so that boxes tell none apart.
class CrowdedCorners {
 public:
  static constexpr int crowd = 1000;  ///< triangles at a place, at least

  /// Without any.
  CrowdedCorners() = default;
  /// Places are told apart by coordinates, so that a soup's count, too. Cost O(T), a few ns a triangle where
  /// there is no crowd.
  explicit CrowdedCorners(const TriangleMesh& mesh);

  bool empty() const { return places_.empty(); }
  /// Those of a triangle with these corners; at most three.
  std::vector<CrowdedCorner> of(int triangle, const std::array<Vec3, 3>& corners) const;

 private:
  std::vector<Vec3> places_;  ///< sorted
};

/// Of two lists, the corners of `a` whose place is in `b`, too.
std::vector<CrowdedCorner> common_corners(std::span<const CrowdedCorner> a, std::span<const CrowdedCorner> b);

/// All directions from a corner within an angle of an axis.
struct CornerCone {
  Vec3 apex, axis;      ///< the axis of unit length, or zero: a cone of all directions
  double cosine, sine;  /// of the angle, 0 to 80 degrees
};

/// Around an apex and points [m]: holds every triangle with a corner there whose other corners are such
/// points. O(points).
CornerCone fit_corner_cone(const Vec3& apex, std::span<const Vec3> points);

/// Four cones in float, with a triangle at the apex of each. One that was not set has all directions.
struct CornerCones {
  Float4 apex[3], axis[3], cosine, sine;
  std::array<TriangleCorner, 4> at;

  CornerCones();
  void set(int lane, const CornerCone& cone, TriangleCorner corner);
};

/// What four cones tell of a point p.
struct ConeDistances {
  Float4 squared;  ///< lower bounds of the distances, squared
  Float4 behind;   ///< positive: the apex itself is the cone's closest point, so it stands for all triangles
};

/// `slack` [m] is above the rounding of coordinates as large as p's and the apexes'.
inline ConeDistances cone_distances(const CornerCones& cones, const Float4* p, float slack) {
  Float4 r[3], along = splat(0), across2 = splat(0), far2 = splat(0);
  for (int k = 0; k < 3; ++k) {
    r[k] = p[k] - cones.apex[k];
    along += r[k] * cones.axis[k];
    far2 += r[k] * r[k];
  }
  for (int k = 0; k < 3; ++k) {
    const Float4 d = r[k] - along * cones.axis[k];  // not far2 - along2, which cancels
    across2 += d * d;
  }
  const Float4 across = square_root(across2), wide = splat(4 * slack);  // more is rounded here than in a box
  const Float4 before = along * cones.cosine + across * cones.sine;
  const Float4 beside = positive_part(across * cones.cosine - along * cones.sine - wide);
  const Float4 behind = positive_part(-before - wide);
  const Float4 apart = positive_part(square_root(far2) - wide);
  return {behind > splat(0) ? apart * apart : before > splat(0) ? beside * beside : splat(0), behind};
}

}  // namespace furrow::physics
