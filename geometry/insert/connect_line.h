// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <set>
#include <vector>

#include "geometry/insert/insertion.h"
#include "geometry/insert/mesh_editor.h"

namespace furrow::geometry {

/// Two nodes of a line in faces that share the edge a-b, which the stroke crosses at t from a to b.
struct Link {
  Vertex from, to;
  Vertex a, b;
  Edge edge;  ///< a-b, until it is flipped or split
  double t = 0.5;
  bool route = false;              ///< never flip or split here: go through corners
  std::vector<Vertex> between;     ///< set by connect_line: what the line passes from `from` to `to`
  std::optional<Refusal> refusal;  ///< set by connect_line: why `from` and `to` are not joined
};

/// Makes a path of edges out of each link, and locks its edges as line edges at once. In order: links whose
/// edge is there already; then, by stroke order, the edge a-b is flipped to from-to where the rules allow it;
/// where a-b is an edge of an earlier line or a seam, it is split at the crossing (or the line goes through
/// its end, if that is near); else the line goes along the shortest path of edges. With the paper's rule
/// flips only, and a link may stay open. `mean_edge` is h [m]. Counts into `report`. Returns the edges that
/// were no line edges before.
std::set<Edge> connect_line(MeshEditor& editor, std::vector<Link>& links, double mean_edge,
                            const InsertionOptions& options, InsertionReport& report);

/// The inner vertices of the shortest path of edges by rest length; ties go to the lower vertex. Dijkstra,
/// local.
std::vector<Vertex> shortest_edge_path(const Mesh& mesh, const EdgeMap<double>& rest, Vertex from, Vertex to);

}  // namespace furrow::geometry
