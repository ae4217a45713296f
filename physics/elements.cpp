// SPDX-License-Identifier: MIT
#include "physics/elements.h"

#include <array>

#include "physics/hinge_forces.h"
#include "physics/membrane.h"
#include "physics/spring_forces.h"
#include "physics/tension_forces.h"

namespace furrow::physics {
namespace {

/// The first (0) or the second (1) half of some elements.
template <class Element>
std::span<const Element> half(const std::vector<Element>& all, int which) {
  const std::size_t middle = all.size() / 2;
  return which ? std::span(all).subspan(middle) : std::span(all).first(middle);
}

void add_half(const Cloth& cloth, std::span<const Vec3> x, int which, std::span<Vec3> force) {
  add_spring_forces(x, half(cloth.structural, which), force);
  add_spring_forces(x, half(cloth.bending, which), force);
  add_membrane_forces(x, half(cloth.membrane, which), force);
  add_tension_forces(x, half(cloth.tension, which), force);
  add_hinge_forces(x, half(cloth.hinges, which), cloth.hinge_law, force);
}

double energy_of_half(const Cloth& cloth, std::span<const Vec3> x, int which) {
  return spring_energy(x, half(cloth.structural, which)) + spring_energy(x, half(cloth.bending, which)) +
         membrane_energy(x, half(cloth.membrane, which)) + tension_energy(x, half(cloth.tension, which)) +
         hinge_energy(x, half(cloth.hinges, which), cloth.hinge_law);
}

}  // namespace

double potential_energy(const Cloth& cloth, std::span<const Vec3> x, ThreadPool& pool) {
  std::array<double, 2> energy{};
  pool.run(2, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) energy[std::size_t(i)] = energy_of_half(cloth, x, i);
  });
  return energy[0] + energy[1];
}

void add_forces(const Cloth& cloth, std::span<const Vec3> x, std::span<Vec3> force, ThreadPool& pool) {
  std::vector<Vec3> second(force.size(), Vec3::Zero());
  pool.run(2, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) add_half(cloth, x, i, i ? std::span<Vec3>(second) : force);
  });
  for (std::size_t i = 0; i < force.size(); ++i) force[i] += second[i];
}

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
