// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/mesh/property_names.h"

namespace furrow::geometry::attribute {

/// Factor on the hinge of an edge as the material makes it [-]; >= 0; NaN: that of the lines around
/// (fold/line_press.h). `furrow keep` stores it where bending is a plate, whose hinges have no stiffness of
/// their own.
inline constexpr PropertyName<Edge, double> press{"e:press", unset_value};

}  // namespace furrow::geometry::attribute
