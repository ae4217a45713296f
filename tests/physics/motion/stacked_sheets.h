// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <utility>
#include <vector>

#include "physics/cloth/join_cloths.h"
#include "tests/cases/flat_meshes.h"

namespace furrow::tests {

using physics::Cloth;
using physics::Vec3;

/// A sheet of cotton in the plane z = height, its lower left corner at `corner`.
inline Cloth level_sheet(double width, int columns, double height, double corner, std::uint64_t seed) {
  Cloth cloth = cases::triangular_sheet(width, width, columns, cases::equilateral_rows(width, width, columns),
                                        0.12, 0.15, seed);
  cloth.structural.clear();
  cases::add_flat_membrane(cloth, 1000);
  cases::add_flat_hinges(cloth, 1e-5);
  for (Vec3& x : cloth.particles.x) x = Vec3(x.x() + corner, x.y() + corner, height);
  return cloth;
}

/// Its particles come after those of `cloth`.
inline void put_over(Cloth& cloth, const Cloth& other) {
  cloth = physics::join_cloths(std::vector{std::move(cloth), other});
}

}  // namespace furrow::tests
