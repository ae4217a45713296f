// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "geometry/insert/insertion.h"

namespace furrow::geometry {

struct LineVertex {
  Vertex vertex;
  Vector normal;            ///< unit; the direction of the displacement
  double stroke_parameter;  ///< where along the stroke, by chord length [-]; [0, 1]
};

/// A drawn line as a chain of edges.
struct InsertedLine {
  int id = -1;
  std::vector<std::vector<Vertex>> chains;  ///< one a sub-stroke, in order; closed: first == last
  std::vector<LineVertex> vertices;         ///< each vertex once, by first appearance
};

/// Two vertices follow each other in a chain, but no edge joins them (paper rule only).
struct MissingLineEdge {
  Vertex from, to;
  Refusal reason;
};

/// An edge was split at a crossing: chains of earlier lines that hold from, to now go from, vertex, to.
struct SplitEdge {
  Vertex from, to, vertex;
};

struct InsertionReport {
  std::size_t inserted = 0;        ///< new vertices, those of split edges included
  std::size_t flipped = 0;         ///< edges flipped by Algorithm 2
  std::size_t delaunay_flips = 0;  ///< edges flipped afterwards, beside the line
  std::size_t folded_flips = 0;    ///< flips that folded a face over in the rest metric (paper rule only)
  std::size_t reused = 0;          ///< crossed faces that took a vertex of an earlier line
  std::size_t snapped = 0;         ///< crossed faces that took another corner instead of a new vertex
  std::size_t too_small = 0;       ///< of the snapped faces: too small or split too often already
  std::size_t routed = 0;    ///< pairs of consecutive faces joined through corners, each after a refused flip
  std::size_t attempts = 1;  ///< rounds of the search for a line with good angles
  std::size_t nudges = 0;    ///< times that the stroke was moved aside from vertices and edges
  std::map<Refusal, std::size_t> refused_flips;  ///< of Algorithm 2, not of the Delaunay flips
  std::vector<SplitEdge> split_edges;
  std::vector<MissingLineEdge> missing_edges;
  std::vector<std::string> warnings;
  std::vector<Face> changed_faces;  ///< new or other corners than before; ascending
  double min_angle_deg = 0;         ///< rest metric, over changed_faces [degrees]
  double max_deviation = 0;         ///< largest distance of a sample on cloth from the line [m]
};

/// Adds another line's report: counts and lists grow, the smaller angle and the larger deviation stay.
InsertionReport& operator+=(InsertionReport& sum, const InsertionReport& line);

}  // namespace furrow::geometry
