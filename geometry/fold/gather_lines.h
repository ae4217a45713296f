// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/fold/wrinkle.h"
#include "geometry/mesh/struts.h"

namespace furrow::geometry {

/// Sews a thread along each line with a WrinkledLine::gather: struts from stitch to stitch, half the line's
/// width apart, of so much of the length that the cloth at rest has between them. The cloth between two
/// stitches has room to buckle, so a line that is drawn in gathers it. A stitch is a vertex of the line's
/// chain. The struts that the mesh has stay. Cost: O(vertices of the lines), and a sort.
void gather_lines(Mesh& mesh, std::span<const WrinkledLine> lines);

/// A gathered line's thread as it lies.
struct GatherThread {
  int line = 0;
  std::vector<Strut> struts;
  double rest_length = 0, length = 0;                         ///< sums over its struts [m]
  bool draws() const { return length > 1.02 * rest_length; }  ///< it has yet to draw its line in
};

/// The threads of these lines (ids, ascending): struts with length between vertices of lines, of which one at
/// least is that line's. Lines without are left out. O(struts x lines).
std::vector<GatherThread> gather_threads(const Mesh& mesh, std::span<const int> lines);

/// Takes off, and returns, the struts of those lines' threads that have yet to draw their line in: that are
/// longer than at rest by more than 2 % in all. sew() gives struts to a mesh, beside those that it has.
std::vector<Strut> cut_undrawn_threads(Mesh& mesh, std::span<const int> lines);
void sew(Mesh& mesh, std::span<const Strut> threads);

}  // namespace furrow::geometry
