// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

struct LineHeight {
  int line = -1;             ///< its id in attribute::line
  double height = 0;         ///< mean over its vertices [m]; > 0 outward; NaN if nothing bounds its patch
  std::size_t vertices = 0;  ///< how many vertices the line has
};

/// How far each line (vertices of the same attribute::line >= 0) stands out of the surface as it would be
/// without it, by id. `widths` [m] go by id, NaN or missing at the end: none. Of a line without a width the
/// vertices two rings away from it stay, of one with a width those beyond its line_region(), so that a fold
/// is measured over its whole width on a coarse mesh and on a fine one; those nearer take the harmonic fill
/// between them: the solution of the Laplace equation with the cotangents of the rest lengths (the present
/// length where unset), so the fill depends on the material and moves rigidly with the cloth. Where the patch
/// meets the border of the mesh the fill's border is free (natural condition). Height of a vertex = (x -
/// fill) . n, n the unit normal of the fill there, weighted by area. Vertices of other lines in the patch
/// count as vertices like any other. On a flat surface it is the displacement minus the lift of the patch's
/// border; on a surface of radius R the fill of a patch of half-width w sags by about w^2 / 2R, which then
/// counts as height: wrinkle() takes the height before displacement off. Throws ContentError if a position is
/// not finite or a face no triangle. Cost: a sparse Cholesky factorisation of the patch for each line. Used
/// for drawn, smoothed and kept heights of reports.
std::vector<LineHeight> line_heights(const Mesh& mesh, std::span<const double> widths = {});

}  // namespace furrow::geometry
