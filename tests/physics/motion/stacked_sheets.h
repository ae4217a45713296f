// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
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

inline void put_over(Cloth& cloth, const Cloth& other) {
  const int n = int(cloth.particles.size());
  const auto add = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  add(cloth.particles.x, other.particles.x);
  add(cloth.particles.v, other.particles.v);
  add(cloth.particles.mass, other.particles.mass);
  add(cloth.particles.inv_mass, other.particles.inv_mass);
  for (auto t : other.triangles) cloth.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  for (auto t : other.membrane) {
    for (int& v : t.vertices) v += n;
    cloth.membrane.push_back(t);
  }
  for (auto h : other.hinges) {
    for (int& v : h.vertices) v += n;
    cloth.hinges.push_back(h);
  }
}

}  // namespace furrow::tests
