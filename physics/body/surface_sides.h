// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "physics/body/exact_distance.h"
#include "physics/body/surface_topology.h"
#include "physics/body/triangle_bvh.h"
#include "physics/body/winding_number.h"

namespace furrow::physics {

/// At how many places the sides of a closed body are held against the winding number.
enum class SignTest {
  whole,     ///< 2000
  short_one  ///< 400: of a body that has passed the whole one in another shape
};

/// Tells inside from outside. In a closed body the winding number is a whole number that changes only across
/// triangles; over a part of the surface that nothing crosses it is one number on the outer side and one more
/// on the inner side. So a point whose closest triangle lies in such a part needs no summation at all. The
/// triangles of parts whose outer side is inside the body (w > 1/2) are inner walls. Sources: method S1.9;
/// Baerentzen & Aanaes 2005; Barill et al. 2018.
class SurfaceSides {
 public:
  /// References the tree (before drop()); drop(dropped()) is the caller's; `topology` is of the mesh. Cost
  /// about 2 us a triangle when closed, else a winding number a triangle.
  SurfaceSides(const TriangleMesh& mesh, const TriangleBvh& bvh, SurfaceTopology topology,
               SignTest test = SignTest::whole);

  /// True when x, whose closest point is `closest`, is inside the body (winding number > 1/2).
  bool inside(const Vec3& x, const ClosestPoint& closest) const;
  /// Whether inside() costs no summation for a point with this closest triangle.
  bool is_cheap(int triangle) const {
    return report_.rule != SignRule::winding && outer_[triangle] != unknown;
  }
  double winding_number(const Vec3& x) const { return winding_.at(x); }

  const SurfaceTopology& topology() const& { return topology_; }
  SurfaceTopology topology() && { return std::move(topology_); }
  const std::vector<char>& dropped() const { return dropped_; }
  const SignReport& report() const { return report_; }

 private:
  static constexpr int unknown = -1000000;
  void number_parts(const std::vector<char>& crossed);
  void leave_out_unsound(const std::vector<char>& crossed);
  void find_inner_walls(const std::vector<char>& crossed);
  struct Comparison {
    int differing = 0, known = 0, differing_known = 0;
    std::int64_t summed = 0;
  };
  void compare_signs(const TriangleMesh& mesh, SignTest test);
  void compare_signs_at(int i, double reach, Comparison& sum);
  double beside(int triangle, double side) const;

  const TriangleBvh& bvh_;
  SurfaceTopology topology_;
  WindingNumber winding_;
  std::vector<int> outer_;  ///< a triangle: winding number on its outer side, or unknown
  std::vector<char> dropped_;
  SignReport report_;
};

}  // namespace furrow::physics
