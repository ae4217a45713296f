// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/cloth/dihedral.h"
#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"
#include "tests/physics/cloth/test_cloths.h"

namespace furrow::tests {

/// Takes the springs out.
inline Cloth without_springs(Cloth cloth) {
  cloth.structural.clear();
  cloth.bending.clear();
  return cloth;
}

/// A membrane triangle for each triangle, at rest as the cloth lies.
inline void add_membrane(Cloth& cloth, double young_times_thickness, double poisson = 0.3) {
  const physics::PlaneLame lame = physics::plane_stress(young_times_thickness, poisson);
  const auto& x = cloth.particles.x;
  for (const auto& t : cloth.triangles) {
    physics::MembraneTriangle m{t, {}, lame.lambda, lame.mu};
    for (int i = 0; i < 3; ++i) m.rest_lengths[i] = (x[t[(i + 2) % 3]] - x[t[(i + 1) % 3]]).norm();
    cloth.membrane.push_back(m);
  }
}

/// A hinge for each interior edge, at rest as the cloth lies, for a bending rigidity [N m].
inline void add_hinges(Cloth& cloth, double rigidity) {
  std::map<std::pair<int, int>, int> apex;
  const auto& x = cloth.particles.x;
  const auto area = [&](int a, int b, int c) { return 0.5 * (x[b] - x[a]).cross(x[c] - x[a]).norm(); };
  for (const auto& t : cloth.triangles) {
    for (int c = 0; c < 3; ++c) apex[{t[c], t[(c + 1) % 3]}] = t[(c + 2) % 3];
  }
  for (const auto& [edge, tip] : apex) {
    const auto [a, b] = edge;
    const auto other = apex.find({b, a});
    if (a > b || other == apex.end()) continue;
    const int c = tip, d = other->second;
    cloth.hinges.push_back(
        {{a, b, c, d},
         physics::dihedral_angle(x[a], x[b], x[c], x[d]),
         physics::hinge_stiffness(rigidity, (x[b] - x[a]).norm(), area(a, b, c), area(b, a, d))});
  }
}

}  // namespace furrow::tests
