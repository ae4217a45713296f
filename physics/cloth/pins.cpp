// SPDX-License-Identifier: MIT
#include "physics/cloth/pins.h"

#include "physics/base/require.h"

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
