// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "geometry/band/band_sizing.h"
#include "geometry/insert/insertion.h"
#include "geometry/stroke/fold_curve.h"

namespace furrow::geometry {

struct BandOptions {
  Detail detail = Detail::normal;
  double least_edge = 0.003;  ///< no finer than this [m]; > 0
  /// As InsertionOptions::may_flip. Empty: yes.
  std::function<bool(const std::array<Point, 4>&)> may_flip;
  std::vector<Vertex> held = {};  ///< vertices of the mesh given that keep their places, as pins do
};

/// The chain of a curve: an edge joins each vertex to the next, and the last to the first if it is closed.
struct BandChain {
  int line = -1;                 ///< FoldCurve::line
  std::vector<Vertex> vertices;  ///< in the direction of the curve, each once for every pass
  std::vector<double> along;     ///< arc length of each from the curve's first point [m]; ascending
  bool closed = false;
  double lateral = 0;  ///< largest distance of a vertex from the curve [m]
};

struct BandReport {
  std::vector<BandChain> chains;  ///< of each curve
  /// Place of every vertex on the mesh given: where a new or moved one came from, the vertex itself for all
  /// others (isolated vertices have no face). Faces and the order of corners are those of the mesh given.
  std::vector<FacePoint> places;
  std::vector<Vertex> snapped;         ///< of the mesh given, but moved onto a curve
  std::vector<SplitEdge> split_edges;  ///< of earlier lines' chains
  std::vector<bool> in_band;           ///< by face
  std::vector<Face> changed_faces;     ///< new, or other corners than before; ascending
  std::size_t inserted = 0, flipped = 0;
  std::size_t detours = 0;                             ///< pieces of chains along edges beside the curve
  double min_angle_before_deg = 0, min_angle_deg = 0;  ///< of the band's faces, rest metric [degrees]
  double shortest_edge = 0;                            ///< of the band, at rest [m]
};

/// Makes the cloth around curves as fine as their folds need, with a vertex chain on each curve, before
/// anything is raised: edges of h in the band (band_sizing.h), growing outwards to the garment's own; by
/// splits and flips alone, so that no index changes; rest metric and attributes carried (mesh_editor.h). New
/// vertices lie on the surface given. Old vertices stay, but for those that snap onto a curve. Sets
/// attribute::line and line_edge. Throws std::invalid_argument for an option or a curve without two points or
/// with places out of the mesh, ContentError for a mesh that is not of triangles or a curve that cannot be
/// followed; the mesh is unchanged then.
/// About O(new vertices). \details Steps: relax_band.h, embed_curve.h.
BandReport refine_band(Mesh& mesh, std::span<const FoldCurve> curves, const BandOptions& options = {});

/// Faces that hang together with those under the curves and lie near one, where a fold may raise them;
/// `graded`: all that refine_band() begins with, those with an edge longer than wanted and those beside them,
/// too. Other layers of cloth, however near, are none. The mesh must have rest lengths. About O(faces found).
std::vector<Face> faces_of_band(const Mesh& mesh, std::span<const FoldCurve> curves,
                                const BandOptions& options, bool graded);

}  // namespace furrow::geometry
