// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "geometry/refine/bake_maps.h"

namespace furrow::io {

/// The three files of a bake.
struct BakedFiles {
  std::filesystem::path displacement, normal, record;
};
/// PREFIX_displacement.png, PREFIX_normal.png, PREFIX_maps.json.
BakedFiles baked_files(const std::string& prefix);

/// Writes both maps as PNG of 16 bits a channel without colour space, and a JSON record that says how to read
/// them. metres = (value - zero) · metres_per_step, so that 0 is exact and the map's largest component fills
/// the range; a unit normal = value / 65535 · 2 - 1. Each file is written atomically, the record last. Throws
/// std::invalid_argument if the maps do not match their sizes; std::runtime_error if a file cannot be
/// written.
BakedFiles write_baked_maps(const std::string& prefix, const geometry::BakedMaps& maps);

/// Reads a displacement map by its record [m]. Throws geometry::ContentError if record or picture cannot be
/// used.
geometry::VectorMap read_displacement(const std::filesystem::path& record);

}  // namespace furrow::io
