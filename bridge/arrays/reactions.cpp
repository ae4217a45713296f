// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/arrays/reactions.h"

#include <utility>

#include "physics/cloth/elements.h"

namespace furrow::bridge {

using physics::Vec3;

Reactions reactions(const physics::Cloth& cloth, const Vec3& gravity,
                    std::span<const std::vector<int>> groups) {
  const physics::Particles& p = cloth.particles;
  std::vector<Vec3> pull(p.size(), Vec3::Zero());
  physics::add_forces(cloth, p.x, pull);
  for (std::size_t i = 0; i < p.size(); ++i) pull[i] += p.mass[i] * gravity;
  Reactions result;
  std::vector<char> counted(p.size(), 0);
  const auto bear = [&](std::size_t i, Vec3& force) {
    if (std::exchange(counted[i], 1)) return;
    force -= pull[i];
    result.weight += p.mass[i] * gravity;
  };
  for (const std::vector<int>& group : groups) {
    result.held.push_back(Vec3::Zero());
    for (const int i : group) {
      counted.at(std::size_t(i));
      bear(std::size_t(i), result.held.back());
    }
  }
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inv_mass[i] > 0) bear(i, result.contact);
  return result;
}

double mean_tension(std::span<const physics::Spring> band, std::span<const Vec3> x) {
  double force = 0, way = 0;
  for (const physics::Spring& s : band) {
    const double length = (x[std::size_t(s.b)] - x[std::size_t(s.a)]).norm();
    force += s.stiffness * (length - s.rest_length) * length;
    way += length;
  }
  return way > 0 ? force / way : 0;
}

}  // namespace furrow::bridge
