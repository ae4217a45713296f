// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/mesh.h"

namespace furrow::io {

/// Throws geometry::ContentError for a vertex attribute (vertex_attributes.h) that is named like a column of
/// saved states (PlyValue::state): a state with both could not be read again.
void check_state_attributes(const geometry::Mesh& mesh);

}  // namespace furrow::io
