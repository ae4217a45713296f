// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

#include "bridge/arrays/place_noise.h"
#include "bridge/draping/drape.h"

/// How a level of a drape begins: for drape() and drape_layers().
namespace furrow::bridge {

/// Noise at places of the garment as it was given.
struct Disturbance {
  const std::vector<physics::Vec3>& places;  ///< one a particle [m]
  const PlaceNoise& noise;
  double by;  ///< [m]
};

/// Moves each free particle along its normal by the noise at its place. Creases begin so, and the cloth is
/// hardly strained.
void disturb(physics::Cloth& cloth, const Disturbance& disturbance);

/// Where the level before ended.
struct Carried {
  std::vector<physics::Vec3> coarse = {};  ///< its surface, one a particle; empty: where the cloth lies
  std::vector<physics::Vec3> fine = {};    ///< refined
};

/// The coarse surface on the mesh that refined it: new vertices lie in the middles of old edges, so that what
/// did not cross does not cross. Held particles stay. Returns a position for each particle [m].
std::vector<physics::Vec3> lay_on_coarse(const std::vector<physics::Vec3>& coarse,
                                         const physics::Cloth& cloth);

/// What cancels the way from one level to the next: an interrupt. A search that was stopped otherwise, as its
/// budget is spent, is carried up to the last level.
std::function<bool()> cancels_way_up(const DrapeOptions& options);

/// Puts a level's cloth where it begins: where it was carried, disturbed, and out of the body. With contact
/// of cloth with cloth on guarded ways; what crosses itself is taken apart there (untangle_contours()).
void begin_level(physics::Cloth& cloth, const Carried& carried, const Disturbance& disturbance,
                 const physics::Collider* body, const DrapeOptions& options, DrapeLevel& level);

/// The next level's mesh. Returns where the shape that was found lies on it.
std::vector<physics::Vec3> refine_level(const std::vector<physics::Vec3>& found, geometry::Mesh& garment,
                                        const DrapeOptions& options);

/// physics::settle() of a level. One that was stopped before its first iteration balances nothing, and finds
/// the residual. Throws physics::Cancelled if it was interrupted then.
physics::SettleReport settle_level(physics::Cloth& cloth, const physics::Collider* body,
                                   const physics::SettleOptions& settle, const DrapeOptions& options,
                                   const physics::SettleObserver& observer);

/// Of a level's own search: coarse ones end early, and have no guard of faces.
physics::SettleOptions level_options(const DrapeOptions& options, bool last, bool stopped);

}  // namespace furrow::bridge
