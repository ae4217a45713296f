// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>

#include "physics/pairs/pair_distance.h"
#include "physics/pairs/pair_mesh.h"
#include "tests/physics/cloth/test_cloths.h"

namespace furrow::tests {

using Corners = std::array<physics::Vec3, 4>;

/// Four points in a cube of half a metre; of a third of the seeds near a plane, of some with a short side.
inline Corners random_corners(std::uint64_t seed) {
  Noise noise(seed);
  Corners x;
  for (Vec3& p : x) p = 0.25 * noise.vector();
  if (seed % 3 == 0)
    for (Vec3& p : x) p.z() *= 1e-3;
  if (seed % 7 == 0) x[3] = x[2] + 1e-3 * noise.vector();
  return x;
}

using physics::distance_of;

/// A sheet of random heights over a square of 1 m, with a membrane at rest as it lay flat, folded over where
/// `crumple` is large.
inline physics::Cloth rough_sheet(int n, double crumple, std::uint64_t seed) {
  Noise noise(seed);
  physics::Cloth cloth;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) add_particle(cloth, {double(i) / n, double(j) / n, 0}, 0.01);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i, b = a + 1, c = a + n + 2, d = a + n + 1;
      cloth.triangles.push_back({a, b, c});
      cloth.triangles.push_back({a, c, d});
    }
  const auto& x = cloth.particles.x;
  for (const auto& t : cloth.triangles)
    cloth.membrane.push_back({t,
                              {(x[std::size_t(t[2])] - x[std::size_t(t[1])]).norm(),
                               (x[std::size_t(t[0])] - x[std::size_t(t[2])]).norm(),
                               (x[std::size_t(t[1])] - x[std::size_t(t[0])]).norm()},
                              100,
                              100});
  for (Vec3& p : cloth.particles.x) p += crumple / n * noise.vector();
  return cloth;
}

}  // namespace furrow::tests
