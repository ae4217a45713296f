// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "bridge/draping/drape.h"
#include "bridge/draping/level_start.h"
#include "geometry/mesh/mesh.h"
#include "geometry/refine/local_refinement.h"

/// A garment that is refined where its cloth asks for it, from one rest to the next: for drape().
namespace furrow::bridge {

/// The edge of an equilateral triangle of a face's area, by the lengths of the edges [m].
double size_of(const geometry::Mesh& mesh, geometry::Face f, const std::vector<double>& lengths);

/// By face, how much finer it should be: the larger of
///   the angle that an edge of it is bent by, over RefineWhere::bend, and
///   where it is pressed together, the height of the folds that would take the strain up, over
///   RefineWhere::seen: at two edges a fold, height = 2 h / pi sqrt(strain), for a face of the size h
///   (size_of()).
/// More than 1: it asks to be cut. The mesh has its rest metric, and lies as the cloth rests. O(faces).
std::vector<double> want_of_refinement(const geometry::Mesh& mesh, const RefineWhere& where);

/// The meshes of such a drape, coarse to fine.
class LocalLevels {
 public:
  LocalLevels(const geometry::Mesh& garment, int depth, const RefineWhere& where)
      : where_(where), refined_(garment, depth) {}

  geometry::Mesh mesh() const { return refined_.mesh(rounds_); }
  std::size_t uniform_vertices() const { return refined_.uniform_vertices(); }

  /// Cuts faces of mesh(), which lies as its cloth rests in `at_rest`, with the rest metric that the cloth
  /// has: those that want it, the ones that want it most first, until about so many vertices are reached as
  /// are allowed. Returns whether there were any.
  bool refine(const geometry::Mesh& at_rest);
  /// Whether there is a face that is cut as often as may be, wants more, and is larger than 1.5 times
  /// `finest`.
  bool out_of_cuts(const geometry::Mesh& at_rest) const;
  /// Whether vertices ran out in refine().
  bool ran_out() const { return ran_out_; }

  /// Where the vertices of a mesh that refine() made begin: on the surface of the one before, and where
  /// Loop's masks move them from there.
  Carried carry(const geometry::Mesh& at_rest, const geometry::Mesh& refined) const;

 private:
  RefineWhere where_;
  geometry::LocalRefinement refined_;
  int rounds_ = 0;
  bool ran_out_ = false;
};

}  // namespace furrow::bridge
