// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <set>
#include <vector>

#include "geometry/band/refine_displaced.h"
#include "geometry/fold/fold_heights.h"

namespace furrow::geometry {

/// A curve that may raise a vertex, and how far that is from its chain along the cloth [m].
struct CurveWay {
  int curve;
  double way;
};

/// The folds as heights over the mesh.
struct Folds {
  std::vector<FoldCurve> curves;
  std::vector<FoldHeight> heights;

  explicit Folds(std::vector<FoldCurve> list);
  /// Of the given curves at a point: of each line, and together [m].
  struct Joined {
    std::map<int, double> of_line;
    double height = 0;
  };
  Joined at(const Eigen::Vector3d& x, const std::vector<CurveWay>& of) const;
};

/// The cloth on its way; by vertex. Flat is the mesh's own positions.
struct Raised {
  std::vector<Point> base;      ///< on the curved surface
  std::vector<Vector> normals;  ///< of that
  std::vector<double> height;   ///< u [m]
  std::vector<double> set;      ///< of the lines that raise it, by their shares; NaN: none does [-]
  std::vector<std::vector<CurveWay>> ways;  ///< by curve

  Point displaced(Vertex v) const { return base[v.idx()] + height[v.idx()] * normals[v.idx()]; }
};

struct RaiseOptions {
  BandOptions band;  ///< of the second pass; held vertices keep height 0
  bool flat_base = false;
};

/// Base, normals and heights of a mesh that refine_band() made of `given`. Then its steep flanks are refined
/// (refine_displaced.h), and new vertices have all that the others have. Where a fold rises into a hollow, so
/// that its normals would meet (edges become half as long), they are averaged further. A height counts in
/// full where the way along the cloth is about the distance, and fades where layers lie close
/// (FoldHeight::share_at), so that it is continuous over the mesh. Throws as refine_displaced().
Raised raise_folds(const Mesh& given, Mesh& mesh, BandReport& band, const Folds& folds,
                   const RaiseOptions& options);

/// A copy with other positions.
Mesh with_points(const Mesh& mesh, const std::vector<Point>& points);

}  // namespace furrow::geometry
