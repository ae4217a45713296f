// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <limits>

#include "physics/cloth/cloth.h"
#include "physics/cloth/pins.h"

using namespace furrow::physics;

TEST_CASE("strain: known strains have their statistics") {
  std::vector<Vec3> x{Vec3::Zero()};
  std::vector<Spring> springs;
  for (int i = 1; i <= 200; ++i) {  // strains 0.001, 0.002 … 0.2, every second one compressed
    x.push_back({i % 2 ? 1 + 0.001 * i : 1 - 0.001 * i, 0, 0});
    springs.push_back({0, i, 1, 5});
  }
  const StrainStatistics s = strain_statistics(x, springs);
  CHECK(s.max == Approx(0.2).epsilon(1e-12));
  CHECK(s.p99 == Approx(0.198).epsilon(1e-12));
  CHECK(s.mean == Approx(0.1005).epsilon(1e-12));
  CHECK(strain_statistics(x, {}).max == 0);
  x[7].x() = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(strain_statistics(x, springs).max));
}

TEST_CASE("strain: kinetic energy leaves pinned particles out") {
  Particles p{{Vec3::Zero(), Vec3::Zero()}, {{3, 4, 0}, {1, 0, 0}}, {2, 7}, {0.5, 1.0 / 7}};
  CHECK(kinetic_energy(p) == Approx(28.5));
  p.inv_mass[1] = 0;
  CHECK(kinetic_energy(p) == Approx(25));
}
