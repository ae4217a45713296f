// SPDX-License-Identifier: GPL-3.0-or-later
#include "bridge/draping/energy_parts.h"

#include <stdexcept>

#include "physics/cloth/elements.h"
#include "physics/cloth/kinds.h"
#include "physics/cloth/patch_membrane.h"

namespace furrow::bridge {

EnergyParts energy_parts(const physics::Cloth& cloth, const physics::Vec3& gravity,
                         const std::vector<physics::Vec3>& places) {
  const physics::Particles& p = cloth.particles;
  if (places.size() != p.size())
    throw std::invalid_argument("energy_parts: " + std::to_string(p.size()) + " particles, but " +
                                std::to_string(places.size()) + " places");
  physics::check_elements(cloth, p.size());
  const auto sum = [&](const auto& elements, auto... law) {
    double e = 0;
    for (const auto& element : elements) e += physics::energy(p.x, element, law...);
    return e;
  };
  EnergyParts parts;
  parts.stretch = sum(cloth.structural) + sum(cloth.membrane) + sum(cloth.tension);
  parts.bending = sum(cloth.hinges, cloth.hinge_law);
  bool across = cloth.hinges.empty();
  for (const auto& own : cloth.energies) {
    const bool stretches = dynamic_cast<const physics::PatchMembrane*>(own.get()) != nullptr;
    (stretches ? parts.stretch : parts.bending) += own->energy(p.x);
    across = across && stretches;
  }
  (across ? parts.bending : parts.ties) += sum(cloth.bending);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.inv_mass[i] > 0) parts.weight -= p.mass[i] * gravity.dot(p.x[i] - places[i]);
  return parts;
}

}  // namespace furrow::bridge
