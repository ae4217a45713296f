// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "io/mesh/mesh_file.h"
#include "io/scene/scene.h"

namespace furrow::jobs {

/// The vertices of each of the scene's pins. Throws std::invalid_argument for one that names nothing.
std::vector<std::vector<int>> find_pins(const io::MeshFile& file, const std::vector<io::ScenePins>& pins);

/// After lines were drawn: vertices from `old_count` on that split a border edge between two pinned vertices,
/// or lie among pinned vertices, are pinned with them.
void pin_new_vertices(const geometry::Mesh& mesh, std::size_t old_count, std::vector<std::vector<int>>& pins);

}  // namespace furrow::jobs
