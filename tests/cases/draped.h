// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>

#include "bridge/arrays/gather.h"
#include "geometry/mesh/mesh.h"
#include "tests/cases/metamorphic.h"

namespace furrow::cases {

/// A garment that hangs from held vertices on a body at rest.
struct Drape {
  geometry::Mesh garment, body;   ///< [m]
  std::vector<int> held;          ///< vertices of the garment
  double density = 0.15;          ///< [kg/m^2]
  bridge::GatherOptions springs;  ///< without the mean lengths, which are the garment's
  physics::SimulateOptions options;
  // How it was changed:
  physics::Mat3 rotation = physics::Mat3::Identity();
  std::vector<int> place;  ///< as in RestCase
};

/// Changes of the meshes, before masses, springs and the body's field are made of them.
Drape rotated(Drape drape, const physics::Mat3& rotation = askew());  ///< with the body, and gravity
Drape permuted(Drape drape, std::uint64_t seed = 1);  ///< vertices and faces of garment and body
/// Both meshes written in millimetres (OBJ) and read with that unit.
Drape through_millimetres(Drape drape);

/// A drape ready to be simulated; `rest.body` is its field.
struct DrapedCase {
  std::shared_ptr<const physics::Collider> field;
  RestCase rest;
};
/// Prepares the drape as the program does: rest lengths as it lies, springs by the paper's law, a field of
/// the body. Held vertices that lie within the body are put on its surface.
DrapedCase draped(const Drape& drape);

/// The distances of the vertices of either surface to the other [m], ascending.
std::vector<double> surface_distances(const geometry::Mesh& mesh, const std::vector<physics::Vec3>& x,
                                      const std::vector<physics::Vec3>& y);
/// Their median [m].
double median_surface_distance(const geometry::Mesh& mesh, const std::vector<physics::Vec3>& x,
                               const std::vector<physics::Vec3>& y);

}  // namespace furrow::cases
