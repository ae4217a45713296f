// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cases/plates.h"

#include <algorithm>
#include <cmath>

#include "physics/plate/plate_bending.h"

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

ClampedStrip clamped_strip(SheetKind kind, double length, double width, int columns, double young,
                           double density) {
  ClampedStrip strip{sheet_of(kind, length, width, columns, density), {}, length, width, density};
  Cloth& cloth = strip.cloth;
  cloth.structural.clear();
  Particles& p = cloth.particles;
  const double end = 1e-9 * length, h = length / columns;
  for (int i = 0; i < int(p.size()); ++i)
    if (p.x[std::size_t(i)].x() > length - end) strip.tip.push_back(i);
  std::sort(strip.tip.begin(), strip.tip.end(),
            [&](int a, int b) { return p.x[std::size_t(a)].y() < p.x[std::size_t(b)].y(); });
  for (const EdgeApexes& e : edges_of(cloth.triangles)) {
    const Vec3 a = p.x[std::size_t(e.a)], b = p.x[std::size_t(e.b)];
    if (a.x() > end || b.x() > end) continue;
    const bool up = e.left >= 0;  // the triangle that there is lies left of a -> b
    cloth.triangles.push_back({up ? e.b : e.a, up ? e.a : e.b, int(p.size())});
    p.inv_mass[std::size_t(e.a)] = p.inv_mass[std::size_t(e.b)] = 0;
    p.x.push_back(0.5 * (a + b) - Vec3(h, 0, 0));
    p.v.push_back(Vec3::Zero());
    p.mass.push_back(1e-3 * density * h * h);
    p.inv_mass.push_back(0);
  }
  add_flat_membrane(cloth, young, 0);
  return strip;
}

double strip_rigidity(const physics::PlateRigidity& p, double angle) {
  const double c2 = std::pow(std::cos(angle), 2), s2 = std::pow(std::sin(angle), 2);
  return 1 / (c2 * c2 / p.warp + s2 * s2 / p.weft + (1 / p.twist - 2 * p.poisson / p.warp) * c2 * s2);
}

}  // namespace furrow::cases
