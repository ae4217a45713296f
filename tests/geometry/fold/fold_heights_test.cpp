// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/fold/fold_heights.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace furrow::geometry;

namespace {

using Vec3 = Eigen::Vector3d;
constexpr double section_width = 0.06, section_height = 0.01;

void measure(FoldCurve& curve) {
  curve.arc.assign(1, 0);
  for (std::size_t i = 1; i < curve.points.size(); ++i)
    curve.arc.push_back(curve.arc.back() + (curve.points[i] - curve.points[i - 1]).norm());
  curve.length = curve.arc.back();
  if (curve.closed) curve.length += (curve.points.front() - curve.points.back()).norm();
  curve.width.assign(curve.points.size(), section_width);
  curve.height.assign(curve.points.size(), section_height);
}

/// Along x from 0 to `length`, both ends on a border: no taper.
FoldCurve straight(double length, int points = 201) {
  FoldCurve curve;
  for (int i = 0; i < points; ++i) curve.points.emplace_back(length * i / (points - 1), 0, 0);
  curve.begins_at_border = curve.ends_at_border = true;
  measure(curve);
  return curve;
}

FoldCurve ring(double radius, int points = 240) {
  FoldCurve curve;
  curve.closed = true;
  for (int i = 0; i < points; ++i) {
    const double a = 2 * std::numbers::pi * i / points;
    curve.points.emplace_back(radius * std::cos(a), radius * std::sin(a), 0);
  }
  measure(curve);
  return curve;
}

}  // namespace

TEST_CASE("fold_heights: a straight line has the section k (1 - t^2)^(5/2) up to the border") {
  const FoldHeight fold(straight(0.5));
  for (const double x : {0.0, 0.001, 0.2, 0.25, 0.5})
    for (double t = 0; t < 1.3; t += 0.05) {
      const double wanted = t < 1 ? section_height * std::pow(1 - t * t, 2.5) : 0;
      CHECK(fold.at(Vec3(x, t * section_width / 2, 0)) == Approx(wanted).margin(1e-4 * section_height));
    }
  FoldCurve sharp = straight(0.5);
  sharp.sharpness = 1;
  CHECK(FoldHeight(sharp).at(Vec3(0.2, section_width / 8, 0)) == Approx(0.75 * section_height).epsilon(1e-9));
}

TEST_CASE("fold_heights: a line with free ends reaches its height, however short it is") {
  for (const double length : {0.06, 0.09, 0.15, 0.4})
    for (const double sharpness : {0.0, 1.0}) {
      FoldCurve curve = straight(length);
      curve.begins_at_border = curve.ends_at_border = false;
      curve.rise = {std::min(1.5 * section_width, 0.45 * length),
                    std::min(1.5 * section_width, 0.45 * length)};
      curve.sharpness = sharpness;
      const FoldHeight fold(curve);
      double most = 0;
      for (int i = 0; i <= 200; ++i) most = std::max(most, fold.at(Vec3(length * i / 200, 0, 0)));
      CHECK(most == Approx(section_height).epsilon(0.003));  // the width grows along it, too
    }
}

TEST_CASE("fold_heights: the section does not depend on how densely the curve is sampled") {
  const FoldHeight coarse(straight(0.5, 167)), fine(straight(0.5, 1001));  // width / 20, width / 120
  for (double y = 0; y < section_width / 2; y += section_width / 30)
    CHECK(coarse.at(Vec3(0.2503, y, 0)) == Approx(fine.at(Vec3(0.2503, y, 0))).margin(2e-4 * section_height));
}

TEST_CASE("fold_heights: a ring of small radius has its height at the crest all around") {
  for (const double radius : {0.025, 0.04, 0.1}) {
    const FoldHeight fold(ring(radius));
    for (double a = 0; a < 6; a += 0.37)
      CHECK(fold.at(radius * Vec3(std::cos(a), std::sin(a), 0)) == Approx(section_height).epsilon(2e-3));
  }
}

