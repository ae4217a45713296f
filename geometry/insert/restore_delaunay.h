// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

#include "geometry/insert/insertion.h"
#include "geometry/insert/mesh_editor.h"

namespace furrow::geometry {

/// Flips edges that are not Delaunay in the rest metric (angles opposite the edge sum to more than pi + 1e-7)
/// until none is left between two faces of the editor's changed faces and their edge neighbours. Line edges,
/// seams, borders and whatever refusal_of_flip refuses stay. Returns the number of flips. The smallest angle
/// of the faces grows or stays. Source: Fisher, Springborn, Bobenko, Schroeder 2007, intrinsic Delaunay
/// triangulation.
std::size_t restore_delaunay(MeshEditor& editor, const InsertionOptions& options);

}  // namespace furrow::geometry
