// SPDX-License-Identifier: MIT
#pragma once
#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// Makes the plates of a cloth that couple_hinges() made anew, from the rest lengths that its triangles have
/// now (those of the membrane, else of the springs or tension along their edges; else those before) and the
/// pins that it has now. Rest angles and presses stay, the warp stays where it lies in the cloth. A plate
/// stays as it is if the cloth's plain hinges are no longer as many as it left. Whether there was one to
/// make. Cost: that of make_plate(). Throws std::invalid_argument, nothing changed, as make_plate().
bool recouple(Cloth& cloth);

}  // namespace furrow::physics
