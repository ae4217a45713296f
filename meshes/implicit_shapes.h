// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

/// Solids as functions of a point: < 0 inside, > 0 outside, near the surface about the distance [m]. They use
/// only the four basic operations and square roots, so the values have the same bits on every machine.
namespace furrow::meshes {

using Vec = Eigen::Vector3d;  ///< [m]; x to the figure's left, y up, z forward

/// About the distance from the ellipsoid of these radii around `center` [m]. It is not a true distance, but
/// right to first order.
double ellipsoid(const Vec& p, const Vec& center, const Vec& radii);
/// Distance from the convex hull of two balls (a, radius ra) and (b, rb).
double round_cone(const Vec& p, const Vec& a, const Vec& b, double ra, double rb);
/// The union of two solids with a fillet about `blend` [m] wide (> 0) where they meet.
double smooth_union(double a, double b, double blend);
/// The same for the intersection of the two.
double smooth_intersection(double a, double b, double blend);

/// A cross-section of a loft: an ellipse at `at` along the axis.
struct Station {
  double at;                ///< along the axis [m]
  double across, deep;      ///< half-widths along the frame's other two directions [m]
  double shift_deep = 0;    ///< of the centre, along the frame's `deep` direction [m]
  double shift_across = 0;  ///< and along `across` [m]
};

/// Ellipses along an axis with smooth curves (Catmull-Rom) between them, and flat ends.
class Loft {
 public:
  /// Unit vectors at right angles; `stations` in growing order of `at`, two or more.
  Loft(const Vec& origin, const Vec& axis, const Vec& across, const Vec& deep, std::vector<Station> stations);

  double operator()(const Vec& p) const;
  /// The ellipse at a place along the axis; the first or last beyond the ends.
  Station section(double at) const;
  double along(const Vec& p) const { return (p - origin_).dot(axis_); }  ///< [m]
  double from_axis(const Vec& p) const;                                  ///< [m]

 private:
  Vec origin_, axis_, across_, deep_;
  std::vector<Station> stations_;
};

}  // namespace furrow::meshes
