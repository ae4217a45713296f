// SPDX-License-Identifier: MIT
#pragma once
#include <functional>
#include <span>

#include "physics/cloth/cloth.h"

namespace furrow::physics {

/// Stiffens a fold where it was drawn, as an iron, starch or fusible interfacing does: multiplies the
/// stiffness of the hinges whose edge has both ends in the patch. A hinge of a plate counts sqrt(factor)
/// times in the curvatures, so that a fold along it is as many times stiffer. Rest angles stay: a cloth in
/// balance by them needs prestress() again. Returns how many hinges. Cost: one pass.
/// Throws std::invalid_argument, nothing changed, if the factor is not > 0 and finite or an index is out of
/// range. Repeats in the patch are harmless.
int press(Cloth& cloth, std::span<const int> patch, double factor);

/// The same of the hinges, plain or of a plate, of which `which` says so.
int press_hinges(Cloth& cloth, const std::function<bool(const Hinge&)>& which, double factor);

}  // namespace furrow::physics
