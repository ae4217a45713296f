// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "geometry/mesh/face_point.h"

namespace furrow::geometry {

/// One connected piece of a stroke, ready to be folded: a smooth curve on the surface as it lies before any
/// fold is raised. prepare_strokes() makes it; the band is refined around it, and the fold's height at a
/// point is an integral along it. All lists have one entry for each point, at least two.
struct FoldCurve {
  int line = -1;                        ///< its id in attribute::line; the pieces of a stroke share it
  std::string name;                     ///< of the stroke, for reports
  std::vector<Eigen::Vector3d> points;  ///< on the surface, about h/4 apart [m]; closed: the first not again
  std::vector<FacePoint> places;        ///< the same points on the mesh that the curve was made on
  std::vector<double> arc;              ///< length from the first point [m]; ascending
  std::vector<double> width;            ///< w(s) > 0 of the whole fold [m], before taper and flare narrow it
  std::vector<double> height;           ///< k(s) [m]; < 0: valley; before taper and flare lower it
  bool closed = false;                  ///< the last point is joined to the first
  bool begins_at_border = false, ends_at_border = false;  ///< that end lies on the border of the mesh
  double length = 0;     ///< of the whole curve, of a closed one with the way back to the first point [m]
  double sharpness = 0;  ///< of the section [-]; [0, 1]: 0 round, 1 a tent
  std::array<double, 2> rise{0, 0};  ///< taper and flare: it rises over so much at beginning and end [m]
  /// Indices of points, in the curve's direction, at which it is cut into arcs that do not meet themselves;
  /// of a closed curve the first one opens it. Empty: it does not meet itself.
  std::vector<std::size_t> cuts = {};
  double set = 0.5;  ///< how much of the fold's angles becomes rest angle [-]; [0, 1]
};

}  // namespace furrow::geometry