TEST_CASE("fold_heights: a free end rises as a smoothstep, and is narrower there") {
  FoldCurve curve = straight(0.5, 401);
  curve.begins_at_border = curve.ends_at_border = false;
  curve.rise = {0.2, 0};
  const FoldHeight fold(curve);
  CHECK(fold.taper_at(0) == 0);
  CHECK(fold.taper_at(0.1) == Approx(0.5));
  CHECK(fold.taper_at(0.2) == 1);
  CHECK(std::abs(fold.at(Vec3(0, 0, 0))) < 0.02 * section_height);
  CHECK(fold.at(Vec3(0.1, 0, 0)) == Approx(0.5 * section_height).epsilon(0.02));
  CHECK(fold.at(Vec3(0.3, 0, 0)) == Approx(section_height).epsilon(1e-3));
  const double there = fold.at(Vec3(0.05, 0.3 * section_width, 0)) / fold.at(Vec3(0.05, 0, 0));
  CHECK(there < 0.7 * fold.at(Vec3(0.3, 0.3 * section_width, 0)) / section_height);
}

TEST_CASE("fold_heights: height and width follow the numbers along the line") {
  FoldCurve curve = straight(0.6, 601);
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    curve.height[i] = 0.02 * curve.arc[i] / 0.6;
    curve.width[i] = 0.05 + 0.05 * curve.arc[i] / 0.6;
  }
  const FoldHeight fold(curve);
  for (const double x : {0.15, 0.3, 0.45}) {
    CHECK(fold.at(Vec3(x, 0, 0)) == Approx(0.02 * x / 0.6).epsilon(0.01));
    const double w = 0.05 + 0.05 * x / 0.6;
    CHECK(fold.at(Vec3(x, 0.49 * w, 0)) < 0.01 * fold.at(Vec3(x, 0, 0)));
    CHECK(fold.at(Vec3(x, 0.25 * w, 0)) == Approx(std::pow(0.75, 2.5) * 0.02 * x / 0.6).epsilon(0.04));
  }
}

TEST_CASE("fold_heights: lines of one sign add to the higher plus half of the lower at most") {
  const auto joined = [](std::vector<double> h) { return joined_heights(h); };
  CHECK(joined({}) == 0);
  CHECK(joined({0.01}) == 0.01);
  CHECK(joined({0.01, 0.01}) == Approx(0.015));
  CHECK(joined({-0.01, -0.01}) == Approx(-0.015));
  CHECK(joined({0.01, -0.004}) == Approx(0.006));
  for (double lower = 0; lower <= 1; lower += 0.01) {
    CHECK(joined({1, lower}) <= 1 + 0.5 * lower + 1e-12);
    CHECK(joined({1, lower}) >= 1);
    CHECK(joined({lower, 1}) == joined({1, lower}));
  }
}

TEST_CASE("fold_heights: cloth that is much farther along the surface than straight takes no share") {
  const FoldHeight fold(straight(0.5));
  const double radius = section_width / 2;
  for (double d = 0; d < 1.2 * radius; d += 0.1 * radius) {
    const Vec3 x(0.2, d, 0);
    CHECK(fold.share_at(x, d) == 1);
    CHECK(fold.share_at(x, 1.2 * d) == 1);  // the way over a curved limb
    if (d < radius) CHECK(fold.share_at(x, fold.reach()) == 0);
    double before = 1;
    for (double way = d; way < fold.reach(); way += 0.02 * radius) {  // no jump
      const double share = fold.share_at(x, way);
      CHECK(share <= before);
      CHECK(before - share < 0.08);
      before = share;
    }
  }
  // beyond a hem the curve's own end counts, not what goes on: an oblique hem keeps its fold
  CHECK(fold.share_at(Vec3(0.52, 0.2 * radius, 0), std::hypot(0.02, 0.2 * radius)) == 1);
}
