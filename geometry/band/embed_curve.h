// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "geometry/band/band_mesh.h"

namespace furrow::geometry {

/// Ends of an arc that arcs of the same curve have already.
struct ArcEnds {
  std::optional<Vertex> first, last;
};

/// Makes a chain of edges out of a curve: vertices near it slide onto it, edges that it crosses are split at
/// the crossing. `given` is curve `index` of band.curves.
/// Marks the chain's edges as line edges and its vertices with `line`. The chain is
/// band.curves[index].vertices, with an edge between every two neighbours.
/// \details Ends first: the nearest vertex goes onto the end, along the border where the curve ends there.
/// Then vertices nearer than 0.3 h, the nearest first, if no face gets thin and none on the curve is within
/// 0.35 h of it along the curve, and once more within 0.42 and 0.5 h where faces stay good; h: the smaller of
/// the sizing and the mean edge there. A vertex of another curve slides along that to the crossing. Vertices
/// of borders, seams and earlier lines stay; nearer than 0.04 h they count as on the curve. Then, from vertex
/// to vertex along the curve: the edge opposite the last vertex that the curve leaves its star through is
/// split where it does. Where no way leads on, the chain goes along the shortest path of edges
/// (BandMesh::detours). O(length of the curve over h) steps.
void embed_curve(BandMesh& band, int index, const FoldCurve& given, const ArcEnds& known = {});

}  // namespace furrow::geometry
