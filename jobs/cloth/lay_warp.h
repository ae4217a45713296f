// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "io/mesh/mesh_file.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// Gives every face of a garment a direction of the warp by the source that material.warp names, spread to
/// faces that it leaves without; warns of those that get none from it, and with `auto` of what was taken.
/// `woven`: whether the cloth has threads at all. Throws geometry::ContentError for a source that the garment
/// does not have, or strokes that cannot be laid on.
void lay_warp(io::MeshFile& file, const std::string& source, bool woven, const std::string& garment,
              const Context& context);

}  // namespace furrow::jobs
