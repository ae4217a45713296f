// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "bridge/draping/drape.h"
#include "geometry/mesh/mesh.h"
#include "physics/pairs/untangle_layers.h"

namespace furrow::bridge {

/// One of several garments that are worn over each other.
struct LayerGarment {
  geometry::Mesh mesh;        ///< as it was given; draped on return, with the maps of make_cloth
  MakeCloth make_cloth;       ///< as for drape()
  double thickness = 0;       ///< of its cloth [m]; >= 0; 0: that of the options
  bool touches = true;        ///< false: it and all others pass through each other
  physics::Cloth cloth = {};  ///< out: of the last level
  EnergyParts energy = {};    ///< out: its own; contact is 0
  bool turned = false;        ///< out: its faces look into the body
};

/// Whether most of a cloth's faces look into the body. O(T).
bool looks_inwards(const physics::TriangleMesh& cloth, const physics::Collider& body);

struct LayersReport {
  std::vector<DrapeLevel> levels;     ///< of all as one cloth; `soft` of the first: of each by itself
  physics::UntangleReport untangled;  ///< before the first level
  double disturbance = 0;             ///< of the last level [m]
  double contact_energy = 0;          ///< of the last level [J]
  bool stopped = false;               ///< by go_on, or interrupted
};

/// Drapes garments over each other, the innermost first, as one cloth of several parts with contact of cloth
/// with cloth (options.settle.self, which must be on). First each comes near rest by itself, as far from the
/// body as its place in the order needs; where they cross then, physics::untangle_layers() takes them apart,
/// and they come to rest together. What cannot be taken apart goes on crossing, and counts in
/// SelfContactReport::exempt. Nothing that is drawn within a garment is pushed; between them all is.
/// Same input, same bits. go_on gets the joined cloth; before, at level -1, that of one garment. Throws
/// std::invalid_argument for an option out of its range, plain, bending_friction, or a soft_start; and as
/// drape() does.
LayersReport drape_layers(std::span<LayerGarment> garments, const physics::Collider* body,
                          const DrapeOptions& options, const DrapeObserver& go_on = {});

}  // namespace furrow::bridge
