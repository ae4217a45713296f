// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/lattice.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace furrow::tests {
namespace {

double nearest_pair(const io::Lattice& lattice) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 1; i < lattice.points(); ++i) {
    const Eigen::Vector2d p = lattice.point(i, 0, 0) - lattice.point(0, 0, 0);
    nearest = std::min(nearest, std::hypot(p.x() - std::round(p.x()), p.y() - std::round(p.y())));
  }
  return nearest;
}

TEST_CASE("lattice: its points are nearly as far apart as they can be, and its steps span it") {
  for (const int n : {4, 16, 32, 36, 144}) {
    const io::Lattice lattice(n);
    const double hexagonal = std::sqrt(2 / std::sqrt(3.0) / n);  // no lattice is better
    CHECK(nearest_pair(lattice) > 0.8 * hexagonal);
    CHECK(nearest_pair(lattice) == Approx(lattice.step(0).norm()));
    const double cell = lattice.step(0).x() * lattice.step(1).y() - lattice.step(0).y() * lattice.step(1).x();
    CHECK(std::abs(cell) == Approx(1.0 / n));
  }
  CHECK_THROWS_WITH(io::Lattice(0), Catch::Contains("points 0"));
}

TEST_CASE("lattice: over all shifts it integrates exactly, whatever the function") {
  const io::Lattice lattice(16);
  double sum = 0;
  constexpr int steps = 200;
  for (int a = 0; a < steps; ++a)
    for (int b = 0; b < steps; ++b)
      for (int i = 0; i < 16; ++i) {
        const Eigen::Vector2d p = lattice.point(i, (a + 0.5) / steps, (b + 0.5) / steps);
        REQUIRE((p.minCoeff() >= 0 && p.maxCoeff() < 1));
        sum += std::hypot(p.x() - 0.3, p.y() - 0.4) < 0.25;  // a disk
      }
  CHECK(sum / (16.0 * steps * steps) == Approx(3.14159265 * 0.0625).epsilon(2e-3));
}

}  // namespace
}  // namespace furrow::tests
