// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/plates.h"

#include <algorithm>
#include <cmath>

#include "physics/cloth/plate_bending.h"
#include "tests/cases/flat_meshes.h"

namespace furrow::cases {

using namespace physics;

std::vector<std::array<double, 3>> lengths_of(const Cloth& cloth) {
  std::vector<std::array<double, 3>> result;
  const auto& x = cloth.particles.x;
  for (const auto& t : cloth.triangles)
    result.push_back({(x[t[2]] - x[t[1]]).norm(), (x[t[0]] - x[t[2]]).norm(), (x[t[1]] - x[t[0]]).norm()});
  return result;
}

std::vector<double> warp_along(const Cloth& cloth, double angle) {
  std::vector<double> result;
  for (const auto& t : cloth.triangles) {
    const Vec3 e = cloth.particles.x[t[1]] - cloth.particles.x[t[0]];
    result.push_back(angle - std::atan2(e.y(), e.x()));
  }
  return result;
}

PlateParts plate_of(const Cloth& cloth, const PlateRigidity& rigidity, double warp_angle) {
  Cloth flat = cloth;
  flat.hinges.clear();
  add_flat_hinges(flat, rigidity.warp);
  const auto lengths = lengths_of(flat);
  const std::vector<double> warp = warp_along(flat, warp_angle);
  return make_plate({flat.triangles, lengths, flat.hinges, flat.particles.inv_mass}, {rigidity, warp});
}

void add_plate(Cloth& cloth, const PlateRigidity& rigidity, double warp_angle) {
  cloth.hinges.clear();
  add_flat_hinges(cloth, rigidity.warp);
  const std::vector<double> warp = warp_along(cloth, warp_angle);
  couple_hinges(cloth, lengths_of(cloth), {rigidity, warp});
}

std::vector<int> rings_from_border(const Cloth& cloth) {
  const int far = 1 << 20;
  std::vector<int> ring(cloth.particles.size(), far);
  const std::vector<EdgeApexes> edges = edges_of(cloth.triangles);
  for (const EdgeApexes& e : edges)
    if (e.left < 0 || e.right < 0) ring[std::size_t(e.a)] = ring[std::size_t(e.b)] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const EdgeApexes& e : edges) {
      int &a = ring[std::size_t(e.a)], &b = ring[std::size_t(e.b)];
      if (a > b + 1) a = b + 1, changed = true;
      if (b > a + 1) b = a + 1, changed = true;
    }
  }
  return ring;
}

std::vector<char> core_of(const Cloth& cloth, int rings) {
  const std::vector<int> ring = rings_from_border(cloth);
  std::vector<char> core;
  for (const auto& t : cloth.triangles)
    core.push_back(std::all_of(t.begin(), t.end(), [&](int v) { return ring[std::size_t(v)] >= rings; }));
  return core;
}

}  // namespace furrow::cases
