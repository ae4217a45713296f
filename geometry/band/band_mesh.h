// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

#include "geometry/band/band_curve.h"
#include "geometry/band/base_surface.h"
#include "geometry/band/star.h"
#include "geometry/insert/insertion.h"
#include "geometry/insert/mesh_editor.h"

namespace furrow::geometry {

/// What may become of a vertex.
enum class Hold : char {
  free,    ///< it may move on the surface
  border,  ///< it may move along the border
  fixed,   ///< on a seam, an earlier line, the end of a curve or a crossing of two
};

/// A vertex on a curve.
struct OnCurve {
  int curve;
  double along;  ///< [m]
};

/// A mesh on its way to a band: how far it is, and the steps that keep its rest metric (split, flip, move).
/// Arrays go by index and grow with the mesh. All choices go by vertex indices and places, never by indices
/// of faces or edges: permuted faces give the same surface.
struct BandMesh {
  /// Prepares the maps of the mesh, which must outlive this.
  explicit BandMesh(Mesh& refined) : BandMesh(refined, refined) {}
  /// The same for one that was refined already, from `given`.
  BandMesh(Mesh& refined, const Mesh& given);

  Mesh& mesh;
  MeshEditor editor;
  EdgeMap<double> rest;
  BaseSurface base;
  std::size_t old_vertices;
  std::vector<BandCurve> curves;
  InsertionOptions flip_options;  ///< of the safe rule; may_flip is asked

  std::vector<FacePoint> place;          ///< of each vertex on the base
  std::vector<Hold> hold;                ///< of each vertex
  std::vector<bool> moved;               ///< of each vertex: it is not where it was made
  std::vector<bool> on_seam;             ///< of each vertex: it has several texture coordinates
  std::vector<std::vector<OnCurve>> on;  ///< curves of each vertex
  std::vector<bool> in_band;             ///< by face
  std::vector<SplitEdge> cut_lines;      ///< edges of earlier lines that were split
  std::size_t splits = 0, flips = 0, detours = 0;

  bool is_old(Vertex v) const { return v.idx() < old_vertices; }
  /// Vertices of the band's faces, ascending.
  std::vector<Vertex> vertices() const;
  /// The halfedge of an edge from its lower vertex.
  Halfedge from_lower(Edge e) const;
  /// Whether one of its faces is in the band.
  bool touches_band(Edge e) const;
  /// Whether the edge is never flipped: border, seam or line.
  bool is_locked(Edge e) const;
  /// Mean rest length of the edges at a vertex [m].
  double mean_edge(Vertex v) const;

  /// Splits an edge at t from its lower vertex. The new vertex goes to the base, and onto the curves that the
  /// edge belongs to if it is near (0.2 of the edge).
  Vertex split(Edge e, double t);
  /// Moves the centre of a star to a place in it, to the point `p` of space (none: the point of the base
  /// there), with new rest lengths. False, nothing changed, if a face would have less than `least` of
  /// quality, or turn over in space.
  bool move(const Star& star, const Place2& x, double least, const Point* p = nullptr);
  /// The same for a star that does not lie flat: edges keep their strain, rest lengths over lengths in space.
  bool move_in_space(const Star& star, const Point& p, double least);
  /// Whether the rules allow the flip of an edge, in the rest metric and in the shape that `at` gives.
  bool may_be_flipped(Edge e, const std::function<const Point&(Vertex)>& at) const;
  /// Delaunay flips in the rest metric within the band; returns how many.
  std::size_t flip_to_delaunay();
  /// Puts a vertex on a curve's list.
  void put_on(Vertex v, int curve, double along);
  void take_off(Vertex v, int curve);
  /// The place of a vertex on a curve; < 0: it is not on it.
  double along(Vertex v, int curve) const;
  /// An edge of the chain of a curve, from a vertex to another: whether in the curve's direction.
  struct CurveEdge {
    int curve;
    double from, to;
    bool ahead;
  };
  /// The curves on which one of the two follows the other.
  std::vector<CurveEdge> curves_of(Vertex a, Vertex b) const;
  /// The vertex after, or before, a place of a curve; none at its end.
  Vertex next_on(int curve, double along) const;
  Vertex previous_on(int curve, double along) const;

  /// Attributes of all that moved; call it once, at the end.
  void finish();

 private:
  FacePoint place_on(Halfedge h, const Point& p) const;
  bool turns_over(const Star& star, const Point& p) const;
  void settle(Vertex v, const Point& p, const FacePoint& at, const Star& star,
              const std::vector<double>& lengths);
  void grow(Vertex v, Hold as, Face left, Face right);
  void join_curve(Vertex v, const CurveEdge& edge, double t);
};

}  // namespace furrow::geometry
