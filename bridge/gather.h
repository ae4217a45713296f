// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh.h"
#include "physics/springs.h"

namespace furrow::bridge {

/// How a mesh's maps become masses and springs.
struct GatherOptions {
  double structural_stiffness = 1000;  ///< k_std of the structural springs [N/m]; > 0
  double bending_stiffness = 10;       ///< k_std of the bending springs [N/m]; >= 0
  double mean_structural_length = 0;   ///< r_avg of the initial model's structural springs [m]; > 0
  double mean_bending_length = 0;  ///< r_avg of the initial model's bending springs [m]; > 0 if there are any
};

/// The mesh as plain arrays: particle i is vertex i, its velocity that of v:velocity (0 without
/// that map). Masses from v:mass, rest lengths from
/// e:rest_length and e:bending_rest_length, stiffness k = (r / r_avg) k_std (method S1.7), times
/// e:bending_count where one bending spring stands for several hinges. A vertex without faces gets mass 0 and
/// stays where it is. Throws std::invalid_argument if an option is out of its range, a map is missing, or the
/// mesh has removed elements (collect its garbage first); ContentError for a rest length or a mass that is
/// not > 0. Cost: O(edges log edges).
physics::Cloth gather(const geometry::Mesh& mesh, const GatherOptions& options);

}  // namespace furrow::bridge
