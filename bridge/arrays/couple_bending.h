// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/arrays/gather.h"
#include "physics/plate/plate_bending.h"

namespace furrow::bridge {

/// With Bending::plate: makes a plate of the hinges of a cloth that gather() made of the mesh by the options,
/// once its pins are set and physics::stiffen_clamps() was called. Plain stay hinges with a stiffness of
/// their own (e:hinge_stiffness) and those that physics::couple_hinges() leaves. With any other law nothing
/// happens. O(edges). Throws std::invalid_argument, nothing changed, if the cloth is not of this mesh;
/// ContentError for a rest length that is not > 0.
physics::CoupledHinges couple_bending(const geometry::Mesh& mesh, const GatherOptions& options,
                                      physics::Cloth& cloth);

}  // namespace furrow::bridge
