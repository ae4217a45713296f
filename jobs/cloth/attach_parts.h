// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "io/mesh/mesh_file.h"
#include "jobs/base/inputs.h"

namespace furrow::jobs {

/// Lets parts of a garment that lie on other cloth ride on it (geometry/figure/attached_parts.h), unless the
/// file notes which ones do: then those that were drawn on since do no more. Warns of them, with the file's
/// name. Parts with pinned vertices stay cloth. pins: vertices, by pin.
void attach_parts(io::MeshFile& file, const std::string& name, const std::vector<std::vector<int>>& pins,
                  const Context& context);

}  // namespace furrow::jobs
