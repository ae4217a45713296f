// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/stroke/fold_curve.h"

namespace furrow::geometry {

/// Curves cut where FoldCurve::cuts says, so that a vertex is on an arc once; a curve without cuts is its own
/// only arc. Arcs of a curve follow each other, and share their ends.
struct CurveArcs {
  explicit CurveArcs(std::span<const FoldCurve> curves);

  std::vector<FoldCurve> arcs;
  std::vector<std::size_t> curve;  ///< of each arc
  std::vector<double> begin;       ///< of each arc, as arc length of its curve [m]
  std::vector<double> length;      ///< of each curve [m]
  std::vector<bool> closed;        ///< of each curve

  /// The arcs before and after one on its curve; -1: none.
  int before(std::size_t arc) const { return neighbour(arc, false); }
  int after(std::size_t arc) const { return neighbour(arc, true); }
  /// The vertices of a curve, in its direction, out of those of all arcs. One that the curve passes twice
  /// stands twice.
  std::vector<std::pair<double, Vertex>> joined(std::size_t of,
                                                const std::vector<const std::map<double, Vertex>*>& on) const;
  /// The vertices of an arc, out of those of its curve.
  std::map<double, Vertex> part(std::size_t arc, std::span<const double> along,
                                std::span<const Vertex> vertices) const;

 private:
  int neighbour(std::size_t arc, bool next) const;
  void cut(const FoldCurve& whole, std::size_t index);
};

}  // namespace furrow::geometry
