// SPDX-License-Identifier: MIT
#include "physics/cloth/elements.h"

#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"
#include "physics/cloth/spring_forces.h"
#include "physics/cloth/tension_forces.h"

namespace furrow::physics {

double potential_energy(const Cloth& cloth, std::span<const Vec3> x) {
  return spring_energy(x, cloth.structural) + spring_energy(x, cloth.bending) +
         membrane_energy(x, cloth.membrane) + tension_energy(x, cloth.tension) +
         hinge_energy(x, cloth.hinges, cloth.hinge_law);
}

void add_forces(const Cloth& cloth, std::span<const Vec3> x, std::span<Vec3> force) {
  add_spring_forces(x, cloth.structural, force);
  add_spring_forces(x, cloth.bending, force);
  add_membrane_forces(x, cloth.membrane, force);
  add_tension_forces(x, cloth.tension, force);
  add_hinge_forces(x, cloth.hinges, cloth.hinge_law, force);
}

void add_stiffness(const Cloth& cloth, std::span<const Vec3> x, Stiffness stiffness, const BlockSink& sink) {
  add_spring_stiffness(x, cloth.structural, stiffness, sink);
  add_spring_stiffness(x, cloth.bending, stiffness, sink);
  add_membrane_stiffness(x, cloth.membrane, stiffness, sink);
  add_tension_stiffness(x, cloth.tension, stiffness, sink);
  add_hinge_stiffness(x, cloth.hinges, cloth.hinge_law, stiffness, sink);
}

}  // namespace furrow::physics
