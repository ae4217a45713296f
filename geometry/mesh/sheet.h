// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// A plain cloth, upright in the x-y plane: |x| <= width / 2, 0 <= y <= height [m], normal +z. Rows of
/// triangles that are equilateral but for a stretch to whole numbers of them: `edge` [m] is met to about edge
/// / (2 width) across and edge / (2 height) upwards. Every other row is shifted by half an edge and ends in
/// half triangles, so the sides are straight and the four corners are vertices. Row by row from below, left
/// to right. Throws std::invalid_argument unless all three are finite and > 0, edge <= width, and there are
/// fewer than 1e7 vertices.
Mesh equilateral_sheet(double width, double height, double edge);

/// The same cloth woven: rows and columns of nearly square cells, `edge` met as above, each cut by a diagonal
/// (attribute::diagonal) that turns from cell to cell like the colours of a chessboard. Vertices row by row
/// from below. Throws as equilateral_sheet(), and if edge > height.
Mesh woven_sheet(double width, double height, double edge);

}  // namespace furrow::geometry
