// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_slice.h"

#include <catch2/catch.hpp>

namespace furrow::tests {

TEST_CASE("render_slice: a slice is blue inside, orange outside, black on the surface, and upright") {
  struct Floor : physics::Collider {  // solid below y = 0
    physics::SignedDistance at(const physics::Vec3& x) const override { return {x.y(), {0, 1, 0}}; }
  };
  const io::Image image = io::render_slice(Floor(), {0, -0.1, 0}, {0.2, 0.1, 0}, 200);
  REQUIRE(image.width == 200);
  REQUIRE(image.height == 200);
  const auto pixel = [&](int row) { return &image.rgb[3 * (200 * row + 100)]; };
  CHECK(pixel(40)[0] > pixel(40)[2]);
  CHECK(pixel(160)[2] > pixel(160)[0]);
  CHECK(int(pixel(100)[0]) + pixel(100)[1] + pixel(100)[2] == 0);
  CHECK_THROWS_AS(io::render_slice(Floor(), {0, 0, 0}, {1, 1, 1}, 3), std::invalid_argument);
}

}  // namespace furrow::tests
