// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/field_file.h"

#include <catch2/catch.hpp>

#include "geometry/mesh/errors.h"
#include "io/base/bytes_file.h"
#include "io/picture/render_slice.h"
#include "tests/io/base/io_test_helpers.h"

namespace furrow::tests {

namespace {

physics::TriangleMesh tetrahedron(double size) {
  return {{{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}},
          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

}  // namespace

TEST_CASE(
    "field_file: a field file gives the field back for its body, and refuses another body or a cut file",
    "[long]") {
  const auto path = std::filesystem::temp_directory_path() / "furrow-field-file-test.field";
  const physics::TriangleMesh body = tetrahedron(0.5);
  const auto field = physics::DistanceField::build(body);
  io::write_field(path, field, body);
  CHECK(io::read_field(path, body).to_bytes() == field.to_bytes());
  CHECK_THROWS_AS(io::read_field(path, tetrahedron(0.6)), geometry::ContentError);
  auto bytes = io::read_bytes(path);
  bytes.resize(bytes.size() / 2);
  io::write_bytes(path, bytes);
  CHECK_THROWS_AS(io::read_field(path, body), geometry::ContentError);
  std::filesystem::remove(path);
}

TEST_CASE("field_file: a slice is blue inside, orange outside, black on the surface, and upright") {
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
