// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/property_names.h"

namespace furrow::geometry::attribute {

/// Along the warp of woven cloth, either way, where the face lay before lines, pose and motion
/// (v:rest_position, else the vertices); of any length, its projection on the face counts; NaN = not known.
inline constexpr PropertyName<Face, RestPosition> warp{"f:warp", {unset_value, unset_value, unset_value}};

}  // namespace furrow::geometry::attribute
