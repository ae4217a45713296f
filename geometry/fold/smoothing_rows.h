// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>
#include <vector>

#include "geometry/fold/taubin_smooth.h"

namespace furrow::geometry {

/// The matrix W of taubin_smooth as compressed rows over a local numbering: row r moves point `active[r]`
/// towards sum_j weight[j] x[neighbour[j]], j in [first[r], first[r + 1]), where the weights of a row sum
/// to 1.
struct SmoothingRows {
  std::vector<Vertex> vertices;  ///< of each local index, ascending: the moving vertices and their neighbours
  std::vector<int> active;       ///< local index of the vertex that a row moves, ascending
  std::vector<int> first;        ///< rows + 1 entries
  std::vector<int> neighbour;    ///< local indices
  std::vector<double> weight;    ///< one for each neighbour
  std::vector<double> inverse_count;  ///< of each row: 1 / neighbours where its weights are uniform, else 0
};

/// Gathers the rows once, from weights, line and border rule of the options (see taubin_smooth).
/// Vertices of the region without a row (isolated ones, ends of lines and corners that are kept) stay.
SmoothingRows gather_smoothing_rows(const Mesh& mesh, std::span<const Vertex> region,
                                    const TaubinOptions& options);

}  // namespace furrow::geometry
