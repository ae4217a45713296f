// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "geometry/stroke/fold_curve.h"

namespace furrow::geometry {

/// The height of a fold at a point of the surface, as an integral along its curve c(s):
///   u(x) = k int T(s) 15 / (16 R N) (1 - |x - c(s)|^2 / R^2)^2_+ ds ,   R = w(s) / 2 ,
/// c extended by 0.6 w straight beyond a border. Across a straight line that is k (1 - t^2)^(5/2), t = 2 d /
/// w: crest k, zero with two derivatives at d = w/2, steepest 3.25 k / w. There is no nearest point, so none
/// jumps, and ends are round by themselves. T rises as a quintic smoothstep over FoldCurve::rise, and w from
/// 0.6 of itself over the same way. N is the integral at the crest itself for k = T = 1, which differs from 1
/// where the curve is bent; of a line so short that u stays below k everywhere, it is what takes its highest
/// place to k. Where a curve meets itself its passes do not add: one counts, smoothly the higher (2^(1/8) of
/// two equal ones). FoldCurve::sharpness blends towards the tent k T (1 - t) of the nearest point.
class FoldHeight {
 public:
  explicit FoldHeight(const FoldCurve& curve);

  /// u(x) [m]. O(points nearby).
  double at(const Eigen::Vector3d& x) const;
  /// The share of u(x) that cloth takes which lies `way` [m] from the curve along the surface [-]: 1 unless
  /// it is much farther than x is straight, as on a layer that lies close; 0 from there on, smoothly.
  double share_at(const Eigen::Vector3d& x, double way) const;
  /// No share from so far along the surface on [m].
  double reach() const;
  /// T at an arc length [m] of the curve [-]; [0, 1].
  double taper_at(double along) const;
  /// k at an arc length [m], without T [m].
  double height_at(double along) const;
  double greatest_width() const { return greatest_width_; }

 private:
  struct Place {
    Eigen::Vector3d point;
    double radius, height, taper, weight;  ///< R, k T, T, and k T 15 / (16 R N) ds
  };
  struct Block {
    Eigen::Vector3d centre;
    double reach;   ///< beyond it no place counts [m]
    double spread;  ///< of its places, and of the one after them, around the centre [m]
  };
  struct Nearest {
    double distance, radius;
  };
  Nearest nearest(const Eigen::Vector3d& x) const;
  double rise(double along) const;
  void add(const FoldCurve& curve, const Eigen::Vector3d& point, std::size_t i, double ds);
  void extend(const FoldCurve& curve, bool at_end, double ds);
  void divide_by_crest(const FoldCurve& curve);
  void make_blocks();
  void reach_height();
  double sum_at(const Eigen::Vector3d& x) const;
  double passes_at(const Eigen::Vector3d& x) const;
  using Term = std::pair<std::size_t, double>;  ///< of an integral: number of the place, and what it adds
  std::vector<double> passes_of(const std::vector<Term>& terms) const;
  double way_between(std::size_t i, std::size_t j) const;
  double share_of_pass(std::size_t i, std::size_t of) const;
  double tent(const Eigen::Vector3d& x) const;

  const std::vector<double> arc_, heights_;
  const double length_, sharpness_;
  const std::array<double, 2> rise_;
  const bool closed_, meets_itself_;
  double step_ = 0;  ///< between two places [m]
  double greatest_width_ = 0;
  std::size_t before_ = 0;  ///< places beyond the border at the beginning
  std::size_t own_ = 0;     ///< places of the curve itself, which follow those
  std::vector<Place> places_;
  std::vector<Block> blocks_;
};

/// Heights of several lines at one point, as one: those of one sign add as
/// (a^p + b^p + ...)^(1/p), p = 1.71: two equal ones make one and a half, never more than the higher plus
/// half of the lower, without a crease where one passes the other. Ridges and valleys are added.
double joined_heights(std::span<const double> heights);

}  // namespace furrow::geometry
