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
/// without it, by id: the height of its vertices over the harmonic fill of the patch around it. `widths` [m]
/// go by id, NaN or missing at the end: none. The patch of a line without a width reaches two rings from it,
/// of one with a width over its line_region(). Throws ContentError if a position is not finite or a face no
/// triangle. Cost: a sparse Cholesky factorisation of the patch for each line.
/// \details The fill solves the Laplace equation with the cotangents of the rest lengths (the present length
/// where unset), so it depends on the material and moves rigidly with the cloth; where the patch meets the
/// border of the mesh it is free (natural condition). Height of a vertex = (x - fill) . n, n the unit normal
/// of the fill there, weighted by area. Vertices of other lines in the patch count as any other. With a
/// width, a fold is measured over its whole width on a coarse mesh and on a fine one. On a flat surface the
/// height is the displacement minus the lift of the patch's border; on a surface of radius R the fill of a
/// patch of half-width w sags by about w^2 / 2R, which counts as height: wrinkle() takes the height before
/// displacement off.
std::vector<LineHeight> line_heights(const Mesh& mesh, std::span<const double> widths = {});
/// The same of some lines alone, whose ids ascend.
std::vector<LineHeight> line_heights(const Mesh& mesh, std::span<const double> widths,
                                     std::span<const int> of);

}  // namespace furrow::geometry
