// SPDX-License-Identifier: MIT
#pragma once

namespace furrow::physics {

/// How stiff friction is along the way of what slides: not at all, as its force is the limit whatever the
/// way; or by limit over way. Moves are shorter then, and where much slides they lower the energy.
enum class SlipStiffness { none, secant };

}  // namespace furrow::physics
