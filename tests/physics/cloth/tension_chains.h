// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "physics/cloth/pins.h"
#include "tests/physics/cloth/test_cloths.h"

namespace furrow::tests {

using physics::Tension;

/// Chains of springs whose tension is c [N/m^2] times the square of their elongation [m], so stretch = c L^2.
/// Sags, lengths: an independent program's, by shooting.
struct Level {
  double span, length, weight;  // m, m, N/m
  int springs;
  double c, sag, largest_strain;
};
inline constexpr Level level_chains[] = {{1, 1.5, 0.981, 32, 50000, 0.563571437043, 0.0831902764289},
                                         {1, 1.2, 0.981, 32, 50000, 0.368253207641, 0.097719365154},
                                         {0.8, 1, 0.5, 20, 10000, 0.328488467273, 0.104302957897},
                                         {0.5, 1.5, 2, 40, 200000, 0.707915341417, 0.0723415752944}};

/// Both ends pinned on one level, masses within; as a parabola of the given depth.
inline Cloth level_chain(const Level& chain, double depth, double compress) {
  Cloth cloth;
  const double rest = chain.length / chain.springs, stretch = chain.c * rest * rest;
  for (int i = 0; i <= chain.springs; ++i) {
    const double t = double(i) / chain.springs;
    add_particle(cloth, {chain.span * t, -4 * depth * t * (1 - t), 0}, chain.weight * rest / 9.81);
    if (i > 0) cloth.tension.push_back({i - 1, i, rest, stretch, compress * stretch});
  }
  physics::pin(cloth.particles, std::vector<int>{0, chain.springs});
  return cloth;
}

inline double lowest(const Cloth& cloth) {
  double y = 0;
  for (const Vec3& x : cloth.particles.x) y = std::min(y, x.y());
  return -y;
}

inline double largest_strain(const Cloth& cloth) {
  double e = 0;
  for (const Tension& t : cloth.tension)
    e = std::max(e, (cloth.particles.x[t.b] - cloth.particles.x[t.a]).norm() / t.rest_length - 1);
  return e;
}

struct Hanging {
  int springs;
  double length, mass, c, hanging_length, largest_extension;
};
inline constexpr Hanging hanging_chains[] = {{10, 1, 0.01, 1000, 1.22253805915, 0.0313209195267},
                                             {20, 1, 0.005, 1000, 1.43188202416, 0.0313209195267},
                                             {20, 0.5, 0.002, 250, 1.04629235073, 0.0396181776461},
                                             {50, 2, 0.004, 4000, 2.74868210747, 0.0221472345904}};

/// Pinned at the top, straight down, at rest: tension has no stiffness at all there.
inline Cloth hanging_at_rest(const Hanging& chain) {
  Cloth cloth;
  const double rest = chain.length / chain.springs;
  for (int i = 0; i <= chain.springs; ++i) {
    add_particle(cloth, {0, -rest * i, 0}, chain.mass);
    if (i > 0) cloth.tension.push_back({i - 1, i, rest, chain.c * rest * rest, 0});
  }
  physics::pin(cloth.particles, std::vector<int>{0});
  return cloth;
}

/// Of the strains against  e = sqrt(T / c), T the weight below.
inline double largest_strain_error(const Cloth& cloth, const Hanging& chain) {
  double worst = 0;
  for (const Tension& t : cloth.tension) {
    const double strain = (cloth.particles.x[t.b] - cloth.particles.x[t.a]).norm() / t.rest_length - 1;
    const double pull = (chain.springs - t.a) * chain.mass * 9.81;
    worst = std::max(worst, std::abs(strain - std::sqrt(pull / t.stretch)));
  }
  return worst;
}

}  // namespace furrow::tests
