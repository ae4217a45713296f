// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "io/picture/png_file.h"
#include "physics/body/collider.h"

namespace furrow::io {

/// The distances of a body in the plane through the middle of the box low … high [m], seen along -z with y
/// up: blue inside, orange outside, a line every centimetre and the surface in black. `width` pixels cover
/// the box and a margin of 10 cm. Throws std::invalid_argument for a width outside [16, 8192] or an empty
/// box.
Image render_slice(const physics::Collider& body, const physics::Vec3& low, const physics::Vec3& high,
                   int width = 900);

}  // namespace furrow::io
