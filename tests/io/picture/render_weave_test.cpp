// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/picture/render_weave.h"

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/rest/warp_directions.h"
#include "tests/test_meshes.h"

using namespace furrow;

namespace {

Eigen::Vector3d at(const io::RenderLine& line, std::size_t i) {
  const auto& p = line.points.at(i);
  return {p[0], p[1], p[2]};
}
double length_of(const io::RenderLine& line) { return (at(line, 1) - at(line, 0)).norm(); }
Eigen::Vector3d middle_of(const io::RenderLine& line) { return (at(line, 0) + at(line, 1)) / 2; }

}  // namespace

TEST_CASE("render_weave: crosses of warp and weft, at right angles on the cloth, apart by the spacing") {
  geometry::Mesh mesh = tests::grid(5, 5);
  geometry::set_warp_along(mesh, {0, 1, 0});
  const double spacing = 0.1;
  const auto lines = io::weave_lines_from(mesh, spacing);
  REQUIRE(lines.size() % 2 == 0);
  CHECK(lines.size() / 2 > 50);   // a square of a hundred spacings, packed at random
  CHECK(lines.size() / 2 < 130);  // no denser than hexagons
  for (std::size_t i = 0; i < lines.size(); i += 2) {
    const auto &weft = lines[i], &warp = lines[i + 1];
    CHECK(length_of(warp) == Approx(0.7 * spacing).epsilon(1e-4));
    CHECK(length_of(weft) == Approx(0.35 * spacing).epsilon(1e-4));
    CHECK(std::abs(at(warp, 0).x() - at(warp, 1).x()) < 1e-6);
    CHECK(std::abs(at(weft, 0).y() - at(weft, 1).y()) < 1e-6);
    CHECK((middle_of(warp) - middle_of(weft)).norm() < 1e-5);
    for (std::size_t j = i + 2; j < lines.size(); j += 2)
      CHECK((middle_of(warp) - middle_of(lines[j + 1])).norm() > 0.999 * spacing);
  }
}

TEST_CASE("render_weave: faces without a direction get none, and a spacing of none is refused") {
  geometry::Mesh mesh = tests::grid(5, 5);
  CHECK(io::weave_lines_from(mesh, 0.1).empty());
  CHECK_THROWS_AS(io::weave_lines_from(mesh, 0), std::invalid_argument);
  CHECK(io::weave_spacing(mesh) == Approx(std::sqrt(2.) / 40));
}
