// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>

#include "physics/body/distance_field.h"

namespace furrow::io {

/// Saves the distance field of a body with a fingerprint of the body's triangles. Written whole or not at
/// all.
void write_field(const std::filesystem::path& path, const physics::DistanceField& field,
                 const physics::TriangleMesh& body);

/// The field saved for this very body. Throws geometry::ContentError if the file is damaged, of another
/// version, or was made for another body.
physics::DistanceField read_field(const std::filesystem::path& path, const physics::TriangleMesh& body);

}  // namespace furrow::io
