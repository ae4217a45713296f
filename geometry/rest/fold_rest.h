// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "geometry/rest/rest_state.h"

namespace furrow::geometry {

struct FoldRestReport {
  RestReport carried;
  std::size_t unfolded_edges = 0;  ///< edges whose factor is that of the unfolded pair
  std::size_t reshaped_faces = 0;  ///< faces that took the lengths of their present shape
  std::size_t invalid_faces = 0;   ///< of the whole mesh: they break the triangle inequality all the same
};

/// The rest state after folds are raised (rule fold). Lengths: apply_rest_rule()'s. But an edge over a crease
/// (a flip: its chord is shorter than its rest length, the unfolded one) grows as in the two triangles across
/// it laid flat about the other diagonal, and a face that then breaks the triangle inequality, or is within 1
/// % of it, takes the lengths of its present shape. Angles: own + (base - before) + set (now - base); by
/// edge, `base_angles` are those of the unraised surface that new vertices were laid on [rad], `set` is in
/// [0, 1]. Rule flat changes nothing, copied counts as set = 1. Throws as apply_rest_rule().
FoldRestReport apply_fold_rest(Mesh& mesh, const RestSnapshot& before, std::span<const double> base_angles,
                               std::span<const double> set, RestRule rule);

/// The rest angles alone: what apply_fold_rest() says of them. Returns how many changed.
std::size_t turn_hinges(Mesh& mesh, const RestSnapshot& before, std::span<const double> base_angles,
                        std::span<const double> set, RestRule rule);

/// Faces that break the triangle inequality at rest, their own lengths (h:rest_length) included.
std::size_t invalid_rest_faces(const Mesh& mesh);

}  // namespace furrow::geometry
