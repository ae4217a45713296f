// SPDX-License-Identifier: MIT
#include "physics/cloth/pins.h"

#include <algorithm>

#include "physics/base/require.h"
#include "physics/cloth/hinge_forces.h"
#include "physics/cloth/membrane.h"
#include "physics/cloth/spring_forces.h"
#include "physics/cloth/tension_forces.h"

namespace furrow::physics {

void pin(Particles& particles, std::span<const int> indices) {
  for (const int i : indices)
    if (i < 0 || std::size_t(i) >= particles.size())
      refuse("pin", "no particle ", i, " among ", particles.size());
  for (const int i : indices) {
    particles.inv_mass[i] = 0;
    particles.v[i] = Vec3::Zero();
  }
}

void drop_held_elements(Cloth& cloth) {
  const auto held = [&](int i) { return cloth.particles.inv_mass[i] == 0; };
  for_each_kind(cloth, [&](auto& elements, auto...) {
    std::erase_if(elements, [&](const auto& e) { return std::ranges::all_of(vertices(e), held); });
  });
}

namespace {

void scale_clamps(Cloth& cloth, double factor) {
  const auto held = [&](int i) { return cloth.particles.inv_mass[i] == 0; };
  for (Hinge& h : cloth.hinges) {
    const auto& [a, b, left, right] = h.vertices;
    if (held(a) && held(b) && held(left) != held(right)) h.stiffness *= factor;
  }
}

}  // namespace

void stiffen_clamps(Cloth& cloth) { scale_clamps(cloth, 2); }

void soften_clamps(Cloth& cloth) { scale_clamps(cloth, 0.5); }

}  // namespace furrow::physics
