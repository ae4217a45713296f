// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include "geometry/figure/skeleton.h"

/// How a place beside a part of a body is carried to another body.
namespace furrow::geometry {

/// The trunk with neck and head, two arms, two legs.
inline constexpr int body_parts = 5;
constexpr int arm_part(int side) { return 1 + side; }
constexpr int leg_part(int side) { return 3 + side; }

/// The part whose skin is nearest, roughly: offsets from slices and from rings.
int nearest_part(const Skeleton& body, const Point& p);

/// Maps of each part of one body to the same part of another; both must outlive it.
class PartMaps {
 public:
  PartMaps(const Skeleton& from, const Skeleton& to);
  /// A part that one of the bodies has not goes with the trunk.
  Point moved(int part, const Point& p) const;

 private:
  Point on_trunk(const Point& p) const;
  Point on_shoulders(const Point& p) const;
  Point on_arm(int side, const Point& p) const;
  Point on_leg(int side, const Point& p) const;

  /// Heights of landmarks, upwards.
  struct Pair {
    double from, to;
  };
  const Skeleton &from_, &to_;
  std::array<Pair, 6> heights_;
  double height_to(double y) const;
};

}  // namespace furrow::geometry
