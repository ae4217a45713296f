// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "cli/common.h"
#include "physics/distance_field.h"
#include "physics/exact_distance.h"

namespace furrow::cli {

/// A body and how its distance field is made.
struct BodyArguments {
  std::string path;                 ///< empty: no body
  std::string field;                ///< a field saved by `furrow sdf`; empty: built
  std::optional<double> tolerance;  ///< of the field [m]
  std::string gradient = "exact";   ///< exact, or interpolated (the paper's)
};
void add_body_options(CLI::App& sub, BodyArguments& a);
void add_field_options(CLI::App& sub, BodyArguments& a);

struct BodyCollider {
  physics::TriangleMesh triangles;
  physics::ExactDistance exact;
  physics::DistanceField field;
};

/// Reads and repairs a body, and builds its field or loads the saved one. Warns of what was repaired.
BodyCollider load_body(const BodyArguments& a, const CommonArguments& common);

/// The gap that a garment keeps: at least `wanted`, and never less than the sag of a long edge (95th
/// percentile) over a limb of 5 cm radius plus 1.5 field tolerances, so that faces and edges stay outside
/// when vertices do [m].
double contact_gap(double wanted, const BodyCollider& body, const geometry::Mesh& garment);

}  // namespace furrow::cli
