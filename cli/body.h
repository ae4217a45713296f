// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>

#include "cli/common.h"
#include "io/scene.h"
#include "physics/distance_field.h"
#include "physics/exact_distance.h"

namespace furrow::cli {

/// A rigid body in its own frame.
struct BodyCollider {
  physics::TriangleMesh triangles;
  physics::ExactDistance exact;
  physics::DistanceField field;
};

/// Reads and repairs a body, and builds its field or loads the saved one. Warns of what was repaired.
BodyCollider load_body(const io::SceneBody& body, const CommonArguments& common);

/// The gap that a garment keeps: at least `wanted`, and never less than the sag of a long edge (95th
/// percentile) over a limb of 5 cm radius plus 1.5 field tolerances, so that faces and edges stay outside
/// when vertices do [m].
double contact_gap(double wanted, double field_tolerance, const geometry::Mesh& garment);

}  // namespace furrow::cli
