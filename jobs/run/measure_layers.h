// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "jobs/drape.h"

namespace furrow::jobs {

/// Several meshes as one, one after the other, without their maps.
geometry::Mesh joined_mesh(std::span<const geometry::Mesh* const> meshes);

/// A garment as it was given and as it is worn.
struct Layer {
  const geometry::Mesh *given, *now;
  bool turned;  ///< its faces look inwards
  bool touch = true;
};

/// How each two garments cross each other, before and now, and whether they lie in their order, the innermost
/// first. Their own crossings are taken from `draped`, which is told with how many faces each crosses others.
/// Throws as geometry::find_crossings(). Cost: that, twice for each two.
std::vector<LayerPair> measure_layers(std::span<const Layer> layers, std::span<Draped> draped);

}  // namespace furrow::jobs
