// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>

#include "bridge/arrays/gather.h"
#include "bridge/draping/drape.h"
#include "geometry/mesh/mesh.h"
#include "physics/body/distance_field.h"
#include "physics/body/exact_distance.h"

namespace furrow::cases {

/// A garment and a body from files [m].
struct GarmentPair {
  geometry::Mesh garment;        ///< as it lies in its file, at rest
  physics::ExactDistance exact;  ///< of the body
  physics::DistanceField field;
};
/// Throws as io::read_mesh(), repair_body() and DistanceField::build() do.
GarmentPair read_pair(const std::filesystem::path& garment, const std::filesystem::path& body,
                      int threads = 1);

/// The gap that `furrow drape` keeps [m] between the body and the garment after so many Loop refinements.
double gap_of(const GarmentPair& pair, int refinements);

/// A vertex of the garment's top border loop. It stays on that loop when the garment is refined.
int vertex_at_top(const geometry::Mesh& garment);

/// Cloth as `furrow drape` makes it of cotton (io/scene/fabrics.h): triangles, and hinges or a plate, which
/// is its default. The border loop through the vertex `held` (none: nothing) is pinned where it lies, or on
/// the body's surface where it lies inside. The pair must outlive it.
bridge::MakeCloth make_cotton(const GarmentPair& pair, std::optional<int> held = {},
                              bridge::Bending bending = bridge::Bending::hinge);

struct Depth {
  int particles = 0;             ///< free ones nearer than the gap and 1e-5 m
  double mean = 0, largest = 0;  ///< of theirs, below the gap [m]
};
Depth depth_of(const physics::Cloth& cloth, const physics::Collider& body, double gap);

}  // namespace furrow::cases
