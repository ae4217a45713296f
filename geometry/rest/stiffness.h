// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"

namespace furrow::geometry {

/// How a spring's constant follows from its rest length r (method S1.7). proportional is the papers' law,
/// inverse is the physics of a thread.
enum class StiffnessLaw {
  proportional,  ///< k = (r / r_avg) k_std
  constant,      ///< k = k_std
  inverse        ///< k = (r_avg / r) k_std
};

/// Spring constant [N/m] of a spring of rest length `rest_length` [m] > 0, where `mean_rest_length` is r_avg
/// [m] > 0 of the initial model and of this type of spring, `k_std` [N/m] >= 0 the constant of a spring of
/// that length. Throws std::invalid_argument for what is out of range or not finite. Source: Shi and Saito,
/// the update of spring constants after a line.
double spring_stiffness(double rest_length, double mean_rest_length, double k_std,
                        StiffnessLaw law = StiffnessLaw::proportional);

/// Mean rest length of the structural springs, one for each edge [m] (the present length where unset).
/// Throws ContentError if the mesh has no edges.
double mean_rest_length(const Mesh& mesh);

/// Mean rest length of the bending springs [m], each vertex pair once; 0 if the mesh has none.
double mean_bending_rest_length(const Mesh& mesh);

}  // namespace furrow::geometry
