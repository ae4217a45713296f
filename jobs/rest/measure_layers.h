// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <span>

#include "jobs/rest/drape.h"

namespace furrow::jobs {

/// Several meshes as one, one after the other, without their maps.
geometry::Mesh joined_mesh(std::span<const geometry::Mesh* const> meshes);

/// A garment as it was given and as it is worn.
struct Layer {
  const geometry::Mesh *given, *now;
  bool turned;  ///< its faces look inwards
  bool touch = true;
};

/// Throws std::invalid_argument that names what to swap, unless the listener allows it, where nearly all of
/// an outer garment that is near an inner one lies inside it as they are given (`given` and `turned` count).
/// names: of the garments, the innermost first. Cost: some 1 us a vertex and pair.
void require_order(std::span<const Layer> layers, std::span<const std::string> names, const Context& context);

/// How each two garments cross each other, before and now, and whether they lie in their order, the innermost
/// first. Their own crossings are taken from `draped`, which is told with how many faces each crosses others.
/// Throws as geometry::find_crossings(). Cost: that, twice for each two.
std::vector<LayerPair> measure_layers(std::span<const Layer> layers, std::span<Draped> draped);

}  // namespace furrow::jobs
