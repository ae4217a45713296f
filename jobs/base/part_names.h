// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "geometry/mesh/parts.h"
#include "io/mesh/mesh_file.h"

namespace furrow::jobs {

/// What a part is called: the group that its faces alone belong to ("'button'"), else "part 2 (12 vertices)",
/// by the order of the parts' first faces in the file; of a garment in one piece "the garment".
std::string name_of_part(const io::MeshFile& file, const geometry::Parts& parts, int part);

/// The shortest of what parts_called() knows it by alone: "button", "part 2". O(faces).
std::string setting_name_of_part(const io::MeshFile& file, const geometry::Parts& parts, int part);

/// The parts that are called so, or whose faces all belong to the group of that name: "button", "part 2", or
/// as name_of_part() has it without quotes. Ascending; empty: none is. O(faces).
std::vector<int> parts_called(const io::MeshFile& file, const geometry::Parts& parts,
                              const std::string& name);

}  // namespace furrow::jobs
