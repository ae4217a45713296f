// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/box_filter.h"

#include <catch2/catch.hpp>

#include "io/picture/prepared_scene.h"
#include "tests/io/picture/scenes.h"

namespace furrow::tests {
namespace {

TEST_CASE("box_filter: a pixel is the mean of its square in linear light") {
  io::Image image{4, 2, std::vector<std::uint8_t>(24, 100)};
  for (int k = 0; k < 3; ++k) image.rgb[std::size_t(k)] = 255, image.rgb[std::size_t(3 + k)] = 0;
  const io::Image half = io::box_filter(image, 2);
  REQUIRE(half.width == 2);
  REQUIRE(half.height == 1);
  const double mean = (1 + 0 + 2 * io::linear_light(100 / 255.0)) / 4;
  CHECK(pixel(half, 0, 0)[0] == std::lround(255 * io::srgb(mean)));
  CHECK(pixel(half, 1, 0) == std::array<int, 3>{100, 100, 100});
  CHECK(io::box_filter(image, 1).rgb == image.rgb);
}

TEST_CASE("box_filter: a factor that does not divide the sides is refused") {
  const io::Image image{4, 2, std::vector<std::uint8_t>(24, 100)};
  CHECK_THROWS_WITH(io::box_filter(image, 3), Catch::Contains("factor 3 does not divide 4 x 2"));
  CHECK_THROWS_AS(io::box_filter(image, 0), std::invalid_argument);
  CHECK_THROWS_AS(io::box_filter({4, 2, {}}, 2), std::invalid_argument);
}

TEST_CASE(
    "render: an oversampled picture is the large one filtered, with lines and wires of the same width") {
  io::RenderScene scene{{square({0, 0, 0}, 0.5, pure_green)}, {{{{-0.4, 0.1, 0}, {0.4, -0.2, 0}}, pure_red}}};
  scene.meshes[0].style = io::Style::cloth;
  io::RenderOptions options = from_the_front(40, 4);
  options.wire_pixels = 0.7;
  options.oversample = 3;
  io::RenderOptions large = from_the_front(120, 4);
  large.wire_pixels = 2.1;
  large.line_radius_pixels = 3 * options.line_radius_pixels;
  CHECK(io::render(scene, options).rgb == io::box_filter(io::render(scene, large), 3).rgb);
  options.oversample = 9;
  CHECK_THROWS_WITH(io::render(scene, options), Catch::Contains("oversample"));
}

}  // namespace
}  // namespace furrow::tests
