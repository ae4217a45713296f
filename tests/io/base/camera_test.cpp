// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/base/camera.h"

#include <rapidcheck.h>

#include <Eigen/Dense>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace furrow::tests {
namespace {

using Eigen::Vector3d;

Vector3d vector(const io::Position& p) { return {p[0], p[1], p[2]}; }

/// Largest |x| and |y| of the points in the picture, whose borders are at ±1; and the middle of their box.
struct Extent {
  double x = 0, y = 0, middle_depth = 0;
};

Extent extent(const io::Camera& camera, const std::vector<io::Position>& points, double aspect) {
  const Vector3d forward = (vector(camera.target) - vector(camera.eye)).normalized();
  const Vector3d right = forward.cross(vector(camera.up)).normalized(), up = right.cross(forward);
  const double slope = std::tan(camera.field_of_view_deg / 2 * std::numbers::pi / 180);
  Extent result;
  for (const auto& point : points) {
    const Vector3d p = vector(point) - vector(camera.eye);
    const double depth = p.dot(forward);
    if (!(depth > 0)) return {HUGE_VAL, HUGE_VAL, depth};
    result.x = std::max(result.x, std::abs(p.dot(right)) / (depth * slope * aspect));
    result.y = std::max(result.y, std::abs(p.dot(up)) / (depth * slope));
  }
  return result;
}

TEST_CASE("camera: the automatic camera holds all points inside the margins and touches them") {
  CHECK(rc::check([] {
    const auto coordinate = [] { return *rc::gen::inRange(-1000, 1000) * 1e-3; };
    std::vector<io::Position> points;
    for (int i = *rc::gen::inRange(8, 40); i > 0; --i) {
      points.push_back({coordinate() + 5, coordinate() * 2, coordinate()});
    }
    points.push_back({4, -2, -1});  // the corners of the box: no cloud is seen end on
    points.push_back({6, 2, 1});
    points.push_back({6, -2, 1});
    points.push_back({4, 2, 1});
    io::View view;
    view.azimuth_deg = *rc::gen::inRange(-180, 180);
    view.elevation_deg = *rc::gen::inRange(-60, 60);
    const double aspect = *rc::gen::inRange(5, 20) * 0.1;
    const Extent seen = extent(io::frame_points(points, aspect, view), points, aspect);
    const double border = 1 - 2 * view.margin;
    RC_ASSERT(seen.x <= border + 1e-9);
    RC_ASSERT(seen.y <= border + 1e-9);
    RC_ASSERT(std::max(seen.x, seen.y) >= border - 1e-9);
  }));
}

TEST_CASE("camera: the automatic camera looks from the front, right of the middle and above") {
  const std::vector<io::Position> box{{-1, 0, -1}, {1, 2, 1}, {-1, 2, 1}, {1, 0, -1}};
  const io::Camera camera = io::frame_points(box, 1);
  CHECK(camera.eye[2] > 1);
  CHECK(camera.eye[0] > 0);
  CHECK(camera.eye[1] > 1);
  CHECK(camera.up == io::Position{0, 1, 0});
}

TEST_CASE("camera: a line along the sight is framed from outside of it") {
  io::View view;
  view.azimuth_deg = view.elevation_deg = 0;
  const io::Camera camera = io::frame_points({{0, 0, 0}, {0, 0, 1}}, 1, view);
  CHECK(camera.eye[2] > 1.05);
}

TEST_CASE("camera: nothing to frame and values out of range are refused") {
  const std::vector<io::Position> points{{0, 0, 0}, {1, 1, 1}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(io::frame_points({}, 1), std::invalid_argument);
  CHECK_THROWS_AS(io::frame_points({{1, 1, 1}, {1, 1, 1}}, 1), std::invalid_argument);
  CHECK_THROWS_AS(io::frame_points({{1, 1, nan}, {1, 1, 1}}, 1), std::invalid_argument);
  CHECK_THROWS_AS(io::frame_points(points, 0), std::invalid_argument);
  CHECK_THROWS_AS(io::frame_points(points, nan), std::invalid_argument);
  CHECK_THROWS_WITH(io::frame_points(points, 1, {0, 86, 28, 0.1}), Catch::Contains("elevation_deg: 86"));
  CHECK_THROWS_WITH(io::frame_points(points, 1, {0, 0, 0.5, 0.1}), Catch::Contains("field_of_view_deg"));
  CHECK_THROWS_WITH(io::frame_points(points, 1, {0, 0, 28, 0.5}), Catch::Contains("margin"));
  CHECK_THROWS_WITH(io::frame_points(points, 1, {nan, 0, 28, 0.1}), Catch::Contains("azimuth_deg"));
}

}  // namespace
}  // namespace furrow::tests
