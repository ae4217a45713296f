// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "bridge/arrays/gather.h"
#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"

namespace furrow::jobs {

/// Masses, rest positions, rest lengths and bending springs where the garment has none (the shape as it is,
/// at rest), and a wrinkle record with the density and the mean rest lengths. Nothing changes in a garment
/// that is complete already, unless the material names another density. Of a garment without faces:
/// complete_chain().
void complete_garment(io::MeshFile& file, const io::SceneMaterial& material);

/// How a complete garment's maps become springs.
bridge::GatherOptions spring_options(const io::MeshFile& file, const io::SceneMaterial& material);

}  // namespace furrow::jobs
