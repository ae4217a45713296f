// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "physics/body/depth_map.h"
#include "physics/body/moving_body.h"

namespace furrow::physics {

/// A body by what is seen of it from a few sides: inside is what lies behind all maps. For bodies whose shape
/// changes each frame: a rebuild takes milliseconds. The body must be closed, counter-clockwise from outside.
/// A map shows of a point x the surface under it, then that under the foot of x on its tangent plane, and the
/// nearest rim. Of what all maps show the point p nearest to x counts: the value is (x - p) . n, the gradient
/// n, the interpolated vertex normal (at edges sharper than about 50 degrees the face's). The depth along the
/// line of sight, which the pixel of a depth map gives, is longer where that is seen at an angle.
///
/// What it cannot do:
///  - What no map sees is filled: a point between a torso and the arm that hides it is taken for inside.
///    compare_colliders() says how often. The value jumps at the edge of such a region.
///  - Near surfaces that all maps see at a grazing angle or not at all (with three maps: soles, the flat
///    sides of a chest) the depth is too large, and a value outside may be, too.
///  - Values are at most reach(), or the distance to the body's box where this is more.
/// Source: method S2.8; Vassilev, Spanlang, Chrysanthou 2001.
class DepthMapCollider : public Collider {
 public:
  /// Throws std::invalid_argument that names a bad option, or as check_body(). Cost: see rebuild().
  explicit DepthMapCollider(const TriangleMesh& mesh, const DepthMapOptions& options = {});

  /// The same triangles at new positions; bit for bit what building anew gives. Throws std::invalid_argument,
  /// nothing changed, if the number of vertices is another or one is no place. Keeps its memory: it grows
  /// only with the number of texels of the body's box. Cost: O(maps (T + texels)), about 6 ms for three maps
  /// of 512 texels and 30,000 triangles on one thread.
  void rebuild(std::span<const Vec3> vertices);

  /// About 0.2 us for three maps; NaN for a NaN point.
  SignedDistance at(const Vec3& x) const override;

  double texel() const { return raster_.texel; }                  ///< edge of a texel [m]
  double reach() const { return raster_.texel * raster_.reach; }  ///< largest value in the body's box [m]
  std::size_t memory() const;                                     ///< [bytes] of maps, vertices and triangles

 private:
  struct Point;
  struct Search;
  bool is_before(const DepthMap& map, const DepthMap::Texel& texel, Search& search) const;
  void descend(const DepthMap& map, Point point, Search& search) const;
  void climb(const DepthMap& map, const Point& rim, Search& search) const;
  Point point_of(int face, const DepthMap& map, const Vec3& x) const;
  SignedDistance in_maps(const Vec3& x) const;
  void find_normals();
  Vec3 face_normal(int face) const;

  DepthMapOptions options_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<Vec3> vertices_, normals_;
  std::vector<char> creases_;  ///< a triangle: bit k: at corner k its own normal counts
  Vec3 low_, high_;            ///< of the body [m]
  DepthRaster raster_;
  std::vector<DepthMap> maps_;
};

}  // namespace furrow::physics
